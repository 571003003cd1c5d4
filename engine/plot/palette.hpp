// SPDX-License-Identifier: GPL-3.0-or-later
// Colour maps readable with any colour vision and in grey. Sources: viridis (Smith & van der Walt 2015),
// cividis (Nuñez, Anderton & Renslow 2018), lines (Okabe & Ito 2008). Same colours in
// bindings/web/page/src/colour.ts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

struct Palette {
  std::string_view name;
  std::span<const unsigned> colours;  // 0xRRGGBB at equal steps, lowest value first
  std::optional<unsigned> none = {};  // colour of the lowest value, if it means none

  // Linear interpolation; `at` is clamped to [0, 1].
  unsigned colour(double at) const;
};

std::vector<std::string> palette_names();
// Throws Error{unknown_name} with the nearest name.
const Palette& palette(std::string_view name);

// Also on the page.
std::string_view palette_of_field(std::string_view field);

// Okabe & Ito while the set suffices, else viridis.
unsigned line_colour(int k, int lines);

}  // namespace asperity
