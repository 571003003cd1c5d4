// SPDX-License-Identifier: GPL-3.0-or-later
// Writes SUR (Digital Surf) for MountainsMap and most metrology programs. Heights are rounded to steps of
// (greatest height) / 2^30, or range / 2^31 far from zero; sizes to single precision. A missing point is
// the least number minus 2. Heights read back within half a step, holes exactly; a map of one line reads
// back as a trace. Header: the software's reference, as in sur.cpp.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

namespace {

constexpr double millimetre = 1e-3;
// Half the range of 32 bits, for rounding and for the number of a missing point.
constexpr double sur_greatest = 1073741824.0;

// Height = number · step + offset, in millimetres.
struct SurSteps {
  float step = 1, offset = 0;
  std::int32_t number(double height) const {
    return static_cast<std::int32_t>(
        std::lround((height / millimetre - static_cast<double>(offset)) / static_cast<double>(step)));
  }
};

float single(double value, const std::string& path, const char* what) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
    refuse(file_name(path) + " cannot be written: its " + what + " of " + format_short(value) +
               " mm is more than a SUR file holds",
           "write .x3p, .h5 or .npy");
  return rounded;
}

SurSteps steps_of(const Range& heights, const std::string& path) {
  // Readers that ignore the offset show shifted heights, so it is used only for otherwise coarse steps.
  constexpr double far_from_zero = 1000;
  const double least = heights.min / millimetre, most = heights.max / millimetre;
  SurSteps steps;
  double reach = std::max(std::abs(least), std::abs(most));
  if (reach > far_from_zero * (most - least)) {
    steps.offset = single(0.5 * least + 0.5 * most, path, "height");
    reach = std::max(std::abs(least - static_cast<double>(steps.offset)),
                     std::abs(most - static_cast<double>(steps.offset)));
  }
  if (reach == 0) return steps;
  steps.step = std::max(single(reach / sur_greatest, path, "step"), std::numeric_limits<float>::min());
  return steps;
}

template <class T>
void put(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little, "SUR files are little-endian");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_text(std::string& bytes, std::string_view text, std::size_t width, char pad) {
  bytes += text.substr(0, width);
  bytes.append(width - std::min(width, text.size()), pad);
}

std::string sur_header(const Surface& surface, const SurSteps& steps, std::int32_t least, std::int32_t most,
                       const std::string& path) {
  const Grid& grid = surface.grid();
  const bool holes = !surface.complete();
  std::string comment =
      "Heights are rounded to steps of " + format_short(static_cast<double>(steps.step)) + " mm.";
  if (holes)
    comment += " " + std::to_string(grid.nodes() - surface.measured()) + " of " +
               std::to_string(grid.nodes()) + " points were not measured.";
  std::string bytes = "DIGITAL SURF";
  // Little-endian, one object, version 1, surface.
  for (const int value : {0, 1, 1, 2}) put(bytes, static_cast<std::int16_t>(value));
  put_text(bytes, "height", 30, ' ');
  put_text(bytes, "Asperity", 30, ' ');
  // No material, no kind of measurement, whole range, holes or not, absolute heights.
  for (const int value : {0, 0, 0, holes ? 1 : 0, 1}) put(bytes, static_cast<std::int16_t>(value));
  put_text(bytes, "", 8, '\0');
  put(bytes, std::int16_t{32});
  for (const std::int32_t value : {least, most, grid.nx, grid.ny, static_cast<std::int32_t>(grid.nodes())})
    put(bytes, value);
  put(bytes, single(grid.hx() / millimetre, path, "spacing"));
  put(bytes, single(grid.hy() / millimetre, path, "spacing"));
  put(bytes, steps.step);
  for (const char* const name : {"X", "Y", "Z"}) put_text(bytes, name, 16, ' ');
  for (int k = 0; k < 6; ++k) put_text(bytes, "mm", 16, ' ');  // units of spacing, then of length, per axis
  for (int k = 0; k < 3; ++k) put(bytes, 1.0F);                // unit ratios
  // Not a replica, not inverted, not levelled.
  for (const int value : {0, 0, 0}) put(bytes, static_cast<std::int16_t>(value));
  put_text(bytes, "", 12, '\0');
  // Fixed date, second to weekday: the same surface gives the same bytes.
  for (const int value : {0, 0, 0, 1, 1, 1970, 4}) put(bytes, static_cast<std::int16_t>(value));
  put(bytes, 0.0F);
  put_text(bytes, "", 10, '\0');
  put(bytes, static_cast<std::int16_t>(comment.size()));
  put(bytes, std::int16_t{0});
  put_text(bytes, "", 128, '\0');
  for (const float offset : {0.0F, 0.0F, steps.offset}) put(bytes, offset);
  put_text(bytes, "", 512 - bytes.size(), '\0');
  return bytes + comment;
}

}  // namespace

// Throws Error{bad_value} if sizes or heights exceed single precision, Error{bad_file} if writing fails.
void write_sur(const Surface& surface, const std::string& path, Monitor& monitor) {
  const Grid& grid = surface.grid();
  const Field& heights = surface.measured_heights();
  if (grid.nodes() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    refuse("a surface of " + std::to_string(grid.nodes()) + " heights does not fit into a SUR file",
           "write .h5 or .npy");
  const Range range = surface.height_range();
  const SurSteps steps = steps_of(range, path);
  const std::int32_t least = steps.number(range.min), most = steps.number(range.max);
  AtomicFile file(path, FileWords::data);
  file.write(sur_header(surface, steps, least, most, path));
  Task task(monitor, "writing", grid.ny);
  Array<std::int32_t> row(static_cast<std::size_t>(grid.nx));
  for (int j = 0; j < grid.ny; ++j) {
    std::ranges::transform(heights.row(j), row.begin(), [&](double height) {
      return std::isnan(height) ? least - 2 : steps.number(height);
    });
    file.write({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(std::int32_t)});
    task.advance();
  }
  file.commit();
}

}  // namespace asperity
