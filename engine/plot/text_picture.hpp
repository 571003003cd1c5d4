// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures for a terminal: a height map or another field as rows of coloured half blocks or of characters
// from light to dense, true to scale with y upwards, and a chart drawn by gnuplot in characters. The map is
// a reduction by area-weighted means, and its last line says of how many cells one mark is the mean.
#pragma once

#include <string>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"
#include "engine/plot/chart.hpp"
#include "engine/plot/picture.hpp"

namespace asperity {

enum class TextColours { none, indexed, full };  // none; the 256 colours of xterm; 24 bits

struct TextCanvas {
  int columns = 80, rows = 24;  // of the terminal; a picture takes a few rows less
  TextColours colours = TextColours::none;
  bool unicode = true;
};

// What the environment and the terminal on standard output can show: TERM, COLORTERM, NO_COLOR, the language
// of the environment; 80 x 24 without colours where there is no terminal.
TextCanvas text_canvas();

// The map with a caption line. `label` and `dimension` are those of the values. Throws as picture_script does
// for a bad range or palette.
std::string text_map(const Grid& grid, const Field& field, const PictureOptions& options, Dimension dimension,
                     const TextCanvas& canvas);

// The chart in characters; `warnings` gets sentences about what was left out. Throws Error{bad_value} if no
// point is left, and as run_gnuplot does.
std::string text_chart(const LineChart& chart, const TextCanvas& canvas, std::vector<std::string>& warnings);

}  // namespace asperity
