// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

const Class& class_at(lua_State* L) {
  return *static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(1)));
}

template <class Body>
int raised(lua_State* L, const std::string& name, const Body& body) {
  const int results = guarded(L, name, body);
  return results < 0 ? lua_error(L) : results;
}

[[noreturn]] void refuse_closed(const Class& type) {
  refuse_state(type.article_name + " was used after it was closed");
}

// t[k]. A dry run does not know how many rows a table has; a loop over them runs once.
Value item_of(const Object& self, std::int64_t k) {
  if (self.is_placeholder()) return k >= 1 ? Value(Unknown{}) : Value();
  if (self.closed) refuse_closed(*self.type);
  return self.type->item(self.pointer.get(), k);
}

// The method whose result has the field, if any, as a hint.
std::string given_by(const Class& type, std::string_view field) {
  const auto has = [&](const std::vector<Getter>& fields) {
    return std::ranges::find(fields, field, &Getter::name) != fields.end();
  };
  for (const Function& method : type.methods) {
    const RecordInfo* record = find_record_type(method.returns);
    if (record != nullptr && has(record->fields))
      return "write `" + qualified_name(method) + (method.options ? "{…}." : "().") + std::string(field) +
             "`";
    const Class* result = find_class(method.returns);
    if (result != nullptr && result != &type && has(result->fields))
      return result->article_name + ", from " + qualified_name(method) + ", has it";
  }
  return "";
}

int guarded_field(lua_State* L, const Class& type) {
  return guarded(L, "", [&]() -> Values {
    const Argument key(L, 2);
    const Object* self = Argument(L, 1).as_object(type);
    if (self == nullptr) refuse("this is not " + type.article_name);
    if (type.item != nullptr && key.is_number() && key.integer()) return {item_of(*self, *key.integer())};
    if (!key.is_text())
      refuse_name(type.article_name + " was indexed with " + key.describe(), "its fields have names");
    if (self->closed) refuse_closed(type);
    for (const Getter& field : type.fields) {
      if (field.name != key.text()) continue;
      if (self->is_placeholder()) return {placeholder_of(field.type)};
      Call call(L, field.name, true);
      const LedgerScope scope = call.session().ledger_scope(field.name, false, type.name);
      Values values = field.body(call);
      for (const Value& value : values) check_declared(field.name, field.type, value);
      return values;
    }
    const std::string meant = meant_by(key.text(), type.names());
    refuse_name(type.article_name + " has no field " + quoted(key.text().substr(0, 40)) + meant,
                meant.empty() ? given_by(type, key.text()) : "");
  });
}

// Closures are made on first use: scripts use few methods.
int outer_index(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  const Class& type = class_at(L);
  if (const auto method = std::ranges::find(type.methods, Argument(L, 2).text(), &Function::name);
      method != type.methods.end()) {
    push_function(L, *method);
    lua_pushvalue(L, -1);
    lua_setfield(L, lua_upvalueindex(2), method->name.c_str());
    return 1;
  }
  const int results = guarded_field(L, type);
  return results < 0 ? mistaken_field(L) : results;
}

int guarded_new_index(lua_State* L, const Class& type) {
  return guarded(L, "", [&]() -> Values {
    const Argument key(L, 2);
    throw Error(ErrorCode::not_permitted,
                type.article_name + " cannot be changed" +
                    (key.is_text() ? " (field " + quoted(key.text().substr(0, 40)) + ")" : ""),
                "its methods return new values");
  });
}

int outer_new_index(lua_State* L) {
  guarded_new_index(L, class_at(L));
  return noted_as_mistake(L) ? 0 : lua_error(L);
}

int outer_to_string(lua_State* L) {
  const Class& type = class_at(L);
  return raised(L, type.name, [&]() -> Values {
    const Object* self = Argument(L, 1).as_object(type);
    if (self == nullptr || self->pointer == nullptr || type.describe == nullptr)
      return {type.article_name + (self != nullptr && self->closed ? " (closed)" : "")};
    return {type.describe(self->pointer.get())};
  });
}

int outer_equal(lua_State* L) {
  const Class& type = class_at(L);
  return raised(L, type.name, [&]() -> Values {
    const Object* a = Argument(L, 1).as_object(type);
    const Object* b = Argument(L, 2).as_object(type);
    if (a == nullptr || b == nullptr || a->pointer == nullptr || b->pointer == nullptr) return {false};
    return {a->pointer == b->pointer ||
            (type.equal != nullptr && type.equal(a->pointer.get(), b->pointer.get()))};
  });
}

int outer_length(lua_State* L) {
  const Class& type = class_at(L);
  return raised(L, type.name, [&]() -> Values {
    const Object* self = Argument(L, 1).as_object(type);
    if (self != nullptr && self->is_placeholder()) return {Unknown{}};
    if (self == nullptr || self->closed) refuse_closed(type);
    return {type.length(self->pointer.get())};
  });
}

int guarded_operator(lua_State* L, const Operator& operation) {
  return guarded(L, operation.form, [&]() -> Values {
    return with_collection(L, [&]() -> Values {
      Call call(L, operation.form, false);
      if (call.argument(1).is_unknown() || call.argument(2).is_unknown())
        return {placeholder_of(operation.returns)};
      const LedgerScope scope = call.session().ledger_scope(operation.form, false);
      return operation.body(call);
    });
  });
}

int outer_operator(lua_State* L) {
  const Operator& operation = *static_cast<const Operator*>(lua_touserdata(L, lua_upvalueindex(1)));
  int results = guarded_operator(L, operation);
  if (results < 0 && noted_as_mistake(L))
    results = guarded(L, operation.form, [&]() -> Values { return {placeholder_of(operation.returns)}; });
  return results < 0 ? lua_error(L) : results;
}

// next(value, key) over the fields that are numbers.
int next_number(lua_State* L) {
  const Class& type = class_at(L);
  std::size_t length = 0, k = 0;
  if (const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tolstring(L, 2, &length) : nullptr) {
    while (k < type.fields.size() && type.fields[k].name != std::string_view(key, length)) ++k;
    ++k;
  }
  for (; k < type.fields.size(); ++k) {
    if (!type.fields[k].type.starts_with("number")) continue;
    lua_pushstring(L, type.fields[k].name.c_str());
    if (lua_getfield(L, 1, type.fields[k].name.c_str()) != LUA_TNIL) return 2;
    lua_pop(L, 2);
  }
  return lua_pushnil(L), 1;
}

int outer_pairs(lua_State* L) {
  const Class& type = class_at(L);
  if (type.iterates_numbers) {
    lua_pushlightuserdata(L, const_cast<Class*>(&type));
    lua_pushcclosure(L, next_number, 1);
    lua_pushvalue(L, 1);
    lua_pushnil(L);
    return 3;
  }
  static const std::string name = "pairs";
  return raised(L, name, [&]() -> Values {
    refuse(type.article_name + " is no table", "help \"" + type.name + "\" lists its fields and methods");
  });
}

void drop(Object* object) {
  if (object == nullptr) return;
  object->pointer.reset();
  object->known.reset();
  object->closed = true;
}

// __gc. Safe to run twice.
int release(lua_State* L) {
  drop(native_at(L, 1));
  return 0;
}

// __close: runs the class's closing function first.
int outer_close(lua_State* L) {
  const Class& type = class_at(L);
  return raised(L, type.name, [&]() -> Values {
    Object* object = native_at(L, 1);
    if (object != nullptr && object->pointer != nullptr && type.closing != nullptr)
      type.closing(object->pointer.get());
    drop(object);
    return {};
  });
}

void set_class_method(lua_State* L, const char* name, lua_CFunction function, const Class& type) {
  lua_pushlightuserdata(L, const_cast<Class*>(&type));
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
}

}  // namespace

int make_class_metatable(lua_State* L) {
  const Class& type = *static_cast<const Class*>(lua_touserdata(L, 1));
  lua_newtable(L);
  lua_pushboolean(L, 1);
  lua_rawsetp(L, -2, &native_key);
  lua_pushstring(L, type.name.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, type.name.c_str());
  lua_setfield(L, -2, "__metatable");
  lua_pushlightuserdata(L, const_cast<Class*>(&type));
  lua_newtable(L);
  lua_pushcclosure(L, outer_index, 2);
  lua_setfield(L, -2, "__index");
  set_class_method(L, "__newindex", outer_new_index, type);
  set_class_method(L, "__tostring", outer_to_string, type);
  set_class_method(L, "__eq", outer_equal, type);
  set_class_method(L, "__pairs", outer_pairs, type);
  if (type.length != nullptr) set_class_method(L, "__len", outer_length, type);
  for (const Operator& operation : type.operators) {
    lua_pushlightuserdata(L, const_cast<Operator*>(&operation));
    lua_pushcclosure(L, outer_operator, 1);
    lua_setfield(L, -2, operation.event.c_str());
  }
  set_class_method(L, "__gc", release, type);
  set_class_method(L, "__close", outer_close, type);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &type);
  return 1;
}

}  // namespace asperity::lua
