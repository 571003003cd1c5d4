// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/registry.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <unordered_map>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/mistakes.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/result_digest.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"

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

std::vector<std::pair<std::string_view, std::string_view>> named_fields(std::string_view type) {
  std::vector<std::pair<std::string_view, std::string_view>> fields;
  const std::size_t with = type.find(" with ");
  for (std::string_view rest = type.substr(with == std::string_view::npos ? type.size() : with + 6);
       !rest.empty();) {
    const std::size_t end = std::min(rest.find(" and "), rest.size());
    const std::size_t colon = std::min(rest.find(": "), end);
    fields.emplace_back(rest.substr(0, colon), rest.substr(0, end).substr(std::min(colon + 2, end)));
    rest.remove_prefix(std::min(end + 5, rest.size()));
  }
  return fields;
}

namespace {

struct NamedFunction {
  const Function* function = nullptr;
  const Class* owner = nullptr;
  std::string name;
};

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

const std::unordered_map<const Function*, NamedFunction>& entries() {
  static const std::unordered_map<const Function*, NamedFunction> all = [] {
    std::unordered_map<const Function*, NamedFunction> map;
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

void check_count(const Call& call, const Function& function) {
  const std::size_t most = function.parameters.size() + (function.options != nullptr ? 1 : 0);
  if (call.count() > static_cast<int>(most))
    throw Error(ErrorCode::bad_value,
                call.function_name() + " takes " +
                    (most == 0   ? std::string("no arguments")
                     : most == 1 ? std::string("one argument")
                                 : "at most " + std::to_string(most) + " arguments") +
                    (most == 1 && function.options != nullptr ? ", a table of named keys," : "") +
                    " and was given " + std::to_string(call.count()));
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
  return results;
}

// Whether planning needs the result, a body or a protocol.
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
    if (!table.is_unknown() && (!function.options_optional || call.given(k)))
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
      throw Error(ErrorCode::bad_value,
                  entry.name + " was called on " + Argument(L, 1).describe() + ", not on " +
                      entry.owner->article_name,
                  "write a colon: x:" + function.name + "(...)");
    if (self->closed && function.name == "close") return {};  // a second close is harmless
    if (self->closed)
      throw Error(ErrorCode::bad_state, entry.owner->article_name + " was used after it was closed");
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
    return with_collection(
        L, [&] { return call_function(L, entry); });  // valid because a failed call changes nothing
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

}  // namespace

void record_call(const Session& session, const std::string& function, const Object* self,
                 const Resolved& inputs, const Values& results) {
  if (session.run == nullptr || session.is_case) return;
  Json line = Json::object();
  line.set("function", function);
  if (self != nullptr)
    if (const std::string digest = digest_of(*self); !digest.empty()) line.set("self", digest);
  Json given = Json::object();
  for (const auto& [key, text] : inputs) given.set(key, text);
  line.set("inputs", given);
  if (const std::string digest = digest_of(results); !digest.empty()) line.set("result", digest);
  session.run->journal().write("call", line);
  if (session.onlooker) session.onlooker(function, results);
}

void enter_into_ledger(const Session& session, const Values& results) {
  for (const Value& result : results) {
    const auto* object = std::get_if<Object>(&result.data);
    if (object != nullptr && object->pointer != nullptr && object->type->enter != nullptr)
      object->type->enter(object->pointer.get(), *session.ledger);
  }
}

const std::string& qualified_name(const Function& function) { return entries().at(&function).name; }

const std::string* name_of_entry(const void* pointer) {
  for (const auto& [function, entry] : entries())
    if (&entry == pointer) return &entry.name;
  return nullptr;
}

void push_function(lua_State* L, const Function& function) {
  lua_pushlightuserdata(L, const_cast<NamedFunction*>(&entries().at(&function)));
  lua_pushcclosure(L, outer_function, 1);
}

bool Call::notes_inputs() const { return !session().is_case; }

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
