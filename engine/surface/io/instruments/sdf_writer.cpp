// SPDX-License-Identifier: GPL-3.0-or-later
// Writes binary SDF (ISO 25178-71, bISO-1.0): heights in metres as doubles, missing points NaN. Both read
// back bit for bit; a size, stored as spacing, may differ in the last digit, and a map of one line reads
// back as a trace.
#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

namespace {

template <class T>
void append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little, "SDF files are little-endian");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string sdf_header(const Grid& grid) {
  std::string bytes = "bISO-1.0Asperity  ";
  // Fixed dates: the same surface gives the same bytes.
  for (int k = 0; k < 2; ++k) bytes += "010119700000";
  append(bytes, static_cast<std::uint16_t>(grid.nx));
  append(bytes, static_cast<std::uint16_t>(grid.ny));
  // hx, hy and unit of height in m; a negative resolution means unknown.
  for (const double number : {grid.hx(), grid.hy(), 1.0, -1.0}) append(bytes, number);
  for (const int number : {0, 7, 0}) append(bytes, static_cast<std::uint8_t>(number));
  return bytes;
}

}  // namespace

// Throws Error{bad_value} above 65535 points a side (16 bits in the header), Error{bad_file} if writing
// fails.
void write_sdf(const Surface& surface, const std::string& path, Monitor& monitor) {
  const Grid& grid = surface.grid();
  constexpr int most = std::numeric_limits<std::uint16_t>::max();
  if (grid.nx > most || grid.ny > most)
    throw Error(ErrorCode::bad_value,
                file_name(path) + " cannot be written: SDF counts " + std::to_string(most) +
                    " points a side, and the surface has " + std::to_string(grid.nx) + " x " +
                    std::to_string(grid.ny),
                "write .x3p, .h5 or .npy");
  const Field& heights = surface.measured_heights();
  AtomicFile file(path, FileWords::data);
  file.write(sdf_header(grid));
  Task task(monitor, "writing", grid.ny);
  for (int j = 0; j < grid.ny; ++j) {
    const auto row = heights.row(j);
    file.write({reinterpret_cast<const char*>(row.data()), row.size_bytes()});
    task.advance();
  }
  file.commit();
}

}  // namespace asperity
