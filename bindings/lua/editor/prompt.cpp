// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/prompt.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/error.hpp"

namespace asperity::lua {

namespace {

const char kept_key = 0;  // registry key of the former globals

constexpr const char* chunk_name = "=prompt";

// restore_action() also removes new globals.
int keep_action(lua_State* L) {
  lua_newtable(L);
  lua_pushglobaltable(L);
  copy_entries(L, 2, 1);
  lua_pop(L, 1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &kept_key);
  return 0;
}

int restore_action(lua_State* L) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kept_key) != LUA_TTABLE) return 0;
  lua_pushglobaltable(L);
  lua_pushnil(L);
  while (lua_next(L, 2) != 0) {
    lua_pop(L, 1);
    lua_pushvalue(L, -1);
    if (lua_rawget(L, 1) == LUA_TNIL) {
      lua_pushvalue(L, -2);
      lua_pushnil(L);
      lua_rawset(L, 2);
    }
    lua_pop(L, 1);
  }
  copy_entries(L, 1, 2);
  return 0;
}

// A traceback without functions repeats the message.
std::string without_idle_traceback(std::string message) {
  const std::size_t at = message.find("\nstack traceback:");
  if (at == std::string::npos) return message;
  const std::string_view trace = std::string_view(message).substr(at + 1);
  bool tells = false;
  for (std::size_t line = trace.find('\n'); line != std::string_view::npos;) {
    const std::size_t next = trace.find('\n', line + 1);
    const std::string_view frame = trace.substr(line + 1, next - line - 1);
    const bool idle = frame.empty() || frame.find("[C]") != std::string_view::npos ||
                      frame.find("sandbox:") != std::string_view::npos ||
                      frame.find("in main chunk") != std::string_view::npos;
    tells = tells || !idle;
    line = next;
  }
  if (!tells) message.resize(at);
  return message;
}

// Start of a final `.field` after a call, else 0.
std::size_t owner_of_field(const std::string& text) {
  const ScriptTypes script(text, read_tokens(text).list, {});
  const std::size_t end = script.size();
  if (end < 4 || script.token(end - 1).kind != Token::Kind::name || !script.is(end - 2, ".")) return 0;
  if (!script.is(end - 3, ")") && !script.is(end - 3, "}")) return 0;
  return script.chain_begin(end - 3) == 0 ? script.token(end - 2).begin : 0;
}

std::string field_at_end(const std::string& text) {
  const std::vector<Token> tokens = read_tokens(text).list;
  return text.substr(tokens.back().begin, tokens.back().end - tokens.back().begin);
}

// In a script, nothing may follow `return`.
std::string without_return(std::string text) {
  const std::vector<Token> tokens = read_tokens(text).list;
  constexpr std::string_view word = "return";
  if (!tokens.empty() &&
      std::string_view(text).substr(tokens[0].begin, tokens[0].end - tokens[0].begin) == word)
    text.replace(tokens[0].begin, word.size(), word.size(), ' ');
  return text;
}

std::string one_line(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n;");
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

}  // namespace

std::string with_lasting_locals(const std::string& text) {
  const ScriptTypes script(text, read_tokens(text).list, {});
  std::string changed = text;
  std::vector<std::size_t> without_value;
  const auto blank = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      if (changed[k] != '\n') changed[k] = ' ';
  };
  for (std::size_t k = 0; k < script.size(); ++k) {
    if (!script.is(k, "local") || script.around(k) != ScriptTypes::none) continue;
    blank(script.token(k).begin, script.token(k).end);
    if (script.is(k + 1, "function")) continue;
    std::size_t n = k + 1;
    while (n < script.size() && script.token(n).kind == Token::Kind::name) {
      ++n;
      if (script.is(n, "<") && n + 2 < script.size()) {
        blank(script.token(n).begin, script.token(n + 2).end);
        n += 3;
      }
      if (!script.is(n, ",")) break;
      ++n;
    }
    if (!script.is(n, "=") && n > k + 1) without_value.push_back(script.token(n - 1).end);
  }
  for (auto at = without_value.rbegin(); at != without_value.rend(); ++at) changed.insert(*at, " = nil");
  return changed;
}

Prompt::Prompt(lua_State* state) : L(state) {
  auto action = [](lua_State* inner) {
    luaL_requiref(
        inner, "asperity", [](lua_State* s) { return push_library(s), 1; }, 0);
    lua_pushglobaltable(inner);
    lua_insert(inner, -2);
    lua_pushliteral(inner, "lab");
    lua_insert(inner, -2);
    lua_rawset(inner, -3);
    lua_pushliteral(inner, "show");
    push_show(inner);
    lua_rawset(inner, -3);
    return 0;
  };
  if (protect(L, 0, 0, action) != LUA_OK)
    throw Error(ErrorCode::out_of_memory, "the prompt could not be set up: " + error_text(L, -1));
}

bool Prompt::load(const std::string& text) {
  return luaL_loadbufferx(L, text.data(), text.size(), chunk_name, "t") == LUA_OK;
}

Prompt::Outcome Prompt::take(std::string_view line, int number) {
  if (waiting_.empty()) first_line_ = number;
  const std::string text =
      without_return(waiting_.empty() ? std::string(line) : waiting_ + "\n" + std::string(line));
  const Argument::StackGuard guard(L);
  const std::string before(static_cast<std::size_t>(first_line_ - 1), '\n'), command = one_line(text);
  const bool lists = command == "who" || command == "who()";
  if (command.empty() || lists) {
    waiting_.clear();
    if (lists) show_text(bench_text());
    return Outcome::done;
  }
  if (command == "exit" || command == "exit()" || command == "quit" || command == "quit()")
    return Outcome::end;
  if (load(before + "return " + text)) {
    // The owner of a call's field gives the unit.
    const std::size_t owner = owner_of_field(text);
    if (owner > 0) {
      lua_pop(L, 1);
      if (!load(before + "local result = " + text.substr(0, owner) + " return result" + text.substr(owner) +
                ", result"))
        lua_pop(L, 1), load(before + "return " + text);
    }
    waiting_.clear();
    return run(text, true, owner > 0);
  }
  lua_pop(L, 1);
  if (load(before + with_lasting_locals(text))) {
    waiting_.clear();
    return run(text, false, false);
  }
  error_ = error_text(L, -1);
  if (error_.ends_with("<eof>") || error_.ends_with("'<eof>'")) {
    waiting_ = text;
    return Outcome::more;
  }
  waiting_.clear();
  return Outcome::failed;
}

Prompt::Outcome Prompt::run_again(const std::string& script, const std::string& why) {
  const Argument::StackGuard guard(L);
  lua_pushcfunction(L, traceback_handler);
  const int handler = lua_gettop(L);
  if (!load(script) || lua_pcall(L, 0, 0, handler) != LUA_OK) {
    error_ = without_idle_traceback(error_text(L, -1));
    return Outcome::failed;
  }
  script_ = script + "-- " + why + "\n";
  return Outcome::done;
}

Prompt::Outcome Prompt::run(const std::string& text, bool is_expression, bool has_owner) {
  auto keep = [](lua_State* state) { return keep_action(state); };
  if (protect(L, 0, 0, keep) != LUA_OK) lua_pop(L, 1);
  lua_pushcfunction(L, traceback_handler);
  lua_insert(L, -2);
  const int handler = lua_gettop(L) - 1;
  if (lua_pcall(L, 0, LUA_MULTRET, handler) != LUA_OK) {
    error_ = without_idle_traceback(error_text(L, -1));
    restore_globals();
    return Outcome::failed;
  }
  const int first = handler + 1;
  if (has_owner && lua_gettop(L) == first + 1) {
    show_text(with_unit_of(first + 1, field_at_end(text), first));
  } else if (lua_gettop(L) >= first) {
    show_results(first, text);
  }
  remember(text, is_expression);
  return Outcome::done;
}

void Prompt::remember(const std::string& text, bool is_expression) {
  const ScriptTypes script(text, read_tokens(text).list, {});
  std::size_t end = script.size();
  while (end > 0 && script.is(end - 1, ";")) --end;
  if (end == 0) return;
  const std::size_t begin = script.token(0).begin;
  const std::string line = text.substr(begin, script.token(end - 1).end - begin);
  const bool moves = script.word(0) == "lab" && script.is(1, ".") && script.word(2) == "knob" &&
                     script.is(3, ".") && script.word(4) == "set";
  if (moves) return;  // the rerun notes the change
  const bool about_itself = script.word(0) == "help" || script.word(0) == "show";
  const bool call =
      script.is(end - 1, ")") || script.is(end - 1, "}") || script.token(end - 1).kind == Token::Kind::text;
  if (about_itself && line.find('\n') == std::string::npos)
    script_ += "-- " + line + "\n";
  else if (!is_expression)
    script_ += one_line(with_lasting_locals(line)) + "\n";
  else
    script_ += call && script.token(0).kind == Token::Kind::name ? line + "\n" : "print(" + line + ")\n";
}

void Prompt::show_results(int first, const std::string& text) {
  const int last = lua_gettop(L);
  std::string shown;
  for (int k = first; k <= last; ++k)
    shown += (k > first ? "  " : "") + (first == last ? with_unit(text, k) : shown_line(L, k));
  show_text(std::move(shown));
}

void Prompt::show_text(std::string text) const {
  if (!text.ends_with("\n")) text += "\n";
  std::FILE* output = Session::of(L).output;
  std::fwrite(text.data(), 1, text.size(), output);
  std::fflush(output);
}

std::string Prompt::bench_text() const {
  const Argument::StackGuard guard(L);
  std::vector<std::pair<std::string, std::string>> rows;
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  Argument(L, lua_gettop(L)).each([&](const Argument& key, const Argument& value) {
    const std::string name = key.is_text() ? std::string(key.text()) : "_";
    const bool own = std::ranges::any_of(lua_names(), [&](const LuaName& of) { return of.name == name; });
    if (!own && !name.starts_with("_") && name != "lab" && name != "show")
      rows.emplace_back(name, shown_line(L, value.index()));
  });
  if (rows.empty())
    return "nothing is on the bench; name a result, as in s = lab.surface.flat{ cells=64, size=1 }";
  std::ranges::sort(rows);
  std::size_t width = 0;
  for (const auto& [name, text] : rows) width = std::max(width, name.size());
  std::string list;
  for (const auto& [name, text] : rows)
    list += name + std::string(width - name.size() + 2, ' ') + text.substr(0, text.find('\n')) + "\n";
  return list;
}

// With the unit of the owner's field, if any.
std::string Prompt::with_unit_of(int owner, std::string_view field, int index) const {
  std::optional<Dimension> dimension;
  if (const std::shared_ptr<Record> record = record_at(L, owner)) {
    for (const Record::Entry& entry : record->entries)
      if (entry.field == field) dimension = entry.dimension;
  } else if (const Object* object = native_at(L, owner)) {
    for (const Getter& getter : object->type->fields)
      if (getter.name == field) dimension = getter.dimension;
  }
  const bool quantity = dimension && *dimension != dimension::number && lua_type(L, index) == LUA_TNUMBER;
  return quantity ? shown_quantity(lua_tonumber(L, index), *dimension) : shown_line(L, index);
}

// A field has a unit, its number none.
std::string Prompt::with_unit(const std::string& expression, int index) const {
  if (lua_type(L, index) != LUA_TNUMBER) return shown_line(L, index);
  const ScriptTypes script(expression, read_tokens(expression).list, {});
  const std::size_t end = script.size();
  const auto is_name = [&](std::size_t k) { return k < end && script.token(k).kind == Token::Kind::name; };
  if (end < 3 || !is_name(end - 1) || !script.is(end - 2, ".")) return shown_line(L, index);
  // Other expressions would repeat a call.
  for (std::size_t k = 0; k < end; ++k)
    if (end % 2 == 0 || (k % 2 == 0 ? !is_name(k) : !script.is(k, "."))) return shown_line(L, index);
  const Argument::StackGuard guard(L);
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  const int owner = lua_gettop(L);
  for (std::size_t k = 0; k + 2 < end; k += 2) {
    if (!lua_istable(L, owner)) return shown_line(L, index);
    with_key(Argument(L, owner), script.word(k), [&](const Argument& value) {
      lua_pushvalue(L, value.index());
      lua_replace(L, owner);
      return 0;
    });
  }
  return with_unit_of(owner, script.word(end - 1), index);
}

Completion Prompt::complete(std::string_view line, std::size_t position) const {
  const std::string before = waiting_.empty() ? std::string() : waiting_ + "\n";
  Completion found = lua::complete(before + std::string(line), before.size() + position, live_globals());
  found.from = found.from < before.size() ? position : found.from - before.size();
  return found;
}

std::vector<LiveGlobal> Prompt::live_globals() const {
  constexpr std::size_t most_fields = 200;
  const Argument::StackGuard guard(L);
  const auto type_of = [&](const Argument& value) -> std::string {
    if (const Module* module = module_at(L, value.index())) return module->path;
    if (const Object* object = native_at(L, value.index())) return object->type->name;
    if (const std::shared_ptr<Record> record = record_at(L, value.index()))
      return record->type != nullptr ? record->type->name : "";
    if (value.is_number()) return "number";
    return value.is_text() ? "string" : "";
  };
  std::vector<LiveGlobal> globals;
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  Argument(L, lua_gettop(L)).each([&](const Argument& key, const Argument& value) {
    if (!key.is_text() || key.text().starts_with("_")) return;
    LiveGlobal global{std::string(key.text()), type_of(value), {}};
    for (const LuaName& own : lua_names())
      if (own.library.empty() && own.name == global.name) return;
    if (value.is_table() && global.type.empty()) {
      std::string element;
      value.element(1, [&](const Argument& first) { element = type_of(first); });
      if (!element.empty()) {
        global.type = element + "[]";
      } else {
        value.each([&](const Argument& name, const Argument& field) {
          if (name.is_text() && global.fields.size() < most_fields)
            global.fields.push_back({std::string(name.text()), type_of(field), {}});
        });
      }
    } else if (const std::shared_ptr<Record> record = record_at(L, value.index());
               record != nullptr && record->type == nullptr) {
      for (const Record::Entry& entry : record->entries)
        global.fields.push_back({entry.field, entry.value.number() ? "number" : "", {}});
    }
    globals.push_back(std::move(global));
  });
  return globals;
}

void Prompt::restore_globals() {
  auto action = [](lua_State* state) { return restore_action(state); };
  // The hook that stopped the line would stop this call; Ctrl-C may set it again.
  constexpr int tries = 5;
  for (int k = 0; k < tries; ++k) {
    lua_sethook(L, nullptr, 0, 0);
    if (protect(L, 0, 0, action) == LUA_OK) return;
    lua_pop(L, 1);
  }
}

}  // namespace asperity::lua
