// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/study_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/require.hpp"

namespace asperity {

namespace {

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
  if (error.high == 0) error.take(std::numeric_limits<double>::epsilon());  // every answer is the truth
  if (seconds.high == 0) seconds.take(1e-9);                                // a clock that did not move
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
