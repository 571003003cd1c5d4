// SPDX-License-Identifier: GPL-3.0-or-later
// PNG pictures of a field by gnuplot: maps to scale, y upwards, with scale bar and colour bar; or reliefs.
// Large grids are reduced first, so viewers need not scale.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct PictureOptions {
  std::string title;
  std::string label = "height";     // of the colour bar
  std::string unit = "m";           // of the values; "" for plain numbers
  std::string palette = "viridis";  // "contact": a mask of 0 and 1 with a key
  std::optional<Range> range;       // of the colours, in `unit`; default: of the values
  int width = 1000;                 // pixels, 200 … 4000; tall maps take less
  enum class View { map, relief } view = View::map;
};

// The script, and the bytes of its data file `cells` (32-bit floats).
struct PictureScript {
  std::string script;
  std::string cells;
};

// Non-finite values stay blank; strips (aspect above 20) are not to scale. Throws Error{bad_value} for a
// field unlike the grid, no finite value, a bad `width` or `range`; Error{unknown_name} for the palette.
// Cost: one pass; a value per pixel.
PictureScript picture_script(const Grid& grid, const Field& field, const PictureOptions& options);

// Replaces `file` (.png) atomically; returns gnuplot's complaints. Throws like picture_script, run_gnuplot,
// write_atomically.
std::vector<std::string> draw(const Grid& grid, const Field& field, const PictureOptions& options,
                              const std::filesystem::path& file);
// Holes stay blank.
std::vector<std::string> draw(const Surface& surface, const PictureOptions& options,
                              const std::filesystem::path& file);

// Area-weighted means over columns × rows equal patches or fewer, of finite values; else NaN.
Field reduced(const Field& field, int columns, int rows);

}  // namespace asperity
