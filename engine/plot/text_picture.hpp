// SPDX-License-Identifier: GPL-3.0-or-later
// Terminal pictures: maps in coloured half blocks or characters, to scale, y upwards; charts by gnuplot in
// characters.
#pragma once

#include <string>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"
#include "engine/plot/chart.hpp"
#include "engine/plot/picture.hpp"

namespace asperity {

enum class TextColours { none, indexed, full };  // none; xterm's 256 colours; 24 bits

struct TextCanvas {
  int columns = 80, rows = 24;  // of the terminal; pictures are a few rows smaller
  TextColours colours = TextColours::none;
  bool unicode = true;
};

// From the terminal, TERM, COLORTERM, NO_COLOR and locale; else 80 x 24, no colours.
TextCanvas text_canvas();

// `dimension`: of the values. Throws like picture_script for a bad range or palette.
std::string text_map(const Grid& grid, const Field& field, const PictureOptions& options, Dimension dimension,
                     const TextCanvas& canvas);

// Appends to `warnings`. Throws Error{bad_value} if no point is left, and like run_gnuplot.
std::string text_chart(const LineChart& chart, const TextCanvas& canvas, std::vector<std::string>& warnings);

}  // namespace asperity
