// SPDX-License-Identifier: GPL-3.0-or-later
// Converts numbers of any format to metres.
#include "engine/surface/io/read.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/files/text_table.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/io/deflated.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

void require_length(const char* key, std::optional<double> value) {
  require_positive(key, value, "m", "give a finite length above zero");
}

void check_call(const ReadOptions& options) {
  require_length("size", options.size_x);
  require_length("size", options.size_y);
  require_length("unit", options.unit);
  require_length("unit_xy", options.unit_xy);
  if (options.material) check(*options.material);
}

void check_call(const ReadProfileOptions& options) {
  require_length("spacing", options.spacing);
  require_length("unit", options.unit);
  require_length("unit_xy", options.unit_xy);
}

// Tolerance: four-byte rounding.
bool differ(double asked, double found) { return std::abs(asked - found) > 1e-6 * std::abs(found); }

// Warns if call and file differ; the call wins.
std::optional<double> settled(const std::optional<double>& asked, const std::optional<double>& found,
                              const SourceFile& file, const std::string& key, Monitor& monitor) {
  if (!asked) return found;
  if (found && differ(*asked, *found))
    monitor.warn(file_name(file.path()) + " says its " + key + " is " + format_short(*found) + " m; " +
                 quoted(key) + " = " + format_short(*asked) + " m of the call is used");
  return asked;
}

// `length_key` names the size or the spacing.
void require_scale(const SourceFile& file, const HeightMap& map, bool unit_known, bool length_known,
                   const std::string& length_key) {
  std::vector<std::string> things, keys;
  const auto lacks = [&](const std::string& key) {
    things.push_back(key == "unit_xy" ? "the unit of its positions" : (things.empty() ? "its " : "") + key);
    keys.push_back(quoted(key));
  };
  if (!length_known && !map.size_in_units) lacks(length_key);
  if (!unit_known) lacks("unit");
  const bool lacks_unit_xy = !length_known && map.size_in_units;
  if (lacks_unit_xy) lacks("unit_xy");
  if (keys.empty()) return;
  refuse(file_name(file.path()) + " does not say " + joined(things, " and "),
         "give " + joined(keys, " and ") + " in the call" +
             (unit_known ? "" : ": `unit` is the length of one number, such as \"um\"") +
             (!lacks_unit_xy ? ""
              : unit_known   ? ": the length of one number of a position, such as \"mm\""
                             : ", `unit_xy` that of a position, which may be another"));
}

// A contradiction to column names is an error.
std::optional<double> unit_of(const std::optional<double>& asked, const std::optional<double>& found,
                              const HeightMap& map, const SourceFile& file, const std::string& key,
                              Monitor& monitor) {
  if (map.named_columns && asked && found && differ(*asked, *found))
    refuse(file_name(file.path()) + " names its columns with " + (key == "unit" ? "heights" : "positions") +
               " in units of " + format_quantity(*found, dimension::length) + ", and " + quoted(key) +
               " is " + format_quantity(*asked, dimension::length),
           "leave " + quoted(key) + " out, or correct that line");
  return settled(asked, found, file, key, monitor);
}

// Sizes remain unknown without a unit of position.
void positions_into_metres(HeightMap& map, const std::optional<double>& asked, const SourceFile& file,
                           Monitor& monitor) {
  if (!map.size_in_units) {
    if (asked)
      refuse("`unit_xy` is " + format_quantity(*asked, dimension::length) + ", and " +
                 file_name(file.path()) + " holds no positions, only heights",
             "leave it out: only x y z points and profiles in two columns have positions");
    return;
  }
  const std::optional<double> unit = unit_of(asked, map.position_unit, map, file, "unit_xy", monitor);
  for (std::optional<double>* size : {&map.size_x, &map.size_y})
    if (*size) *size = unit ? std::optional<double>(**size * *unit) : std::nullopt;
}

// Lengths beyond any instrument indicate a wrong unit.
void warn_of_proportions(const HeightMap& map, const SourceFile& file, double hx, double hy,
                         Monitor& monitor) {
  constexpr double shortest = 1e-12, longest = 1e3, steepest = 1e3, narrowest = 1e5;
  const double size_x = hx * map.heights.nx(), size_y = hy * map.heights.ny();
  const auto length = [](double value) { return format_quantity(value, dimension::length); };
  const auto warn = [&](const std::string& finding) {
    monitor.warn(file_name(file.path()) + " " + finding + ": check its size and its unit");
  };
  if (const double least = std::min(hx, hy), most = std::max(size_x, size_y); least < shortest) {
    warn("has points " + length(least) + " apart");
  } else if (most > longest) {
    warn("is " + length(most) + " long");
  } else if (!map.trace && (hx > narrowest * hy || hy > narrowest * hx)) {
    warn("has points " + length(hx) + " apart along x and " + length(hy) + " along y");
  }
  if (const double span = known_range(map.heights.values()).span();
      span > steepest * std::max(size_x, size_y))
    warn("has heights that span " + length(span) + " over " + length(std::max(size_x, size_y)));
}

HeightMap read_map(const SourceFile& file, const std::string& forced, const std::string& channel,
                   Monitor& monitor, const Format** chosen) {
  const Format& format = choose_format(file, forced);
  *chosen = &format;
  if (format.read_channel != nullptr) return format.read_channel(file, channel, monitor);
  if (channel.empty()) return format.read(file, monitor);
  std::vector<std::string> several;
  for (const Format* other : formats())
    if (other->read_channel != nullptr) several.emplace_back(other->name);
  refuse("`channel` is \"" + channel + "\", and " + file_name(file.path()) + " is of the format " +
             quoted(format.name) + ", which holds one map",
         "leave `channel` out; files of " + joined(several, " and ") + " may hold several maps");
}

void into_metres(HeightMap& map, const SourceFile& file, double unit, double hx, double hy,
                 const HoleFill& fill, Monitor& monitor) {
  if (fill.kind == HoleFill::Kind::value)
    require(std::isfinite(fill.height), "fill", fill.height, "m", "give a finite height");
  const auto nx = static_cast<std::size_t>(map.heights.nx());
  std::size_t holes = 0;
  for (std::size_t k = 0; k < map.heights.size(); ++k) {
    double& height = map.heights[k];
    if (std::isnan(height)) {
      ++holes;
      continue;
    }
    height *= unit;
    if (!std::isfinite(height))
      refuse_file(
          file,
          "has an infinite height at node (" + std::to_string(k % nx) + ", " + std::to_string(k / nx) + ")",
          "mark missing points with nan");
  }
  if (holes == 0) return;
  if (holes == map.heights.size()) refuse_file(file, "holds no height, only missing points");
  if (fill.kind == HoleFill::Kind::none) return;
  const bool by_value = fill.kind == HoleFill::Kind::value;
  fill_holes(map.heights, by_value ? std::optional(fill.height) : std::nullopt, hx, hy, monitor);
}

// Position and height become a trace.
void fold_positions(HeightMap& map, const SourceFile& file) {
  const int n = map.heights.ny();
  if (n < 2)
    refuse_file(file, "has two columns, position and height, and one row",
                "a profile takes two samples or more");
  Field heights(n, 1);
  Array<double> positions;
  for (int k = 0; k < n; ++k) {
    heights(k, 0) = map.heights(1, k);
    positions.push_back(map.heights(0, k));
  }
  if (const std::size_t even = even_values(positions, 0.25); even < positions.size())
    refuse_file(file,
                "has two columns, position and height, but its positions are not evenly spaced at sample " +
                    std::to_string(even + 1));
  const double spacing = (positions.back() - positions.front()) / (n - 1);
  map.heights = std::move(heights);
  map.pairs = false;
  map.size_x = spacing * n;
  map.size_y.reset();
  map.size_in_units = true;
  map.trace = true;
}

// Lowest line first; traces are unchanged.
void stand_upright(HeightMap& map, const Format& format) {
  if (map.trace || map.heights.ny() < 2) return;
  if (map.first_line.value_or(format.lines.first) == FirstLine::bottom) return;
  turn_over(map.heights);
}

}  // namespace

Surface read_surface(const SourceFile& given, const ReadOptions& options, Monitor& monitor) {
  check_call(options);
  const std::optional<SourceFile> unpacked = inside_gzip(given, monitor);
  const SourceFile& file = unpacked ? *unpacked : given;
  const Format* format = nullptr;
  HeightMap map = read_map(file, options.format, options.channel, monitor, &format);
  if (format == &text_format && options.format.empty() && !map.size_x && map.heights.nx() == 3 &&
      map.heights.ny() == 1)
    refuse_file(file, "holds one line of three numbers: a point, or a matrix of three heights",
                "say `format` = \"text\" for a matrix; one point is no surface");
  if (map.pairs) fold_positions(map, file);
  stand_upright(map, *format);

  const std::optional<double> unit = unit_of(options.unit, map.unit, map, file, "unit", monitor);
  positions_into_metres(map, options.unit_xy, file, monitor);
  const std::optional<double> size_x = settled(options.size_x, map.size_x, file, "size", monitor);
  std::optional<double> size_y = settled(options.size_y, map.size_y, file, "size", monitor);
  if (map.trace && size_x && !size_y) size_y = *size_x / map.heights.nx();
  require_scale(file, map, unit.has_value(), size_x && size_y, "size");

  const Grid grid = make_grid(map.heights.nx(), map.heights.ny(), *size_x, *size_y);
  into_metres(map, file, *unit, grid.hx(), grid.hy(), options.fill, monitor);
  warn_of_proportions(map, file, grid.hx(), grid.hy(), monitor);
  return Surface::with_holes(grid, std::move(map.heights),
                             {.material = options.material, .periodic = false, .aliased_share = {}});
}

Profile read_profile(const SourceFile& given, const ReadProfileOptions& options, Monitor& monitor) {
  check_call(options);
  const std::optional<SourceFile> unpacked = inside_gzip(given, monitor);
  const SourceFile& file = unpacked ? *unpacked : given;
  const Format* format = nullptr;
  HeightMap map = read_map(file, options.format, options.channel, monitor, &format);
  if (map.pairs || (!map.trace && map.heights.nx() == 2 && map.heights.ny() > 2 && format == &text_format))
    fold_positions(map, file);
  stand_upright(map, *format);
  const int nx = map.heights.nx(), ny = map.heights.ny();
  if (nx > 1 && ny > 1)
    refuse_file(
        file,
        "holds a surface of " + std::to_string(nx) + " x " + std::to_string(ny) + " heights, not a profile",
        "read it with `surface.read` and take a profile of it");

  const std::optional<double> unit = unit_of(options.unit, map.unit, map, file, "unit", monitor);
  positions_into_metres(map, options.unit_xy, file, monitor);
  const std::optional<double>& length = ny == 1 ? map.size_x : map.size_y;
  std::optional<double> found = map.spacing;
  if (!found && length) found = *length / (nx * ny);
  const std::optional<double> spacing = settled(options.spacing, found, file, "spacing", monitor);
  require_scale(file, map, unit.has_value(), spacing.has_value(), "spacing");

  into_metres(map, file, *unit, *spacing, *spacing, options.fill, monitor);
  map.trace = true;
  warn_of_proportions(map, file, *spacing, *spacing, monitor);
  const auto heights = map.heights.values();
  return Profile::with_holes(*spacing, Array<double>(heights.begin(), heights.end()), map.closed_radius);
}

}  // namespace asperity
