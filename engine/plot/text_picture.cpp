// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/text_picture.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "engine/core/require.hpp"
#include "engine/plot/palette.hpp"

namespace asperity {

namespace {

// Light to dense.
constexpr std::string_view densities = " .:-=+*#%@";

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

// Nearest of xterm's 6 x 6 x 6 colours.
int indexed(unsigned rgb) {
  constexpr std::array<int, 6> steps = {0, 95, 135, 175, 215, 255};
  const auto nearest = [&](unsigned value) {
    const auto at = std::min_element(steps.begin(), steps.end(), [&](int a, int b) {
      return std::abs(a - static_cast<int>(value)) < std::abs(b - static_cast<int>(value));
    });
    return static_cast<int>(at - steps.begin());
  };
  return 16 + 36 * nearest(rgb >> 16 & 255U) + 6 * nearest(rgb >> 8 & 255U) + nearest(rgb & 255U);
}

std::string colour_code(unsigned rgb, bool background, TextColours colours) {
  const std::string ground = background ? "48" : "38";
  if (colours == TextColours::indexed) return "\033[" + ground + ";5;" + std::to_string(indexed(rgb)) + "m";
  return "\033[" + ground + ";2;" + std::to_string(rgb >> 16 & 255U) + ";" + std::to_string(rgb >> 8 & 255U) +
         ";" + std::to_string(rgb & 255U) + "m";
}

std::string caption(const Grid& grid, const Field& marks, Range range, const PictureOptions& options,
                    Dimension dimension, bool coloured) {
  const auto cells = [](int all, int shown) { return format_short(static_cast<double>(all) / shown, 3); };
  std::string text = options.label + " from " + format_quantity(range.min, dimension, 3) + " (" +
                     (!coloured                                                       ? "blank"
                      : palette(options.palette).none || options.palette == "contact" ? "light"
                                                                                      : "dark") +
                     ") to " + format_quantity(range.max, dimension, 3) + "; " +
                     format_quantity(grid.size_x, dimension::length, 3) + " x " +
                     format_quantity(grid.size_y, dimension::length, 3);
  if (marks.nx() < grid.nx || marks.ny() < grid.ny)
    text += "; a mark is the mean of " + cells(grid.nx, marks.nx()) + " x " + cells(grid.ny, marks.ny()) +
            " cells";
  return text;
}

std::string axis_script(const std::string& name, const AxisLayout& layout, bool logarithmic) {
  std::string text = logarithmic ? "set logscale " + name + " 10\n" : "";
  text += "set " + name + "range [" + gnuplot_number(layout.low) + ":" + gnuplot_number(layout.high) +
          "]\nset " + name + "tics nomirror (";
  bool first = true;
  for (const Tic& tic : layout.tics) {
    if (tic.label.empty()) continue;
    text += (first ? "" : ", ") + gnuplot_text(tic.label) + " " + gnuplot_number(tic.at);
    first = false;
  }
  return text + ")\n";
}

std::string without_blanks(std::string_view drawn) {
  std::string text;
  for (std::size_t at = drawn.find_first_not_of('\f'); at < drawn.size();) {
    const std::size_t end = std::min(drawn.find('\n', at), drawn.size());
    const std::size_t last = drawn.find_last_not_of(" \n", end == 0 ? 0 : end - 1);
    if (last != std::string_view::npos && last >= at) text.append(drawn, at, last + 1 - at) += '\n';
    at = end + 1;
  }
  return text;
}

}  // namespace

TextCanvas text_canvas() {
  TextCanvas canvas;
  const std::string_view language = !variable("LC_ALL").empty()     ? variable("LC_ALL")
                                    : !variable("LC_CTYPE").empty() ? variable("LC_CTYPE")
                                                                    : variable("LANG");
  canvas.unicode =
      language.find("UTF-8") != std::string_view::npos || language.find("utf8") != std::string_view::npos;
  const std::string_view term = variable("TERM");
  if (::isatty(STDOUT_FILENO) == 0) return canvas;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= 20 && size.ws_row >= 8) {
    canvas.columns = size.ws_col;
    canvas.rows = size.ws_row;
  }
  if (!variable("NO_COLOR").empty() || term.empty() || term == "dumb" || !canvas.unicode) return canvas;
  if (variable("COLORTERM") == "truecolor" || variable("COLORTERM") == "24bit")
    canvas.colours = TextColours::full;
  else if (term.find("256") != std::string_view::npos || term.find("xterm") != std::string_view::npos ||
           term.find("screen") != std::string_view::npos || term.find("tmux") != std::string_view::npos)
    canvas.colours = TextColours::indexed;
  return canvas;
}

std::string text_map(const Grid& grid, const Field& field, const PictureOptions& options, Dimension dimension,
                     const TextCanvas& canvas) {
  const Palette& colours = palette(options.palette);
  const bool coloured = canvas.colours != TextColours::none;
  // Characters are twice as high as wide; coloured ones hold two marks.
  const double ratio = grid.size_y / grid.size_x;
  const int most_rows = std::max(4, canvas.rows - 4) * (coloured ? 2 : 1);
  const double mark_height = coloured ? 1 : 2;  // in widths
  double width = std::min<double>(canvas.columns - 2, 120);
  double height = width * ratio / mark_height;
  if (height > most_rows) {
    width *= most_rows / height;
    height = most_rows;
  }
  // Small grids get several marks per cell.
  const int columns = std::max(1, static_cast<int>(std::lround(width)));
  const int rows = std::max(1, static_cast<int>(std::lround(height)));
  const Field marks = reduced(field, std::min(columns, grid.nx), std::min(rows, grid.ny));
  Range range{0, 0};
  bool any = false;
  for (const double value : marks.values()) {
    if (!std::isfinite(value)) continue;
    range = any ? Range{std::min(range.min, value), std::max(range.max, value)} : Range{value, value};
    any = true;
  }
  if (!any) refuse("there is no finite value to show", "print the values instead");
  if (options.range) range = *options.range;
  if (!options.range && colours.none && range.min > 0) range.min = 0;
  const auto share = [&](int column, int row) {  // row 0: lowest
    const int i = std::min(static_cast<int>((column + 0.5) * marks.nx() / columns), marks.nx() - 1);
    const int j = std::min(static_cast<int>((row + 0.5) * marks.ny() / rows), marks.ny() - 1);
    const double value = marks(i, j);
    return range.max > range.min ? std::clamp((value - range.min) / (range.max - range.min), 0.0, 1.0) : 0.5;
  };
  std::string text;
  for (int top = rows - 1; top >= 0; top -= coloured ? 2 : 1) {
    for (int column = 0; column < columns; ++column) {
      const double upper = share(column, top);
      if (!coloured) {
        const double at = std::isnan(upper) ? 0 : upper;
        text += densities[static_cast<std::size_t>(at * 0.999 * static_cast<double>(densities.size()))];
        continue;
      }
      const auto colour = [&](double at) { return std::isnan(at) ? 0x808080U : colours.colour(at); };
      text += colour_code(colour(upper), false, canvas.colours);
      if (top > 0) text += colour_code(colour(share(column, top - 1)), true, canvas.colours);
      text += "▀";
    }
    text += coloured ? "\033[0m\n" : "\n";
  }
  return text + caption(grid, marks, range, options, dimension, coloured) + "\n";
}

std::string text_chart(const LineChart& chart, const TextCanvas& canvas, std::vector<std::string>& warnings) {
  std::vector<double> xs, ys;
  std::size_t lost = 0;
  const auto drawable = [](double value, const ChartAxis& axis) {
    return std::abs(value) <= 1e300 && (!axis.logarithmic || value > 0);
  };
  for (const ChartSeries& series : chart.series)
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      if (series.gaps && (std::isnan(series.x[k]) || std::isnan(series.y[k]))) continue;
      if (!drawable(series.x[k], chart.x) || !drawable(series.y[k], chart.y)) {
        ++lost;
        continue;
      }
      xs.push_back(series.x[k]);
      ys.push_back(series.y[k]);
    }
  if (lost > 0)
    warnings.push_back(std::to_string(lost) + (lost == 1 ? " point is" : " points are") +
                       " not drawn: not finite, or not above zero on a logarithmic axis");
  if (xs.empty()) refuse("the chart has nothing to draw");
  const AxisLayout x = lay_out(chart.x, xs), y = lay_out(chart.y, ys);
  const char* colours = canvas.colours == TextColours::none      ? "mono"
                        : canvas.colours == TextColours::indexed ? "ansi256"
                                                                 : "ansirgb";
  std::string script = "set terminal dumb size " + std::to_string(std::min(canvas.columns - 1, 110)) + "," +
                       std::to_string(std::clamp(canvas.rows - 2, 10, 30)) + " noenhanced " + colours + "\n";
  std::vector<std::string> layers;
  bool keyed = false;
  constexpr std::string_view signs = "oxA+BCDE";
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const ChartSeries& series = chart.series[k];
    const std::string block = "$line" + std::to_string(k);
    script += block + " << EOD\n";
    for (std::size_t n = 0; n < series.x.size(); ++n)
      if (drawable(series.x[n], chart.x) && drawable(series.y[n], chart.y))
        script +=
            gnuplot_number(series.x[n] / x.factor) + " " + gnuplot_number(series.y[n] / y.factor) + "\n";
      else if (series.gaps)
        script += "\n";
    script += "EOD\n";
    const std::string sign(1, signs[k % signs.size()]);
    const bool line = series.line && !series.points;
    layers.push_back(block + " using 1:2 with " +
                     (line          ? "lines"
                      : series.line ? "linespoints"
                                    : "points") +
                     " pointtype '" + sign + "' linecolor " +
                     gnuplot_colour(line_colour(static_cast<int>(k), static_cast<int>(chart.series.size()))) +
                     (series.name.empty() ? " notitle" : " title " + gnuplot_text(series.name)));
    keyed = keyed || !series.name.empty();
  }
  script +=
      "set border 3\n" + axis_script("x", x, chart.x.logarithmic) + axis_script("y", y, chart.y.logarithmic);
  script += "set xlabel " + gnuplot_text(x.label) + "\n";
  // As a ylabel, the letters would be stacked.
  script += "set title " + gnuplot_text(chart.title.empty() ? y.label : chart.title + ": " + y.label) + "\n";
  script += keyed ? "set key top right\n" : "set key off\n";
  if (keyed && !chart.key_title.empty()) script += "set key title " + gnuplot_text(chart.key_title) + "\n";
  return without_blanks(run_gnuplot(script + "plot " + joined(layers, ", ") + "\n").picture);
}

}  // namespace asperity
