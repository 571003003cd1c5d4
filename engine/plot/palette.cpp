// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr unsigned viridis[] = {0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d,
                                0x2c728e, 0x26828e, 0x21918c, 0x1fa088, 0x28ae80, 0x3fbc73,
                                0x5ec962, 0x84d44b, 0xaddc30, 0xd8e219, 0xfde725};
constexpr unsigned cividis[] = {0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173,
                                0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46};
constexpr unsigned grey[] = {0x000000, 0xffffff};
// Inferno from .62 down to 0; contrast to `nothing` at least 3 to 1.
constexpr unsigned heat[] = {0xdf5337, 0xcb4149, 0xb1325a, 0x932667, 0x751d6c,
                             0x57106e, 0x380962, 0x190c3e, 0x000004};
constexpr unsigned nothing = 0xe6eaed;
constexpr unsigned balance[] = {0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                                0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f};
constexpr unsigned contact[] = {0xe6e6e6, 0x08306b};

constexpr std::array<Palette, 6> palettes = {{{"viridis", viridis},
                                              {"cividis", cividis},
                                              {"grey", grey},
                                              {"heat", heat, nothing},
                                              {"balance", balance},
                                              {"contact", contact}}};

constexpr std::array<unsigned, 7> okabe_ito = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                               0xe69f00, 0x56b4e9, 0x000000};

}  // namespace

unsigned Palette::colour(double at) const {
  if (at <= 0 && none) return *none;
  const double place = std::clamp(at, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  const double share = place - static_cast<double>(below);
  unsigned mixed = 0;
  for (const unsigned shift : {16U, 8U, 0U}) {
    const auto a = static_cast<double>(colours[below] >> shift & 0xFFU);
    const auto b = static_cast<double>(colours[below + 1] >> shift & 0xFFU);
    mixed |= static_cast<unsigned>(std::lround(a + share * (b - a))) << shift;
  }
  return mixed;
}

std::vector<std::string> palette_names() {
  std::vector<std::string> names;
  for (const Palette& known : palettes) names.emplace_back(known.name);
  return names;
}

const Palette& palette(std::string_view name) {
  for (const Palette& known : palettes)
    if (known.name == name) return known;
  const std::vector<std::string> names = palette_names();
  refuse_name("`palette` " + quoted(name) + " is not known" + did_you_mean(name, names),
              "palettes are " + joined(names, " and "));
}

std::string_view palette_of_field(std::string_view field) {
  if (field == "gap") return "cividis";
  if (field == "pressure" || field == "plastic") return "heat";
  return field == "contact" ? "contact" : "viridis";
}

unsigned line_colour(int k, int lines) {
  if (lines <= static_cast<int>(okabe_ito.size())) return okabe_ito[static_cast<std::size_t>(k)];
  constexpr double lightest = 0.88;  // the end of viridis is too pale on white
  return palettes[0].colour(lightest * k / (lines - 1));
}

}  // namespace asperity
