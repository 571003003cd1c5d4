// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/row_block.hpp"

#include <utility>

namespace asperity::lua {

namespace {

std::string type_of(const OptionRow& row) {
  if (row.words.empty()) return row.dimension == dimension::number ? "number" : describe(row.dimension);
  std::string type;
  for (const std::string& word : row.words) type += (type.empty() ? "\"" : "|\"") + word + "\"";
  return type;
}

}  // namespace

OptionInfo row_info(const OptionRow& row, const std::any& defaults) {
  OptionInfo info{row.name,     type_of(row), row.dimension, row.default_text, row.range.text(row.dimension),
                  row.sentence, row.required};
  const std::optional<double> value = row.get(defaults);
  if (!row.required && info.default_text.empty() && value)
    info.default_text = row.words.empty() ? detail::number_text(*value, row.dimension)
                                          : "\"" + row.words[static_cast<std::size_t>(*value)] + "\"";
  return info;
}

void read_row(const OptionRow& row, const OptionInfo& info, const Argument& value, std::any& options,
              Problems& problems) {
  if (row.words.empty()) {
    if (const auto number = detail::read_quantity(value, info, row.range, problems))
      row.set(options, *number);
  } else if (const auto place = detail::read_word(value, info, row.words, problems)) {
    row.set(options, static_cast<double>(*place));
  }
}

RowBlock::RowBlock(std::string name, std::span<const OptionRow> rows, std::any defaults)
    : name_(std::move(name)), rows_(rows), defaults_(std::move(defaults)) {
  for (const OptionRow& row : rows_) infos_.push_back(row_info(row, defaults_));
}

std::vector<const OptionInfo*> RowBlock::options() const {
  std::vector<const OptionInfo*> infos;
  for (const OptionInfo& info : infos_) infos.push_back(&info);
  return infos;
}

std::any RowBlock::read(const Argument& table, const std::string& caller) const {
  std::any result = defaults_;
  detail::read_table(
      table, caller, options(),
      [&](std::size_t k, const Argument& value, Problems& problems) {
        if (value.is_unknown() && value.as_any_object() == nullptr) return;
        read_row(rows_[k], infos_[k], value, result, problems);
      },
      [](Problems&) {});
  return result;
}

}  // namespace asperity::lua
