// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/require.hpp"
#include "engine/plot/palette.hpp"

namespace asperity {

namespace {

constexpr int most_relief_cells = 240;  // per side; more gives moiré
constexpr double longest_aspect = 20;

struct Share {
  int patch;
  double weight;
};

std::vector<std::vector<Share>> shares(int cells, int patches) {
  std::vector<std::vector<Share>> all(static_cast<std::size_t>(cells));
  const double ratio = static_cast<double>(patches) / cells;
  for (int k = 0; k < cells; ++k) {
    const double from = k * ratio, to = (k + 1) * ratio;
    for (int patch = static_cast<int>(from); patch < patches && patch < to; ++patch) {
      const double weight = std::min(to, patch + 1.0) - std::max(from, static_cast<double>(patch));
      if (weight > 1e-12) all[static_cast<std::size_t>(k)].push_back({patch, weight});
    }
  }
  return all;
}

// gnuplot needs two cells a side.
Field at_least_two(const Field& field) {
  if (field.nx() > 1 && field.ny() > 1) return field;
  Field doubled(std::max(field.nx(), 2), std::max(field.ny(), 2));
  for (int j = 0; j < doubled.ny(); ++j)
    for (int i = 0; i < doubled.nx(); ++i)
      doubled(i, j) = field(std::min(i, field.nx() - 1), std::min(j, field.ny() - 1));
  return doubled;
}

std::string bytes_of(const Field& field, double factor) {
  std::string bytes(field.size() * sizeof(float), '\0');
  for (std::size_t k = 0; k < field.size(); ++k) {
    const auto value = static_cast<float>(field[k] / factor);
    std::memcpy(bytes.data() + k * sizeof value, &value, sizeof value);
  }
  return bytes;
}

void check(const Grid& grid, const Field& field, const PictureOptions& options) {
  if (field.nx() != grid.nx || field.ny() != grid.ny || field.empty())
    refuse("the field has " + std::to_string(field.nx()) + " × " + std::to_string(field.ny()) +
           " values on a grid of " + std::to_string(grid.nx) + " × " + std::to_string(grid.ny));
  require(options.width >= 200 && options.width <= 4000, "width", options.width, "pixels",
          "give 200 to 4000");
  if (options.range && !(options.range->min < options.range->max && std::isfinite(options.range->span())))
    refuse("`range` is from " + format_short(options.range->min) + " to " + format_short(options.range->max),
           "give two finite numbers, the lower one first");
}

std::string palette_command(const Palette& colours) {
  std::string text = "set palette maxcolors 0 defined (";
  if (colours.none) text += "0 " + gnuplot_colour(*colours.none).substr(4) + ", ";
  for (std::size_t k = 0; k < colours.colours.size(); ++k)
    text += (k > 0 ? ", " : "") + (k == 0 && colours.none ? "0.0001" : std::to_string(k)) + " " +
            gnuplot_colour(colours.colours[k]).substr(4);
  return text + ")\n";
}

std::string tics(std::string_view axis, const AxisLayout& layout, std::string_view style) {
  std::string text = "set " + std::string(axis) + "tics " + std::string(style) + " (";
  bool first = true;
  for (const Tic& tic : layout.tics) {
    if (tic.at < layout.low || tic.at > layout.high) continue;
    text += (first ? "" : ", ") + gnuplot_text(tic.label) + " " + gnuplot_number(tic.at);
    first = false;
  }
  return text + ")\n";
}

std::string range_command(std::string_view axis, const AxisLayout& layout) {
  return "set " + std::string(axis) + "range [" + gnuplot_number(layout.low) + ":" +
         gnuplot_number(layout.high) + "]\n";
}

// Pixels from the lower left corner.
struct Canvas {
  double width, height, font;
  double left, bottom, map_width, map_height;
  double bar_bottom, bar_height;  // of the colour bar
};

bool fits_to_scale(const Grid& grid) {
  const double aspect = grid.size_x / grid.size_y;
  return aspect < longest_aspect && aspect > 1 / longest_aspect;
}

Canvas canvas_of(const Grid& grid, const PictureOptions& options) {
  constexpr double map_share = 0.7, beside = 0.175, tallest = 1.5;
  Canvas canvas{};
  canvas.width = options.width;
  canvas.font = 15.0 * options.width / 1000;
  const double text = 4.0 / 3.0 * canvas.font;  // line height
  const double aspect = fits_to_scale(grid)         ? grid.size_y / grid.size_x
                        : grid.size_y > grid.size_x ? 2.0
                                                    : 0.2;
  canvas.map_width = std::round(map_share * options.width);
  canvas.map_height = std::max(2.0, std::round(aspect * canvas.map_width));
  if (canvas.map_height > tallest * options.width) {
    canvas.map_height = std::round(tallest * options.width);
    canvas.map_width = std::max(2.0, std::round(canvas.map_height / aspect));
  }
  canvas.left = std::round(0.125 * options.width);
  // Tall maps narrow the canvas.
  canvas.width = std::round(canvas.left + canvas.map_width + beside * options.width);
  canvas.bar_height = std::max(canvas.map_height, 6 * text);  // room for tics of flat strips
  canvas.bar_bottom = std::round(4 * text);
  canvas.bottom = canvas.bar_bottom + std::round((canvas.bar_height - canvas.map_height) / 2);
  canvas.height =
      std::ceil(canvas.bar_bottom + canvas.bar_height + (options.title.empty() ? 1.0 : 2.6) * text);
  return canvas;
}

std::string screen(double x, double y, const Canvas& canvas) {
  return "screen " + format_short(x / canvas.width, 8) + ", screen " + format_short(y / canvas.height, 8);
}

// White on a dark veil; omitted on small maps.
std::string scale_bar(const AxisLayout& x, const Canvas& canvas) {
  const double text = 4.0 / 3.0 * canvas.font;
  const double length = round_below((x.high - x.low) / 4);
  const std::string label = format_short(length, 3) + " " + x.unit;
  const double bar = length / (x.high - x.low) * canvas.map_width;
  const double box = std::max(bar, 0.62 * text * static_cast<double>(label.size())) + 1.2 * text;
  const double box_height = 2.2 * text, gap = 0.8 * text;
  if (box + 2 * gap > canvas.map_width || box_height + 2 * gap > canvas.map_height) return {};
  const double left = canvas.left + gap, bottom = canvas.bottom + gap, middle = left + box / 2;
  const auto rectangle = [&](int number, double x0, double y0, double x1, double y1,
                             std::string_view colour) {
    return "set object " + std::to_string(number) + " rectangle from " + screen(x0, y0, canvas) + " to " +
           screen(x1, y1, canvas) + " front fillcolor rgb '" + std::string(colour) +
           "' fillstyle solid noborder\n";
  };
  return rectangle(1, left, bottom, left + box, bottom + box_height, "#60000000") +
         rectangle(2, middle - bar / 2, bottom + 0.4 * text, middle + bar / 2, bottom + 0.65 * text,
                   "#ffffff") +
         "set label 1 " + gnuplot_text(label) + " at " + screen(middle, bottom + 1.4 * text, canvas) +
         " center front textcolor rgb '#ffffff'\n";
}

struct Frame {
  AxisLayout x, y, colour;
  double step_x, step_y;  // of a drawn cell, displayed unit
};

int tics_along(double pixels, double font) { return std::clamp(static_cast<int>(pixels / (4 * font)), 1, 6); }

Frame frame_of(const Grid& grid, const Field& cells, Range values, const PictureOptions& options,
               const Canvas& canvas) {
  Frame frame;
  const auto side = [&](const char* label, double size, double spacing, double pixels) {
    ChartAxis axis;
    axis.label = label;
    axis.unit = "m";
    axis.range = Range{-spacing / 2, size - spacing / 2};
    axis.tics = tics_along(pixels, canvas.font);
    if (fits_to_scale(grid)) axis.prefix_for = std::max(grid.size_x, grid.size_y);
    return lay_out(axis, {}, 0);
  };
  frame.x = side("x", grid.size_x, grid.hx(), canvas.map_width);
  frame.y = side("y", grid.size_y, grid.hy(), canvas.map_height);
  frame.step_x = (frame.x.high - frame.x.low) / cells.nx();
  frame.step_y = (frame.y.high - frame.y.low) / cells.ny();
  ChartAxis colour;
  colour.label = options.label;
  colour.unit = options.unit;
  colour.range = options.range;
  colour.tics = tics_along(canvas.bar_height, canvas.font);
  const double ends[] = {values.min, values.max};
  frame.colour = lay_out(colour, ends, 0);
  return frame;
}

std::string cells_clause(const Frame& frame, const Field& cells, std::string_view style) {
  return "'cells' binary array=(" + std::to_string(cells.nx()) + "," + std::to_string(cells.ny()) +
         ") format='%float32' endian=little origin=(" + gnuplot_number(frame.x.low + frame.step_x / 2) + "," +
         gnuplot_number(frame.y.low + frame.step_y / 2) + (style == "pm3d" ? ",0" : "") +
         ") dx=" + gnuplot_number(frame.step_x) + " dy=" + gnuplot_number(frame.step_y) + " using 1 with " +
         std::string(style) + " notitle";
}

std::string map_body(const Frame& frame, const Field& cells, const PictureOptions& options,
                     const Canvas& canvas) {
  const auto share = [](double value, double whole) { return format_short(value / whole, 8); };
  const double right = canvas.left + canvas.map_width, top = canvas.bottom + canvas.map_height;
  std::string text = "set lmargin at screen " + share(canvas.left, canvas.width) +
                     "\nset rmargin at screen " + share(right, canvas.width) + "\nset bmargin at screen " +
                     share(canvas.bottom, canvas.height) + "\nset tmargin at screen " +
                     share(top, canvas.height) + "\n" + scale_bar(frame.x, canvas);
  const bool mask = options.palette == "contact";
  if (mask) {
    text += "unset colorbox\nset key at " + screen(right + 0.02 * options.width, top, canvas) +
            " left top Left reverse samplen 1 width 0 spacing 1.3\n";
  } else {
    text += "set colorbox user origin " + screen(right + 0.025 * options.width, canvas.bar_bottom, canvas) +
            " size " + screen(0.025 * options.width, canvas.bar_height, canvas) + " noborder\nset key off\n";
  }
  text += "plot " + cells_clause(frame, cells, "image");
  if (mask) {
    const Palette& colours = palette(options.palette);
    for (const auto& [colour, name] :
         {std::pair{colours.colours.back(), "contact"}, std::pair{colours.colours.front(), "apart"}})
      text += ", NaN with boxes fillstyle solid 1 border linecolor rgb '#808080' fillcolor " +
              gnuplot_colour(colour) + " title " + gnuplot_text(name);
  }
  return text + "\n";
}

// In a relief, gnuplot underestimates the bar's numbers; the title is above the bar.
std::string bar_title(const std::string& label, bool relief) {
  if (!relief) return "\nset cblabel " + gnuplot_text(label);
  return "\nset label 1 " + gnuplot_text(label) + " at screen 0.985, screen 0.8 right front";
}

std::string relief_body(const Frame& frame, const Field& cells, const Grid& grid) {
  std::string text = "set view 52, 322, 1.42, 1\n";
  if (fits_to_scale(grid)) text += "set view equal xy\n";
  const double height = frame.colour.high - frame.colour.low;
  text += "set zrange [" + gnuplot_number(frame.colour.low - 0.5 * height) + ":" +
          gnuplot_number(frame.colour.high + 0.5 * height) + "]\nunset ztics\nset border 0\nset xyplane at " +
          gnuplot_number(frame.colour.low - 0.05 * height) +
          "\nset pm3d depthorder noborder lighting primary 0.4 specular 0.1\n"
          "set colorbox user origin screen 0.88, screen 0.25 size screen 0.022, screen 0.5 noborder\nset key "
          "off\n";
  return text + "splot " + cells_clause(frame, cells, "pm3d") + "\n";
}

constexpr int most_stretches = 2000;  // about two per pixel

void add_trace(const Profile& profile, ChartSeries& series) {
  const auto heights = profile.measured_heights();
  const auto at = [&](std::size_t k) { return static_cast<double>(k) * profile.spacing(); };
  const auto add = [&](std::size_t k) {
    series.x.push_back(at(k));
    series.y.push_back(heights[k]);
  };
  // Adds the extremes and the start of a gap.
  const auto add_stretch_with_gap = [&](std::span<const double> part, std::size_t from) {
    std::size_t low = part.size(), high = part.size(), gap = part.size();
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (std::isnan(part[k])) {
        gap = std::min(gap, k);
        continue;
      }
      if (low == part.size() || part[k] < part[low]) low = k;
      if (high == part.size() || part[k] > part[high]) high = k;
    }
    for (std::size_t k = 0; k < part.size(); ++k)
      if (k == low || k == high || k == gap) add(from + k);
  };
  if (heights.size() <= 2 * most_stretches) {
    for (std::size_t k = 0; k < heights.size(); ++k) add(k);
    return;
  }
  for (std::size_t stretch = 0; stretch < most_stretches; ++stretch) {
    const std::size_t from = stretch * heights.size() / most_stretches;
    const std::size_t to = (stretch + 1) * heights.size() / most_stretches;
    const auto part = heights.subspan(from, to - from);
    if (known_count(part) < part.size()) {
      add_stretch_with_gap(part, from);
      continue;
    }
    const auto [low, high] = std::ranges::minmax_element(part);
    const auto a = from + static_cast<std::size_t>(low - part.begin());
    const auto b = from + static_cast<std::size_t>(high - part.begin());
    add(std::min(a, b));
    if (a != b) add(std::max(a, b));
  }
}

void add_outline(const Profile& profile, ChartSeries& series) {
  const auto heights = profile.measured_heights();
  const double radius = *profile.closed_radius();
  // Repeats the first point.
  for (std::size_t k = 0; k <= heights.size(); ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(heights.size());
    const double r = radius + heights[k % heights.size()];
    series.x.push_back(r * elementary::cos(angle));
    series.y.push_back(r * elementary::sin(angle));
  }
}

}  // namespace

Field reduced(const Field& field, int columns, int rows) {
  const int nx = std::min(columns, field.nx()), ny = std::min(rows, field.ny());
  if (nx == field.nx() && ny == field.ny()) return field;
  const auto along_x = shares(field.nx(), nx), along_y = shares(field.ny(), ny);
  Field sum(nx, ny), weight(nx, ny);
  Array<double> row_sum(static_cast<std::size_t>(nx)), row_weight(static_cast<std::size_t>(nx));
  for (int j = 0; j < field.ny(); ++j) {
    std::ranges::fill(row_sum, 0.0);
    std::ranges::fill(row_weight, 0.0);
    for (int i = 0; i < field.nx(); ++i) {
      if (!std::isfinite(field(i, j))) continue;
      for (const Share& share : along_x[static_cast<std::size_t>(i)]) {
        row_sum[static_cast<std::size_t>(share.patch)] += share.weight * field(i, j);
        row_weight[static_cast<std::size_t>(share.patch)] += share.weight;
      }
    }
    for (const Share& share : along_y[static_cast<std::size_t>(j)])
      for (int i = 0; i < nx; ++i) {
        sum(i, share.patch) += share.weight * row_sum[static_cast<std::size_t>(i)];
        weight(i, share.patch) += share.weight * row_weight[static_cast<std::size_t>(i)];
      }
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
    sum[k] = weight[k] > 0 ? sum[k] / weight[k] : std::numeric_limits<double>::quiet_NaN();
  return sum;
}

PictureScript picture_script(const Grid& grid, const Field& field, const PictureOptions& options) {
  check(grid, field, options);
  const Palette& colours = palette(options.palette);
  const bool relief = options.view == PictureOptions::View::relief;
  Canvas canvas = canvas_of(grid, options);
  if (relief) {
    canvas.width = options.width;
    canvas.height = std::round(0.7 * canvas.width);
  }
  // At most one cell per pixel.
  const Field cells = at_least_two(
      relief ? reduced(field, most_relief_cells, most_relief_cells)
             : reduced(field, static_cast<int>(canvas.map_width), static_cast<int>(canvas.map_height)));
  Range values{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : cells.values()) {
    if (!std::isfinite(value)) continue;
    values.min = std::min(values.min, value);
    values.max = std::max(values.max, value);
  }
  if (values.min > values.max)
    refuse("the picture of " + asperity::quoted(options.label) + " has no finite value to show");
  PictureOptions resolved = options;
  if (options.palette == "contact" && !options.range) resolved.range = Range{0, 1};
  if (options.palette == "balance" && !options.range) {
    // Centre zero.
    const double most_apart = std::max(std::abs(values.min), std::abs(values.max));
    values = {-most_apart, most_apart};
  }
  // Palettes with a colour for none start at zero.
  if (colours.none && values.min > 0) values.min = 0;
  const Frame frame = frame_of(grid, cells, values, resolved, canvas);

  PictureScript picture;
  picture.script = gnuplot_terminal(PictureFormat::png, static_cast<int>(canvas.width),
                                    static_cast<int>(canvas.height), canvas.font) +
                   palette_command(colours) + range_command("x", frame.x) + range_command("y", frame.y) +
                   range_command("cb", frame.colour) + tics("x", frame.x, "nomirror out scale 0.6") +
                   tics("y", frame.y, "nomirror out scale 0.6") + tics("cb", frame.colour, "scale 0.6") +
                   "set xlabel " + gnuplot_text(frame.x.label) + "\nset ylabel " +
                   gnuplot_text(frame.y.label) + bar_title(frame.colour.label, relief) +
                   "\nset border linewidth 1 linecolor rgb '#404040'\n";
  if (!options.title.empty()) picture.script += "set title " + gnuplot_text(options.title) + "\n";
  picture.script += relief ? relief_body(frame, cells, grid) : map_body(frame, cells, resolved, canvas);
  picture.cells = bytes_of(cells, frame.colour.factor);
  return picture;
}

std::vector<std::string> draw(const Grid& grid, const Field& field, const PictureOptions& options,
                              const std::filesystem::path& file) {
  if (const std::string ending = file.extension().string(); ending != ".png")
    refuse("the picture " + asperity::quoted(file.string()) +
               (ending.empty() ? " has no ending" : " ends in " + ending),
           "pictures of surfaces are .png");
  const PictureScript picture = picture_script(grid, field, options);
  if (leave_to_page()) return {};
  const GnuplotData cells{"cells", picture.cells};
  const GnuplotResult drawn = run_gnuplot(picture.script, {&cells, 1});
  write_atomically(file, drawn.picture);
  return complaints_of(drawn, file);
}

std::vector<std::string> draw(const Surface& surface, const PictureOptions& options,
                              const std::filesystem::path& file) {
  return draw(surface.grid(), surface.measured_heights(), options, file);
}

LineChart profile_chart(std::span<const NamedProfile> profiles, std::string title) {
  if (profiles.empty()) refuse("a picture of profiles has none", "give at least one");
  const bool closed = profiles.front().profile.closed();
  LineChart chart;
  chart.title = std::move(title);
  chart.x.label = "x";
  chart.y.label = closed ? "y" : "height";
  chart.x.unit = chart.y.unit = "m";
  chart.equal_axes = closed;
  chart.height = closed ? 860 : 480;
  for (const NamedProfile& item : profiles) {
    if (item.profile.closed() != closed)
      refuse("a picture has open traces and closed outlines together", "draw them in separate pictures");
    ChartSeries series;
    series.name = item.name;
    series.points = item.profile.measured() == 1;
    series.gaps = !item.profile.complete();
    if (closed) {
      add_outline(item.profile, series);
    } else {
      add_trace(item.profile, series);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

std::vector<std::string> draw(const Profile& profile, const std::string& title,
                              const std::filesystem::path& file) {
  const NamedProfile item{"", profile};
  return draw(profile_chart({&item, 1}, title), file);
}

}  // namespace asperity
