// SPDX-License-Identifier: GPL-3.0-or-later
// Many calls of one script function on threads, each in its own Lua state with a fresh copy of the data.
// Answers are stored with the run; bits do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/registry/value.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::lua {

class Argument;
class Call;

// Passes warnings and stored results on, progress only to `tell`.
class QuietMonitor final : public Monitor {
 public:
  explicit QuietMonitor(Monitor& outer, std::function<void(double)> tell = {})
      : outer_(outer), tell_(std::move(tell)) {}
  void progress(std::string_view, double done) override {
    if (tell_) tell_(done);
  }
  void warn(std::string_view sentence) override { outer_.warn(sentence); }
  void inform(std::string_view sentence) override {
    if (tell_) outer_.inform(sentence);
  }
  ResultStore* results() override { return outer_.results(); }

 private:
  Monitor& outer_;
  std::function<void(double)> tell_;
};

struct BatchedAnswer {
  std::optional<double> number;
  bool nil = false;
  std::string other;  // if no number, "the string \"steep\""
  std::string failure;
  double seconds = 0;  // on one thread, also if stored
};

class CallBatch {
 public:
  virtual ~CallBatch() = default;
  // One answer per list of arguments, in order; answers after the first failure may be empty. The calling
  // thread reports finished calls to `done`. Throws Error if an argument cannot be copied, and after a stop
  // once every call has ended.
  virtual std::vector<BatchedAnswer> answers(const std::vector<Values>& arguments,
                                             const std::function<void(std::size_t)>& done) = 0;
};

// Null if the function uses uncopyable values, such as a contact, or may not run in parallel. Calls are
// independent. Must not outlive `call`.
std::unique_ptr<CallBatch> call_batch(const Call& call, const Argument& function, const std::string& name);

}  // namespace asperity::lua
