// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry.hpp"

#include <algorithm>
#include <cctype>
#include <exception>
#include <new>
#include <unordered_map>

#include "bindings/lua/placeholder.hpp"
#include "bindings/lua/session.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/text.hpp"
#include "engine/experiment/run_directory.hpp"

namespace asperity::lua {

std::vector<std::string> Class::names() const {
  std::vector<std::string> result;
  for (const Getter& field : fields) result.push_back(field.name);
  for (const Function& method : methods) result.push_back(method.name);
  return result;
}

std::vector<std::string> result_types(const Function& function) {
  constexpr std::string_view separator = ", ";
  std::vector<std::string> types;
  for (std::string_view rest = function.returns; !rest.empty();) {
    const std::size_t end = std::min(rest.find(separator), rest.size());
    types.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  }
  return types;
}

namespace {

// A function as it is reached from a script.
struct Entry {
  const Function* function = nullptr;
  const Class* owner = nullptr;
  std::string name;
};

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

const std::unordered_map<const Function*, Entry>& entries() {
  static const std::unordered_map<const Function*, Entry> all = [] {
    std::unordered_map<const Function*, Entry> map;
    for (const Module* module : modules()) {
      for (const Function& f : module->functions) map[&f] = {&f, nullptr, module->path + "." + f.name};
      if (module->call) map[&*module->call] = {&*module->call, nullptr, module->path};
    }
    for (const Class* type : classes())
      for (const Function& f : type->methods) map[&f] = {&f, type, lower_first(type->name) + ":" + f.name};
    return map;
  }();
  return all;
}

std::string message_of(lua_State* L, const std::string& name, const Error& error) {
  if (error.code() == ErrorCode::interrupted) return where(L) + "interrupted";
  const std::string text = error.what();
  return where(L) + (text.starts_with(name) || name.empty() ? text : name + ": " + text);
}

// Pushes an error message and returns -1, which tells the outer frame to raise it.
int fail(lua_State* L, const std::string& message) {
  auto action = [&message](lua_State* state) {
    lua_pushlstring(state, message.data(), message.size());
    return 1;
  };
  protect(L, 0, 1, action);  // on failure Lua's own memory error is there instead
  return -1;
}

int deliver(lua_State* L, const Values& results) {
  const int count = static_cast<int>(results.size());
  auto action = [&results](lua_State* state) {
    luaL_checkstack(state, static_cast<int>(results.size()) + 8, "too many results");
    for (const Value& value : results) push(state, value);
    return static_cast<int>(results.size());
  };
  return protect(L, 0, count, action) == LUA_OK ? count : -1;
}

// The middle frame: runs a body that returns Values; -1 with the error on the stack if it threw.
template <class Run>
int guarded(lua_State* L, const std::string& name, Run run) {
  try {
    stop_flag().check();
    return deliver(L, run());
  } catch (const Error& error) {
    return fail(L, message_of(L, name, error));
  } catch (const std::bad_alloc&) {
    return fail(L, where(L) + name + ": out of memory");
  } catch (const std::exception& error) {
    return fail(L, where(L) + name + ": internal error: " + error.what());
  }
}

void check_count(const Call& call, const Function& function) {
  const std::size_t most = function.parameters.size() + (function.options != nullptr ? 1 : 0);
  if (call.count() > static_cast<int>(most))
    throw Error(ErrorCode::bad_value,
                call.function_name() + " takes " +
                    (most == 0 ? std::string("no arguments") : "at most " + std::to_string(most)) +
                    " and was given " + std::to_string(call.count()));
}

// Whether a value is a placeholder, or a table that holds one within `depth` levels.
bool holds_unknown(const Argument& value, int depth) {
  if (value.is_unknown()) return true;
  if (depth == 0 || !value.is_table()) return false;
  bool found = false;
  value.each([&](const Argument&, const Argument& item) { found = found || holds_unknown(item, depth - 1); });
  return found;
}

bool any_unknown(const Call& call) {
  constexpr int nested_options = 3;
  for (int k = 1; k <= call.count(); ++k)
    if (holds_unknown(call.argument(k), nested_options)) return true;
  return false;
}

// A dry run reads the arguments and gives placeholders.
Values dry_call(const Call& call, const Function& function) {
  if (function.options != nullptr) {
    const int k = static_cast<int>(function.parameters.size()) + 1;
    const Argument table = call.argument(k);
    if (!table.is_unknown() && (!function.options_optional || call.given(k)))
      function.options->check(table, call.function_name());
  }
  Values results;
  for (const std::string& type : result_types(function)) results.push_back(placeholder_of(type));
  return results;
}

std::string digest_of(const Object& object) {
  return object.pointer == nullptr || object.type->digest == nullptr
             ? ""
             : object.type->digest(object.pointer.get());
}

// One journal line a heavy call: what it was called on and with, and the digest of what came out.
void record(const Call& call, const Function&, const Values& results) {
  const Session& session = call.session();
  if (session.run == nullptr || session.is_case) return;
  Json line = Json::object();
  line.set("function", call.function_name());
  if (const Object* self = Argument(call.L, 1).as_any_object())
    if (const std::string digest = digest_of(*self); !digest.empty()) line.set("self", digest);
  Json inputs = Json::object();
  for (const auto& [key, text] : call.inputs()) inputs.set(key, text);
  line.set("inputs", inputs);
  for (const Value& result : results)
    if (const auto* object = std::get_if<Object>(&result.data))
      if (const std::string digest = digest_of(*object); !digest.empty()) line.set("result", digest);
  session.run->journal().write("call", line);
}

Values call_function(lua_State* L, const Entry& entry) {
  Call call(L, entry.name, entry.owner != nullptr);
  const Function& function = *entry.function;
  bool placeholder_self = false;
  if (entry.owner != nullptr) {
    const Object* self = Argument(L, 1).as_object(*entry.owner);
    if (self == nullptr)
      throw Error(ErrorCode::bad_value,
                  entry.name + " was called on " + Argument(L, 1).describe() + ", not on " +
                      entry.owner->article_name,
                  "write a colon: x:" + function.name + "(...)");
    if (self->closed)
      throw Error(ErrorCode::bad_state, entry.owner->article_name + " was used after it was closed");
    placeholder_self = self->is_placeholder();
  }
  check_count(call, function);
  if (call.session().dry_run && (function.heavy || placeholder_self || any_unknown(call)))
    return dry_call(call, function);
  Values results = function.body(call);
  if (function.heavy) record(call, function, results);
  return results;
}

// Whether collecting what the script can no longer reach gave memory back.
bool collected_something(lua_State* L) {
  const std::int64_t before = memory::held();
  lua_gc(L, LUA_GCCOLLECT);
  return memory::held() < before;
}

int guarded_function(lua_State* L, const Entry& entry) {
  return guarded(L, entry.name, [&]() -> Values {
    try {
      return call_function(L, entry);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::out_of_memory || !collected_something(L)) throw;
    }
    return call_function(L, entry);  // a call that failed left everything as it was
  });
}

// The outer frame of every function: nothing here has a destructor.
int outer_function(lua_State* L) {
  const int results = guarded_function(L, *static_cast<const Entry*>(lua_touserdata(L, lua_upvalueindex(1))));
  return results < 0 ? lua_error(L) : results;
}

int guarded_field(lua_State* L, const Class& type) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    const Argument key(L, 2);
    const Object* self = Argument(L, 1).as_object(type);
    if (self == nullptr) throw Error(ErrorCode::bad_value, "this is not " + type.article_name);
    if (!key.is_text())
      throw Error(ErrorCode::unknown_name, type.article_name + " was indexed with " + key.describe(),
                  "its fields have names");
    if (self->closed) throw Error(ErrorCode::bad_state, type.article_name + " was used after it was closed");
    for (const Getter& field : type.fields) {
      if (field.name != key.text()) continue;
      if (self->is_placeholder()) return {placeholder_of(field.type)};
      Call call(L, field.name, true);
      return field.body(call);
    }
    throw Error(ErrorCode::unknown_name, type.article_name + " has no field " +
                                             quoted(key.text().substr(0, 40)) +
                                             did_you_mean(key.text(), type.names()));
  });
}

int outer_index(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;  // a method
  lua_pop(L, 1);
  const int results = guarded_field(L, *static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(1))));
  return results < 0 ? lua_error(L) : results;
}

int guarded_new_index(lua_State* L, const Class& type) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    const Argument key(L, 2);
    throw Error(ErrorCode::not_permitted,
                type.article_name + " cannot be changed" +
                    (key.is_text() ? " (field " + quoted(key.text().substr(0, 40)) + ")" : ""),
                "its methods return new values");
  });
}

int outer_new_index(lua_State* L) {
  guarded_new_index(L, *static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(1))));
  return lua_error(L);
}

int outer_to_string(lua_State* L) {
  const Class& type = *static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(1)));
  const int results = [&] {
    return guarded(L, type.name, [&]() -> Values {
      const Object* self = Argument(L, 1).as_object(type);
      if (self == nullptr || self->pointer == nullptr || type.describe == nullptr)
        return {type.article_name + (self != nullptr && self->closed ? " (closed)" : "")};
      return {type.describe(self->pointer.get())};
    });
  }();
  return results < 0 ? lua_error(L) : results;
}

int outer_equal(lua_State* L) {
  const Class& type = *static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(1)));
  const int results = [&] {
    return guarded(L, type.name, [&]() -> Values {
      const Object* a = Argument(L, 1).as_object(type);
      const Object* b = Argument(L, 2).as_object(type);
      if (a == nullptr || b == nullptr || a->pointer == nullptr || b->pointer == nullptr) return {false};
      return {a->pointer == b->pointer ||
              (type.equal != nullptr && type.equal(a->pointer.get(), b->pointer.get()))};
    });
  }();
  return results < 0 ? lua_error(L) : results;
}

// __gc and __close: drops the native value. Safe to run twice.
int release(lua_State* L) {
  if (Object* object = native_at(L, 1)) {
    object->pointer.reset();
    object->closed = true;
  }
  return 0;
}

const char native_key = 0;  // metatables[native_key] = true marks the metatables of native values
const char module_key = 0;  // and [module_key] = Module* those of modules

int module_index(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  const int results = [&] {
    static const std::string nothing;
    return guarded(L, nothing, [&]() -> Values {
      std::vector<std::string> names;
      Argument(L, lua_upvalueindex(2)).each([&](const Argument& key, const Argument&) {
        names.emplace_back(key.text());
      });
      const Argument key(L, 2);
      const std::string shown = key.is_text() ? quoted(key.text().substr(0, 40)) : key.describe();
      throw Error(
          ErrorCode::unknown_name,
          module.path + " has no field " + shown + (key.is_text() ? did_you_mean(key.text(), names) : ""),
          "lab.help \"" + module.path + "\" lists what it has");
    });
  }();
  return results < 0 ? lua_error(L) : results;
}

int module_new_index(lua_State* L) {
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  return luaL_error(L, "%s cannot be changed", module.path.c_str());
}

// The storage stays an upvalue: handed to the script, it could be written to.
int module_next(lua_State* L) {
  lua_settop(L, 2);
  return lua_next(L, lua_upvalueindex(1)) != 0 ? 2 : (lua_pushnil(L), 1);
}

int module_pairs(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_pushcclosure(L, module_next, 1);
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

// With [-1] = the metatable being made and [-2] = hidden storage: sets a closure over both.
void set_module_method(lua_State* L, const char* name, lua_CFunction function, const Module& module) {
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_pushvalue(L, -3);
  lua_pushcclosure(L, function, 2);
  lua_setfield(L, -2, name);
}

int module_call(lua_State* L) {
  lua_remove(L, 1);  // the module itself
  const int results = guarded_function(L, *static_cast<const Entry*>(lua_touserdata(L, lua_upvalueindex(1))));
  return results < 0 ? lua_error(L) : results;
}

// Pushes the proxy of a module and leaves its storage below it: storage, proxy.
void push_module(lua_State* L, const Module& module) {
  lua_newtable(L);  // storage
  for (const Function& function : module.functions) {
    push_function(L, function);
    lua_setfield(L, -2, function.name.c_str());
  }
  for (const Constant& constant : module.constants) {
    push(L, constant.value());
    lua_setfield(L, -2, constant.name.c_str());
  }
  lua_newtable(L);  // proxy, empty for ever
  lua_pushvalue(L, -2);
  lua_newtable(L);  // its metatable
  set_module_method(L, "__index", module_index, module);
  set_module_method(L, "__newindex", module_new_index, module);
  set_module_method(L, "__pairs", module_pairs, module);
  if (module.call) {
    lua_pushlightuserdata(L, const_cast<Entry*>(&entries().at(&*module.call)));
    lua_pushcclosure(L, module_call, 1);
    lua_setfield(L, -2, "__call");
  }
  lua_pushstring(L, module.path.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, module.path.c_str());
  lua_setfield(L, -2, "__metatable");
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_rawsetp(L, -2, &module_key);
  lua_remove(L, -2);  // the second reference to storage
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &module);
}

void set_class_method(lua_State* L, const char* name, lua_CFunction function, const Class& type) {
  lua_pushlightuserdata(L, const_cast<Class*>(&type));
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
}

}  // namespace

std::string where(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; level < 16 && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline > 0)
      return std::string(frame.short_src) + ":" + std::to_string(frame.currentline) + ": ";
  }
  return "";
}

const std::string& qualified_name(const Function& function) { return entries().at(&function).name; }

Object* native_at(lua_State* L, int index) {
  void* block = lua_touserdata(L, index);
  if (lua_type(L, index) != LUA_TUSERDATA || lua_getmetatable(L, index) == 0) return nullptr;
  lua_rawgetp(L, -1, &native_key);
  const bool ours = lua_toboolean(L, -1) != 0;
  lua_pop(L, 2);
  return ours ? static_cast<Object*>(block) : nullptr;
}

const Module* module_at(lua_State* L, int index) {
  if (lua_type(L, index) != LUA_TTABLE || lua_getmetatable(L, index) == 0) return nullptr;
  lua_rawgetp(L, -1, &module_key);
  const auto* module = static_cast<const Module*>(lua_touserdata(L, -1));
  lua_pop(L, 2);
  return module;
}

void push_proxy(lua_State* L, const Module& module) { lua_rawgetp(L, LUA_REGISTRYINDEX, &module); }

void push_function(lua_State* L, const Function& function) {
  lua_pushlightuserdata(L, const_cast<Entry*>(&entries().at(&function)));
  lua_pushcclosure(L, outer_function, 1);
}

void push_metatable(lua_State* L, const Class& type) {
  luaL_checkstack(L, 8, nullptr);
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &type) == LUA_TTABLE) return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_pushboolean(L, 1);
  lua_rawsetp(L, -2, &native_key);
  lua_pushstring(L, type.name.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, type.name.c_str());
  lua_setfield(L, -2, "__metatable");
  lua_pushlightuserdata(L, const_cast<Class*>(&type));
  lua_newtable(L);
  for (const Function& method : type.methods) {
    push_function(L, method);
    lua_setfield(L, -2, method.name.c_str());
  }
  lua_pushcclosure(L, outer_index, 2);
  lua_setfield(L, -2, "__index");
  set_class_method(L, "__newindex", outer_new_index, type);
  set_class_method(L, "__tostring", outer_to_string, type);
  set_class_method(L, "__eq", outer_equal, type);
  set_class_method(L, "__gc", release, type);
  set_class_method(L, "__close", release, type);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &type);
}

void push_library(lua_State* L) {
  luaL_checkstack(L, 16, nullptr);
  lua_newtable(L);  // path -> storage
  const int storages = lua_gettop(L);
  int root = 0;
  for (const Module* module : modules()) {
    push_module(L, *module);
    if (module->path == "lab") {
      root = lua_gettop(L);
    } else {
      const std::string& path = module->path;
      const std::size_t dot = path.rfind('.');
      lua_pushlstring(L, path.data(), dot);
      lua_rawget(L, storages);  // the parent's storage
      lua_pushvalue(L, -2);
      lua_setfield(L, -2, path.c_str() + dot + 1);
      lua_pop(L, 1);
    }
    lua_pushvalue(L, -2);  // this module's storage
    lua_setfield(L, storages, module->path.c_str());
    if (lua_gettop(L) != root) lua_pop(L, 2);
  }
  lua_pushvalue(L, root);
  lua_replace(L, storages);
  lua_settop(L, storages);
}

Session& Call::session() const { return Session::of(L); }

void* Call::self_pointer(const Class& type) const {
  const Object* object = Argument(L, 1).as_object(type);
  if (object == nullptr || object->pointer == nullptr)
    throw Error(ErrorCode::bad_state, "this is not " + type.article_name + " that can be used");
  return object->pointer.get();
}

void* Call::object_pointer(int k, std::string_view name, const Class& type) const {
  const Argument value = argument(k);
  const Object* object = value.as_object(type);
  if (object == nullptr)
    throw Error(ErrorCode::bad_value, quoted(name) + " is " + value.describe(), "give " + type.article_name);
  if (object->pointer == nullptr) throw Error(ErrorCode::bad_state, quoted(name) + " was closed");
  return object->pointer.get();
}

double Call::number(int k, std::string_view name) const { return quantity(k, name, dimension::number); }

double Call::quantity(int k, std::string_view name, Dimension dimension) const {
  const Argument value = argument(k);
  OptionInfo info;
  info.name = name;
  info.dimension = dimension;
  Problems problems;
  const auto number = detail::read_quantity(value, info, any(), problems);
  if (!number)
    throw Error(ErrorCode::bad_value, problems.empty() ? quoted(name) + " is not known" : problems.front());
  return *number;
}

std::string Call::text(int k, std::string_view name) const {
  const Argument value = argument(k);
  if (!value.is_text())
    throw Error(ErrorCode::bad_value, quoted(name) + " is " + value.describe(), "give a string");
  return std::string(value.text());
}

}  // namespace asperity::lua
