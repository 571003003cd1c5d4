// SPDX-License-Identifier: GPL-3.0-or-later
// Many calls of one function of the script, spread over threads as the cases of an ensemble are: each in a
// Lua state of its own with a fresh copy of everything the function uses, kept in the store of the run, the
// same bits for any number of threads. Studies call through this; the room of ensembles, which stands above
// them, defines how.
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
  bool nil = false;     // nothing was returned
  std::string other;    // what was returned in place of a number, "the string \"steep\""; of nothing, too
  std::string failure;  // why there is no answer
  double seconds = 0;   // on one thread; of a call that is kept those it took
};

class CallBatch {
 public:
  virtual ~CallBatch() = default;
  // An answer for each list of arguments, in order; behind the first that failed they may be empty. `done` is
  // told now and then how many there are, by the calling thread. Throws Error where an argument is no data,
  // and when the run is to stop, after every call has ended.
  virtual std::vector<BatchedAnswer> answers(const std::vector<Values>& arguments,
                                             const std::function<void(std::size_t)>& done) = 0;
};

// Null where the function reaches what cannot be copied into another state, such as a contact, and where
// nothing may be spread. What one call changes is seen by no other. Not to outlive the call.
std::unique_ptr<CallBatch> call_batch(const Call& call, const Argument& function, const std::string& name);

}  // namespace asperity::lua
