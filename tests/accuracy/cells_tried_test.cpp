// SPDX-License-Identifier: GPL-3.0-or-later
// Which cells are tried for an error of the corrected area, one after the other, and which of them a press is
// compared with: by the choice and by later presses of the contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/accuracy/accuracy_choice.hpp"
#include "engine/accuracy/companion_grids.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "tests/accuracy/asked_scenes.hpp"

namespace asperity::cells_tried_test {
namespace {

using test::asking;
using test::measured;
using test::rough;

// Whether `cells` are `given` ones doubled or halved.
bool of_doubling(int cells, int given) {
  while (cells < given) cells *= 2;
  while (cells > given && cells % 2 == 0) cells /= 2;
  return cells == given;
}

TEST(CellsTried, TheDoubtOfAnOutlineTellsWhichCellsToTryNext) {
  const PressRequest request{PressBy::pressure, 1e7, {}};
  int left_out = 0, half_way = 0;
  for (const double error : {0.1, 0.05, 0.03, 0.02, 0.01}) {
    const ChosenAccuracy chosen =
        *SpecimenPair(asking(rough(256), rigid_material(), Boundary::periodic, error))
             .press(request)
             .chosen();
    for (std::size_t k = 1; k < chosen.tried.size(); ++k) {
      const int before = chosen.tried[k - 1].nx, now = chosen.tried[k].nx;
      left_out += now > 2 * before ? 1 : 0;
      half_way += of_doubling(now, 256) ? 0 : 1;
      EXPECT_GE(now, before);
      EXPECT_LE(now, 16 * before);
    }
  }
  EXPECT_GT(left_out, 0);
  EXPECT_GT(half_way, 0);
}

// Heights between nodes that were measured would be smoothed, a second rough body would lie elsewhere, and of
// other quantities nothing is known but how far grids of twice the cells agree.
TEST(CellsTried, HalfWayCellsAreTriedOnlyWhereTheySayTheSame) {
  const PressRequest request{PressBy::pressure, 1e7, {}};
  for (const double error : {0.1, 0.05, 0.03, 0.02}) {
    for (const Scene& scene : {asking(measured(rough(512)).with_material(test::elastic_to_yield()),
                                      rigid_material(), Boundary::periodic, error),
                               asking(rough(512), rough(512, 2), Boundary::periodic, error),
                               asking(rough(512), rigid_material(), Boundary::periodic, error,
                                      {"corrected_area_fraction", "energy"})}) {
      const ChosenAccuracy chosen = *SpecimenPair(scene).press(request).chosen();
      for (const TriedGrid& tried : chosen.tried)
        if (tried.nx < 512) {
          EXPECT_TRUE(of_doubling(tried.nx, 512)) << chosen.text();
        }
    }
  }
}

// A step from an area by edges to one within an outline between the nodes tells nothing of either.
TEST(CellsTried, LaterPressesAreComparedWithOutlinesOfTheirKind) {
  const PressRequest request{PressBy::pressure, 1e7, {}};
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Surface surface = rough(256, seed);
    SpecimenPair pair(asking(surface, rigid_material(), Boundary::periodic, 0.05));
    pair.press(request);
    pair.release();
    const State again = pair.press(request);
    const int before = again.chosen()->before()->nx;
    const double coarser = SpecimenPair({at_cells(surface, before, before).surface, rigid_material(),
                                         Boundary::periodic, HalfSpaceOptions{}, Accuracy{}})
                               .press(request)
                               .with_outline(1e9)
                               .corrected_area_fraction();
    const double area = again.corrected_area_fraction();
    const double step = std::abs(area - coarser) / std::min(area, coarser),
                 doubt = 1.2 * again.outline()->doubt, error = again.chosen()->error;
    // Of half the cells seven tenths of the step or all of it; of others what the head of the source says.
    const double ratio = static_cast<double>(again.grid().nx) / before;
    const double in_part = std::max(doubt, 0.7 * std::sqrt(9 / (1 + ratio * ratio * ratio)) * step);
    const double in_full = std::max(doubt, std::max(1.0, 1 + 3.2 * (2 - ratio)) * step);
    EXPECT_LT(std::min(std::abs(error - in_part), std::abs(error - in_full)), 0.02 * error) << seed;
  }
}

// Compared with half the cells where the choice had compared with others, or with heights smoothed between
// the nodes where these cells miss the shortest waves, a press was refused that had been chosen for.
TEST(CellsTried, ThePressThatChoseMeetsItsErrorAgain) {
  int other_than_half = 0, sampled = 0, pressed = 0;
  const auto press_twice = [&](const Scene& scene, double pressure, double shortest_wave) {
    SpecimenPair pair(scene);
    const State first = pair.press({PressBy::pressure, pressure, {}});
    const ChosenAccuracy& chosen = *first.chosen();
    ASSERT_TRUE(chosen.before());
    const int before = chosen.before()->nx;
    pair.release();
    EXPECT_NE(pair.plan().text().find("the same press on " + std::to_string(before) + " x "),
              std::string::npos)
        << pair.plan().text();
    const State again = pair.press({PressBy::pressure, pressure, {}});
    const State compared = first.companion_grids()->levels().front().state,
                compared_again = again.companion_grids()->levels().front().state;
    EXPECT_EQ(compared_again.grid().nx, before);
    EXPECT_NEAR(compared_again.corrected_area_fraction(), compared.corrected_area_fraction(),
                chosen.tolerance * compared.corrected_area_fraction());
    EXPECT_NEAR(again.chosen()->error, chosen.error, 0.02 * chosen.error) << chosen.text();
    other_than_half += 2 * before != chosen.nx ? 1 : 0;
    sampled += chosen.nx % before != 0 && 2.0 / before > shortest_wave ? 1 : 0;
    ++pressed;
  };
  for (const auto& [boundary, pressure] :
       {std::pair{Boundary::periodic, 1e7}, std::pair{Boundary::free, 4e6}})
    for (const double error : {0.1, 0.05, 0.03, 0.02, 0.01})
      for (const std::uint64_t seed : {1, 2, 3})
        for (const double waves : {16.0, 20.0})
          press_twice(asking(rough(256, seed, waves), rigid_material(), boundary, error), pressure,
                      1 / waves);
  EXPECT_GT(other_than_half, 5);
  EXPECT_LT(other_than_half, pressed);
  EXPECT_GT(sampled, 0);
}

// Where the heights on the cells that were compared with are no nodes of what was measured and no generator
// makes them again, later presses are compared with half the cells.
TEST(CellsTried, CellsAreComparedWithWhereHeightsAreKnown) {
  const Surface made = rough(96);
  Scene scene{made, rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.compared = {make_grid(64, 64, 1, 1)};
  const auto compared = [&](const Surface& lower, UpperBody upper) {
    scene.lower = lower;
    scene.upper = std::move(upper);
    std::vector<int> cells;
    for (const Grid& grid : compared_grids(ContactGeometry(scene, LatticeIsometry(96, 96)), scene.accuracy))
      cells.push_back(grid.nx);
    return cells;
  };
  EXPECT_EQ(compared(made, rigid_material()), (std::vector{64, 32}));
  EXPECT_EQ(compared(measured(made), rigid_material()), (std::vector{48, 24}));
  EXPECT_EQ(compared(made, rough(96, 2)), (std::vector{48, 24}));
  scene.accuracy.compared = {make_grid(64, 64, 1, 1), make_grid(16, 16, 1, 1)};
  EXPECT_EQ(compared(made, rigid_material()), (std::vector{64, 16}));
  scene.accuracy.compared = {make_grid(32, 32, 1, 1)};
  EXPECT_EQ(compared(measured(made), rigid_material()), (std::vector{32, 16}));
  scene.accuracy.compared.clear();
  EXPECT_EQ(compared(made, rigid_material()), (std::vector{48, 24}));
}

}  // namespace
}  // namespace asperity::cells_tried_test
