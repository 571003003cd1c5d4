// SPDX-License-Identifier: GPL-3.0-or-later
// A chart of lines and points, drawn to print legibly in black and white: lines differ in colour, point
// shape and dashes; the key stands beside the plot; units carry a readable prefix. Drawn by gnuplot.
// Behind the lines stand bands (of a fit) and bars (of a histogram), across them lines at one x or y, whose
// names stand in the key, where they meet nothing. Two panels stand one below the other. Values that cannot
// be drawn (non-finite, or not positive on a logarithmic axis) are left out, and a sentence says how many.
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

// Of the line's own kind, or one that stands for something else: a ring about points of other lines, a
// cross, a triangle or a diamond, open.
enum class PointShape { of_line, ring, cross, triangle, diamond };

struct ChartSeries {
  std::string name;                      // in the key; "" keeps it out
  std::vector<double> x, y;              // same length
  std::vector<double> y_error;           // half length of the error bar of each point; or empty
  std::vector<double> cloud_x, cloud_y;  // faint points behind: the single values a point is the mean of
  bool line = true;
  bool points = true;
  std::vector<double> x_low = {}, x_high = {};  // ends of a bar along x at each point; or both empty
  PointShape shape = PointShape::of_line;       // any other is drawn in grey, with a thin line
  std::vector<double> y_low = {}, y_high = {};  // ends of a bar along y at each point; or both empty
  bool band = false;                            // y_low and y_high bound a shaded band instead
  bool gaps = false;                            // a value that is NaN breaks the line, and is no loss
};

// One that is drawn as marks alone.
inline ChartSeries marks_alone(std::string name, PointShape shape) {
  ChartSeries series;
  series.name = std::move(name);
  series.line = false;
  series.shape = shape;
  return series;
}

// A line across the plot at one x or one y, named in the key.
struct ChartReference {
  std::optional<double> x, y;  // one of them
  std::string name = {};
};

// A bar from 0, of a histogram.
struct ChartBar {
  double left = 0, right = 0, height = 0;
};

// Words at a place of the plot, centred above it, or below.
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
  bool equal_axes = false;  // one unit of x is as long as one of y
  int width = 960, height = 640;
  std::vector<ChartReference> references = {};
  std::vector<ChartBar> bars = {};
};

// The gnuplot script; `warnings` gets the sentences about what was left out. Throws Error{bad_value}
// if no point is left or lengths differ. Cost: the number of points.
std::string chart_script(const LineChart& chart, PictureFormat format, std::vector<std::string>& warnings);

// Two charts or more, one below the other, as wide as the first and each as high. Those that show the same
// quantity along x, which they call alike, run over the same range. Throws as above.
std::string chart_script(std::span<const LineChart> panels, PictureFormat format,
                         std::vector<std::string>& warnings);

// Draws the chart into `file` (.svg, .png or .pdf), replaced atomically. Returns the warnings. Throws as
// chart_script, picture_format, run_gnuplot and write_atomically do.
std::vector<std::string> draw(const LineChart& chart, const std::filesystem::path& file);
std::vector<std::string> draw(std::span<const LineChart> panels, const std::filesystem::path& file);

}  // namespace asperity
