// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/study_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/core/require.hpp"
#include "engine/statistics/sample_mean.hpp"

namespace asperity {

namespace {

bool has_error(const StudyRow& row) { return row.end == StudyRow::End::measured && std::isfinite(row.error); }

std::vector<StudyRow*> rows_of_way(StudyResult& result, std::size_t way) {
  std::vector<StudyRow*> rows(result.request.ways[way].settings.size(), nullptr);
  for (StudyRow& row : result.rows)
    if (row.way == way) rows[row.setting] = &row;
  return rows;
}

constexpr double much_faster = 0.5;

bool stood_for(const StudyResult& result, const StudyRow& row, double error) {
  for (const StudyRow& other : result.rows) {
    if (&other == &row) return false;
    if (has_error(other) && other.held_error <= error && other.value == row.value &&
        row.seconds >= much_faster * other.seconds)
      return true;
  }
  return false;
}

Cell cell_of(const KnobValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  return std::get<std::string>(value);
}

std::string time_with_spread(const StudyRow& row) {
  if (row.runs.empty()) return seconds_text(row.first_seconds) + " (first run)";
  return seconds_text(row.seconds) + " (" + seconds_text(row.seconds_low) + " to " +
         seconds_text(row.seconds_high) + ")";
}

std::string short_reason(const std::string& reason) {
  constexpr std::size_t longest = 72;
  return shortened(reason.substr(0, reason.find('\n')), longest);
}

std::string ties_text(const StudyResult& result, const StudyRow& row, double error) {
  constexpr std::size_t most_named = 3;
  std::vector<const StudyRow*> tied = tied_with(result, row, error);
  std::ranges::stable_sort(tied, {}, &StudyRow::held_error);
  std::string text;
  for (std::size_t k = 0; k < std::min(tied.size(), most_named); ++k)
    text += (k == 0 ? "; as fast within the scatter: " : ", ") + result.name_of(*tied[k]) + " (held to " +
            error_text(tied[k]->held_error, result.relative()) + ")";
  if (tied.size() > most_named) text += " and " + std::to_string(tied.size() - most_named) + " more";
  return text;
}

std::string recommendation(const StudyResult& result, double error) {
  std::string text = "cheapest for " + error_text(error, result.relative()) + ": ";
  try {
    const StudyRow& row = cheapest(result, error);
    text += result.name_of(row) + ", " + seconds_text(row.seconds) + ", held to " +
            error_text(row.held_error, result.relative());
    if (row.confirmed == 0) text += ", not confirmed by a finer setting";
    text += ties_text(result, row, error);
  } catch (const Error& refusal) {
    text += "none of these";
    const StudyRow* best = best_held(result);
    if (best != nullptr)
      text += "; the best reached is " + error_text(best->held_error, result.relative()) + ", by " +
              result.name_of(*best);
  }
  return text;
}

Json to_json(const KnobValue& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

std::string_view name(StudyRow::End end) {
  constexpr std::array<std::string_view, 3> names = {"measured", "failed", "left out"};
  return names.at(static_cast<std::size_t>(end));
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void take(double value) {
    if (!(value > 0) || std::isinf(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  Range range(double below, double above) const { return {low / below, high * above}; }
};

double time_of(const StudyRow& row) {
  return row.end == StudyRow::End::failed ? row.first_seconds : row.expected_seconds.value_or(0);
}

void add(ChartSeries& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

LineChart chart_of_times(const std::string& title, bool relative) {
  LineChart chart;
  chart.title = title;
  chart.x.label = "time of one run";
  chart.x.unit = "s";
  chart.y.label = relative ? "error, relative to the truth" : "error, absolute (the truth is 0)";
  chart.x.logarithmic = chart.y.logarithmic = true;
  return chart;
}

}  // namespace

std::string StudyResult::name_of(const StudyRow& row) const {
  return way_of(row).name + " " + lua_source(knobs_of(row));
}

bool StudyResult::is_truth(const StudyRow& row) const {
  const auto* knobs = std::get_if<Knobs>(&request.truth);
  return knobs != nullptr && (*knobs == knobs_of(row) || (truth && row.value == *truth));
}

double StudyResult::overhead() const {
  return asked_seconds > 0 ? (total_seconds - asked_seconds) / asked_seconds : 0;
}

void conclude(StudyResult& result) {
  for (StudyRow& row : result.rows) {
    row.pareto = false;
    row.confirmed = 0;
    row.error = row.held_error = row.absolute_error = StudyRow::none;
    if (row.end != StudyRow::End::measured) continue;
    row.seconds = row.seconds_low = row.seconds_high = row.first_seconds;
    if (!row.runs.empty()) {
      row.seconds = median(row.runs);
      row.seconds_low = *std::ranges::min_element(row.runs);
      row.seconds_high = *std::ranges::max_element(row.runs);
    }
    if (!result.truth || result.is_truth(row)) continue;
    row.absolute_error = std::abs(row.value - *result.truth);
    row.error = result.relative() ? row.absolute_error / std::abs(*result.truth) : row.absolute_error;
  }
  for (std::size_t way = 0; way < result.request.ways.size(); ++way) {
    const std::vector<StudyRow*> rows = rows_of_way(result, way);
    const std::vector<std::size_t> order = coarse_to_fine(result.request.ways[way]);
    double greatest = 0;
    int finer = 0;
    for (auto place = order.rbegin(); place != order.rend(); ++place) {
      StudyRow* row = rows[*place];
      if (row == nullptr || !has_error(*row)) continue;
      greatest = std::max(greatest, row->error);
      row->held_error = greatest;
      row->confirmed = finer++;
    }
  }
  for (StudyRow& row : result.rows) {
    if (!has_error(row)) continue;
    row.pareto = std::ranges::none_of(result.rows, [&](const StudyRow& other) {
      return has_error(other) && other.seconds <= row.seconds && other.error <= row.error &&
             (other.seconds < row.seconds || other.error < row.error);
    });
  }
}

const StudyRow* best_held(const StudyResult& result) {
  const StudyRow* best = nullptr;
  for (const StudyRow& row : result.rows) {
    if (!has_error(row)) continue;
    if (best == nullptr || row.held_error < best->held_error ||
        (row.held_error == best->held_error && row.error > best->error))
      best = &row;
  }
  return best;
}

std::vector<const StudyRow*> tied_with(const StudyResult& result, const StudyRow& chosen, double error) {
  std::vector<const StudyRow*> tied;
  for (const StudyRow& row : result.rows)
    if (&row != &chosen && has_error(row) && row.held_error <= error && !stood_for(result, row, error) &&
        row.seconds_low <= chosen.seconds_high && chosen.seconds_low <= row.seconds_high)
      tied.push_back(&row);
  return tied;
}

const StudyRow& cheapest(const StudyResult& result, double error) {
  require(error > 0 && !std::isinf(error), "error", error, "", "give a number above 0");
  const StudyRow *found = nullptr, *accident = nullptr;
  for (const StudyRow& row : result.rows) {
    if (!has_error(row)) continue;
    if (row.held_error <= error) {
      if (stood_for(result, row, error)) continue;
      if (found == nullptr || row.seconds < found->seconds) found = &row;
    } else if (row.error <= error && accident == nullptr) {
      accident = &row;
    }
  }
  if (found != nullptr) return *found;
  std::string sentence = "no setting of the study holds an error of " + error_text(error, result.relative());
  const StudyRow* best = best_held(result);
  if (best == nullptr) refuse_infeasible(sentence, "none of them was measured");
  sentence += ": the best reached is " + error_text(best->held_error, result.relative()) + ", by " +
              result.name_of(*best);
  std::string hint = "add finer settings to a way, or ask for less";
  if (accident != nullptr)
    hint = result.name_of(*accident) + " reaches " + error_text(accident->error, result.relative()) +
           " by accident: finer settings of its way do not; " + hint;
  refuse_infeasible(sentence, hint);
}

std::string share_text(double share) {
  const double percent = 100 * share;
  return format_short(percent >= 100 && percent < 1e6 ? std::round(percent) : percent,
                      percent >= 100 ? 6 : 3) +
         " %";
}

std::string error_text(double error, bool relative) {
  return relative ? share_text(error) : format_short(error, 3);
}

std::string seconds_text(double seconds) {
  if (seconds < 99.95) return format_quantity(seconds, dimension::time, 3);
  const auto whole = static_cast<long long>(std::llround(std::fmin(seconds, 1e12)));
  const auto two = [](long long large, const char* unit, long long small, const char* rest) {
    return std::to_string(large) + unit + (small > 0 ? " " + std::to_string(small) + rest : "");
  };
  return whole < 3600 ? two(whole / 60, " min", whole % 60, " s")
                      : two(whole / 3600, " h", whole % 3600 / 60, " min");
}

std::string study_text(const StudyResult& result) {
  std::string text = "work and precision: " + counted(result.rows.size(), "setting") + " of " +
                     counted(result.request.ways.size(), "way");
  if (result.truth) {
    text += ", truth " + format_short(*result.truth, 8);
    if (const auto* knobs = std::get_if<Knobs>(&result.request.truth))
      text += " from " + lua_source(*knobs) + " in " + seconds_text(result.truth_seconds);
    if (!result.relative()) text += "; errors are absolute, for it is 0";
  }
  if (!result.complete) text += "; stopped before its end";

  std::vector<TextLine> lines = {{"way", "setting", "value", "error", "seconds (fastest to slowest)", ""}};
  std::string previous;
  for (const StudyRow& row : result.rows) {
    const std::string& way = result.way_of(row).name;
    TextLine line = {way == previous ? "" : way, lua_source(result.knobs_of(row)), "", "", "", ""};
    previous = way;
    if (row.end == StudyRow::End::measured) {
      line[2] = format_short(row.value, 7);
      line[3] = std::isfinite(row.error) ? error_text(row.error, result.relative()) : "";
      line[4] = time_with_spread(row);
      if (row.pareto) line[5] = "*";
      if (!row.reason.empty()) line[5] += (line[5].empty() ? "" : " ") + short_reason(row.reason);
    } else {
      line[2] = row.end == StudyRow::End::failed ? "failed" : "left out";
      line[5] = short_reason(row.reason);
    }
    lines.push_back(std::move(line));
  }
  text += aligned(lines);
  if (std::ranges::any_of(result.rows, [](const StudyRow& row) { return row.pareto; }))
    text += "\n  * nothing measured is both faster and closer";
  if (result.relative())
    for (const double error : {0.1, 0.01, 0.001}) text += "\n" + recommendation(result, error);
  text += "\n" + std::to_string(result.calls) + " calls took " + seconds_text(result.asked_seconds) +
          ", the study itself " + share_text(result.overhead()) + " more";
  return text;
}

Table study_table(const StudyResult& result) {
  Table table;
  table.declare_unit("way", "");
  std::set<std::string> names;
  for (const StudyWay& way : result.request.ways)
    for (const Knobs& knobs : way.settings)
      for (const Knob& knob : knobs) names.insert(knob.name);
  for (const StudyRow& row : result.rows) {
    std::vector<Entry> entries = {{"way", result.way_of(row).name}};
    for (const std::string& name_of_knob : names) {
      Entry entry{name_of_knob, {}};
      for (const Knob& knob : result.knobs_of(row))
        if (knob.name == name_of_knob) entry.value = cell_of(knob.value);
      entries.push_back(std::move(entry));
    }
    const auto number = [](double value) { return std::isfinite(value) ? Cell(value) : Cell(); };
    entries.push_back({"end", std::string(name(row.end))});
    entries.push_back({"value", number(row.value)});
    entries.push_back({"error", number(row.error)});
    entries.push_back({"absolute_error", number(row.absolute_error)});
    entries.push_back({"held_error", number(row.held_error)});
    entries.push_back({"seconds", number(row.seconds), "s"});
    entries.push_back({"seconds_low", number(row.seconds_low), "s"});
    entries.push_back({"seconds_high", number(row.seconds_high), "s"});
    entries.push_back({"first_seconds", number(row.first_seconds), "s"});
    entries.push_back({"runs", static_cast<double>(row.runs.size())});
    entries.push_back({"pareto", row.pareto});
    entries.push_back({"steady", row.steady});
    entries.push_back({"reason", row.reason.empty() ? Cell() : Cell(row.reason)});
    table.append(entries);
  }
  return table;
}

Json to_json(const Knobs& knobs) {
  Json json = Json::object();
  for (const Knob& knob : knobs) json.set(knob.name, to_json(knob.value));
  return json;
}

Json to_json(const StudyRequest& request) {
  Json::List ways;
  for (const StudyWay& way : request.ways) {
    Json::List settings;
    for (const Knobs& knobs : way.settings) settings.push_back(to_json(knobs));
    ways.push_back(Json::object({{"name", way.name}, {"settings", std::move(settings)}}));
  }
  Json json = Json::object({{"try", std::move(ways)}});
  if (const auto* knobs = std::get_if<Knobs>(&request.truth))
    json.set("truth", to_json(*knobs));
  else
    json.set("truth", std::get<double>(request.truth));
  json.set("repeats", request.repeats);
  if (request.at_most) json.set("at_most", *request.at_most);
  return json;
}

Json answers_json(const StudyResult& result) {
  Json::List rows;
  for (const StudyRow& row : result.rows) {
    Json line = Json::object({{"way", result.way_of(row).name},
                              {"knobs", to_json(result.knobs_of(row))},
                              {"end", std::string(name(row.end))}});
    if (std::isfinite(row.value)) line.set("value", row.value);
    if (std::isfinite(row.error)) line.set("error", row.error);
    if (row.end == StudyRow::End::failed) line.set("reason", row.reason);
    rows.push_back(std::move(line));
  }
  Json json = Json::object({{"rows", std::move(rows)}});
  if (result.truth) json.set("truth", *result.truth);
  json.set("complete", result.complete);
  return json;
}

LineChart study_chart(const StudyResult& result, const std::string& title) {
  Extent seconds, error;
  bool top = false, bottom = false;
  for (const StudyRow& row : result.rows) {
    if (row.end == StudyRow::End::measured && std::isfinite(row.error)) {
      for (const double value : {row.seconds_low, row.seconds, row.seconds_high}) seconds.take(value);
      error.take(row.error);
      bottom |= row.error == 0;
    } else if (row.end != StudyRow::End::measured) {
      top |= time_of(row) > 0;
    }
  }
  if (error.high == 0 && !bottom)
    refuse("the chart of the study has nothing to draw", "no setting was measured against the truth");
  if (error.high == 0) error.take(std::numeric_limits<double>::epsilon());  // only exact answers
  if (seconds.high == 0) seconds.take(1e-9);                                // a clock without steps
  // A distant mark would squeeze the lines.
  constexpr double room = 4;
  const Extent measured = seconds;
  const auto at_rim = [&measured](const StudyRow& row) {
    return std::clamp(time_of(row), measured.low / room, measured.high * room);
  };
  for (const StudyRow& row : result.rows)
    if (row.end != StudyRow::End::measured && time_of(row) > 0) seconds.take(at_rim(row));

  LineChart chart = chart_of_times(title, result.relative());
  chart.x.range = seconds.range(1.4, 1.4);
  chart.y.range = error.range(bottom ? 4 : 1.6, top ? 4 : 1.6);
  const double high = chart.y.range->max / 1.2, low = chart.y.range->min * 1.2;

  ChartSeries front = marks_alone("nothing beats these", PointShape::ring),
              failed = marks_alone("failed", PointShape::cross),
              left_out = marks_alone("left out: budget", PointShape::triangle),
              exact = marks_alone("no error at all", PointShape::diamond);
  for (std::size_t way = 0; way < result.request.ways.size(); ++way) {
    ChartSeries line;
    line.name = result.request.ways[way].name;
    for (const std::size_t place : coarse_to_fine(result.request.ways[way]))
      for (const StudyRow& row : result.rows) {
        if (row.way != way || row.setting != place) continue;
        if (row.end == StudyRow::End::failed) {
          add(failed, at_rim(row), high);
        } else if (row.end == StudyRow::End::left_out) {
          if (time_of(row) > 0) add(left_out, at_rim(row), high);
        } else if (row.error == 0) {
          add(exact, row.seconds, low);
        } else if (std::isfinite(row.error)) {
          add(line, row.seconds, row.error);
          line.x_low.push_back(row.seconds_low);
          line.x_high.push_back(row.seconds_high);
          if (row.pareto) add(front, row.seconds, row.error);
        }
      }
    chart.series.push_back(std::move(line));
  }
  for (ChartSeries* marks : {&front, &failed, &left_out, &exact})
    if (!marks->x.empty()) chart.series.push_back(std::move(*marks));
  return chart;
}

}  // namespace asperity
