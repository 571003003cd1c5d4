// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/dry_run.hpp"

#include <algorithm>
#include <string_view>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/declarations.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::lua {

namespace {

const char unknown_made_key = 0;  // the script received a placeholder

int again(lua_State* L) {
  push_unknown(L);
  return 1;
}

// A loop passes the state, here nil, and the previous values. It runs once over an unknown result.
int called(lua_State* L) {
  return lua_gettop(L) == 3 && lua_isnil(L, 2) && Argument(L, 3).is_unknown() ? 0 : again(L);
}

int compared(lua_State* L) { return luaL_error(L, "%s", cannot_follow); }

int to_string(lua_State* L) {
  lua_pushliteral(L, "?");
  return 1;
}

int ignored(lua_State*) { return 0; }

bool any_unknown(lua_State* L) {
  for (int k = 1; k <= lua_gettop(L); ++k)
    if (Argument(L, k).is_unknown()) return true;
  return false;
}

// Calls upvalue 1, a library function, on the same frame: errors keep the script's line.
int call_original(lua_State* L) { return lua_tocfunction(L, lua_upvalueindex(1))(L); }

int pass_unknown(lua_State* L) { return any_unknown(L) ? again(L) : call_original(L); }

// table.concat also finds placeholders inside its list.
int concat_unknown(lua_State* L) {
  if (any_unknown(L)) return again(L);
  if (lua_istable(L, 1)) {
    const auto length = static_cast<lua_Integer>(lua_rawlen(L, 1));
    for (lua_Integer k = 1; k <= length; ++k) {
      lua_rawgeti(L, 1, k);
      if (Argument(L, -1).is_unknown()) return again(L);
      lua_pop(L, 1);
    }
  }
  return call_original(L);
}

// type() and math.type(): scripts branch on them.
int refuse_unknown(lua_State* L) {
  const bool of_known_class = native_at(L, 1) != nullptr || record_at(L, 1) != nullptr;
  return Argument(L, 1).is_unknown() && !of_known_class ? luaL_error(L, "%s", cannot_follow)
                                                        : call_original(L);
}

Record record_placeholder(const RecordInfo& type);

// Pushes an item of the placeholder at `index`: a record if the list has a known type, else a placeholder.
void push_item(lua_State* L, int index) {
  const RecordInfo* item = nullptr;
  if (block_at(L, index, &unknown_key) != nullptr) {
    lua_getiuservalue(L, index, 1);  // nil for other placeholders
    item = static_cast<const RecordInfo*>(lua_touserdata(L, -1));
    lua_pop(L, 1);
  }
  if (item == nullptr) return push_unknown(L);
  if (guarded(L, item->name, [&]() -> Values { return {record_placeholder(*item)}; }) < 0) lua_error(L);
}

int index_unknown(lua_State* L) {
  if (lua_type(L, 2) == LUA_TSTRING) return again(L);
  push_item(L, 1);
  return 1;
}

// Iterates once. Upvalues: the placeholder, and whether its item was given.
int unknown_once(lua_State* L) {
  if (lua_toboolean(L, lua_upvalueindex(2)) != 0) return lua_pushnil(L), 1;
  lua_pushboolean(L, 1);
  lua_replace(L, lua_upvalueindex(2));
  lua_pushinteger(L, 1);
  push_item(L, lua_upvalueindex(1));
  return 2;
}

// == with a placeholder is silently false: an assertion may fail wrongly.
int assert_known(lua_State* L) {
  if (lua_gettop(L) == 0 || lua_toboolean(L, 1)) return call_original(L);
  const bool any = lua_rawgetp(L, LUA_REGISTRYINDEX, &unknown_made_key) != LUA_TNIL;
  lua_pop(L, 1);
  return any ? lua_gettop(L) : call_original(L);
}

int pairs_or_once(lua_State* L) {
  if (lua_gettop(L) >= 1 && Argument(L, 1).is_unknown()) {
    lua_settop(L, 1);
    lua_pushboolean(L, 0);
    lua_pushcclosure(L, unknown_once, 2);
    return 1;
  }
  return call_original(L);
}

void wrap(lua_State* L, const char* library, const char* name, lua_CFunction wrapper) {
  lua_getglobal(L, library);
  lua_getfield(L, -1, name);
  if (lua_isfunction(L, -1)) {
    lua_pushcclosure(L, wrapper, 1);
    lua_setfield(L, -2, name);
    lua_pop(L, 1);
  } else {
    lua_pop(L, 2);
  }
}

// From "State", or "ProtocolEvent and State?".
std::optional<Values> one_turn(const std::shared_ptr<bool>& done, const std::string& types) {
  if (*done) return std::nullopt;
  *done = true;
  Values values;
  for (const std::string_view type : parts_of(types, " and "))
    values.push_back(placeholder_of(std::string(type)));
  return values;
}

// A nested list has an unknown length.
Value placeholder_inside(const std::string& type) {
  return type.ends_with("[]") ? Value(Unknown{find_record_type(type.substr(0, type.size() - 2))})
                              : placeholder_of(type);
}

Record record_placeholder(const RecordInfo& type) {
  Record record;
  record.name = type.title;
  record.type = &type;
  record.placeholder = true;
  for (const Getter& field : type.fields)
    record.add(field.name, placeholder_inside(field.type), field.dimension);
  return record;
}

}  // namespace

void push_unknown(lua_State* L, const RecordInfo* item) {
  lua_pushboolean(L, 1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &unknown_made_key);
  lua_newuserdatauv(L, 0, item == nullptr ? 0 : 1);
  if (item != nullptr) {
    lua_pushlightuserdata(L, const_cast<RecordInfo*>(item));
    lua_setiuservalue(L, -2, 1);
  }
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &unknown_key) != LUA_TTABLE) {
    lua_pop(L, 1);
    static const luaL_Reg methods[] = {
        {"__add", again},           {"__sub", again},          {"__mul", again},    {"__div", again},
        {"__mod", again},           {"__pow", again},          {"__unm", again},    {"__idiv", again},
        {"__band", again},          {"__bor", again},          {"__bxor", again},   {"__shl", again},
        {"__shr", again},           {"__bnot", again},         {"__concat", again}, {"__len", again},
        {"__index", index_unknown}, {"__call", called},        {"__lt", compared},  {"__le", compared},
        {"__newindex", ignored},    {"__tostring", to_string}, {nullptr, nullptr}};
    lua_newtable(L);
    luaL_setfuncs(L, methods, 0);
    lua_pushliteral(L, "placeholder");
    lua_setfield(L, -2, "__name");
    lua_pushliteral(L, "placeholder");
    lua_setfield(L, -2, "__metatable");
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &unknown_key);
  }
  lua_setmetatable(L, -2);
}

bool holds_unknown(const Argument& value, int depth) {
  if (value.is_unknown()) return true;
  if (depth == 0 || !value.is_table()) return false;
  bool found = false;
  value.each([&](const Argument&, const Argument& item) { found = found || holds_unknown(item, depth - 1); });
  return found;
}

Value placeholder_of(const std::string& type) {
  if (type.empty() || type == "nil") return {};
  if (type.ends_with("?")) return placeholder_of(type.substr(0, type.size() - 1));
  if (type == "boolean" || type == "string" || type == "number" || type == "integer") return Unknown{};
  if (const std::size_t at = type.find("[] with "); at != std::string::npos) {
    List list{{placeholder_of(type.substr(0, at))}};
    for (const auto& [field, of] : named_fields(type))
      list.named.emplace_back(field, placeholder_inside(std::string(of)));
    return list;
  }
  if (type.ends_with("[]")) {
    const std::string inner = type.substr(0, type.size() - 2);
    List list{{placeholder_of(inner)}};
    list.rows = find_record_type(inner) != nullptr;
    return list;
  }
  if (type.starts_with("iterator<")) {
    const std::string inner = type.substr(9, type.size() - 10);
    auto done = std::make_shared<bool>(false);
    return Iterator{[inner, done](Call&) { return one_turn(done, inner); }};
  }
  if (const Class* found = find_class(type)) return Object{found, nullptr, false};
  if (const RecordInfo* found = find_record_type(type)) return record_placeholder(*found);
  return Unknown{};
}

bool stopped_at_placeholder(const std::string& message) {
  const std::string first = message.substr(0, message.find('\n'));
  for (const char* sign :
       {cannot_follow, "got placeholder)", "a placeholder value", "'for' initial value must be a number",
        "'for' limit must be a number", "'for' step must be a number"})
    if (first.find(sign) != std::string::npos) return true;
  return false;
}

bool met_nothing(const std::string& message) {
  const std::string first = message.substr(0, message.find('\n'));
  return first.find("attempt to ") != std::string::npos && first.find("a nil value") != std::string::npos;
}

namespace {
// From ":12:"; empty at the end if absent.
std::string_view line_number(std::string_view message) {
  for (std::size_t at = message.find(':'); at != std::string::npos; at = message.find(':', at + 1)) {
    const std::size_t end = message.find_first_not_of("0123456789", at + 1);
    if (end != std::string::npos && end > at + 1 && message[end] == ':')
      return message.substr(at + 1, end - at - 1);
  }
  return message.substr(message.size());
}
}  // namespace

std::string line_of(const std::string& message) {
  const std::string_view number = line_number(message);
  return number.empty() ? "?" : std::string(number);
}

std::string without_place(const std::string& message) {
  const std::string_view number = line_number(message);
  std::size_t begin = 0;
  if (!number.empty())
    begin = message.find_first_not_of(
        ": ", static_cast<std::size_t>(number.data() - message.data()) + number.size());
  begin = std::min(begin, message.size());
  return message.substr(begin, message.find('\n', begin) - begin);
}

void open_dry_run_library(lua_State* L) {
  for (const char* name : {"abs",  "ceil", "cos", "deg",  "exp", "floor",     "fmod", "log",  "max",  "min",
                           "modf", "rad",  "sin", "sqrt", "tan", "tointeger", "ult",  "asin", "acos", "atan"})
    wrap(L, "math", name, pass_unknown);
  for (const char* name : {"format", "rep", "len", "sub", "upper", "lower"})
    wrap(L, "string", name, pass_unknown);
  for (const char* name : {"unpack", "sort"}) wrap(L, "table", name, pass_unknown);
  wrap(L, "table", "concat", concat_unknown);
  wrap(L, "_G", "tonumber", pass_unknown);
  wrap(L, "_G", "type", refuse_unknown);
  wrap(L, "math", "type", refuse_unknown);
  for (const char* name : {"pairs", "ipairs"}) wrap(L, "_G", name, pairs_or_once);
  wrap(L, "_G", "assert", assert_known);
  wrap(L, "_G", "print", ignored);
  wrap(L, "io", "write", again);
  lua_getglobal(L, "io");
  for (const char* name : {"stdout", "stderr"}) {
    push_unknown(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
  lua_pushnil(L);  // stdout and stderr are no results
  lua_rawsetp(L, LUA_REGISTRYINDEX, &unknown_made_key);
}

namespace {
bool is_caught(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sn", &frame);
    const std::string_view name = frame.name == nullptr ? "" : frame.name;
    if (*frame.what == 'C' && (name == "pcall" || name == "xpcall")) return true;
  }
  return false;
}
}  // namespace

bool noted_as_mistake(lua_State* L) {
  Session* session = Session::find(L);
  if (session == nullptr || !session->dry_run || session->mistakes == nullptr) return false;
  if (stop_flag().reason() != StopReason::none) return false;
  const Argument error(L, -1);
  if (!error.is_text()) return false;
  const std::string message(error.text());
  // A placeholder may also cause errors in script functions called from C++.
  if (stopped_at_placeholder(message) || (session->gave_placeholders && met_nothing(message))) return false;
  if (is_caught(L)) {
    session->mistakes->note("a pcall catches this error: " + message);
    return false;
  }
  session->mistakes->add(message);
  session->gave_placeholders = true;
  lua_pop(L, 1);
  return true;
}

int mistaken_field(lua_State* L) {
  if (!noted_as_mistake(L)) return lua_error(L);
  push_unknown(L);
  return 1;
}

}  // namespace asperity::lua
