// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a field on a grid, as PNG: seen from above, true to scale, y upwards, with a scale bar of
// round length and a colour bar with unit; or in relief. Grids larger than the picture are reduced by
// area-weighted averages first, so nothing depends on how a viewer scales. Drawn by gnuplot.
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
  std::string palette = "viridis";  // see palette.hpp; "contact" shows a mask of 0 and 1 with a key
  std::optional<Range> range;       // of the colours, in `unit`; default: of the values
  int width = 1000;                 // pixels, 200 … 4000; a tall map takes less
  enum class View { map, relief } view = View::map;
};

// The gnuplot script of a picture and the name of the data file it reads ("cells": 32-bit floats).
struct PictureScript {
  std::string script;
  std::string cells;
};

// Non-finite values are left blank. A strip (one cell wide, or longer than 20 times its width) is drawn
// out of scale so that it can be seen. Throws Error{bad_value} for a field that does not fit the grid,
// no finite value, a bad `width` or `range`; Error{unknown_name} for a palette that is not known.
// Cost: one pass over the field; memory of a value a pixel.
PictureScript picture_script(const Grid& grid, const Field& field, const PictureOptions& options);

// Draws into `file` (.png), replaced atomically. Returns warnings: what gnuplot complained of. Throws as
// picture_script, run_gnuplot and write_atomically do.
std::vector<std::string> draw(const Grid& grid, const Field& field, const PictureOptions& options,
                              const std::filesystem::path& file);
// Points that were not measured are left blank.
std::vector<std::string> draw(const Surface& surface, const PictureOptions& options,
                              const std::filesystem::path& file);

// Means of the field over columns × rows equal patches, none more than the field has; cells that straddle
// patches count by area. Non-finite values do not count; a patch without any other is nan.
Field reduced(const Field& field, int columns, int rows);

}  // namespace asperity
