// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/library.hpp"

#include <algorithm>
#include <string_view>

#include "bindings/lua/registry/call_record.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

void check_count(const Call& call, const Function& function) {
  if (!function.parameters.empty() && function.parameters.back().name == "...") return;
  const std::size_t most = function.parameters.size() + (function.options != nullptr ? 1 : 0);
  if (call.count() > static_cast<int>(most))
    refuse(call.function_name() + " takes " +
           (most == 0   ? std::string("no arguments")
            : most == 1 ? std::string("one argument")
                        : "at most " + std::to_string(most) + " arguments") +
           (most == 1 && function.options != nullptr ? ", a table of named keys," : "") + " and was given " +
           std::to_string(call.count()));
}

bool any_argument_unknown(const Call& call) {
  constexpr int nested_options = 3;
  for (int k = 1; k <= call.count(); ++k)
    if (holds_unknown(call.argument(k), nested_options)) return true;
  return false;
}

Values placeholders_of(const Function& function) {
  Values results;
  for (const std::string& type : result_types(function)) results.push_back(placeholder_of(type));
  for (const Value& value : results)
    if (const auto* iterator = std::get_if<std::shared_ptr<Iterator>>(&value.data);
        iterator != nullptr && function.look_at_table != nullptr)
      (*iterator)->table = [look = function.look_at_table](const Call& call, const auto&) {
        look(call);
        return placeholder_of("Table");
      };
  return results;
}

// The result, a body or a protocol.
bool is_planned_with(const Function& function) {
  const Class* made = find_class(function.returns);
  return made != nullptr && (made->known != nullptr || made->name == "Protocol");
}

std::string_view path_given(const Call& call, const Function& function) {
  for (std::size_t k = 0; k < function.parameters.size(); ++k)
    if (function.parameters[k].name == "path") {
      const Argument path = call.argument(static_cast<int>(k) + 1);
      return path.is_text() ? path.text() : std::string_view();
    }
  return {};
}

Values dry_call(const Call& call, const Function& function) {
  if (const auto& told = call.session().on_call_left_out; told && function.heavy) told(call, function);
  if (function.options != nullptr) {
    const int k = static_cast<int>(function.parameters.size()) + 1;
    const Argument table = call.argument(k);
    if (!table.is_unknown() && (!function.options.optional || call.given(k)))
      function.options->check(table, call.function_name());
  }
  if (function.look != nullptr) function.look(call);
  if (const std::string_view path = path_given(call, function); !path.empty() && !is_planned_with(function))
    call.session().paths_left_out.emplace(path);
  call.session().gave_placeholders = true;
  Values results = placeholders_of(function);
  if (const Class* made = find_class(function.returns); made != nullptr && made->known != nullptr)
    if (auto* object = std::get_if<Object>(&results.front().data))
      object->known = made->known(call, function);
  return results;
}

void check_results(const Function& function, const Values& results) {
  const auto may_hold_records = [](const Value& value) {
    return std::holds_alternative<std::shared_ptr<Record>>(value.data) ||
           std::holds_alternative<std::shared_ptr<List>>(value.data);
  };
  if (std::none_of(results.begin(), results.end(), may_hold_records)) return;
  const std::vector<std::string> types = result_types(function);
  for (std::size_t k = 0; k < std::min(types.size(), results.size()); ++k)
    check_declared(qualified_name(function), types[k], results[k]);
}

Values call_function(lua_State* L, const NamedFunction& entry) {
  Call call(L, entry.name, entry.owner != nullptr);
  const Function& function = *entry.function;
  bool placeholder_self = false;
  if (entry.owner != nullptr) {
    const Object* self = Argument(L, 1).as_object(*entry.owner);
    if (self == nullptr)
      refuse(entry.name + " was called on " + Argument(L, 1).describe() + ", not on " +
                 entry.owner->article_name,
             "write a colon: x:" + function.name + "(...)");
    if (self->closed && function.name == "close") return {};  // a second close is harmless
    if (self->closed) refuse_state(entry.owner->article_name + " was used after it was closed");
    placeholder_self = self->is_placeholder();
  }
  check_count(call, function);
  // `explain` needs bodies and protocols, except from files written by the script. `check` needs none.
  const bool left_out =
      function.unknown_when_dry ||
      (function.heavy && (call.session().explanation == nullptr || !is_planned_with(function) ||
                          call.session().paths_left_out.contains(path_given(call, function))));
  if (call.session().dry_run && (left_out || placeholder_self || any_argument_unknown(call)))
    return dry_call(call, function);
  LedgerScope scope = call.session().ledger_scope(call.function_name(), function.heavy);
  if (function.returns.starts_with("iterator")) scope.forget();  // its turns are entered instead
  if (function.heavy) ++call.session().heavy_calls;
  const Session::Running running(call.session(), L);
  Values results = function.body(call);
  if (call.session().run != nullptr) call.session().run->see_outputs();
  check_results(function, results);
  if (function.heavy) {
    enter_into_ledger(call.session(), results);
    record_call(call.session(), call.function_name(), Argument(L, 1).as_any_object(), call.inputs(), results);
  }
  return results;
}

int guarded_function(lua_State* L, const NamedFunction& entry) {
  return guarded(L, entry.name, [&]() -> Values {
    // Valid because a failed call changes nothing.
    Values results = with_collection(L, [&] { return call_function(L, entry); });
    for (const Value& value : results)
      if (const auto* iterator = std::get_if<std::shared_ptr<Iterator>>(&value.data))
        (*iterator)->place = where(L), (*iterator)->name = entry.name;
    return results;
  });
}

int after_failure(lua_State* L, const NamedFunction& entry) {
  if (!noted_as_mistake(L)) return -1;
  return guarded(L, entry.name, [&] { return placeholders_of(*entry.function); });
}

// Outer frame of every function: no destructors.
int outer_function(lua_State* L) {
  const NamedFunction& entry = *static_cast<const NamedFunction*>(lua_touserdata(L, lua_upvalueindex(1)));
  int results = guarded_function(L, entry);
  if (results < 0) results = after_failure(L, entry);
  return results < 0 ? lua_error(L) : results;
}

const char module_key = 0;  // metatable[module_key] = Module*

// At most one. A submodule hides a constant, a constant hides a function.
struct Member {
  const Module* module = nullptr;
  const Constant* constant = nullptr;
  const Function* function = nullptr;
};

Member member_of(const Module& module, std::string_view name) {
  for (const Module* inner : modules())
    if (!name.empty() && name_within(module, *inner) == name) return {.module = inner};
  for (const Constant& constant : module.constants)
    if (constant.name == name) return {.constant = &constant};
  for (const Function& function : module.functions)
    if (function.name == name) return {.function = &function};
  return {};
}

std::vector<std::string> names_of_members(const Module& module) {
  std::vector<std::string> names;
  for (const Function& function : module.functions) names.push_back(function.name);
  for (const Constant& constant : module.constants) names.push_back(constant.name);
  for (const Module* inner : modules())
    if (const std::string_view name = name_within(module, *inner); !name.empty()) names.emplace_back(name);
  return names;
}

// Cached in `storage`: scripts use few of several hundred functions. Raises.
void make_member(lua_State* L, int storage, const char* name, const Member& member) {
  if (member.module != nullptr) {
    push_proxy(L, *member.module);
  } else if (member.constant != nullptr) {
    const auto value = [&member]() -> Values { return {member.constant->value()}; };
    if (guarded(L, "", value) < 0) lua_error(L);
  } else {
    push_function(L, *member.function);
  }
  lua_pushvalue(L, -1);
  lua_setfield(L, storage, name);
}

// Makes the missing members. Raises.
template <class Named>
void make_all(lua_State* L, int storage, const Module& module, const std::vector<Named>& members) {
  for (const Named& named : members) {
    if (lua_getfield(L, storage, named.name.c_str()) == LUA_TNIL)
      make_member(L, storage, named.name.c_str(), member_of(module, named.name));
    lua_settop(L, 1);
  }
}

int module_index(lua_State* L) {
  lua_settop(L, 2);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  if (lua_type(L, 2) == LUA_TSTRING) {
    std::size_t length = 0;
    const char* name = lua_tolstring(L, 2, &length);
    const Member member = member_of(module, {name, length});
    if (member.module != nullptr || member.constant != nullptr || member.function != nullptr)
      return make_member(L, lua_upvalueindex(2), name, member), 1;
  }
  lua_pop(L, 1);
  const int results = guarded(L, "", [&]() -> Values {
    const Argument key(L, 2);
    const std::string shown = key.is_text() ? quoted(key.text().substr(0, 40)) : key.describe();
    refuse_name(module.path + " has no field " + shown +
                    (key.is_text() ? did_you_mean(key.text(), names_of_members(module)) : ""),
                "lab.help \"" + module.path + "\" lists its members");
  });
  return results < 0 ? mistaken_field(L) : results;
}

int module_new_index(lua_State* L) {
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  return luaL_error(L, "%s cannot be changed", module.path.c_str());
}

int module_pairs(lua_State* L) {
  lua_settop(L, 1);
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  const int storage = lua_upvalueindex(2);
  make_all(L, storage, module, module.functions);
  make_all(L, storage, module, module.constants);
  for (const Module* inner : modules()) {
    const std::string_view name = name_within(module, *inner);
    if (name.empty()) continue;
    push_proxy(L, *inner);
    lua_setfield(L, storage, name.data());  // end of the path, null-terminated
  }
  push_ordered_loop(L, storage);  // hides the storage from scripts
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

// Stack: [-1] = new metatable, [-2] = storage. The closure has module and storage.
void set_module_method(lua_State* L, const char* name, lua_CFunction function, const Module& module) {
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_pushvalue(L, -3);
  lua_pushcclosure(L, function, 2);
  lua_setfield(L, -2, name);
}

int module_call(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_replace(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

void push_module(lua_State* L, const Module& module) {
  lua_newtable(L);  // storage
  lua_newtable(L);  // proxy, always empty
  lua_pushvalue(L, -2);
  lua_newtable(L);
  set_module_method(L, "__index", module_index, module);
  set_module_method(L, "__newindex", module_new_index, module);
  set_module_method(L, "__pairs", module_pairs, module);
  if (module.call) {
    push_function(L, *module.call);
    lua_pushcclosure(L, module_call, 1);
    lua_setfield(L, -2, "__call");
  }
  lua_pushstring(L, module.path.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, module.path.c_str());
  lua_setfield(L, -2, "__metatable");
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_rawsetp(L, -2, &module_key);
  lua_remove(L, -2);  // storage
  lua_setmetatable(L, -2);
  lua_remove(L, -2);  // storage
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &module);
}

}  // namespace

void push_function(lua_State* L, const Function& function) {
  lua_pushlightuserdata(L, const_cast<NamedFunction*>(&entry_of(function)));
  lua_pushcclosure(L, outer_function, 1);
}

const Module* module_at(lua_State* L, int index) {
  if (lua_type(L, index) != LUA_TTABLE || lua_getmetatable(L, index) == 0) return nullptr;
  lua_rawgetp(L, -1, &module_key);
  const auto* module = static_cast<const Module*>(lua_touserdata(L, -1));
  lua_pop(L, 2);
  return module;
}

void push_proxy(lua_State* L, const Module& module) {
  luaL_checkstack(L, 16, nullptr);
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &module) != LUA_TNIL) return;
  lua_pop(L, 1);
  push_module(L, module);
}

void push_library(lua_State* L) {
  luaL_checkstack(L, 8, nullptr);
  lua_pushcfunction(L, make_class_metatable);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &native_key);
  open_results(L);
  push_proxy(L, *modules().front());
}

}  // namespace asperity::lua
