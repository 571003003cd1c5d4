// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of surfaces made in one process (lab.surface) or in slabs over several (lab.spread).
#pragma once

#include <vector>

#include "bindings/lua/surface/grid_keys.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"

namespace asperity::lua {

struct SineKeys : GridKeys, SineOptions {};
inline std::vector<Option<SineKeys>> sine_keys() {
  return {Option<SineKeys>(cells_key()).required(),
          Option<SineKeys>(size_key()).required(),
          Option<SineKeys>(quantity("amplitude", &SineOptions::amplitude, dimension::length, at_least(0),
                                    "height of a crest above the mean"))
              .required(),
          Option<SineKeys>(quantity("wavelength", &SineOptions::wavelength, dimension::length, above(0),
                                    "length of a wave"))
              .defaults_to("size"),
          integer("directions", &SineOptions::directions, between(1, 2),
                  "1: cos along x; 2: cos along x times cos along y"),
          material_key()};
}

inline void check_sine_keys(SineKeys& keys, Problems&) {
  keys.grid = keys.make();
  (void)sine_factors(keys);
}

struct SelfAffineKeys : GridKeys, SelfAffineOptions {};
inline std::vector<Option<SelfAffineKeys>> self_affine_keys() {
  using O = SelfAffineOptions;
  using K = SelfAffineKeys;
  return {Option<K>(cells_key()).required(),
          Option<K>(size_key()).required(),
          Option<K>(number("hurst", &O::hurst, {0, 1, true, false, false}, "Hurst exponent H; D = 3 - H"))
              .required(),
          quantity("rms_height", &O::rms_height, dimension::length, above(0),
                   "root mean square height; or give rms_slope or ra"),
          number("rms_slope", &O::rms_slope, above(0),
                 "spectral root mean square slope; or give rms_height or ra"),
          quantity("ra", &O::ra, dimension::length, above(0),
                   "mean absolute height; or give rms_height or rms_slope"),
          Option<K>(quantity("long_wave", &O::long_wave, dimension::length, above(0), "longest wave"))
              .defaults_to("size"),
          Option<K>(quantity("roll_off", &O::roll_off, dimension::length, above(0),
                             "wave above which the spectrum is flat"))
              .defaults_to("long_wave"),
          Option<K>(quantity("short_wave", &O::short_wave, dimension::length, above(0),
                             "shortest wave, at least two cells"))
              .required(),
          integer("seed", &O::seed, at_least(0), "of the random waves"),
          material_key()};
}
inline void check_self_affine_keys(SelfAffineKeys& keys, Problems& problems) {
  const int given = (keys.rms_height ? 1 : 0) + (keys.rms_slope ? 1 : 0) + (keys.ra ? 1 : 0);
  if (given != 1)
    problems.push_back("give exactly one of `rms_height`, `rms_slope` and `ra`, which sets the amplitude; " +
                       std::to_string(given) + " are given");
  keys.grid = keys.make();
  if (problems.empty()) require_makeable(keys);
}

// `height` is only checked here; the caller reads the function.
inline std::vector<Option<GridKeys>> from_function_keys() {
  return {cells_key().required(), size_key().required(),
          custom<GridKeys>("height", "function", "function(x, y) returning the height, all in metres",
                           [](const Argument& value, const OptionInfo& info, GridKeys&, Problems& problems) {
                             if (!value.is_function())
                               detail::wrong_type(value, info, "a function(x, y)", problems);
                           })
              .required(),
          material_key()};
}

}  // namespace asperity::lua
