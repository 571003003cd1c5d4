// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/text.hpp"
#include "engine/plot/palette.hpp"

namespace asperity {

namespace {

// Filled and open shapes of gnuplot that stay apart when small and in black: circle, square, triangle,
// diamond, triangle down, pentagon; then their open forms.
constexpr std::array<int, 10> shapes = {7, 5, 9, 13, 11, 15, 6, 4, 8, 12};
constexpr std::array<std::string_view, 5> dashes = {"1", "'-'", "'_. '", "'.'", "'_-'"};

constexpr const char* mark_colour = "rgb '#505050'";

int point_type(const ChartSeries& series, int k) {
  switch (series.shape) {
    case PointShape::ring:
      return 6;
    case PointShape::cross:
      return 2;
    case PointShape::triangle:
      return 8;
    case PointShape::diamond:
      return 12;
    case PointShape::of_line:
      break;
  }
  return shapes[static_cast<std::size_t>(k) % shapes.size()];
}

bool drawable(double value, const ChartAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

struct Point {
  double x, y, low, high, left, right;
  bool after_gap = false;
};

std::string count_sentence(std::size_t lost, std::size_t all, std::string_view why) {
  return std::to_string(lost) + " of " + std::to_string(all) + (all == 1 ? " value is" : " values are") +
         " not drawn: " + std::string(why);
}

// What is left out, and why, over all series.
struct Losses {
  std::size_t all = 0, not_finite = 0, too_large = 0, not_positive_x = 0, not_positive_y = 0;

  bool keep(double x, double y, const LineChart& chart) {
    ++all;
    // The largest doubles would overflow in the sums that place them.
    constexpr double largest = 1e300;
    if (!std::isfinite(x) || !std::isfinite(y)) {
      ++not_finite;
    } else if (std::abs(x) > largest || std::abs(y) > largest) {
      ++too_large;
    } else if (!drawable(x, chart.x)) {
      ++not_positive_x;
    } else if (!drawable(y, chart.y)) {
      ++not_positive_y;
    } else {
      return true;
    }
    return false;
  }
  void tell(const LineChart& chart, std::vector<std::string>& warnings) const {
    if (not_finite > 0) warnings.push_back(count_sentence(not_finite, all, "not finite"));
    if (too_large > 0) warnings.push_back(count_sentence(too_large, all, "too large to draw (above 1e300)"));
    const std::string reason = " is not above zero, and its axis is logarithmic";
    if (not_positive_x > 0)
      warnings.push_back(count_sentence(not_positive_x, all, asperity::quoted(chart.x.label) + reason));
    if (not_positive_y > 0)
      warnings.push_back(count_sentence(not_positive_y, all, asperity::quoted(chart.y.label) + reason));
  }
};

std::string tic_command(std::string_view axis, const AxisLayout& layout) {
  std::string text = "set " + std::string(axis) + "tics nomirror out scale 0.8,0.4 textcolor rgb '#202020' (";
  for (std::size_t k = 0; k < layout.tics.size(); ++k) {
    const Tic& tic = layout.tics[k];
    if (k > 0) text += ", ";
    text += gnuplot_text(tic.label) + " " + gnuplot_number(tic.at) + (tic.label.empty() ? " 1" : " 0");
  }
  return text + ")\n";
}

std::string axis_command(std::string_view axis, const AxisLayout& layout, bool logarithmic) {
  const std::string name(axis);
  return (logarithmic ? "set logscale " + name + " 10\n" : "") + "set " + name + "range [" +
         gnuplot_number(layout.low) + ":" + gnuplot_number(layout.high) + "]\nset " + name + "label " +
         gnuplot_text(layout.label) + "\n" + tic_command(axis, layout);
}

std::vector<Point> points_of(const ChartSeries& series, const LineChart& chart, Losses& losses) {
  if (series.x.size() != series.y.size() || series.cloud_x.size() != series.cloud_y.size() ||
      (!series.y_error.empty() && series.y_error.size() != series.y.size()) ||
      series.x_low.size() != series.x_high.size() ||
      (!series.x_low.empty() && series.x_low.size() != series.x.size()))
    throw Error(ErrorCode::bad_value,
                "the line " + asperity::quoted(series.name) + " of a chart has " +
                    std::to_string(series.x.size()) + " x and " + std::to_string(series.y.size()) +
                    " y values",
                "give as many of one as of the other, and as many errors or none");
  std::vector<Point> points;
  bool gap = false;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (series.gaps && (std::isnan(series.x[k]) || std::isnan(series.y[k]))) {
      gap = !points.empty();
      continue;
    }
    if (!losses.keep(series.x[k], series.y[k], chart)) continue;
    const double error = series.y_error.empty() || !std::isfinite(series.y_error[k]) ? 0 : series.y_error[k];
    double left = series.x[k], right = left;
    if (!series.x_low.empty() && drawable(series.x_low[k], chart.x) && drawable(series.x_high[k], chart.x)) {
      left = series.x_low[k];
      right = series.x_high[k];
    }
    points.push_back({series.x[k], series.y[k], series.y[k] - error, series.y[k] + error, left, right, gap});
    gap = false;
  }
  return points;
}

struct Ends {
  std::vector<double> x, y;
};

std::string data_block(const std::string& name, const std::vector<Point>& points, const AxisLayout& x,
                       const AxisLayout& y, bool across) {
  std::string text = "$" + name + " << EOD\n";
  for (const Point& point : points) {
    if (point.after_gap) text += "\n";  // an empty line breaks the line of a plot
    // The foot of a bar that reaches past zero ends at the rim of a logarithmic axis.
    const double low = std::max(point.low / y.factor, y.low), high = std::min(point.high / y.factor, y.high);
    text += gnuplot_number(point.x / x.factor) + " " + gnuplot_number(point.y / y.factor) + " " +
            gnuplot_number(low) + " " + gnuplot_number(high);
    if (across)
      text += " " + gnuplot_number(point.left / x.factor) + " " + gnuplot_number(point.right / x.factor);
    text += "\n";
  }
  return text + "EOD\n";
}

}  // namespace

std::string chart_script(const LineChart& chart, PictureFormat format, std::vector<std::string>& warnings) {
  Losses losses, ignored;
  std::vector<std::vector<Point>> points, clouds;
  Ends ends;
  bool keyed = false;
  for (const ChartSeries& series : chart.series) {
    points.push_back(points_of(series, chart, losses));
    clouds.push_back(points_of({.name = series.name,
                                .x = series.cloud_x,
                                .y = series.cloud_y,
                                .y_error = {},
                                .cloud_x = {},
                                .cloud_y = {},
                                .x_low = {},
                                .x_high = {}},
                               chart, ignored));
    for (const auto* set : {&points.back(), &clouds.back()})
      for (const Point& point : *set) {
        ends.x.insert(ends.x.end(), {point.x, point.left, point.right});
        ends.y.insert(ends.y.end(), {point.y, point.low, point.high});
      }
    keyed |= !series.name.empty();
  }
  losses.tell(chart, warnings);
  if (ends.x.empty())
    throw Error(ErrorCode::bad_value,
                "the chart of " + asperity::quoted(chart.y.label) + " against " +
                    asperity::quoted(chart.x.label) + " has nothing to draw",
                warnings.empty() ? "no row has a number in both" : warnings.front());

  ChartAxis x_axis = chart.x, y_axis = chart.y;
  if (chart.equal_axes)
    for (const auto* values : {&ends.x, &ends.y})
      for (const double value : *values)
        x_axis.prefix_for = y_axis.prefix_for = std::max(x_axis.prefix_for.value_or(0), std::abs(value));
  const AxisLayout x = lay_out(x_axis, ends.x), y = lay_out(y_axis, ends.y);

  std::string script = gnuplot_terminal(format, chart.width, chart.height, 16);
  for (std::size_t k = 0; k < points.size(); ++k) {
    script += data_block("line" + std::to_string(k), points[k], x, y, !chart.series[k].x_low.empty());
    script += data_block("cloud" + std::to_string(k), clouds[k], x, y, false);
  }
  script +=
      "set border 3 linewidth 1.2 linecolor rgb '#404040'\n"
      "set grid xtics ytics mxtics mytics linetype 1 linewidth 0.7 linecolor rgb '#dcdcdc', "
      "linetype 1 linewidth 0.5 linecolor rgb '#eeeeee'\n";
  script += axis_command("x", x, chart.x.logarithmic) + axis_command("y", y, chart.y.logarithmic);
  if (!chart.title.empty()) script += "set title " + gnuplot_text(chart.title) + " font ',18'\n";
  if (chart.equal_axes) script += "set size ratio -1\n";
  script += keyed ? "set key outside right top Left reverse samplen 2.6 spacing 1.25\n" : "set key off\n";
  if (keyed && !chart.key_title.empty())
    script += "set key title " + gnuplot_text(chart.key_title) + " left\n";

  for (const ChartLabel& label : chart.labels)
    if (drawable(label.x, chart.x) && drawable(label.y, chart.y))
      script += "set label " + gnuplot_text(label.text) + " at " + gnuplot_number(label.x / x.factor) + "," +
                gnuplot_number(label.y / y.factor) + " center front offset 0," +
                (label.below ? "-1.4" : "0.8") + " font ',13' textcolor rgb '#202020'\n";

  const int lines = static_cast<int>(chart.series.size());
  std::vector<std::string> layers, clouds_first;
  for (int k = 0; k < lines; ++k) {
    const ChartSeries& series = chart.series[static_cast<std::size_t>(k)];
    const bool mark = series.shape != PointShape::of_line;
    const std::string colour = mark ? mark_colour : gnuplot_colour(line_colour(k, lines)),
                      number = std::to_string(k), shape = std::to_string(point_type(series, k));
    if (!clouds[static_cast<std::size_t>(k)].empty())
      clouds_first.push_back("$cloud" + number + " using 1:2 with points pointtype " + shape +
                             " pointsize 0.7 linecolor rgb '#80" + colour.substr(6) + " notitle");
    if (points[static_cast<std::size_t>(k)].empty()) continue;
    if (!series.y_error.empty())
      layers.push_back("$line" + number +
                       " using 1:2:3:4 with yerrorbars pointtype -1 linewidth 1.4 linecolor " + colour +
                       " notitle");
    if (!series.x_low.empty())
      layers.push_back("$line" + number +
                       " using 1:2:5:6 with xerrorbars pointtype -1 linewidth 1.4 linecolor " + colour +
                       " notitle");
    const std::string style = series.line ? (series.points ? "linespoints" : "lines") : "points";
    std::string layer = "$line" + number + " using 1:2 with " + style + " linecolor " + colour;
    if (mark)
      layer += " linewidth 1.2";
    else if (series.line)
      layer += " linewidth 2.2 dashtype " + std::string(dashes[static_cast<std::size_t>(k) % dashes.size()]);
    if (series.points || !series.line)
      layer += " pointtype " + shape + (mark ? " pointsize 2" : " pointsize 1.2");
    layers.push_back(layer + (series.name.empty() ? " notitle" : " title " + gnuplot_text(series.name)));
  }
  clouds_first.insert(clouds_first.end(), layers.begin(), layers.end());
  return script + "plot " + joined(clouds_first, ", ") + "\n";
}

std::vector<std::string> draw(const LineChart& chart, const std::filesystem::path& file) {
  std::vector<std::string> warnings;
  const std::string script = chart_script(chart, picture_format(file), warnings);
  const GnuplotResult drawn = run_gnuplot(script);
  write_atomically(file, drawn.picture);
  const std::vector<std::string> complaints = complaints_of(drawn, file);
  warnings.insert(warnings.end(), complaints.begin(), complaints.end());
  return warnings;
}

}  // namespace asperity
