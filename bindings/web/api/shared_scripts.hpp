// SPDX-License-Identifier: GPL-3.0-or-later
// Scripts that pass between the teacher and the students of a classroom: the one handed to the room, and
// those sent with a request for help. In memory, bounded. Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace asperity::web {

struct SharedScript {
  std::string name, script;
};

class SharedScripts {
 public:
  static constexpr std::size_t most_handed = std::size_t{256} << 10, most_shown = std::size_t{64} << 10;

  // The number grows with each script, also over server starts.
  struct Handed {
    std::int64_t number = 0;
    std::optional<SharedScript> script;
  };
  // Replaces the script of the room; none takes it back.
  void hand(std::optional<SharedScript> script);
  Handed handed() const;

  // None ends the request for help.
  void show(std::size_t person, std::optional<SharedScript> script);
  std::optional<SharedScript> shown_by(std::size_t person) const;

 private:
  mutable std::mutex mutex_;
  Handed handed_;
  std::map<std::size_t, SharedScript> shown_;
};

}  // namespace asperity::web
