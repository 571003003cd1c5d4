// SPDX-License-Identifier: GPL-3.0-or-later
// print(value), and a Lua value as one line: records with units, tables by their content, not by their
// varying address.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

constexpr std::size_t most_items = 10;  // of one table
constexpr int deepest = 3;              // nested tables
constexpr std::size_t longest_text = 200, longest_line = 120;

std::string line_of(lua_State* L, int index, int depth);

// As Lua's tostring.
std::string told(lua_State* L, int index) {
  const Argument::StackGuard guard(L);
  index = lua_absindex(L, index);
  lua_pushvalue(L, index);
  auto action = [](lua_State* state) {
    luaL_tolstring(state, 1, nullptr);
    return 1;
  };
  if (protect(L, 1, 1, action) != LUA_OK) return "(a value that cannot be shown: " + error_text(L, -1) + ")";
  return std::string(Argument(L, -1).text());
}

std::string record_line(const Record& record) {
  std::string text;
  for (const Record::Entry& entry : record.entries)
    if (!entry.value.is_nil()) text += (text.empty() ? " " : ", ") + entry.field + " " + show(entry);
  return record.name + " {" + text + " }";
}

std::string key_text(const Argument& key) {
  if (key.is_text()) return std::string(key.text().substr(0, longest_text));
  return "[" + line_of(key.state(), key.index(), deepest) + "]";
}

std::string item_line(lua_State* L, int index, int depth, const std::string& unit) {
  const Argument item(L, index);
  if (unit.empty() || !item.is_number()) return line_of(L, index, depth);
  return format_short(in_unit(item.number(), unit));
}

std::string table_line(lua_State* L, int index, int depth) {
  const Argument table(L, index);
  const std::string unit = list_unit(L, index);
  const std::int64_t length = table.length();
  std::vector<std::string> parts;
  std::size_t items = static_cast<std::size_t>(length);
  if (depth >= deepest) return length > 0 ? "{ " + std::to_string(length) + " values }" : "{ ... }";
  for (std::int64_t k = 1; k <= length && parts.size() < most_items; ++k)
    table.element(
        k, [&](const Argument& value) { parts.push_back(item_line(L, value.index(), depth + 1, unit)); });
  std::vector<std::string> named;
  table.each([&](const Argument& key, const Argument& value) {
    const auto whole = key.is_number() ? key.integer() : std::optional<std::int64_t>();
    if (whole && *whole >= 1 && *whole <= length) return;
    ++items;
    named.push_back(key_text(key) + " = " + line_of(L, value.index(), depth + 1));
  });
  std::sort(named.begin(), named.end());
  for (std::string& part : named)
    if (parts.size() < most_items) parts.push_back(std::move(part));
  if (parts.size() < items) parts.push_back("... (" + std::to_string(items) + " in all)");
  const std::string line = joined(parts, ", "), behind = unit.empty() ? "" : " " + unit;
  if (depth == 0 && line.size() > longest_line) return "{ " + joined(parts, ",\n  ") + " }" + behind;
  return parts.empty() ? "{}" : "{ " + line + " }" + behind;
}

bool is_plain_table(lua_State* L, int index) {
  if (lua_type(L, index) != LUA_TTABLE) return false;
  if (luaL_getmetafield(L, index, "__tostring") == LUA_TNIL) return true;
  lua_pop(L, 1);
  return false;
}

std::string line_of(lua_State* L, int index, int depth) {
  const Argument value(L, index);
  if (value.is_text()) {
    if (depth == 0) return std::string(value.text());
    return "\"" + std::string(value.text().substr(0, longest_text)) +
           (value.text().size() > longest_text ? "...\"" : "\"");
  }
  if (value.is_number() && depth > 0) return format_short(value.number() + 0.0);
  if (const std::shared_ptr<Record> record = record_at(L, value.index())) return record_line(*record);
  if (const Module* module = module_at(L, value.index()))
    return module->path + (depth == 0 ? ": " + module->sentence : "");
  if (value.is_function()) {
    const Argument::StackGuard guard(L);
    if (lua_iscfunction(L, value.index()) && lua_getupvalue(L, value.index(), 1) != nullptr)
      if (const std::string* name = name_of_entry(lua_touserdata(L, -1)))
        return "function " + *name + (depth == 0 ? ", which help explains" : "");
    return "a function";
  }
  const Argument::StackGuard guard(L);
  return is_plain_table(L, value.index()) ? table_line(L, value.index(), depth) : told(L, value.index());
}

bool write(std::FILE* output, std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), output) == text.size();
}

}  // namespace

std::string shown_line(lua_State* L, int index) { return line_of(L, lua_absindex(L, index), 0); }

int print_values(lua_State* L) {
  std::FILE* output = Session::of(L).output;
  bool written = true;
  const int values = lua_gettop(L);
  for (int k = 1; k <= values; ++k) {
    if (k > 1) written = write(output, "\t") && written;
    if (is_plain_table(L, k)) {
      written = write(output, shown_line(L, k)) && written;
      continue;
    }
    std::size_t length = 0;
    const char* text = luaL_tolstring(L, k, &length);
    written = write(output, {text, length}) && written;
    lua_pop(L, 1);
  }
  written = write(output, "\n") && std::fflush(output) == 0 && written;
  // A full disk is an error at the end of a run.
  return written || output == stdout ? 0 : luaL_error(L, "there is no memory for the output");
}

}  // namespace asperity::lua
