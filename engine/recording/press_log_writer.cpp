// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of press logs: rows that read back as the events, and numbers in the first unit with short exact
// texts.
#include <initializer_list>
#include <span>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/recording/press_log.hpp"

namespace asperity {

namespace {

struct Row {
  std::optional<double> time, place, rotation, load, dwell;
  std::optional<std::size_t> press{};  // event of the results
  bool empty() const { return !place && !rotation && !load; }
};

[[noreturn]] void refuse(std::size_t k, const Protocol::Step& step, const std::string& reason,
                         const std::string& hint = {}) {
  throw Error(ErrorCode::bad_value,
              "a press log cannot hold event " + std::to_string(k + 1) + ", " + text(step) + ": " + reason,
              hint);
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
  bool same_time(const Protocol::Event& event) const { return !timed || row_.time == event.time; }

  void begin(const Protocol::Event& event) {
    if (!row_.empty() && !same_time(event)) finish(0);
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
        refuse(k, event.step, "it presses to a pressure or a load only");
      if (by && *by != press->by)
        refuse(k, event.step,
               "it has a column of pressures or one of loads, and events before give the other");
      if (press->value < 0 || !press->preload.empty())
        refuse(k, event.step, "a log holds neither pulls nor preloads");
      if (!(press->value > 0)) refuse(k, event.step, "zero stands for a release there", "use a release");
      by = press->by;
      begin(event);
      row_.dwell = press->dwell;
      row_.press = k;
      finish(press->value);
    } else if (const auto* place = std::get_if<Protocol::Place>(&event.step)) {
      if (place->seed > (std::uint64_t{1} << 53)) refuse(k, event.step, "its seed is above 2^53");
      if (!row_.empty()) finish(0);
      begin(event);
      row_.place = static_cast<double>(place->seed);
    } else if (const auto* rotate = std::get_if<Protocol::Rotate>(&event.step)) {
      if (rotate->angle == 0) refuse(k, event.step, "a turn by nothing stands for none there");
      if (row_.rotation) finish(0);
      begin(event);
      row_.rotation = rotate->angle;
    } else if (std::holds_alternative<Protocol::Release>(event.step)) {
      if (!row_.empty()) finish(0);
      if (under_load_ && reader_releases(k)) return;
      begin(event);
      finish(0);
    } else {
      refuse(k, event.step, "it has no column for one");
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

struct TextColumn {
  std::string title;
  std::vector<std::string> cells;
};

using Member = std::optional<double> Row::*;

TextColumn column_of(const std::vector<Row>& rows, Member member, const std::string& name,
                     Dimension dimension, std::initializer_list<std::string> units) {
  TextColumn column;
  for (const std::string& unit : units) {
    column = {name + " [" + unit + "]", {}};
    bool exact = true;
    for (const Row& row : rows) {
      const std::optional<double>& value = row.*member;
      column.cells.push_back(value ? exact_text(*value, unit, dimension) : "");
      exact = exact && (!value || !column.cells.back().empty());
    }
    if (exact) return column;
  }
  throw Error(ErrorCode::internal, "a number of the column " + quoted(name) + " has no exact text");
}

// So many rows look like a recording without a column of dwells.
constexpr std::size_t rows_of_a_recording = 100;

bool any(const std::vector<Row>& rows, Member member) {
  for (const Row& row : rows)
    if (row.*member) return true;
  return false;
}

}  // namespace

std::string press_log_text(const Protocol& protocol, std::span<const ResultColumn> results) {
  const Gatherer gathered(protocol);
  const std::vector<Row>& rows = gathered.rows;
  std::vector<TextColumn> columns;
  if (gathered.timed) columns.push_back(column_of(rows, &Row::time, "time", dimension::time, {"s"}));
  if (any(rows, &Row::place)) {
    columns.push_back({"place", {}});
    for (const Row& row : rows) columns.back().cells.push_back(row.place ? format_exact(*row.place) : "");
  }
  if (any(rows, &Row::rotation))
    columns.push_back(column_of(rows, &Row::rotation, "rotation", dimension::angle, {"deg", "rad"}));
  if (gathered.by == PressBy::load)
    columns.push_back(column_of(rows, &Row::load, "load", dimension::force, {"N"}));
  else
    columns.push_back(column_of(rows, &Row::load, "pressure", dimension::pressure, {"MPa", "Pa"}));
  if (any(rows, &Row::dwell) || (gathered.timed && rows.size() >= rows_of_a_recording))
    columns.push_back(column_of(rows, &Row::dwell, "dwell", dimension::time, {"min", "s"}));
  for (const ResultColumn& result : results) {
    columns.push_back({"result " + result.title, {}});
    for (const Row& row : rows) {
      const std::optional<double> value = row.press ? result.values[*row.press] : std::nullopt;
      columns.back().cells.push_back(value ? format_exact(*value) : "");
    }
  }

  std::string text;
  const auto line = [&](const auto& cell) {
    for (std::size_t c = 0; c < columns.size(); ++c) text += (c == 0 ? "" : ", ") + cell(columns[c]);
    text += '\n';
  };
  line([](const TextColumn& column) { return column.title; });
  for (std::size_t r = 0; r < rows.size(); ++r)
    line([r](const TextColumn& column) { return column.cells[r]; });
  return text;
}

}  // namespace asperity
