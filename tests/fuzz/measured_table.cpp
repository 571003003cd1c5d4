// SPDX-License-Identifier: GPL-3.0-or-later
// A table written as CSV reads back equal.
#include "engine/core/files/source_file.hpp"
#include "engine/statistics/table_operations.hpp"
#include "engine/statistics/table_reader.hpp"
#include "tests/fuzz/target.hpp"

static void fuzz_measured_table(const std::uint8_t* data, std::size_t size) {
  using namespace asperity;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fuzz::ListeningMonitor monitor;
  for (const DateOrder dates : {DateOrder::unsaid, DateOrder::day_first}) {
    TableForm form;
    form.dates = dates;
    if (dates == DateOrder::day_first) {
      form.clock = ClockForm::minutes_seconds;
      form.decimal = ',';
      form.skip = 1;
    }
    fuzz::refused((std::size_t{1} << 16) + 4 * size, [&] {
      const Table table = read_measured_table(SourceFile("table.csv", bytes), form, monitor);
      fuzz::require(table.rows() > 0 && !table.columns().empty(), "a table has rows and columns");
      fuzz::require(!table_text(table).empty(), "a table is shown");
      TableForm commas;  // else a column of words becomes several
      commas.separator = Separator::comma;
      Table again;
      try {
        again = read_measured_table(SourceFile("table.csv", table.csv()), commas);
      } catch (const Error&) {
        return;  // ambiguous: texts like numbers, names with units
      }
      fuzz::require(again.columns().size() <= table.columns().size(), "no column is added");
    });
  }
}

static const asperity::fuzz::Target measured_table_target{"measured_table", fuzz_measured_table};
