// SPDX-License-Identifier: GPL-3.0-or-later
// An interactive session in one Lua state. An expression prints its value; an incomplete statement waits for
// more lines; a top-level `local` becomes a global. A failing line restores all variables, not the contents
// of tables, and clears the hook. No terminal codes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/editor/completion.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

class Prompt {
 public:
  // Sets globals `lab` and `show`. Throws Error{out_of_memory}.
  explicit Prompt(lua_State* state);

  enum class Outcome { done, more, failed, end };
  // `number`: of the input line. `more`: the statement is incomplete. `failed`: see error(); the next line
  // may follow. `end`: the line is `exit` or `quit`. `who` lists the variables.
  Outcome take(std::string_view line, int number = 1);
  // Runs an earlier prompt's script() and appends `why` as a comment. Never `more`.
  Outcome run_again(const std::string& script, const std::string& why);
  // With traceback inside functions.
  const std::string& error() const { return error_; }

  bool continued() const { return !waiting_.empty(); }
  void forget() { waiting_.clear(); }

  Completion complete(std::string_view line, std::size_t position) const;

  // All lines that succeeded.
  std::string script() const { return script_; }

 private:
  bool load(const std::string& text);
  Outcome run(const std::string& text, bool is_expression, bool has_owner);
  void remember(const std::string& text, bool is_expression);
  void show_results(int first, const std::string& text);
  void show_text(std::string text) const;
  std::string bench_text() const;
  std::string with_unit(const std::string& expression, int index) const;
  std::string with_unit_of(int owner, std::string_view field, int index) const;
  std::vector<LiveGlobal> live_globals() const;
  void restore_globals();

  lua_State* L;
  std::string waiting_;
  int first_line_ = 1;
  std::string error_;
  std::string script_ = "lab = require \"asperity\"\n";
};

// `local x = 1` becomes `x = 1`, `local x` becomes `x = nil`, on the same lines.
std::string with_lasting_locals(const std::string& text);

// Raises a Lua error without memory.
void push_show(lua_State* L);

// "814.7 pm (8.147e-10 m)"
std::string shown_quantity(double value, Dimension dimension);

}  // namespace asperity::lua
