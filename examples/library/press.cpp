// SPDX-License-Identifier: GPL-3.0-or-later
// The engine as a C++ library: how much of a rough face touches a flat at a thousandth of its stiffness?
//
//   cmake -S examples/library -B build/library && cmake --build build/library && build/library/press
//
// Its twin as a script is press.lua, with the same digest. Needs an installed Asperity: Debian's way,
// libasperity-dev, or `cmake --install` and CMAKE_PREFIX_PATH.
#include <cstdio>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"

int main() {
  using namespace asperity;
  const Material steel = named_material("steel");
  const Surface face = self_affine_surface(
      {.grid = make_grid(256, 256, 1e-3, 1e-3), .hurst = 0.8, .rms_slope = 0.1, .short_wave = 32e-6});
  SpecimenPair pair({.lower = face.with_material(steel),
                     .upper = rigid_material(),
                     .boundary = Boundary::periodic,
                     .elasticity = HalfSpaceOptions{}});
  const State state = pair.press({.by = PressBy::pressure, .value = 1e-3 * *steel.young});
  std::printf("%.2f %% of the tile touches, to %.0e\n%s\n", 100 * state.area_fraction(), state.residual(),
              state.digest().c_str());
}
