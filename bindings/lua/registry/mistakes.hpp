// SPDX-License-Identifier: GPL-3.0-or-later
// The mistakes of a dry run that goes on past them: a call or a field that is refused is noted with its
// place, and the script goes on with a placeholder for its result, in functions given to pcall too. So one
// run tells all mistakes of a file. An error of Lua itself, and a path that depends on a result, end the
// dry run as ever.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

class Mistakes {
 public:
  // Of a loop each message counts once.
  void add(const std::string& message) {
    if (known_.insert(message).second) messages_.push_back(message);
  }
  // In the order of the script's path.
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::set<std::string> known_;
  std::vector<std::string> messages_;
};

// Notes the error on top of the stack, takes it off and returns true, in a dry run that goes on past
// mistakes. Returns false, with the stack as it was, where the error is to be raised: in every other run,
// when the run was stopped, and where the script's path depends on a result. Raises nothing.
bool noted_as_mistake(lua_State* L);

}  // namespace asperity::lua
