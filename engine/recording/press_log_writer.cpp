// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <initializer_list>
#include <span>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/recording/press_log.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity {

namespace {

struct Row {
  std::optional<double> time, place, rotation, load, dwell;
  std::optional<std::size_t> press{};  // event of the results
  bool empty() const { return !place && !rotation && !load; }
};

[[noreturn]] void refuse_event(std::size_t k, const Protocol::Step& step, const std::string& reason,
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
