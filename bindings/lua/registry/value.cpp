// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

Record& Record::add(std::string field, Value value, Dimension dimension) {
  entries.push_back({std::move(field), std::move(value), dimension});
  return *this;
}

Record& Record::add_if(std::string effect, std::string field, Value value, Dimension dimension) {
  if (!value.is_nil()) return add(std::move(field), std::move(value), dimension);
  missing_effects.emplace_back(std::move(field), std::move(effect));
  return *this;
}

const Value* Record::find(std::string_view field) const {
  for (const Entry& entry : entries)
    if (entry.field == field) return &entry.value;
  return nullptr;
}

std::optional<double> Value::number() const {
  if (const auto* real = std::get_if<double>(&data)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&data)) return static_cast<double>(*whole);
  return {};
}

Value::Numbers number_list(std::span<const double> values) {
  return std::make_shared<const Array<double>>(values.begin(), values.end());
}

}  // namespace asperity::lua
