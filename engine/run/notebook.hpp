// SPDX-License-Identifier: GPL-3.0-or-later
// A notebook: rows of free columns that a script writes as it goes. Each row is in the journal before
// `write` returns, and in the notebook's CSV file, to which it is appended; a new column or unit
// rewrites the file atomically. Rows keep the order in which they were written.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/expectation.hpp"
#include "engine/run/expectation_log.hpp"
#include "engine/run/journal.hpp"
#include "engine/statistics/table.hpp"

namespace asperity {

// Thread-safe. Made by RunDirectory::notebook, which keeps the journal and the log alive.
class Notebook {
 public:
  // An empty `csv` keeps the rows in memory (and in the journal) only. No file is made before the
  // first row.
  Notebook(std::string name, std::filesystem::path csv, Journal& journal, ExpectationLog& log);

  const std::string& name() const { return name_; }
  const std::filesystem::path& csv() const { return csv_; }

  // Columns that stand first, in this order, from the first row on; a name may carry its unit. The same order
  // may be given again. Throws Error{bad_state} where rows or columns stand in another one already, and as
  // Table::declare_unit does.
  void order_columns(const std::vector<std::string>& columns);

  // Journal event "row"; the first one carries the order that was given. Throws as Table::check and
  // Journal::write do, with nothing changed; and Error{bad_file} if the CSV cannot be written, when row and
  // journal line are kept and the next write or save tries again.
  void write(std::span<const Entry> row);
  // Throws as Table::declare_unit.
  void declare_unit(std::string_view column, std::string_view unit);
  // The unit of a column; "" where it has none, or is not there.
  std::string unit_of(std::string_view column) const;
  // Journal event "expect"; the verdict also enters the run's log. Throws only as check() and
  // in_column_unit() do: an expectation that fails is a verdict, not an error.
  Verdict expect(const Expectation& expectation);

  // A copy of what is written now.
  Table table() const;

  // Writes the CSV as the rows are, over what another notebook of the same file wrote. Throws
  // Error{bad_file}.
  void write_again();
  // Brings the CSV up to date if a write failed. Waits at most `patience` for a writer that is stuck;
  // returns false if that was not enough. Throws Error{bad_file}.
  bool save(std::chrono::milliseconds patience);

 private:
  void rewrite();
  void append_last_row();

  const std::string name_;
  const std::filesystem::path csv_;
  Journal& journal_;
  ExpectationLog& log_;
  mutable std::mutex mutex_;
  Table table_;
  std::vector<std::string> order_;
  bool stale_ = false;  // the file lacks a row or has an old header
};

}  // namespace asperity
