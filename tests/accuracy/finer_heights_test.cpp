// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies on thrice the cells keep their pose for every turn and shift. Generated surfaces are sampled between
// the nodes, others interpolated.
#include "engine/accuracy/finer_heights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::finer_heights_test {
namespace {

using test::elastic;
using test::error_of;

Surface rough(int nx, int ny, std::uint64_t seed) {
  SelfAffineOptions o = test::self_affine(Grid{nx, ny, 1, 1}, 0.8, 1.0 / 8, seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  return self_affine_surface(o).with_material(elastic(1e9));
}

Surface measured(const Surface& surface) {
  return Surface(surface.grid(), surface.heights(), surface.traits());
}

// Combined heights over their span.
double off_at_shared_nodes(const Scene& scene, const Pose& pose) {
  const ContactGeometry geometry(scene, pose);
  const Field& given = geometry.combined();
  const Field fine = finer_heights(scene, geometry);
  double worst = 0;
  for (int j = 0; j < given.ny(); ++j)
    for (int i = 0; i < given.nx(); ++i) {
      const int step_x = fine.nx() / given.nx(), step_y = fine.ny() / given.ny();
      worst = std::max(worst, std::abs(given(i, j) - fine(step_x * i, step_y * j)));
    }
  return worst / geometry.peak_to_valley();
}

TEST(FinerGrid, HasThriceTheCellsOfEverySideOfMoreThanOne) {
  EXPECT_EQ(finer_grid(Grid{15, 8, 2, 1}), (Grid{45, 24, 2, 1}));
  EXPECT_EQ(finer_grid(Grid{21845, 1, 1, 1}), (Grid{65535, 1, 1, 1}));
  EXPECT_EQ(
      error_of([] {
        finer_grid(Grid{21846, 4, 1, 1});
      }),
      "`estimate` = \"finer\" is given for a tile of 21846 x 4 cells; it needs 3 times the cells a side, "
      "and a tile has at most 65536: estimate=true compares with coarser ones");
  EXPECT_EQ(error_of([] {
              finer_grid(Grid{1, 1, 1, 1});
            }),
            "`estimate` = \"finer\" is given for a tile of 1 x 1 cells; give at least 2 along x or y");
}

TEST(FinerHeights, GeneratedBodiesAreMadeAgain) {
  const Surface surface = rough(32, 32, 1);
  const Scene scene{surface, rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  const Field fine = finer_heights(scene, ContactGeometry(scene, LatticeIsometry(32, 32)));
  const Field again = at_cells(surface, 96, 96).surface.heights();
  EXPECT_TRUE(std::equal(fine.values().begin(), fine.values().end(), again.values().begin()));
}

TEST(FinerHeights, PeriodicBodiesLieAsTheyDid) {
  for (const int quarters : {0, 1, 2, 3})
    for (const bool known : {true, false}) {
      const Surface lower = rough(32, 32, 1), upper = rough(32, 32, 2);
      const Scene scene{known ? lower : measured(lower), known ? upper : measured(upper), Boundary::periodic,
                        HalfSpaceOptions{}, Accuracy{}};
      EXPECT_LT(off_at_shared_nodes(scene, LatticeIsometry(32, 32).turned(quarters).shifted(7, 30)), 1e-12)
          << quarters << known;
    }
  const Scene oblong{rough(32, 16, 1), rough(32, 16, 2), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  EXPECT_LT(off_at_shared_nodes(oblong, LatticeIsometry(32, 16).turned(2).shifted(3, 5)), 1e-12);
}

TEST(FinerHeights, FreeBodiesLieAsTheyDid) {
  const Scene scene{rough(32, 32, 1), rough(32, 32, 2), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  for (const int quarters : {0, 1, 2, 3})
    EXPECT_LT(off_at_shared_nodes(scene, LatticeIsometry(32, 32).turned(quarters)), 1e-12) << quarters;
}

TEST(FinerHeights, TurnedOffTheLatticeAboutTheSamePlace) {
  // Bilinear interpolation is exact for planes.
  Field plane(32, 32);
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) plane(i, j) = 0.01 * i + 0.003 * j;
  const Surface body(Grid{32, 32, 1, 1}, plane,
                     {.material = elastic(1e9), .periodic = false, .aliased_share = {}});
  const Surface level(Grid{32, 32, 1, 1}, Field(32, 32),
                      {.material = elastic(1e9), .periodic = false, .aliased_share = {}});
  const Scene scene{level, body, Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  const Pose pose = Pose(LatticeIsometry(32, 32)).turned(0.3, scene.lower.grid());
  const ContactGeometry geometry(scene, pose);
  const Field fine = finer_heights(scene, geometry);
  int covered = 0;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) {
      const double given = geometry.combined()(i, j);
      // Uncovered nodes have no height.
      ASSERT_EQ(std::isnan(fine(3 * i, 3 * j)), std::isnan(given)) << i << " " << j;
      if (std::isnan(given)) continue;
      ++covered;
      EXPECT_NEAR(fine(3 * i, 3 * j), given, 1e-12) << i << " " << j;
    }
  EXPECT_GT(covered, 700);
}

}  // namespace
}  // namespace asperity::finer_heights_test
