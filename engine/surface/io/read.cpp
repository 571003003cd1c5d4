// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the numbers of any format to metres: unit, size, holes.
#include "engine/surface/io/read.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/files/text_encoding.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/deflated.hpp"
#include "engine/surface/io/foreign_format.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/operations/holes.hpp"

namespace asperity {

namespace {

void require_length(const char* key, std::optional<double> value) {
  require_positive(key, value, "m", "give a finite length above zero");
}

// Refuses wrong calls before the file is opened.
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

// Spreadsheets save "Unicode text" in UTF-16. Formats with a UTF-16 head decode it themselves.
std::optional<SourceFile> as_utf8(const SourceFile& file, const std::string& forced) {
  const std::optional<ForeignFormat> foreign = foreign_format(file);
  if (!foreign || foreign->what != utf16_text) return {};
  for (const Format* format : formats()) {
    if (format == &text_format() || format == &xyz_format() || format == &stylus_csv_format()) continue;
    if (forced.empty() ? format->recognises(file) : format->name == forced) return {};
  }
  const std::optional<std::string> text = utf8_of_utf16(file.bytes());
  if (!text) return {};
  return SourceFile(file.path(), Array<char>(text->begin(), text->end()), file.extension());
}

// After gunzip and conversion to UTF-8; none if not needed.
std::optional<SourceFile> plain_file(const SourceFile& given, const std::string& forced, Monitor& monitor) {
  std::optional<SourceFile> unpacked = inside_gzip(given, monitor);
  if (std::optional<SourceFile> text = as_utf8(unpacked ? *unpacked : given, forced)) return text;
  return unpacked;
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

[[noreturn]] void refuse_missing(const SourceFile& file, const std::vector<std::string>& missing) {
  std::vector<std::string> things, keys;
  for (const std::string& key : missing) {
    things.push_back(key == "unit_xy" ? "the unit of its positions" : "its " + key);
    keys.push_back(quoted(key));
  }
  for (std::size_t k = 1; k < things.size(); ++k)
    if (things[k].starts_with("its ")) things[k].erase(0, 4);
  const auto lacks = [&](const char* key) {
    return std::find(missing.begin(), missing.end(), key) != missing.end();
  };
  throw Error(ErrorCode::bad_value, file_name(file.path()) + " does not say " + joined(things, " and "),
              "give " + joined(keys, " and ") + " in the call" +
                  (lacks("unit") ? ": `unit` is the length of one number, such as \"um\"" : "") +
                  (!lacks("unit_xy") ? ""
                   : lacks("unit")   ? ", `unit_xy` that of a position, which may be another"
                                     : ": the length of one number of a position, such as \"mm\""));
}

// A contradiction to the line of column names is an error: either may be a mistake.
std::optional<double> unit_of(const std::optional<double>& asked, const std::optional<double>& found,
                              const HeightMap& map, const SourceFile& file, const std::string& key,
                              Monitor& monitor) {
  if (map.named_columns && asked && found && differ(*asked, *found))
    throw Error(ErrorCode::bad_value,
                file_name(file.path()) + " says in the line that names its columns that its " +
                    (key == "unit" ? "heights" : "positions") + " are in units of " +
                    format_quantity(*found, dimension::length) + ", and " + quoted(key) + " is " +
                    format_quantity(*asked, dimension::length),
                "leave " + quoted(key) + " out, or correct that line");
  return settled(asked, found, file, key, monitor);
}

// Sizes remain unknown without a unit of position.
void positions_into_metres(HeightMap& map, const std::optional<double>& asked, const SourceFile& file,
                           Monitor& monitor) {
  if (!map.size_in_units) {
    if (asked)
      throw Error(ErrorCode::bad_value,
                  "`unit_xy` is " + format_quantity(*asked, dimension::length) + ", and " +
                      file_name(file.path()) + " holds no positions, only heights",
                  "leave it out: it is of x y z points and of profiles in two columns");
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
    warn("has points that lie " + length(least) + " apart");
  } else if (most > longest) {
    warn("is " + length(most) + " long");
  } else if (!map.trace && (hx > narrowest * hy || hy > narrowest * hx)) {
    warn("has points that lie " + length(hx) + " apart along x and " + length(hy) + " along y");
  }
  double low = INFINITY, high = -INFINITY;
  for (const double height : map.heights.values()) {
    low = std::min(low, height);
    high = std::max(high, height);
  }
  if (high - low > steepest * std::max(size_x, size_y))
    warn("has heights that span " + length(high - low) + " over " + length(std::max(size_x, size_y)));
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
  throw Error(ErrorCode::bad_value,
              "`channel` is \"" + channel + "\", and " + file_name(file.path()) + " is of the format " +
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
  switch (fill.kind) {
    case HoleFill::Kind::none:
      break;
    case HoleFill::Kind::value:
      for (double& height : map.heights.values())
        if (std::isnan(height)) height = fill.height;
      break;
    case HoleFill::Kind::interpolate:
      fill_harmonic(map.heights, hx, hy, monitor);
      break;
  }
}

// Position and height become a trace.
void fold_positions(HeightMap& map, const SourceFile& file) {
  const int n = map.heights.ny();
  if (n < 2)
    refuse_file(file, "has two columns, position and height, and one row",
                "a profile takes two samples or more");
  Field heights(n, 1);
  for (int k = 0; k < n; ++k) heights(k, 0) = map.heights(1, k);
  const double spacing = (map.heights(0, n - 1) - map.heights(0, 0)) / (n - 1);
  for (int k = 0; k < n; ++k)
    if (!(spacing > 0) ||
        !(std::abs(map.heights(0, k) - (map.heights(0, 0) + k * spacing)) <= 0.25 * spacing))
      refuse_file(file,
                  "has two columns, position and height, but its positions are not evenly spaced at sample " +
                      std::to_string(k + 1));
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

Surface read_surface(const std::string& path, const ReadOptions& options, Monitor& monitor) {
  check_call(options);
  return read_surface(SourceFile(path, monitor), options, monitor);
}

Surface read_surface(const SourceFile& given, const ReadOptions& options, Monitor& monitor) {
  check_call(options);
  const std::optional<SourceFile> plain = plain_file(given, options.format, monitor);
  const SourceFile& file = plain ? *plain : given;
  const Format* format = nullptr;
  HeightMap map = read_map(file, options.format, options.channel, monitor, &format);
  if (format == &text_format() && options.format.empty() && !map.size_x && map.heights.nx() == 3 &&
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
  std::vector<std::string> missing;
  const bool without_size = !size_x || !size_y;
  if (without_size && !map.size_in_units) missing.emplace_back("size");
  if (!unit) missing.emplace_back("unit");
  if (without_size && map.size_in_units) missing.emplace_back("unit_xy");
  if (!missing.empty()) refuse_missing(file, missing);

  const Grid grid = make_grid(map.heights.nx(), map.heights.ny(), *size_x, *size_y);
  into_metres(map, file, *unit, grid.hx(), grid.hy(), options.fill, monitor);
  warn_of_proportions(map, file, grid.hx(), grid.hy(), monitor);
  return Surface::with_holes(grid, std::move(map.heights),
                             {.material = options.material, .periodic = false, .aliased_share = {}});
}

Profile read_profile(const std::string& path, const ReadProfileOptions& options, Monitor& monitor) {
  check_call(options);
  return read_profile(SourceFile(path, monitor), options, monitor);
}

Profile read_profile(const SourceFile& given, const ReadProfileOptions& options, Monitor& monitor) {
  check_call(options);
  const std::optional<SourceFile> plain = plain_file(given, options.format, monitor);
  const SourceFile& file = plain ? *plain : given;
  const Format* format = nullptr;
  HeightMap map = read_map(file, options.format, options.channel, monitor, &format);
  if (map.pairs || (!map.trace && map.heights.nx() == 2 && map.heights.ny() > 2 && format == &text_format()))
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
  std::vector<std::string> missing;
  if (!spacing && !map.size_in_units) missing.emplace_back("spacing");
  if (!unit) missing.emplace_back("unit");
  if (!spacing && map.size_in_units) missing.emplace_back("unit_xy");
  if (!missing.empty()) refuse_missing(file, missing);

  into_metres(map, file, *unit, *spacing, *spacing, options.fill, monitor);
  map.trace = true;
  warn_of_proportions(map, file, *spacing, *spacing, monitor);
  const auto heights = map.heights.values();
  return Profile::with_holes(*spacing, Array<double>(heights.begin(), heights.end()), map.closed_radius);
}

}  // namespace asperity
