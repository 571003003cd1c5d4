// SPDX-License-Identifier: GPL-3.0-or-later
// Charts by gnuplot, legible in black and white. Values that cannot be drawn (non-finite, or not positive on
// a logarithmic axis) are counted in a warning.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/plot/chart_axis.hpp"
#include "engine/plot/gnuplot.hpp"

namespace asperity {

// of_line: the line's own; others: open symbols.
enum class PointShape { of_line, ring, cross, triangle, diamond };

struct ChartSeries {
  std::string name;                      // in the key; "": not in the key
  std::vector<double> x, y;              // same length
  std::vector<double> y_error;           // half length of error bars; or empty
  std::vector<double> cloud_x, cloud_y;  // faint points behind
  bool line = true;
  bool points = true;
  std::vector<double> x_low = {}, x_high = {};  // error bar ends along x; or both empty
  PointShape shape = PointShape::of_line;       // all others: grey, thin line
  std::vector<double> y_low = {}, y_high = {};  // error bar ends along y; or both empty
  bool band = false;                            // y_low and y_high bound a shaded band
  bool gaps = false;                            // NaN breaks the line without a warning
};

inline ChartSeries marks_alone(std::string name, PointShape shape) {
  ChartSeries series;
  series.name = std::move(name);
  series.line = false;
  series.shape = shape;
  return series;
}

struct ChartReference {
  std::optional<double> x, y;  // exactly one
  std::string name = {};
};

// Histogram bar from 0.
struct ChartBar {
  double left = 0, right = 0, height = 0;
};

// Text centred above or below a point.
struct ChartLabel {
  double x = 0, y = 0;
  std::string text;
  bool below = false;
};

struct LineChart {
  std::string title;
  ChartAxis x, y;
  std::string key_title;
  std::vector<ChartSeries> series;
  std::vector<ChartLabel> labels = {};
  bool equal_axes = false;            // equal scales of x and y
  int width = 960, height = 640;      // pixels, with text of 16 points
  std::optional<double> print_width;  // m; pixels follow from the size of text in print
  std::string legend = {};            // "right", "below", "none", "top left", …; "": right or below
  std::vector<ChartReference> references = {};
  std::vector<ChartBar> bars = {};
};

// Appends to `warnings`. Throws Error{bad_value} if no point is left or lengths differ.
std::string chart_script(const LineChart& chart, PictureFormat format, std::vector<std::string>& warnings);

// Canvas of a figure `width` wide (m) with text of `font_size` points, as printed. Throws Error{bad_value} if
// the text leaves no room.
void print_at(LineChart& chart, double width, double font_size);

// Panels one below the other, equally high, as wide as the first. Equal quantities along x share the range.
std::string chart_script(std::span<const LineChart> panels, PictureFormat format,
                         std::vector<std::string>& warnings);

// Replaces `file` (.svg, .png, .pdf) atomically; returns warnings. Throws like chart_script, run_gnuplot,
// write_atomically.
std::vector<std::string> draw(const LineChart& chart, const std::filesystem::path& file);
std::vector<std::string> draw(std::span<const LineChart> panels, const std::filesystem::path& file);

}  // namespace asperity
