// SPDX-License-Identifier: GPL-3.0-or-later
// "152.78" under "[MPa]" has the bits of "152.78 MPa" in a script.
#include "engine/recording/press_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>

#include "engine/core/require.hpp"
#include "engine/recording/log_table.hpp"
#include "engine/specimen/specimen_pair.hpp"

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

// --- writing

struct Row {
  std::optional<double> time, place, rotation, load, dwell;
  std::optional<std::size_t> press{};  // event of the results
  bool empty() const { return !place && !rotation && !load; }
};

[[noreturn]] void refuse_event(std::size_t k, const Protocol::Step& step, const std::string& reason,
                               const std::string& hint = {}) {
  refuse("a press log cannot hold event " + std::to_string(k + 1) + ", " + text(step) + ": " + reason, hint);
}

class Gatherer {
 public:
  explicit Gatherer(const Protocol& protocol) : events_(protocol.events()) {
    timed = true;
    for (const Protocol::Event& event : events_) timed = timed && event.time.has_value();
    for (std::size_t k = 0; k < events_.size(); ++k) take(k);
    if (!row_.empty()) finish(0);
  }

  std::vector<Row> rows;
  bool timed = false;
  std::optional<PressBy> by;

 private:
  void begin(const Protocol::Event& event) {
    if (!row_.empty() && timed && row_.time != event.time) finish(0);
    if (timed) row_.time = event.time;
  }

  void finish(double load) {
    row_.load = load;
    // As the reader does.
    under_load_ = load > 0;
    rows.push_back(std::exchange(row_, Row{}));
  }

  void take(std::size_t k) {
    const Protocol::Event& event = events_[k];
    if (const auto* press = std::get_if<PressRequest>(&event.step)) {
      if (press->by != PressBy::pressure && press->by != PressBy::load)
        refuse_event(k, event.step, "a log presses to a pressure or a load only");
      if (by && *by != press->by)
        refuse_event(k, event.step, "a log has pressures or loads, and the events before give the other");
      if (press->value < 0 || !press->preload.empty())
        refuse_event(k, event.step, "a log holds neither pulls nor preloads");
      if (!(press->value > 0)) refuse_event(k, event.step, "a log reads zero as a release", "use a release");
      by = press->by;
      begin(event);
      row_.dwell = press->dwell;
      row_.press = k;
      finish(press->value);
    } else if (const auto* place = std::get_if<Protocol::Place>(&event.step)) {
      if (place->seed > (std::uint64_t{1} << 53)) refuse_event(k, event.step, "its seed is above 2^53");
      if (!row_.empty()) finish(0);
      begin(event);
      row_.place = static_cast<double>(place->seed);
    } else if (const auto* rotate = std::get_if<Protocol::Rotate>(&event.step)) {
      if (rotate->angle == 0) refuse_event(k, event.step, "a log has no turn by zero");
      if (row_.rotation) finish(0);
      begin(event);
      row_.rotation = rotate->angle;
    } else if (std::holds_alternative<Protocol::Release>(event.step)) {
      if (!row_.empty()) finish(0);
      if (under_load_ && reader_releases(k)) return;
      begin(event);
      finish(0);
    } else {
      refuse_event(k, event.step, "a log has no column for it");
    }
  }

  bool reader_releases(std::size_t k) const {
    if (k + 1 >= events_.size()) return false;
    const Protocol::Event& next = events_[k + 1];
    const bool lifts = std::holds_alternative<Protocol::Place>(next.step) ||
                       std::holds_alternative<Protocol::Rotate>(next.step);
    return lifts && (!timed || next.time == events_[k].time);
  }

  std::span<const Protocol::Event> events_;
  Row row_;
  bool under_load_ = false;
};

// The shortest text that reads back as the value; "" if 17 digits are too few.
std::string exact_text(double value, const std::string& unit, Dimension dimension) {
  const double factor = parse_unit(unit).value;
  for (int digits = 10; digits <= 17; ++digits) {
    std::string text = format_short(value / factor, digits);
    if (parse_quantity_as(text + " " + unit, dimension) == value) return text;
  }
  return {};
}

using Member = std::optional<double> Row::*;
using TextColumn = std::vector<std::string>;  // title, then cells

TextColumn column_of(const std::vector<Row>& rows, Member member, const std::string& name,
                     Dimension dimension, std::initializer_list<std::string> units) {
  for (const std::string& unit : units) {
    TextColumn column{name + " [" + unit + "]"};
    bool exact = true;
    for (const Row& row : rows) {
      const std::optional<double>& value = row.*member;
      column.push_back(value ? exact_text(*value, unit, dimension) : "");
      exact = exact && (!value || !column.back().empty());
    }
    if (exact) return column;
  }
  throw Error(ErrorCode::internal, "a number of the column " + quoted(name) + " has no exact text");
}

// More rows look like a recording unless a column has dwells.
constexpr std::size_t rows_of_a_recording = 100;

}  // namespace

Protocol read_press_log(const SourceFile& file, Monitor& monitor, const TableForm& form) {
  return LogReader(file, monitor, form).read();
}

std::string press_log_text(const Protocol& protocol, std::span<const ResultColumn> results) {
  const Gatherer gathered(protocol);
  const std::vector<Row>& rows = gathered.rows;
  std::vector<TextColumn> columns;
  const auto any = [&](Member member) {
    return std::ranges::any_of(rows, [member](const Row& row) { return (row.*member).has_value(); });
  };
  const auto add = [&](const std::string& title, const auto& value_in) {
    columns.push_back({title});
    for (const Row& row : rows) {
      const std::optional<double> value = value_in(row);
      columns.back().push_back(value ? format_exact(*value) : "");
    }
  };
  if (gathered.timed) columns.push_back(column_of(rows, &Row::time, "time", dimension::time, {"s"}));
  if (any(&Row::place)) add("place", [](const Row& row) { return row.place; });
  if (any(&Row::rotation))
    columns.push_back(column_of(rows, &Row::rotation, "rotation", dimension::angle, {"deg", "rad"}));
  if (gathered.by == PressBy::load)
    columns.push_back(column_of(rows, &Row::load, "load", dimension::force, {"N"}));
  else
    columns.push_back(column_of(rows, &Row::load, "pressure", dimension::pressure, {"MPa", "Pa"}));
  if (any(&Row::dwell) || (gathered.timed && rows.size() >= rows_of_a_recording))
    columns.push_back(column_of(rows, &Row::dwell, "dwell", dimension::time, {"min", "s"}));
  for (const ResultColumn& result : results)
    add("result " + result.title,
        [&](const Row& row) { return row.press ? result.values[*row.press] : std::nullopt; });

  std::string text;
  for (std::size_t line = 0; line <= rows.size(); ++line)
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += columns[c][line] + (c + 1 < columns.size() ? ", " : "\n");
  return text;
}

std::string bench_log_text(const SpecimenPair& pair) {
  using Done = SpecimenPair::Done;
  const std::vector<Done>& history = pair.history();
  if (history.empty())
    refuse_state("nothing was done to this contact yet, so there is nothing to log", "press it first");
  const auto only = [&](PressBy by) {
    return std::ranges::all_of(history, [by](const Done& done) {
      const auto* press = std::get_if<PressRequest>(&done.step);
      return press == nullptr || press->by == by || press->value == 0;
    });
  };
  const bool by_load = only(PressBy::load), as_asked = by_load || only(PressBy::pressure);
  std::vector<ResultColumn> results = {{by_load ? "pressure [Pa]" : "load [N]", {}},
                                       {"approach [m]", {}},
                                       {"area_fraction", {}},
                                       {"peak_pressure [Pa]", {}}};
  std::vector<Protocol::Event> events;
  for (const Done& done : history) {
    Protocol::Event event{done.step, done.time};
    std::vector<std::optional<double>> values(results.size());
    if (auto* press = std::get_if<PressRequest>(&event.step)) {
      if (press->value == 0 && press->preload.empty()) {
        event.step = Protocol::Release{};
      } else if (!as_asked) {
        press->by = PressBy::pressure;
        press->value = done.measured->pressure;
      }
      const Done::Measured& m = *done.measured;
      values = {by_load ? m.pressure : m.load, m.approach, m.area_fraction, m.peak_pressure};
    }
    events.push_back(std::move(event));
    for (std::size_t c = 0; c < results.size(); ++c) results[c].values.push_back(values[c]);
  }
  return press_log_text(Protocol(std::move(events)), results);
}

}  // namespace asperity
