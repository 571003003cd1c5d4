// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/declarations.hpp"

#include <algorithm>
#include <cctype>
#include <unordered_map>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

std::vector<std::string> Class::names() const {
  std::vector<std::string> result;
  for (const Getter& field : fields) result.push_back(field.name);
  for (const Function& method : methods) result.push_back(method.name);
  return result;
}

std::vector<std::string_view> parts_of(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + separator.size(), text.size()));
  }
  return parts;
}

std::vector<std::string> result_types(const Function& function) {
  const std::vector<std::string_view> parts = parts_of(function.returns, ", ");
  return {parts.begin(), parts.end()};
}

std::vector<std::pair<std::string_view, std::string_view>> named_fields(std::string_view type) {
  std::vector<std::pair<std::string_view, std::string_view>> fields;
  const std::size_t with = type.find(" with ");
  if (with == std::string_view::npos) return fields;
  for (const std::string_view part : parts_of(type.substr(with + 6), " and ")) {
    const std::size_t colon = std::min(part.find(": "), part.size());
    fields.emplace_back(part.substr(0, colon), part.substr(std::min(colon + 2, part.size())));
  }
  return fields;
}

std::string_view name_within(const Module& outer, const Module& inner) {
  const std::string_view path = inner.path;
  const std::size_t dot = path.rfind('.');
  return dot != std::string_view::npos && path.substr(0, dot) == outer.path ? path.substr(dot + 1)
                                                                            : std::string_view();
}

const Class* find_class(std::string_view name) {
  for (const Class* type : classes())
    if (type->name == name) return type;
  return nullptr;
}

namespace {

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

// Few short items, else their number.
template <class Items>
std::string content_of(const Items& items) {
  constexpr std::size_t most = 10, longest = 100;
  std::string text;
  for (const auto& item : items)
    if (text.size() <= longest) text += (text.empty() ? "" : ", ") + show(Value(item));
  return items.size() > most || text.size() > longest ? "a table of " + std::to_string(items.size())
                                                      : "{ " + text + " }";
}

}  // namespace

const NamedFunction& entry_of(const Function& function) { return entries().at(&function); }

const std::string& qualified_name(const Function& function) { return entry_of(function).name; }

const std::string* name_of_entry(const void* pointer) {
  for (const auto& [function, entry] : entries())
    if (&entry == pointer) return &entry.name;
  return nullptr;
}

const std::vector<const RecordInfo*>& record_types() {
  static const std::vector<const RecordInfo*> all = [] {
    std::vector<const RecordInfo*> found;
    const auto add = [&](const std::vector<const RecordInfo*>& results) {
      for (const RecordInfo* type : results)
        if (std::find(found.begin(), found.end(), type) == found.end()) found.push_back(type);
    };
    for (const Module* module : modules()) add(module->results);
    for (const Class* type : classes()) add(type->results);
    return found;
  }();
  return all;
}

const RecordInfo* find_record_type(std::string_view name) {
  for (const RecordInfo* type : record_types())
    if (type->name == name) return type;
  return nullptr;
}

std::vector<const RecordInfo*> record_types_in(std::string_view type) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::vector<const RecordInfo*> found;
  for (std::size_t begin = 0, end = 0; begin < type.size(); begin = end + 1) {
    end = begin;
    while (end < type.size() && is_letter(type[end])) ++end;
    if (const RecordInfo* named = find_record_type(type.substr(begin, end - begin))) found.push_back(named);
  }
  return found;
}

void check_declared(std::string_view giver, std::string_view declared, const Value& given) {
  if (const auto* record = std::get_if<std::shared_ptr<Record>>(&given.data)) {
    constexpr std::string_view map = "table<string, ";
    if (declared.starts_with(map)) {
      for (const Record::Entry& entry : (*record)->entries)
        check_declared(giver, declared.substr(map.size(), declared.size() - map.size() - 1), entry.value);
      return;
    }
    const RecordInfo* type = (*record)->type;
    if (type == nullptr || type->name != declared.substr(0, declared.find('?')))
      throw Error(ErrorCode::internal, std::string(giver) + " gave " +
                                           (type == nullptr ? "a record without a type" : type->name) +
                                           ", and is described to give " + quoted(declared));
  } else if (const auto* list = std::get_if<std::shared_ptr<List>>(&given.data)) {
    const std::string_view element = declared.substr(0, declared.find("[]"));
    if (!(*list)->items.empty()) check_declared(giver, element, (*list)->items.front());
    for (const auto& [name, type] : named_fields(declared))
      for (const auto& [field, value] : (*list)->named)
        if (field == name) check_declared(giver, type, value);
  }
}

std::string show(const Record::Entry& entry) {
  const auto number = entry.value.number();
  return number && entry.dimension != dimension::number ? format_quantity(*number, entry.dimension)
                                                        : show(entry.value);
}

std::string show(const Value& value) {
  struct Shower {
    std::string operator()(std::monostate) const { return "nil"; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return format_short(v + 0.0); }  // avoids "-0"
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(const Object& v) const {
      const bool known = v.pointer != nullptr && v.type->describe != nullptr;
      return known ? v.type->describe(v.pointer.get()) : std::string(v.type->article_name);
    }
    std::string operator()(const std::shared_ptr<Record>& v) const {
      std::string text;
      for (const Record::Entry& entry : v->entries)
        text += (text.empty() ? "" : ", ") + entry.field + " " + show(entry);
      return "{ " + text + " }";
    }
    std::string operator()(const std::shared_ptr<List>& v) const { return content_of(v->items); }
    std::string operator()(const std::shared_ptr<Map>& v) const { return count(v->items.size()); }
    std::string operator()(const Value::Numbers& v) const { return content_of(*v); }
    std::string operator()(const Value::Rows& v) const { return count(static_cast<std::size_t>(v->ny())); }
    std::string operator()(const std::shared_ptr<Iterator>&) const { return "an iterator"; }
    std::string operator()(Unknown) const { return "?"; }
    std::string operator()(Value::Function) const { return "a function"; }
    std::string operator()(Script) const { return "a function"; }
    std::string operator()(const std::shared_ptr<const StoredValue>&) const { return "a table"; }
    static std::string count(std::size_t n) { return "a table of " + std::to_string(n); }
  };
  return std::visit(Shower{}, value.data);
}

}  // namespace asperity::lua
