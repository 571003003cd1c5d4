// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/registry.hpp"

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

Session& Call::session() const { return Session::of(L); }

void Call::warn(const std::string& sentence) const {
  session().monitor().warn(where(L) + function_ + ": " + sentence);
}

bool Call::notes_inputs() const { return !session().is_case; }

void* Call::self_pointer(const Class& type) const {
  const Object* object = Argument(L, 1).as_object(type);
  if (object == nullptr || object->pointer == nullptr)
    refuse_state("this is not " + type.article_name + " that can be used");
  return object->pointer.get();
}

void* Call::object_pointer(int k, std::string_view name, const Class& type) const {
  const Argument value = argument(k);
  const Object* object = value.as_object(type);
  if (object == nullptr) {
    std::string wanted = "give " + type.article_name;
    if (const std::shared_ptr<Record> record = record_at(L, value.index()))
      for (const Record::Entry& entry : record->entries)
        if (const auto* part = std::get_if<Object>(&entry.value.data); part != nullptr && part->type == &type)
          wanted += ", such as its `" + entry.field + "`";
    refuse(quoted(name) + " is " + value.describe(), wanted);
  }
  if (object->pointer == nullptr) refuse_state(quoted(name) + " was closed");
  return object->pointer.get();
}

double Call::number(int k, StaticText name) const { return quantity(k, name, dimension::number); }

double Call::quantity(int k, StaticText name, Dimension dimension) const {
  const Argument value = argument(k);
  OptionInfo info;
  info.name = name;
  info.dimension = dimension;
  Problems problems;
  const auto number = detail::read_quantity(value, info, any(), problems);
  if (!number) refuse(problems.empty() ? quoted(name) + " is not known" : problems.front());
  return *number;
}

std::string Call::text(int k, std::string_view name, const std::string& wanted) const {
  const Argument value = argument(k);
  if (!value.is_text()) refuse(quoted(name) + " is " + value.describe(), "give " + wanted);
  return std::string(value.text());
}

}  // namespace asperity::lua
