// SPDX-License-Identifier: GPL-3.0-or-later
// Reads measured topographies in all formats() (format.hpp), plain or gzipped. The call must give size and
// unit if the file does not. A value of the call overrides the file with a warning, but must not contradict
// units in a line of column names. Damaged or mislabelled files throw Error{bad_file}.
#pragma once

#include <optional>
#include <string>

#include "engine/core/monitor.hpp"
#include "engine/surface/material.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

class SourceFile;

struct HoleFill {
  enum class Kind { none, interpolate, value };  // `none`: points stay missing
  Kind kind = Kind::none;
  double height = 0;  // m, for Kind::value

  static HoleFill interpolate() { return {Kind::interpolate, 0}; }
  static HoleFill with(double height) { return {Kind::value, height}; }
};

struct ReadOptions {
  std::optional<double> size_x, size_y;  // m, nodes times spacing
  std::optional<double> unit;            // m per height of the file
  std::optional<double> unit_xy{};       // m per number of a position
  HoleFill fill;
  std::string format;   // name in formats(); empty: detected
  std::string channel;  // name of a map; empty: the first of heights
  std::optional<Material> material;
};

struct ReadProfileOptions {
  std::optional<double> spacing;    // m between samples
  std::optional<double> unit;       // m per height of the file
  std::optional<double> unit_xy{};  // m per number of a position
  HoleFill fill;
  std::string format, channel;
};

// j = 0 is the lowest line. A trace becomes one row, ny = 1; default size_y: one cell. Traits: only the
// material. Errors: bad_file, also if no point was measured; bad_value for a missing `size`, `unit` or
// `unit_xy`, a contradictory unit, a `unit_xy` without positions, or more than 65536 cells a side;
// unknown_name for `format`. Warns of implausible sizes.
Surface read_surface(const SourceFile& file, const ReadOptions& options = {},
                     Monitor& monitor = Monitor::silent());

// A trace, a single row or column, or two columns, position and height. Throws Error{bad_file} for a map.
Profile read_profile(const SourceFile& file, const ReadProfileOptions& options = {},
                     Monitor& monitor = Monitor::silent());

}  // namespace asperity
