// SPDX-License-Identifier: GPL-3.0-or-later
// Rows with free columns, in journal and CSV file before `write` returns. A new column or unit rewrites the
// file atomically.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/expectation.hpp"
#include "engine/run/journal.hpp"
#include "engine/statistics/table.hpp"

namespace asperity {

// Journals do not distinguish integers.
Json to_json(const Cell& cell);

// Thread-safe. Use RunDirectory::notebook.
class Notebook {
 public:
  // Empty `csv`: no file. The first row creates the file.
  Notebook(std::string name, std::filesystem::path csv, Journal& journal, ExpectationLog& log);

  const std::string& name() const { return name_; }
  const std::filesystem::path& csv() const { return csv_; }

  // These columns come first; names may have units. The same order may be repeated. Throws Error{bad_state}
  // after other columns, and as Table::declare_unit does.
  void order_columns(const std::vector<std::string>& columns);

  // Journal event "row". Throws as Table::resolved and Journal::write do, with nothing changed;
  // Error{bad_file} if the CSV write fails: the row stays, and the next write or save tries again.
  void write(std::span<const Entry> row);
  void declare_unit(std::string_view column, std::string_view unit);
  // Journal event "expect", and a log entry. Throws as evaluate() does.
  Verdict expect(const Expectation& expectation);

  Table table() const;
  // Reads the rows without a copy.
  template <class Read>
  auto read(const Read& read) const {
    const std::lock_guard lock(mutex_);
    return read(table_);
  }

  // Replaces another notebook's CSV. Throws Error{bad_file}.
  void write_again();
  // Retries a failed CSV write; false if a writer is blocked longer than `patience`. Throws Error{bad_file}.
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
  bool stale_ = false;  // a row or column is missing
};

}  // namespace asperity
