// SPDX-License-Identifier: GPL-3.0-or-later
// Measured topographies from files: text matrices, x y z triples, NPY, X3P (ISO 25178-72), HDF5 and the
// CSV of stylus profilers and the others of formats() (format.hpp), each as it is or packed with gzip. A file
// is known by its content, then by its extension, unless `format` names it. A file that does not say its size
// or unit needs them in the call; the call wins over the file, with a warning, but not over the units of a
// line that names the columns: these must agree. A file that is damaged, or not what it claims to be, is an
// Error{bad_file}, and memory stays within a fixed multiple of the file's size.
#pragma once

#include <optional>
#include <string>

#include "engine/core/monitor.hpp"
#include "engine/surface/material.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

class SourceFile;

// What to do with missing points.
struct HoleFill {
  enum class Kind {
    none,
    interpolate,
    value
  };  // they stay missing, harmonic from the neighbours, one height
  Kind kind = Kind::none;
  double height = 0;  // m, for Kind::value

  static HoleFill interpolate() { return {Kind::interpolate, 0}; }
  static HoleFill with(double height) { return {Kind::value, height}; }
};

struct ReadOptions {
  std::optional<double> size_x, size_y;  // m, nodes times spacing
  std::optional<double> unit;            // m per height of the file
  std::optional<double> unit_xy{};       // m per number of a position, of files that hold positions
  HoleFill fill;
  std::string format;   // a name of formats() in format.hpp; empty: found out
  std::string channel;  // which of several maps in the file; empty: the first of heights
  std::optional<Material> material;
};

struct ReadProfileOptions {
  std::optional<double> spacing;    // m between samples
  std::optional<double> unit;       // m per height of the file
  std::optional<double> unit_xy{};  // m per number of a position, of files that hold positions
  HoleFill fill;
  std::string format, channel;
};

// In maps y points up: j = 0 is the lowest line, for each order of lines in the file (Format::lines). A trace
// (stylus CSV, one-dimensional array) becomes one row, ny = 1, whose size_y is one cell unless given. Points
// that the file marks as missing, each format in its own way, are holes of the surface unless `fill` says
// otherwise. Traits: the material, nothing else. Errors: bad_file, also where no point was measured;
// bad_value for a missing `size`, `unit` or `unit_xy`, for a unit that contradicts the head of the file, for
// a `unit_xy` where there are no positions, or for more than 65536 cells a side; unknown_name for `format`.
// Warns of sizes out of all proportion.
Surface read_surface(const std::string& path, const ReadOptions& options = {},
                     Monitor& monitor = Monitor::silent());
Surface read_surface(const SourceFile& file, const ReadOptions& options = {},
                     Monitor& monitor = Monitor::silent());

// A trace, a single row or a single column of heights, or two columns of text: position and height.
// A map of several rows is an error that points to reading it as a surface.
Profile read_profile(const std::string& path, const ReadProfileOptions& options = {},
                     Monitor& monitor = Monitor::silent());
Profile read_profile(const SourceFile& file, const ReadProfileOptions& options = {},
                     Monitor& monitor = Monitor::silent());

}  // namespace asperity
