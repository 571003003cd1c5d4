// SPDX-License-Identifier: GPL-3.0-or-later
// A conversation with the laboratory, line by line, in one Lua state. An expression shows its value; a
// statement that is not whole waits for more lines; what `local` declares at the top of a line stays for the
// lines after it (as a global: the lines of a prompt are one script). A line that fails leaves every variable
// as it was before it, though not what is inside tables that it changed; the state's hook is then gone. Knows
// nothing of terminals: lines come as text, what is shown goes to the session's output.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/editor/completion.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

class Prompt {
 public:
  // Gives the state the globals `lab` and `show`. Throws Error{out_of_memory}.
  explicit Prompt(lua_State* state);

  enum class Outcome { done, more, failed };
  // Takes the next line, which is line `number` of whatever it comes from. `more`: what came so far is not
  // whole. `failed`: error() says why, and the state is ready for the next line.
  Outcome take(std::string_view line, int number = 1);
  // Runs what an earlier prompt, in another state, became, from its start: `script` is its script(). Then a
  // line of the script says why. `more` never.
  Outcome run_again(const std::string& script, const std::string& why);
  // A message as a run prints it, with a traceback where functions of the script were running.
  const std::string& error() const { return error_; }

  // Whether lines wait for more; and what they are.
  bool continued() const { return !waiting_.empty(); }
  void forget() { waiting_.clear(); }

  // What may come next in the line that is being typed.
  Completion complete(std::string_view line, std::size_t position) const;

  // What was said so far as a script: the lines that ended well.
  std::string script() const { return script_; }

 private:
  bool load(const std::string& text);
  Outcome run(const std::string& text, bool is_expression, bool has_owner);
  void remember(const std::string& text, bool is_expression);
  void show_results(int first, const std::string& text);
  void show_text(std::string text) const;
  std::string with_unit(const std::string& expression, int index) const;
  std::string with_unit_of(int owner, std::string_view field, int index) const;
  std::vector<LiveGlobal> live_globals() const;
  void keep_globals();
  void restore_globals();

  lua_State* L;
  std::string waiting_;
  int first_line_ = 1;
  std::string error_;
  std::string script_ = "lab = require \"asperity\"\n";
};

// The text with what `local` declares outside blocks and functions made to stay: `local x = 1` reads `x = 1`.
// Places of all other words stay as they are.
std::string with_lasting_locals(const std::string& text);

// Pushes show(value) (show.cpp), what a prompt draws in the terminal. A surface or a field of a state as a
// map, a profile or the columns of a notebook as a chart; with the name of a file, the picture goes there
// instead. Raises on lack of memory.
void push_show(lua_State* L);

// --- how a value is shown (shown_line.cpp)

// Never raises; what cannot be shown says why.
std::string shown_line(lua_State* L, int index);
// A number with its unit, readable and as it is: "814.7 pm (8.147e-10 m)".
std::string shown_quantity(double value, Dimension dimension);

}  // namespace asperity::lua
