// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever follows a run from outside, such as the page: it hears what a terminal would show, as values.
#pragma once

#include <string>
#include <string_view>

#include "bindings/lua/registry/value.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::cli {

// Called from the run's threads, one call at a time of each kind.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  // `done` in [0, 1]; `seconds_left` is negative where it is not known.
  virtual void progress(std::string_view task, double done, double seconds_left) = 0;
  // A line of the journal, once it is written.
  virtual void recorded(std::string_view event, const Json& fields) = 0;
  // What a heavy call found, at journal line `line`.
  virtual void found(const std::string& call, std::int64_t line, const lua::Values& results) = 0;
  // Whether found() is to be called.
  virtual bool looks_at_results() const { return false; }
  // A mistake that does not end a check; the last mistake is the reason of its end.
  virtual void mistake(const std::string&) {}
  // What a check that came to its end knows of the script's knobs, as RunKnobs::json() says it.
  virtual void made_knobs(const Json&) {}
  // The end, with why the run failed, "" if it did not. It may be the last that the process does.
  virtual void ended(int status, StopReason stopped, const std::string& why) = 0;
};

}  // namespace asperity::cli
