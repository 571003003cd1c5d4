// SPDX-License-Identifier: GPL-3.0-or-later
// Receives as values everything that a terminal would show, for example for the page.
#pragma once

#include <string>
#include <string_view>

#include "bindings/lua/registry/value.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::cli {

// Called by the run's threads; calls of one kind never overlap.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  // `done` in [0, 1]; `seconds_left` is negative if unknown.
  virtual void progress(std::string_view task, double done, double seconds_left) = 0;
  // After writing the journal line.
  virtual void recorded(std::string_view event, const Json& fields) = 0;
  // Results of a heavy call at journal line `line`.
  virtual void found(const std::string& call, std::int64_t line, const lua::Values& results) = 0;
  // Enables found().
  virtual bool looks_at_results() const { return false; }
  // During a check. The last mistake is the reason of the end.
  virtual void mistake(const std::string&) {}
  // At the end of a check, as RunKnobs::json().
  virtual void made_knobs(const Json&) {}
  // `why`: reason of a failure, or "". Possibly the process's last call.
  virtual void ended(int status, StopReason stopped, const std::string& why) = 0;
};

}  // namespace asperity::cli
