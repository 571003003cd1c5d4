// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of lab.surface (one process) and lab.spread (slabs).
#pragma once

#include <vector>

#include "bindings/lua/surface/surface.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

namespace asperity::lua {

struct SineKeys : GridKeys, SineOptions {};
struct SelfAffineKeys : GridKeys, SelfAffineOptions {};
extern const Block<SineKeys> sine_block;
extern const Block<SelfAffineKeys> self_affine_block;
extern const Block<GridKeys> flat_block;
// The caller reads the function `height`.
extern const Block<GridKeys> from_function_block;

// For generator and exact heights. The caller reads a `phases` function.

// K: WeierstrassMandelbrotOptions or derived.
template <class K>
std::vector<Option<K>> weierstrass_mandelbrot_keys() {
  using O = WeierstrassMandelbrotOptions;
  auto phases = custom<K>("phases", "\"golden\"|function",
                          "how the phases are drawn instead of from `seed`: the golden sequence that anyone "
                          "can reproduce, or function(m, n) returning radians",
                          [](const Argument& value, const OptionInfo& info, K& keys, Problems& problems) {
                            if (value.is_text() && value.text() == "golden") {
                              keys.phases = WavePhases::golden;
                            } else if (value.is_function()) {
                              keys.phases = WavePhases::function;
                            } else {
                              detail::wrong_type(
                                  value, info, "\"golden\" or a function(m, n) returning radians", problems);
                            }
                          });
  return {cells_option<O>(&O::nx, &O::ny).required(),
          number("D", &O::D, between(2, 3), "fractal dimension of the surface").required(),
          number("span", &O::span, above(0), "length of the x side in units of L"),
          quantity("L", &O::L, dimension::length, above(0), "sample length"),
          quantity("G", &O::G, dimension::length, above(0), "fractal roughness, the height scale"),
          number("gamma", &O::gamma, above(1), "ratio of neighbouring wave numbers"),
          integer("M", &O::M, between(1, 4096), "number of ridges (directions)"),
          integer("n_max", &O::n_max, at_least(0), "highest frequency index"),
          integer("seed", &O::seed, at_least(0), "of the random phases"),
          std::move(phases),
          choice("band", &O::band, {{"all", WaveBand::all}, {"resolved", WaveBand::resolved}},
                 "every wave as published (those past Nyquist alias), or only what the grid carries"),
          material_key(&O::material)};
}

}  // namespace asperity::lua
