// SPDX-License-Identifier: GPL-3.0-or-later
// Many calls of one script function on threads, each in its own Lua state with a fresh copy of the data.
// Answers are stored with the run; bits do not depend on the number of threads. Implemented in ensemble/.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

class Argument;
class Call;

struct BatchedAnswer {
  std::optional<double> number;
  bool nil = false;
  std::string other;  // a non-numeric or missing result, "the string \"steep\""
  std::string failure;
  double seconds = 0;  // on one thread; a stored answer has its original time
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

// Null if the function uses uncopyable values, such as a contact, or may not run in parallel. Calls do not
// see each other's changes. Must not outlive `call`.
std::unique_ptr<CallBatch> call_batch(const Call& call, const Argument& function, const std::string& name);

}  // namespace asperity::lua
