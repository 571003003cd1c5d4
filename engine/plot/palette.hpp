// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that can be told apart by eyes with any colour vision and in grey print. For ordered values:
// viridis and cividis (perceptually uniform; Smith & van der Walt 2015, Nuñez, Anderton & Renslow
// 2018), grey, heat (for what is nothing over most of a map, such as pressures: light grey at nothing, then
// from orange over purple to black, the lower part of inferno, each at 3:1 or more to that grey), balance
// (two-sided about the middle) and contact (light grey: apart, dark blue: touching). The page has the same
// colours (bindings/web/page/src/palettes.ts). For lines: the qualitative set of Okabe & Ito (2008).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

struct Palette {
  std::string_view name;
  std::span<const unsigned> colours;  // 0xRRGGBB at equal steps, first for the lowest value
  std::optional<unsigned> none = {};  // of the lowest value itself, where that is nothing

  // Linear between the two nearest steps; `at` is held to [0, 1].
  unsigned colour(double at) const;
};

std::vector<std::string> palette_names();
// Throws Error{unknown_name} with the nearest name.
const Palette& palette(std::string_view name);

// What a field is drawn in, on the page too: "gap" in cividis, "pressure" and "plastic" in heat, "contact" in
// contact, all others in viridis.
std::string_view palette_of_field(std::string_view field);

// Colour of line `k` of `lines`: the qualitative set while it suffices, else steps of viridis.
unsigned line_colour(int k, int lines);

}  // namespace asperity
