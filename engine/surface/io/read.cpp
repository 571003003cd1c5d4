// SPDX-License-Identifier: GPL-3.0-or-later
// From the numbers of a file to metres: unit, size, holes. The same for every format, so that a
// reader only has to take numbers out.
#include "engine/surface/io/read.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/holes.hpp"

namespace asperity {

namespace {

void check_positive(const std::optional<double>& value, const std::string& key) {
  if (value && !(std::isfinite(*value) && *value > 0))
    throw Error(ErrorCode::bad_value, quoted(key) + " is " + format_short(*value) + " m",
                "give a finite length above zero");
}

// A call that cannot be right is told so before the file is looked for.
void check_call(const ReadOptions& options) {
  check_positive(options.size_x, "size");
  check_positive(options.size_y, "size");
  check_positive(options.unit, "unit");
  if (options.material) check(*options.material);
}

void check_call(const ReadProfileOptions& options) {
  check_positive(options.spacing, "spacing");
  check_positive(options.unit, "unit");
}

// The call's value, else the file's; a warning when the call overrules the file.
std::optional<double> settled(const std::optional<double>& asked, const std::optional<double>& found,
                              const SourceFile& file, const std::string& key, Monitor& monitor) {
  if (!asked) return found;
  if (found && std::abs(*asked - *found) > 1e-9 * std::abs(*found))
    monitor.warn(file_name(file.path()) + " says its " + key + " is " + format_short(*found) + " m; " +
                 quoted(key) + " = " + format_short(*asked) + " m of the call is used");
  return asked;
}

[[noreturn]] void refuse_missing(const SourceFile& file, const std::vector<std::string>& missing) {
  std::vector<std::string> keys;
  for (const std::string& key : missing) keys.push_back(quoted(key));
  throw Error(ErrorCode::bad_value, file_name(file.path()) + " does not say its " + joined(missing, " and "),
              "give " + joined(keys, " and ") + " in the call" +
                  (std::find(missing.begin(), missing.end(), "unit") != missing.end()
                       ? ": `unit` is the length of one number, such as \"um\""
                       : ""));
}

HeightMap read_map(const SourceFile& file, const std::string& forced, const std::string& channel,
                   Monitor& monitor, const Format** chosen = nullptr) {
  const Format& format = choose_format(file, forced);
  if (chosen != nullptr) *chosen = &format;
  if (channel.empty()) return format.read(file, monitor);
  if (format.read_channel != nullptr) return format.read_channel(file, channel, monitor);
  std::vector<std::string> several;
  for (const Format* other : formats())
    if (other->read_channel != nullptr) several.emplace_back(other->name);
  throw Error(ErrorCode::bad_value,
              "`channel` is \"" + channel + "\", and " + file_name(file.path()) + " is of the format " +
                  quoted(format.name) + ", which holds one map",
              "leave `channel` out; files of " + joined(several, " and ") + " may hold several maps");
}

// Turns the numbers into metres and closes the holes.
void into_metres(HeightMap& map, const SourceFile& file, double unit, double hx, double hy,
                 const HoleFill& fill, Monitor& monitor) {
  if (fill.kind == HoleFill::Kind::value && !std::isfinite(fill.height))
    throw Error(ErrorCode::bad_value, "`fill` is " + format_short(fill.height) + " m",
                "give a finite height");
  const auto nx = static_cast<std::size_t>(map.heights.nx());
  const auto node = [&](std::size_t k) {
    return "node (" + std::to_string(k % nx) + ", " + std::to_string(k / nx) + ")";
  };
  std::size_t holes = 0, first = 0;
  for (std::size_t k = 0; k < map.heights.size(); ++k) {
    double& height = map.heights[k];
    if (std::isnan(height)) {
      if (holes++ == 0) first = k;
      continue;
    }
    height *= unit;
    if (!std::isfinite(height))
      refuse_file(file, "has an infinite height at " + node(k), "mark missing points with nan");
  }
  if (holes == 0) return;
  if (holes == map.heights.size()) refuse_file(file, "holds no height, only missing points");
  switch (fill.kind) {
    case HoleFill::Kind::none:
      throw Error(ErrorCode::bad_value,
                  file_name(file.path()) + " has " + std::to_string(holes) + " missing " +
                      (holes == 1 ? "height" : "heights") + " of " + std::to_string(map.heights.size()) +
                      ", the first at " + node(first),
                  "`fill` = \"interpolate\" fills them from their neighbours, `fill` = 0 with that height");
    case HoleFill::Kind::value:
      for (double& height : map.heights.values())
        if (std::isnan(height)) height = fill.height;
      break;
    case HoleFill::Kind::interpolate:
      fill_harmonic(map.heights, hx, hy, monitor);
      break;
  }
}

// Two columns, position and height, become a trace; positions are evenly spaced.
void fold_positions(HeightMap& map, const SourceFile& file) {
  const int n = map.heights.ny();
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
  map.size_x = spacing * n;
  map.size_y.reset();
  map.size_in_units = true;
  map.trace = true;
}

}  // namespace

Surface read_surface(const std::string& path, const ReadOptions& options, Monitor& monitor) {
  check_call(options);
  return read_surface(SourceFile(path, monitor), options, monitor);
}

Surface read_surface(const SourceFile& file, const ReadOptions& options, Monitor& monitor) {
  check_call(options);
  HeightMap map = read_map(file, options.format, options.channel, monitor);

  const std::optional<double> unit = settled(options.unit, map.unit, file, "unit", monitor);
  if (map.size_in_units) {
    // Without a unit the sizes are unknown too, but one word of the call mends both.
    if (map.size_x) map.size_x = *map.size_x * unit.value_or(1);
    if (map.size_y) map.size_y = *map.size_y * unit.value_or(1);
  }
  const std::optional<double> size_x = settled(options.size_x, map.size_x, file, "size", monitor);
  std::optional<double> size_y = settled(options.size_y, map.size_y, file, "size", monitor);
  if (map.trace && size_x && !size_y) size_y = *size_x / map.heights.nx();
  std::vector<std::string> missing;
  if (!size_x || !size_y) missing.emplace_back("size");
  if (!unit) missing.emplace_back("unit");
  if (!missing.empty()) refuse_missing(file, missing);

  const Grid grid = make_grid(map.heights.nx(), map.heights.ny(), *size_x, *size_y);
  into_metres(map, file, *unit, grid.hx(), grid.hy(), options.fill, monitor);
  return Surface(grid, std::move(map.heights),
                 {.material = options.material, .periodic = false, .aliased_share = {}});
}

Profile read_profile(const std::string& path, const ReadProfileOptions& options, Monitor& monitor) {
  check_call(options);
  return read_profile(SourceFile(path, monitor), options, monitor);
}

Profile read_profile(const SourceFile& file, const ReadProfileOptions& options, Monitor& monitor) {
  check_call(options);
  const Format* format = nullptr;
  HeightMap map = read_map(file, options.format, options.channel, monitor, &format);
  if (!map.trace && map.heights.nx() == 2 && map.heights.ny() > 2 && format == &text_format())
    fold_positions(map, file);
  const int nx = map.heights.nx(), ny = map.heights.ny();
  if (nx > 1 && ny > 1)
    refuse_file(
        file,
        "holds a surface of " + std::to_string(nx) + " x " + std::to_string(ny) + " heights, not a profile",
        "read it with `surface.read` and take a profile of it");

  const std::optional<double> unit = settled(options.unit, map.unit, file, "unit", monitor);
  const std::optional<double>& length = ny == 1 ? map.size_x : map.size_y;
  std::optional<double> found = map.spacing;
  if (!found && length) found = *length * (map.size_in_units ? unit.value_or(1) : 1.0) / (nx * ny);
  const std::optional<double> spacing = settled(options.spacing, found, file, "spacing", monitor);
  std::vector<std::string> missing;
  if (!spacing) missing.emplace_back("spacing");
  if (!unit) missing.emplace_back("unit");
  if (!missing.empty()) refuse_missing(file, missing);

  into_metres(map, file, *unit, *spacing, *spacing, options.fill, monitor);
  const auto heights = map.heights.values();
  return Profile(*spacing, Array<double>(heights.begin(), heights.end()), map.closed_radius);
}

}  // namespace asperity
