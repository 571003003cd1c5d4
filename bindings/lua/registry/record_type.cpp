// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/record_type.hpp"

#include <algorithm>
#include <cctype>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

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

}  // namespace asperity::lua
