// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/require.hpp"
#include "engine/plot/palette.hpp"

namespace asperity {

namespace {

// Distinct when small and black, filled then open.
constexpr std::array<int, 10> shapes = {7, 5, 9, 13, 11, 15, 6, 4, 8, 12};
constexpr std::array<std::string_view, 5> dashes = {"1", "'-'", "'_. '", "'.'", "'_-'"};
constexpr std::array<std::string_view, 4> reference_dashes = {"'--'", "'. '", "'-. '", "'-.. '"};

constexpr const char* mark_colour = "rgb '#505050'";

int point_type(const ChartSeries& series, int k) {
  constexpr std::array<int, 5> open = {0, 6, 2, 8, 12};  // in the order of PointShape
  return series.shape == PointShape::of_line ? shapes[static_cast<std::size_t>(k) % shapes.size()]
                                             : open[static_cast<std::size_t>(series.shape)];
}

bool drawable(double value, const ChartAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

struct Point {
  double x, y, low, high, left, right;
  bool after_gap = false;
  bool reaches(bool logarithmic) const { return logarithmic && low <= 0; }  // beyond the axis
};

struct Losses {
  std::size_t all = 0;
  std::array<std::size_t, 4> lost{};  // not finite, too large, not positive along x, along y

  bool keep(double x, double y, const LineChart& chart) {
    ++all;
    // Larger values overflow in the layout.
    constexpr double largest = 1e300;
    const std::array<bool, 4> faults{!std::isfinite(x) || !std::isfinite(y),
                                     std::abs(x) > largest || std::abs(y) > largest, !drawable(x, chart.x),
                                     !drawable(y, chart.y)};
    const auto first = std::ranges::find(faults, true);
    if (first == faults.end()) return true;
    ++lost[static_cast<std::size_t>(first - faults.begin())];
    return false;
  }
  void tell(const LineChart& chart, std::vector<std::string>& warnings) const {
    const std::string not_positive = " is not above zero, and its axis is logarithmic";
    const std::array<std::string, 4> reasons{"not finite", "too large to draw (above 1e300)",
                                             asperity::quoted(chart.x.label) + not_positive,
                                             asperity::quoted(chart.y.label) + not_positive};
    for (std::size_t k = 0; k < lost.size(); ++k)
      if (lost[k] > 0)
        warnings.push_back(std::to_string(lost[k]) + " of " + std::to_string(all) +
                           (all == 1 ? " value is" : " values are") + " not drawn: " + reasons[k]);
  }
};

std::string tic_command(std::string_view axis, const AxisLayout& layout) {
  std::string text = "set " + std::string(axis) + "tics nomirror out scale 0.8,0.4 ";
  if (layout.slanted && axis == "x") text += "rotate by 45 right ";
  text += "textcolor rgb '#202020' (";
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
      series.x_low.size() != series.x_high.size() || series.y_low.size() != series.y_high.size() ||
      (!series.x_low.empty() && series.x_low.size() != series.x.size()) ||
      (!series.y_low.empty() && series.y_low.size() != series.y.size()))
    refuse("the line " + asperity::quoted(series.name) + " of a chart has " +
               std::to_string(series.x.size()) + " x and " + std::to_string(series.y.size()) + " y values",
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
    double low = series.y[k] - error, high = series.y[k] + error;
    if (!series.y_low.empty() && std::isfinite(series.y_low[k]) && std::isfinite(series.y_high[k])) {
      low = series.y_low[k];
      high = series.y_high[k];
    }
    points.push_back({series.x[k], series.y[k], low, high, left, right, gap});
    gap = false;
  }
  return points;
}

struct Ends {
  std::vector<double> x, y;
};

std::string data_block(const std::string& name, const std::vector<Point>& points, const AxisLayout& x,
                       const AxisLayout& y, const ChartSeries& series, bool logarithmic) {
  std::string text = "$" + name + " << EOD\n";
  for (const Point& point : points) {
    if (point.after_gap) text += "\n";  // an empty line breaks the plotted line
    // A band is clipped; a bar beyond a logarithmic axis gets its arrow from open_bars.
    const bool open = !series.band && point.reaches(logarithmic);
    const double low = open ? point.y / y.factor : std::max(point.low / y.factor, y.low),
                 high = std::min(point.high / y.factor, y.high);
    text += gnuplot_number(point.x / x.factor) + " " + gnuplot_number(point.y / y.factor) + " " +
            gnuplot_number(low) + " " + gnuplot_number(high);
    if (!series.x_low.empty())
      text += " " + gnuplot_number(point.left / x.factor) + " " + gnuplot_number(point.right / x.factor);
    text += "\n";
  }
  return text + "EOD\n";
}

struct Content {
  std::vector<std::vector<Point>> points, clouds;
  Ends ends;
  bool keyed = false;
  std::size_t longest_name = 0;
};

void take_references(const LineChart& chart, Content& content, std::vector<std::string>& warnings) {
  for (const ChartReference& line : chart.references) {
    const bool along = line.y.has_value();
    const double at = along ? *line.y : line.x.value_or(std::nan(""));
    if (!drawable(at, along ? chart.y : chart.x)) {
      warnings.push_back("the line at " + std::string(along ? "y" : "x") + " = " + format_short(at) +
                         " is not drawn: it has no place on its axis");
      continue;
    }
    (along ? content.ends.y : content.ends.x).push_back(at);
    content.keyed |= !line.name.empty();
    content.longest_name = std::max(content.longest_name, characters_of(line.name));
  }
}

Content gathered(const LineChart& chart, std::vector<std::string>& warnings) {
  Content content;
  Losses losses, ignored;
  for (const ChartSeries& series : chart.series) {
    content.points.push_back(points_of(series, chart, losses));
    ChartSeries cloud;
    cloud.name = series.name;
    cloud.x = series.cloud_x;
    cloud.y = series.cloud_y;
    content.clouds.push_back(points_of(cloud, chart, ignored));
    for (const auto* set : {&content.points.back(), &content.clouds.back()})
      for (const Point& point : *set) {
        content.ends.x.insert(content.ends.x.end(), {point.x, point.left, point.right});
        content.ends.y.insert(content.ends.y.end(), {point.y, point.low, point.high});
      }
    content.keyed |= !series.name.empty();
    content.longest_name = std::max(content.longest_name, characters_of(series.name));
  }
  content.longest_name = std::max(content.longest_name, characters_of(chart.key_title));
  for (const ChartBar& bar : chart.bars) {
    content.ends.x.insert(content.ends.x.end(), {bar.left, bar.right});
    content.ends.y.insert(content.ends.y.end(), {0, bar.height});
  }
  losses.tell(chart, warnings);
  if (content.ends.x.empty())
    refuse("the chart of " + asperity::quoted(chart.y.label) + " against " + asperity::quoted(chart.x.label) +
               " has nothing to draw",
           warnings.empty() ? "no row has a number in both" : warnings.front());
  take_references(chart, content, warnings);
  return content;
}

struct Axes {
  AxisLayout x, y;
};

Axes axes_of(const LineChart& chart, const Content& content) {
  ChartAxis x_axis = chart.x, y_axis = chart.y;
  x_axis.names_room = chart.width - 340;
  if (chart.width < 700) x_axis.tics = chart.width / 150 + 1;
  if (chart.equal_axes)
    for (const auto* values : {&content.ends.x, &content.ends.y})
      for (const double value : *values)
        x_axis.prefix_for = y_axis.prefix_for = std::max(x_axis.prefix_for.value_or(0), std::abs(value));
  Axes axes{lay_out(x_axis, content.ends.x), lay_out(y_axis, content.ends.y)};
  // Bars start at the axis.
  if (!chart.bars.empty() && !chart.y.logarithmic) axes.y.low = std::max(axes.y.low, 0.0);
  return axes;
}

// Bars beyond a logarithmic axis: x, y and the way down to the frame, an arrow without a cap.
std::string open_bars(const std::string& name, const std::vector<Point>& points, const Axes& axes) {
  std::string text;
  for (const Point& point : points)
    if (point.low <= 0)
      text += gnuplot_number(point.x / axes.x.factor) + " " + gnuplot_number(point.y / axes.y.factor) + " " +
              gnuplot_number(axes.y.low - point.y / axes.y.factor) + "\n";
  return text.empty() ? text : "$" + name + " << EOD\n" + text + "EOD\n";
}

std::string reference_data(const LineChart& chart, const Axes& axes, const std::string& prefix) {
  std::string text;
  for (std::size_t k = 0; k < chart.references.size(); ++k) {
    const ChartReference& line = chart.references[k];
    const double at = line.y ? *line.y : line.x.value_or(std::nan(""));
    if (!drawable(at, line.y ? chart.y : chart.x)) continue;
    const std::string place = gnuplot_number(at / (line.y ? axes.y : axes.x).factor);
    const AxisLayout& along = line.y ? axes.x : axes.y;
    text += "$" + prefix + "across" + std::to_string(k) + " << EOD\n";
    for (const double end : {along.low, along.high})
      text += line.y ? gnuplot_number(end) + " " + place + "\n" : place + " " + gnuplot_number(end) + "\n";
    text += "EOD\n";
  }
  return text;
}

std::string bar_data(const LineChart& chart, const Axes& axes, const std::string& prefix) {
  if (chart.bars.empty()) return "";
  std::string text = "$" + prefix + "bars << EOD\n";
  for (const ChartBar& bar : chart.bars) {
    const double left = bar.left / axes.x.factor, right = bar.right / axes.x.factor;
    text += gnuplot_number(0.5 * (left + right)) + " 0 " + gnuplot_number(left) + " " +
            gnuplot_number(right) + " " + gnuplot_number(axes.y.low) + " " +
            gnuplot_number(std::max(axes.y.low, bar.height / axes.y.factor)) + "\n";
  }
  return text + "EOD\n";
}

// Left margin in pixels for slanted names (16 points); 0: gnuplot's default.
double left_rim(const LineChart& chart, const AxisLayout& x) {
  constexpr double usual = 125, character = 11.8, share_along = 0.71, reserved = 160;
  if (!x.slanted) return 0;
  const double step = (chart.width - usual - reserved) / static_cast<double>(x.tics.size());
  double rim = usual;
  for (std::size_t k = 0; k < x.tics.size(); ++k)
    rim = std::max(rim, character * share_along * static_cast<double>(characters_of(x.tics[k].label)) -
                            (static_cast<double>(k) + 0.5) * step);
  return rim;
}

// Pixels for numbers and label along y (16 points).
double room_for_numbers(const AxisLayout& y) {
  constexpr double label_and_gaps = 74, character = 12.5;
  std::size_t longest = 0;
  for (const Tic& tic : y.tics) longest = std::max(longest, characters_of(tic.label));
  return label_and_gaps + character * static_cast<double>(longest);
}

// Right of the plot; long names of a single chart move the key below.
std::string key_command(const LineChart& chart, std::size_t longest_name,
                        const std::optional<double>& right_rim) {
  constexpr double sample = 70, character = 8.5, widest = 1.0 / 3;
  const double beside = sample + character * static_cast<double>(longest_name);
  if (chart.legend.find(' ') != std::string::npos)
    return "set key inside " + chart.legend + " Left reverse samplen 2.6 spacing 1.25\n";
  const bool fits = beside <= widest * chart.width && !chart.print_width;
  if (chart.legend == "below" || (chart.legend.empty() && !right_rim && !fits))
    return "set key below left horizontal Left reverse samplen 2.6 spacing 1.25 maxcols " +
           std::string(2 * beside < chart.width ? "2" : "1") + "\n";
  if (!right_rim) return "set key outside right top Left reverse samplen 2.6 spacing 1.25\n";
  return "set key at screen " + gnuplot_number(*right_rim + 0.015) +
         ", graph 1 left top Left reverse samplen 2.6 spacing 1.25\n";
}

std::string look_commands(const LineChart& chart, const Axes& axes, const Content& content,
                          const std::optional<double>& right_rim) {
  const bool keyed = content.keyed && chart.legend != "none";
  std::string script =
      "set border 3 linewidth 1.2 linecolor rgb '#404040'\n"
      "set grid xtics ytics mxtics mytics linetype 1 linewidth 0.7 linecolor rgb '#dcdcdc', "
      "linetype 1 linewidth 0.5 linecolor rgb '#eeeeee'\n";
  script += axis_command("x", axes.x, chart.x.logarithmic) + axis_command("y", axes.y, chart.y.logarithmic);
  if (!chart.title.empty()) script += "set title " + gnuplot_text(chart.title) + " font ',18'\n";
  if (chart.equal_axes) script += "set size ratio -1\n";
  script += keyed ? key_command(chart, content.longest_name, right_rim) : "set key off\n";
  if (keyed && !chart.key_title.empty())
    script += "set key title " + gnuplot_text(chart.key_title) + " left\n";
  for (const ChartLabel& label : chart.labels)
    if (drawable(label.x, chart.x) && drawable(label.y, chart.y))
      script += "set label " + gnuplot_text(label.text) + " at " + gnuplot_number(label.x / axes.x.factor) +
                "," + gnuplot_number(label.y / axes.y.factor) + " center front offset 0," +
                (label.below ? "-1.4" : "1.4") + " font ',13' textcolor rgb '#202020'\n";
  return script;
}

std::string title_of(const std::string& name) {
  return name.empty() ? " notitle" : " title " + gnuplot_text(name);
}

struct Layers {
  std::vector<std::string> behind, front;
};

void add_series(const LineChart& chart, int k, const Content& content, const std::string& prefix,
                Layers& layers) {
  const int lines = static_cast<int>(chart.series.size());
  const auto place = static_cast<std::size_t>(k);
  const ChartSeries& series = chart.series[place];
  const bool mark = series.shape != PointShape::of_line;
  const std::string colour = mark ? mark_colour : gnuplot_colour(line_colour(k, lines)),
                    number = std::to_string(k), shape = std::to_string(point_type(series, k));
  if (!content.clouds[place].empty())
    layers.behind.push_back("$" + prefix + "cloud" + number + " using 1:2 with points pointtype " + shape +
                            " pointsize 0.7 linecolor rgb '#80" + colour.substr(6) + " notitle");
  if (content.points[place].empty()) return;
  const std::string data = "$" + prefix + "line" + number;
  if (series.band) {
    layers.behind.push_back(data +
                            " using 1:3:4 with filledcurves fillstyle solid noborder fillcolor rgb '#c8" +
                            colour.substr(6) + " notitle");
    for (const char* end : {"3", "4"})
      layers.behind.push_back(data + " using 1:" + end + " with lines linewidth 0.8 linecolor rgb '#60" +
                              colour.substr(6) + " notitle");
  } else if (!series.y_error.empty() || !series.y_low.empty()) {
    layers.front.push_back(data + " using 1:2:3:4 with yerrorbars pointtype -1 linewidth 1.4 linecolor " +
                           colour + " notitle");
    if (std::ranges::any_of(content.points[place],
                            [&](const Point& point) { return point.reaches(chart.y.logarithmic); }))
      layers.front.push_back("$" + prefix + "open" + number +
                             " using 1:2:(0):3 with vectors head filled linewidth 1.4 linecolor " + colour +
                             " notitle");
  }
  if (!series.x_low.empty())
    layers.front.push_back(data + " using 1:2:5:6 with xerrorbars pointtype -1 linewidth 1.4 linecolor " +
                           colour + " notitle");
  const std::string style = series.line ? (series.points ? "linespoints" : "lines") : "points";
  std::string layer = data + " using 1:2 with " + style + " linecolor " + colour;
  if (mark)
    layer += " linewidth 1.2";
  else if (series.line)
    layer += " linewidth 2.2 dashtype " + std::string(dashes[place % dashes.size()]);
  if (series.points || !series.line)
    layer += " pointtype " + shape + (mark ? " pointsize 2" : " pointsize 1.2");
  layers.front.push_back(layer + title_of(series.name));
}

std::string body_of(const LineChart& chart, const Content& content, const Axes& axes,
                    const std::string& prefix, const std::optional<double>& right_rim) {
  std::string script;
  for (std::size_t k = 0; k < content.points.size(); ++k) {
    const std::string number = std::to_string(k);
    script += data_block(prefix + "line" + number, content.points[k], axes.x, axes.y, chart.series[k],
                         chart.y.logarithmic);
    script += data_block(prefix + "cloud" + number, content.clouds[k], axes.x, axes.y, {}, false);
    if (chart.y.logarithmic && !chart.series[k].band)
      script += open_bars(prefix + "open" + number, content.points[k], axes);
  }
  script += reference_data(chart, axes, prefix) + bar_data(chart, axes, prefix);
  script += look_commands(chart, axes, content, right_rim);

  Layers layers;
  if (!chart.bars.empty())
    layers.behind.push_back("$" + prefix +
                            "bars using 1:2:3:4:5:6 with boxxyerror fillstyle solid border linecolor rgb "
                            "'#ffffff' fillcolor rgb '#7fa8c9' notitle");
  for (int k = 0; k < static_cast<int>(chart.series.size()); ++k)
    add_series(chart, k, content, prefix, layers);
  for (std::size_t k = 0; k < chart.references.size(); ++k) {
    const ChartReference& line = chart.references[k];
    if (!drawable(line.y ? *line.y : line.x.value_or(std::nan("")), line.y ? chart.y : chart.x)) continue;
    layers.front.push_back("$" + prefix + "across" + std::to_string(k) +
                           " using 1:2 with lines linewidth 1.6 linecolor " + mark_colour + " dashtype " +
                           std::string(reference_dashes[k % reference_dashes.size()]) + title_of(line.name));
  }
  layers.behind.insert(layers.behind.end(), layers.front.begin(), layers.front.end());
  return script + "plot " + joined(layers.behind, ", ") + "\n";
}

LineChart with_short_names(LineChart chart) {
  constexpr std::size_t longest = 30;
  for (ChartSeries& series : chart.series) series.name = shortened(series.name, longest);
  for (ChartReference& line : chart.references) line.name = shortened(line.name, longest);
  chart.key_title = shortened(chart.key_title, longest);
  return chart;
}

// Panels of several are lower than a chart alone.
int height_of(std::span<const LineChart> panels) {
  if (panels.size() == 1) return panels.front().height;
  int height = 0;
  for (const LineChart& panel : panels) height += panel.height * 3 / 4;
  return height;
}

std::optional<double> inches_of(const LineChart& chart) {
  return chart.print_width ? std::optional(*chart.print_width / 0.0254) : std::nullopt;
}

bool share_x(const LineChart& a, const LineChart& b) {
  return a.x.label == b.x.label && a.x.unit == b.x.unit && a.x.logarithmic == b.x.logarithmic &&
         a.x.names == b.x.names;
}

}  // namespace

void print_at(LineChart& chart, double width, double font_size) {
  constexpr double points_per_metre = 72 / 0.0254, text = 16,
                   least = 320;  // pixels of axes and their numbers
  const double pixels = width * points_per_metre * text / font_size;
  if (pixels < least)
    refuse("a chart " + format_short(1000 * width) + " mm wide with text of " + format_short(font_size) +
               " points has no room for its lines",
           "give a `font_size` of at most " + format_short(std::floor(font_size * pixels / least)));
  chart.width = static_cast<int>(std::lround(pixels));
  chart.height = static_cast<int>(std::lround(pixels * 2 / 3));
  chart.print_width = width;
}

std::string chart_script(const LineChart& chart, PictureFormat format, std::vector<std::string>& warnings) {
  const Content content = gathered(chart, warnings);
  const Axes axes = axes_of(chart, content);
  std::string script = gnuplot_terminal(format, chart.width, chart.height, 16, inches_of(chart));
  if (const double rim = left_rim(chart, axes.x); rim > 0) {
    script += "set lmargin at screen " + gnuplot_number(rim / chart.width) + "\n";
    if (!content.keyed) script += "set rmargin at screen 0.97\n";
  }
  return script + body_of(chart, content, axes, "", {});
}

std::string chart_script(std::span<const LineChart> given, PictureFormat format,
                         std::vector<std::string>& warnings) {
  if (given.size() == 1) return chart_script(given.front(), format, warnings);
  if (given.empty()) refuse("a picture of charts has no chart");
  std::vector<LineChart> panels;
  for (const LineChart& panel : given) panels.push_back(with_short_names(panel));
  std::vector<Content> contents;
  std::size_t longest = 0;
  const int height = height_of(panels);
  for (const LineChart& panel : panels) {
    contents.push_back(gathered(panel, warnings));
    const bool key_on_the_right = panel.legend == "right" || (panel.legend.empty() && !panel.print_width);
    if (contents.back().keyed && key_on_the_right) longest = std::max(longest, contents.back().longest_name);
  }
  for (std::size_t k = 0; k < panels.size(); ++k)
    for (std::size_t other = 0; other < panels.size(); ++other)
      if (other != k && share_x(panels[k], panels[other])) {
        const std::vector<double> ends = contents[other].ends.x;
        contents[k].ends.x.insert(contents[k].ends.x.end(), ends.begin(), ends.end());
      }
  const int width = panels.front().width;
  std::vector<Axes> axes;
  double left = 0.13 * width;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    axes.push_back(axes_of(panels[k], contents[k]));
    left = std::max({left, left_rim(panels[k], axes.back().x), room_for_numbers(axes.back().y)});
  }
  // Only the last of adjacent panels shows shared names.
  for (std::size_t k = 0; k + 1 < panels.size(); ++k)
    if (!panels[k].x.names.empty() && share_x(panels[k], panels[k + 1])) {
      axes[k].x.label.clear();
      axes[k].x.slanted = false;
      for (Tic& tic : axes[k].x.tics) tic.label = " ";
    }
  // Room for the longest name and its sample.
  const double beside = 100 + 12.0 * static_cast<double>(longest);
  const double right = longest == 0 ? 0.97 : 1 - std::min(0.5, beside / width);
  std::string script = gnuplot_terminal(format, width, height, 16, inches_of(panels.front()));
  script += "set multiplot layout " + std::to_string(panels.size()) + ",1\nset lmargin at screen " +
            gnuplot_number(left / width) + "\nset rmargin at screen " + gnuplot_number(right) + "\n";
  for (std::size_t k = 0; k < panels.size(); ++k) {
    if (k > 0)
      script +=
          "unset logscale\nunset label\nunset title\nset size noratio\nset key default\n"
          "set xtics norotate autojustify\n";
    script += body_of(panels[k], contents[k], axes[k], k == 0 ? "" : "panel" + std::to_string(k), right);
  }
  return script + "unset multiplot\n";
}

std::vector<std::string> draw(const LineChart& chart, const std::filesystem::path& file) {
  return draw(std::span(&chart, 1), file);
}

std::vector<std::string> draw(std::span<const LineChart> panels, const std::filesystem::path& file) {
  std::vector<std::string> warnings;
  const std::string script = chart_script(panels, picture_format(file), warnings);
  constexpr std::size_t many = 100000;
  std::size_t points = 0;
  for (const LineChart& panel : panels)
    for (const ChartSeries& series : panel.series) points += series.x.size();
  if (points > many && picture_format(file) != PictureFormat::png)
    warnings.push_back(std::to_string(points) +
                       " points are drawn and stored in the file; a .png is smaller");
  if (leave_to_page()) return warnings;
  GnuplotResult drawn = run_gnuplot(script);
  const LineChart& first = panels.front();
  if (first.print_width && picture_format(file) == PictureFormat::svg) {
    const double ratio = static_cast<double>(height_of(panels)) / first.width;
    drawn.picture = printed_at(std::move(drawn.picture), *first.print_width, *first.print_width * ratio);
  }
  write_atomically(file, drawn.picture);
  const std::vector<std::string> complaints = complaints_of(drawn, file);
  warnings.insert(warnings.end(), complaints.begin(), complaints.end());
  return warnings;
}

}  // namespace asperity
