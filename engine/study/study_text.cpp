// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/study_text.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

Cell cell_of(const KnobValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  return std::get<std::string>(value);
}

// Number of UTF-8 characters.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string time_with_spread(const StudyRow& row) {
  if (row.runs.empty()) return seconds_text(row.first_seconds) + " (first run)";
  return seconds_text(row.seconds) + " (" + seconds_text(row.seconds_low) + " to " +
         seconds_text(row.seconds_high) + ")";
}

std::string short_reason(const std::string& reason, std::size_t most = 72) {
  std::string text = reason.substr(0, reason.find('\n'));
  if (width_of(text) <= most) return text;
  text.resize(most);
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  return text + "…";
}

// Settings of similar speed, smallest held error first.
std::string ties_text(const StudyResult& result, const StudyRow& row, double error) {
  constexpr std::size_t most_named = 3;
  std::vector<const StudyRow*> tied = tied_with(result, row, error);
  std::ranges::stable_sort(tied, {}, &StudyRow::held_error);
  std::string text;
  for (std::size_t k = 0; k < std::min(tied.size(), most_named); ++k)
    text += (k == 0 ? "; its time is not told apart from that of " : ", ") + result.name_of(*tied[k]) +
            " (held to " + error_text(tied[k]->held_error, result.relative()) + ")";
  if (tied.size() > most_named) text += " and " + std::to_string(tied.size() - most_named) + " more";
  return text;
}

std::string recommendation(const StudyResult& result, double error) {
  std::string text = "cheapest for " + error_text(error, result.relative()) + ": ";
  try {
    const StudyRow& row = cheapest(result, error);
    text += result.name_of(row) + ", " + seconds_text(row.seconds) + ", held to " +
            error_text(row.held_error, result.relative());
    if (row.confirmed == 0) text += ", which no finer setting confirms";
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
  switch (end) {
    case StudyRow::End::measured:
      return "measured";
    case StudyRow::End::failed:
      return "failed";
    case StudyRow::End::left_out:
      break;
  }
  return "left out";
}

}  // namespace

std::string aligned(const std::vector<TextLine>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const TextLine& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width_of(line[c]));
  std::string text;
  for (const TextLine& line : lines) {
    std::string row = " ";
    for (std::size_t c = 0; c < line.size(); ++c)
      row += " " + line[c] + std::string(widths[c] - width_of(line[c]) + 1, ' ');
    row.erase(row.find_last_not_of(' ') + 1);
    text += "\n" + row;
  }
  return text;
}

std::string share_text(double share) {
  const double percent = 100 * share;
  // No power of ten for readable percentages.
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
  const std::size_t ways = result.request.ways.size();
  std::string text = "work and precision: " + std::to_string(result.rows.size()) +
                     (result.rows.size() == 1 ? " setting of " : " settings of ") + std::to_string(ways) +
                     (ways == 1 ? " way" : " ways");
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
  if (std::any_of(result.rows.begin(), result.rows.end(), [](const StudyRow& row) { return row.pareto; }))
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

}  // namespace asperity
