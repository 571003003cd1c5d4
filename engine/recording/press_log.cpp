// SPDX-License-Identifier: GPL-3.0-or-later
// "152.78" under "[MPa]" has the bits of "152.78 MPa" in a script.
#include "engine/recording/press_log.hpp"

#include <array>
#include <cmath>
#include <filesystem>

#include "engine/core/quantity.hpp"
#include "engine/recording/log_table.hpp"

namespace asperity {

namespace {

enum LogMeaning { time, pressure, load, place, rotation, dwell };
constexpr std::array<LogColumn, 8> log_columns{{{"time", time, dimension::time, "time [s]"},
                                                {"pressure", pressure, dimension::pressure, "pressure [MPa]"},
                                                {"load", load, dimension::force, "load [N]"},
                                                {"place", place, dimension::number, "place"},
                                                {"seed", place, dimension::number, "seed"},
                                                {"rotation", rotation, dimension::angle, "rotation [deg]"},
                                                {"turn", rotation, dimension::angle, "turn [deg]"},
                                                {"dwell", dwell, dimension::time, "dwell [min]"}}};
constexpr std::size_t meanings = 6;

class LogReader {
 public:
  LogReader(const SourceFile& file, Monitor& monitor, const TableForm& form)
      : file_(file),
        monitor_(monitor),
        table_(file, log_columns, form),
        log_name_(std::filesystem::path(file.path()).filename().string()) {}

  Protocol read() {
    table_.read_titles();
    check_columns();
    table_.fail_if_any();
    table_.read_rows(monitor_, [this](const std::vector<TableCell>& cells) { return read_row(cells), true; });
    table_.fail_if_any();
    if (events_.empty()) refuse_file(file_, "names columns but holds no row", "a row is an event");
    warn_if_sampled();
    warn_of_cells();
    return Protocol(std::move(events_));
  }

 private:
  void check_columns() {
    table_.require_one_of(pressure, load);
    if (table_.problems() == 0) table_.warn_of_others(monitor_);
  }

  void read_row(const std::vector<TableCell>& cells) {
    std::array<std::optional<double>, meanings> row;
    const std::size_t before = table_.problems();
    for (std::size_t k = 0; k < table_.columns(); ++k)
      if (const LogColumn* column = table_.column(k))
        row[static_cast<std::size_t>(column->meaning)] = checked(k, cells[k]);
    check_time(row[time], table_.problems() == before);
    if (table_.problems() == before) add_events(row);
  }

  std::optional<double> checked(std::size_t k, const TableCell& cell) {
    const auto [kind, value, complaint, warning] = table_.read(k, cell, true);
    const int meaning = table_.column(k)->meaning;
    constexpr double most = 9007199254740992.0;
    const char* wrong = nullptr;
    if (kind == CellKind::hole && !cell.text.empty()) wrong = " is no number";
    if (kind == CellKind::number && meaning == place &&
        !(value >= 0 && value <= most && value == std::floor(value)))
      wrong = " is no seed; give a whole number from zero up";
    else if (kind == CellKind::number && value < 0 && meaning != time && meaning != rotation)
      wrong = " is negative";
    if (wrong != nullptr) table_.problem(table_.here(k), shown(cell.text) + wrong);
    return kind == CellKind::number && wrong == nullptr ? std::optional(value) : std::nullopt;
  }

  void check_time(const std::optional<double>& now, bool row_is_good) {
    const std::optional<std::size_t> column = table_.find(time);
    if (!column) return;
    if (!now) {
      if (row_is_good) table_.problem(table_.here(*column), "the time is missing");
    } else if (last_time_ && *now < *last_time_) {
      table_.problem(table_.here(*column), "the time " + format_short(*now) + " s runs backwards, after " +
                                               format_short(*last_time_) + " s" +
                                               past_midnight(*last_time_ - *now));
    } else {
      last_time_ = now;
    }
  }

  void add(Protocol::Step step, const std::optional<double>& now) {
    events_.push_back({std::move(step), now, log_name_ + " " + table_.here()});
  }

  void add_events(const std::array<std::optional<double>, meanings>& row) {
    const auto now = row[time], seed = row[place], stay = row[dwell];
    const double angle = row[rotation].value_or(0);
    const bool by_load = table_.has(load);
    const double value = row[by_load ? load : pressure].value_or(0);
    const std::size_t before = events_.size();
    if (!row[by_load ? load : pressure] && ++empty_loads_ == 1) first_empty_load_ = table_.here();
    check_dwell(now);
    if (under_load_ && (seed || angle != 0)) {
      add(Protocol::Release{}, now);
      under_load_ = false;
    }
    if (seed) add(Protocol::Place{static_cast<std::uint64_t>(*seed)}, now);
    if (angle != 0) add(Protocol::Rotate{angle}, now);
    ++rows_;
    if (stay || angle != 0 || seed) ++rows_with_more_;
    if (value > 0) {
      add(PressRequest{by_load ? PressBy::load : PressBy::pressure, value, stay}, now);
      under_load_ = true;
      held_ = {now, stay, table_.here()};
      return;
    }
    if (events_.size() == before) {
      add(Protocol::Release{}, now);
      under_load_ = false;
    }
    if (stay.value_or(0) > 0)
      monitor_.warn(file_name(file_.path()) + ": a dwell without load changes nothing, as in " +
                    table_.here());
  }

  // With slack, because times and dwells are rounded.
  void check_dwell(const std::optional<double>& now) {
    constexpr double rounded_by = 0.01;
    if (now && held_.begun && held_.dwell && *held_.begun + (1 - rounded_by) * *held_.dwell > *now &&
        ++long_dwells_ == 1)
      first_long_dwell_ = "the dwell of " + format_quantity(*held_.dwell, dimension::time) + " in " +
                          held_.line + " ends after the start of " + table_.here() + ", " +
                          format_quantity(*now - *held_.begun, dimension::time) + " later";
    held_ = {};
  }

  void warn_of_cells() const {
    const auto more = [](std::size_t count) {
      return count > 1 ? ", and so in " + std::to_string(count - 1) + " more" : std::string();
    };
    const std::string file = file_name(file_.path()) + ": ";
    if (empty_loads_ > 0)
      monitor_.warn(file + "the cell of the " + (table_.has(load) ? "load" : "pressure") + " is empty in " +
                    first_empty_load_ + more(empty_loads_) +
                    ": it is read as 0, a release; write 0 to confirm");
    if (long_dwells_ > 0)
      monitor_.warn(file + first_long_dwell_ + more(long_dwells_) + ": both are kept as written");
    for (const std::string& warning : table_.warnings()) monitor_.warn(warning);
  }

  void warn_if_sampled() const {
    constexpr std::size_t many = 100;
    if (rows_ >= many && rows_with_more_ == 0)
      monitor_.warn(
          file_name(file_.path()) + " has " + std::to_string(rows_) +
          " rows without dwell or turn, and each is read as an event" +
          (table_.find(time) ? "" : "; a recording needs a column of times: columns={ time=\"its head\" }"));
  }

  const SourceFile& file_;
  Monitor& monitor_;
  LogTable table_;
  std::string log_name_;
  std::vector<Protocol::Event> events_;
  std::optional<double> last_time_;
  bool under_load_ = false;
  std::size_t rows_ = 0, rows_with_more_ = 0;
  std::size_t empty_loads_ = 0, long_dwells_ = 0;
  std::string first_empty_load_, first_long_dwell_;
  struct Held {
    std::optional<double> begun{}, dwell{};
    std::string line{};
  };
  Held held_;  // previous press
};

}  // namespace

Protocol read_press_log(const SourceFile& file, Monitor& monitor, const TableForm& form) {
  return LogReader(file, monitor, form).read();
}

}  // namespace asperity
