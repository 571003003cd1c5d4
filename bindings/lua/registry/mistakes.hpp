// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes of a dry run that continues after them, so that one run reports all. A refused call or field is
// noted with its place and returns a placeholder. An error caught by a pcall is raised and noted. Lua's own
// errors, and paths that depend on a result, end the dry run.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

class Mistakes {
 public:
  // A repeated message counts once.
  void add(const std::string& message) {
    if (known_.insert(message).second) messages_.push_back(message);
  }
  void note(const std::string& message) {
    if (known_.insert(message).second) notes_.push_back(message);
  }
  const std::vector<std::string>& messages() const { return messages_; }
  const std::vector<std::string>& notes() const { return notes_; }

  std::string script;
  // By notebook; an empty name stands for any column.
  std::map<std::string, std::set<std::string>> columns;

 private:
  std::set<std::string> known_;
  std::vector<std::string> messages_, notes_;
};

// In a dry run that continues after mistakes: notes and pops the error on the stack, returns true. Returns
// false, changing nothing, if the error must be raised: in other runs, after a stop, or if the script's path
// depends on a result. Raises nothing.
bool noted_as_mistake(lua_State* L);

}  // namespace asperity::lua
