// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/notebook.hpp"

#include <algorithm>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity {

Json to_json(const Cell& cell) {
  if (is_number(cell)) return *number_in(cell);
  if (const bool* truth = std::get_if<bool>(&cell)) return *truth;
  if (const std::string* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

Notebook::Notebook(std::string name, std::filesystem::path csv, Journal& journal, ExpectationLog& log)
    : name_(std::move(name)), csv_(std::move(csv)), journal_(journal), log_(log) {}

void Notebook::order_columns(const std::vector<std::string>& columns) {
  const std::lock_guard lock(mutex_);
  if (columns == order_) return;
  if (!table_.columns().empty())
    refuse_state("the columns of the notebook " + quoted(name_) + " already have another order",
                 "give their order where the notebook is first opened");
  Table ordered;
  for (const std::string& column : columns) {
    const auto [name, unit, mean_of, plain] = split_column_unit(column);
    if (!ordered.declare_column(name))
      refuse("`columns` names " + quoted(name) + " twice", "give each column one place");
    if (!unit.empty()) ordered.declare_unit(name, unit);
  }
  table_ = std::move(ordered);
  order_ = columns;
}

void Notebook::write(std::span<const Entry> given) {
  const std::lock_guard lock(mutex_);
  std::vector<Entry> row = table_.resolved(given);
  std::ranges::stable_sort(row, {}, [this](const Entry& entry) {
    const auto place = table_.find_column(entry.column);
    return place && *place < order_.size() ? *place : order_.size();
  });
  Json values = Json::object();
  Json units;
  for (const Entry& entry : row) {
    // A number in the display unit.
    const bool in_its_unit = is_number(entry.value) && !entry.unit.empty();
    values.set(entry.column, in_its_unit ? Json(in_unit(*number_in(entry.value), entry.unit))
                                         : asperity::to_json(entry.value));
    if (!entry.unit.empty()) units.set(entry.column, entry.unit);
  }
  Json fields = Json::object({{"notebook", name_}, {"row", std::move(values)}});
  if (!units.is_null()) fields.set("units", std::move(units));
  if (table_.rows() == 0 && !order_.empty()) {
    std::vector<std::string> columns;
    for (const TableColumn& column : table_.columns()) columns.push_back(column.name);
    fields.set("columns", Json::strings(columns));
  }
  journal_.write("row", fields);
  const bool new_header = table_.append(row);
  if (csv_.empty()) return;
  // The resumed file has these rows already.
  if (journal_.repeating()) {
    stale_ = true;
    return;
  }
  if (new_header || stale_) {
    rewrite();
  } else {
    append_last_row();
  }
}

void Notebook::declare_unit(std::string_view column, std::string_view unit) {
  const std::lock_guard lock(mutex_);
  const bool new_header = table_.declare_unit(column, unit);
  if (new_header && !csv_.empty() && table_.rows() > 0 && !journal_.repeating()) rewrite();
}

void Notebook::rewrite() {
  stale_ = true;
  write_atomically(csv_, table_.csv());
  stale_ = false;
}

void Notebook::append_last_row() {
  stale_ = true;
  // Another program may have removed the file.
  if (!append_to_existing(csv_, table_.csv_row(table_.rows() - 1))) return rewrite();
  stale_ = false;
}

Verdict Notebook::expect(const Expectation& expectation) {
  check(expectation);
  const std::lock_guard lock(mutex_);
  Verdict verdict = evaluate(expectation, table_, name_);
  log_.add(verdict);
  journal_.write("expect", asperity::to_json(verdict));
  return verdict;
}

Table Notebook::table() const {
  const std::lock_guard lock(mutex_);
  return table_;
}

void Notebook::write_again() {
  const std::lock_guard lock(mutex_);
  if (!csv_.empty() && table_.rows() > 0) rewrite();
}

bool Notebook::save(std::chrono::milliseconds patience) {
  const std::unique_lock lock = lock_within(mutex_, patience);
  if (!lock.owns_lock()) return false;
  if (stale_ && !csv_.empty()) rewrite();
  return true;
}

}  // namespace asperity
