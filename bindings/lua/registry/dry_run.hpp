// SPDX-License-Identifier: GPL-3.0-or-later
// Values and mistakes of a dry run. A skipped call returns an object of the declared class, which still
// checks names of fields and methods, or an unknown number, which arithmetic passes on. If the script's path
// depends on it, the dry run stops with `cannot_follow`.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

// `item`: the records of an unknown list, whose fields are checked.
void push_unknown(lua_State* L, const RecordInfo* item = nullptr);
// "Surface", "number", "Profile[]", "Roughness", "Profile[] with lines: Traverse[]".
Value placeholder_of(const std::string& type);

// Searches tables to `depth` levels.
bool holds_unknown(const Argument& value, int depth);

// Prefix of the final message.
inline constexpr const char* cannot_follow =
    "the script's path depends on a result that is not known before the run";

bool stopped_at_placeholder(const std::string& message);
// Lua's complaint about nil; the real result may have more parts than a placeholder.
bool met_nothing(const std::string& message);
// Line number of "script.lua:12: …"; "?" if none.
std::string line_of(const std::string& message);
// The message after the place, to the end of the line.
std::string without_place(const std::string& message);

// Replaces functions that fail on placeholders. Raises on lack of memory.
void open_dry_run_library(lua_State* L);

// Mistakes of a dry run that reports all in one run: a refused call or field is noted with its place and
// returns a placeholder. An error caught by a pcall is raised and noted. Lua's own errors, and paths that
// depend on a result, end the dry run.
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

// Raises the error on the stack, or returns a placeholder in a dry run that continues after mistakes.
int mistaken_field(lua_State* L);

}  // namespace asperity::lua
