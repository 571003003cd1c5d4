// SPDX-License-Identifier: GPL-3.0-or-later
// Many calls of one script function, spread over threads. Each call runs in its own Lua state with a fresh
// copy of the function's data. Results are stored with the run; their bits do not depend on the number of
// threads. ensemble/ implements the interface.
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
  // Returns one answer per list of arguments, in order; answers after the first failure may be empty. The
  // calling thread reports the number of finished calls to `done`. Throws Error if an argument cannot be
  // copied, and after a stop once every call has ended.
  virtual std::vector<BatchedAnswer> answers(const std::vector<Values>& arguments,
                                             const std::function<void(std::size_t)>& done) = 0;
};

// Null if the function uses values that cannot be copied to another state, such as a contact, or if parallel
// calls are not allowed. Calls do not see each other's changes. The batch must not outlive `call`.
std::unique_ptr<CallBatch> call_batch(const Call& call, const Argument& function, const std::string& name);

}  // namespace asperity::lua
