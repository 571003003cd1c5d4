// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that can be told apart by eyes with any colour vision and in grey print. For ordered values:
// viridis and cividis (perceptually uniform; Smith & van der Walt 2015, Nuñez, Anderton & Renslow
// 2018), grey, heat (white at nothing), balance (two-sided about the middle) and contact (light
// grey: apart, dark blue: touching). For lines: the qualitative set of Okabe & Ito (2008).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

struct Palette {
  std::string_view name;
  std::span<const unsigned> colours;  // 0xRRGGBB at equal steps, first for the lowest value

  // Linear between the two nearest steps; `at` is held to [0, 1].
  unsigned colour(double at) const;
};

std::vector<std::string> palette_names();
// Throws Error{unknown_name} with the nearest name.
const Palette& palette(std::string_view name);

// Colour of line `k` of `lines`: the qualitative set while it suffices, else steps of viridis.
unsigned line_colour(int k, int lines);

}  // namespace asperity
