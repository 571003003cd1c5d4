// SPDX-License-Identifier: GPL-3.0-or-later
// The parent's side of a confined process (confined.hpp): this program started again, inheriting only its
// pipes.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "bindings/web/confined/confined.hpp"

namespace asperity::web {

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const { return number_; }
  void reset();

 private:
  int number_ = -1;
};

// Dies with its creating thread.
class ConfinedProcess {
 public:
  // Throws Error{bad_state} if the process cannot start.
  ConfinedProcess(const ConfinedRequest& request, const std::string& folder);
  // Kills and waits.
  ~ConfinedProcess();
  ConfinedProcess(const ConfinedProcess&) = delete;
  ConfinedProcess& operator=(const ConfinedProcess&) = delete;

  Descriptor output, error, events, drawing;  // this side's ends

  void send(int signal) const;
  // The waitpid status after the end.
  std::optional<int> ended();
  double processor_seconds() const { return processor_seconds_; }

 private:
  pid_t process_ = -1;
  std::optional<int> status_;
  double processor_seconds_ = 0;
};

struct Finished {
  int status = -1;                    // exit status; -1 after a signal
  bool late = false;                  // killed at the time limit
  std::string output, error, events;  // each cut at `most_bytes`
};
// Runs a process to its end; kills it as late at the time limit or when `given_up` (may be null) is true.
Finished run_confined(const ConfinedRequest& request, const std::string& folder,
                      std::chrono::milliseconds patience, std::size_t most_bytes,
                      const std::atomic<bool>* given_up = nullptr);

}  // namespace asperity::web
