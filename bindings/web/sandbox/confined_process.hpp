// SPDX-License-Identifier: GPL-3.0-or-later
// A confined process (confined.hpp) as its parent sees it: this program started again, with nothing inherited
// but the pipes between the two.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "bindings/web/confined/confined.hpp"

namespace asperity::web {

// A file descriptor that is closed with its owner.
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

// It dies with the thread that made it.
class ConfinedProcess {
 public:
  // Throws Error{bad_state} where it cannot be started.
  ConfinedProcess(const ConfinedRequest& request, const std::string& folder);
  // Killed, if it has not ended, and waited for.
  ~ConfinedProcess();
  ConfinedProcess(const ConfinedProcess&) = delete;
  ConfinedProcess& operator=(const ConfinedProcess&) = delete;

  Descriptor output, error, events, drawing;  // this side's ends

  void send(int signal) const;
  // The status of waitpid, once it has ended.
  std::optional<int> ended();
  // That it used, once it has ended.
  double processor_seconds() const { return processor_seconds_; }

 private:
  pid_t process_ = -1;
  std::optional<int> status_;
  double processor_seconds_ = 0;
};

struct Finished {
  int status = -1;                    // of exit; -1 if it died of a signal
  bool late = false;                  // it was killed because it took too long
  std::string output, error, events;  // each cut after the bytes that were allowed
};
// Runs one to its end; it is killed, and counts as late, as soon as `given_up` is true, which may be null.
// Throws as above.
Finished run_confined(const ConfinedRequest& request, const std::string& folder,
                      std::chrono::milliseconds patience, std::size_t most_bytes,
                      const std::atomic<bool>* given_up = nullptr);

}  // namespace asperity::web
