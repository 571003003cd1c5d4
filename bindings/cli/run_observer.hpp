// SPDX-License-Identifier: GPL-3.0-or-later
// An observer of a run, such as the page, receives as values everything that a terminal would show.
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
  // A journal line, after writing.
  virtual void recorded(std::string_view event, const Json& fields) = 0;
  // The results of a heavy call at journal line `line`.
  virtual void found(const std::string& call, std::int64_t line, const lua::Values& results) = 0;
  // Enables found().
  virtual bool looks_at_results() const { return false; }
  // A mistake that does not end a check; the last mistake is the reason of its end.
  virtual void mistake(const std::string&) {}
  // The script's knobs at the end of a check, as RunKnobs::json().
  virtual void made_knobs(const Json&) {}
  // The end, with the reason of a failure or "". Possibly the last call of the process.
  virtual void ended(int status, StopReason stopped, const std::string& why) = 0;
};

}  // namespace asperity::cli
