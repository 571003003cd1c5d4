// SPDX-License-Identifier: GPL-3.0-or-later
// The mistakes of a dry run that goes on past them: a call or a field that is refused is noted with its
// place, and the script goes on with a placeholder for its result. So one run tells all mistakes of a file.
// An error that a pcall of the script catches is raised, as in a run, and is a note. An error of Lua itself,
// and a path that depends on a result, end the dry run as ever.
#pragma once

#include <map>
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
  // A remark that does not make the script wrong.
  void note(const std::string& message) {
    if (known_.insert(message).second) notes_.push_back(message);
  }
  // In the order of the script's path.
  const std::vector<std::string>& messages() const { return messages_; }
  const std::vector<std::string>& notes() const { return notes_; }

  std::string script;  // its text
  // The columns that the script has written so far, by notebook; an empty one stands for any.
  std::map<std::string, std::set<std::string>> columns;

 private:
  std::set<std::string> known_;
  std::vector<std::string> messages_, notes_;
};

// Notes the error on top of the stack, takes it off and returns true, in a dry run that goes on past
// mistakes. Returns false, with the stack as it was, where the error is to be raised: in every other run,
// when the run was stopped, and where the script's path depends on a result. Raises nothing.
bool noted_as_mistake(lua_State* L);

}  // namespace asperity::lua
