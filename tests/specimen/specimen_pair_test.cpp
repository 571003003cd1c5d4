// SPDX-License-Identifier: GPL-3.0-or-later
// The bench: presses, sweeps, placements, copies; failed calls change nothing.
#include "engine/specimen/specimen_pair.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/contact/contacts.hpp"
#include "tests/support/warnings.hpp"

namespace asperity::specimen_pair_test {
namespace {

using test::error_of;
using test::random_surface;
using test::row_of;
using test::scene_of;

constexpr double quarter = 0.5 * std::numbers::pi;

Scene rough_pair(Boundary boundary, int nx = 12, int ny = 12) {
  return scene_of(random_surface(nx, ny, 1), random_surface(nx, ny, 2), 3.0, boundary);
}

PressRequest pressure(double value) { return {PressBy::pressure, value, {}}; }

TEST(SpecimenPair, SortsOncePerPlacement) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  const auto before = pair.solver();
  pair.press(pressure(1));
  pair.press(pressure(2));
  EXPECT_EQ(pair.solver(), before);
  pair.place(1);
  EXPECT_NE(pair.solver(), before);
}

TEST(SpecimenPair, TheFirstPressCountsTheSort) {
  SpecimenPair pair(rough_pair(Boundary::free, 200, 200));
  const State first = pair.press(pressure(1)), second = pair.press(pressure(1));
  EXPECT_GT(first.cost().total.bytes, 200 * 200 * 8);
  EXPECT_EQ(second.cost().total.bytes, 0);
  EXPECT_EQ(first.cost().by_effect.size(), 1U);
  EXPECT_EQ(first.cost().by_effect[0].first, "elasticity");
  EXPECT_EQ(first.cost().by_effect[0].second.bytes, first.cost().total.bytes);
}

TEST(SpecimenPair, SweepsUpAndDownThroughTheSameStates) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  std::vector<std::string> up, down;
  for (const double p : {0.1, 0.5, 2.0}) up.push_back(pair.press(pressure(p)).digest());
  for (const double p : {2.0, 0.5, 0.1}) down.insert(down.begin(), pair.press(pressure(p)).digest());
  EXPECT_EQ(up, down);
}

TEST(SpecimenPair, LoadIsOnUntilReleased) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  EXPECT_FALSE(pair.under_load());
  pair.press(pressure(1));
  EXPECT_TRUE(pair.under_load());
  pair.release();
  EXPECT_FALSE(pair.under_load());
  pair.press(pressure(0));
  EXPECT_FALSE(pair.under_load());
}

TEST(SpecimenPair, BodiesComeBackElastically) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  const std::string lower = pair.lower().digest(), upper = pair.upper().digest();
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    pair.press(pressure(5));
    pair.release();
    pair.place(seed);
  }
  EXPECT_EQ(pair.lower().digest(), lower);
  EXPECT_EQ(pair.upper().digest(), upper);
}

TEST(SpecimenPair, PlacingIsAFunctionOfTheSeedAlone) {
  SpecimenPair pair(rough_pair(Boundary::periodic)), other(rough_pair(Boundary::periodic));
  pair.place(1);
  pair.place(2);
  other.place(2);
  EXPECT_EQ(pair.placement(), other.placement());
  EXPECT_EQ(pair.press(pressure(1)).digest(), other.press(pressure(1)).digest());
}

TEST(SpecimenPair, PlacementsGiveDifferentContacts) {
  SpecimenPair pair(rough_pair(Boundary::free));
  const double home = pair.press(pressure(1)).approach();
  pair.rotate(quarter);
  EXPECT_NE(pair.press(pressure(1)).approach(), home);
  pair.rotate(-quarter);
  EXPECT_EQ(pair.press(pressure(1)).approach(), home);
}

TEST(SpecimenPair, AWholeTurnInAnyNumberOfStepsIsTheIdentity) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  const LatticeIsometry home = pair.placement();
  for (int k = 0; k < 4; ++k) pair.rotate(quarter);
  EXPECT_EQ(pair.placement(), home);
  pair.rotate(4 * quarter);
  EXPECT_EQ(pair.placement(), home);
  pair.rotate(90 * std::numbers::pi / 180 + 5e-10);
  EXPECT_EQ(pair.placement(), home.turned(1));
}

TEST(SpecimenPair, TurnsOffTheLatticeAreRefused) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  EXPECT_EQ(error_of([&] { pair.rotate(37 * std::numbers::pi / 180); }),
            "a turn by 37 deg does not fit a periodic tile, which turns by multiples of 90 deg; "
            "place the body again with `place{seed=}`, or give boundary=\"free\"");
  EXPECT_NE(error_of([&] { pair.rotate(quarter + 2e-9); }), "");
  EXPECT_NE(error_of([&] { pair.rotate(std::numeric_limits<double>::quiet_NaN()); }), "");
  SpecimenPair oblong(rough_pair(Boundary::periodic, 12, 8));
  EXPECT_NE(error_of([&] { oblong.rotate(quarter); }).find("a tile that is not square"), std::string::npos);
  EXPECT_EQ(error_of([&] { oblong.rotate(2 * quarter); }), "");
}

TEST(SpecimenPair, ShiftsByWholeCellsOnAPeriodicBoundary) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  const LatticeIsometry home = pair.placement();
  pair.shift(3.0 / 12, -1.0 / 12);
  EXPECT_EQ(pair.placement(), home.shifted(3, -1));
  EXPECT_EQ(error_of([&] { pair.shift(0.5 / 12, 0); }).find("`shift` along x is 0.5 cells"), 0U);
  EXPECT_NE(error_of([&] { pair.shift(0, std::numeric_limits<double>::infinity()); }), "");
  EXPECT_EQ(pair.placement(), home.shifted(3, -1));
  SpecimenPair open(rough_pair(Boundary::free));
  EXPECT_NE(error_of([&] { open.shift(1.0 / 12, 0); }).find("free boundary"), std::string::npos);
}

TEST(SpecimenPair, ACopyGoesItsOwnWay) {
  SpecimenPair pair(rough_pair(Boundary::periodic));
  const State before = pair.press(pressure(1));
  SpecimenPair copy = pair;
  copy.place(3);
  copy.press(pressure(9));
  EXPECT_EQ(pair.press(pressure(1)).digest(), before.digest());
  EXPECT_NE(copy.placement(), pair.placement());
}

TEST(SpecimenPair, AFailedCallLeavesItAsItWas) {
  // A half turn would give a plane, without a default stiffness.
  const Surface ramp = row_of({0, 1, 2}).with_material(test::elastic(1));
  SpecimenPair pair(scene_of(ramp, row_of({2, 1, 0}).with_material(test::elastic(1)), {}, Boundary::free));
  const State before = pair.press(pressure(0.1));
  const std::string plan = pair.plan().text();
  EXPECT_NE(error_of([&] { pair.rotate(2 * quarter); }).find("all combined heights are equal"),
            std::string::npos);
  EXPECT_NE(error_of([&] { pair.press(pressure(-1)); }), "");
  EXPECT_NE(error_of([&] { pair.press(pressure(1e-300)); }), "");
  EXPECT_TRUE(pair.under_load());
  EXPECT_EQ(pair.plan().text(), plan);
  EXPECT_EQ(pair.press(pressure(0.1)).digest(), before.digest());
}

TEST(SpecimenPair, AFlatIsAPlaneOfZeros) {
  SpecimenPair pair(scene_of(random_surface(6, 5, 1), test::elastic(3), 1.0));
  EXPECT_EQ(pair.upper().peak_to_valley(), 0);
  EXPECT_EQ(pair.upper().grid(), pair.lower().grid());
  EXPECT_EQ(pair.upper().material()->young, 3);
  const std::string home = pair.press(pressure(1)).digest();
  pair.place(4);
  EXPECT_EQ(pair.press(pressure(1)).digest(), home);
}

TEST(SpecimenPair, AnElasticFlatIsDentedWhereItLies) {
  // The deformed flat turns with the placement.
  const Surface lower = random_surface(9, 9, 1).with_material(test::elastic(1));
  SpecimenPair pair(scene_of(lower, test::elastic(1)));
  pair.rotate(quarter);
  const State st = pair.press(pressure(0.05));
  const Surface flat = st.deformed("upper");
  const auto depth = st.field("displacement");
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) {
      const auto own = pair.placement().to_upper(LatticeIsometry::Node{i, j});
      EXPECT_EQ(flat.height(own.i, own.j), -0.5 * (*depth)(i, j));
    }
}

// Once per pair, and only with an overhang.
TEST(SpecimenPair, AnOverhangIsWarnedOf) {
  test::Warnings monitor;
  SpecimenPair pair(rough_pair(Boundary::free));
  const std::string home = pair.press(pressure(1), monitor).digest();
  pair.rotate(quarter);
  EXPECT_EQ(pair.press(pressure(1), monitor).overlap_fraction(), 1);
  EXPECT_TRUE(monitor.all.empty());
  pair.rotate(0.5 * quarter);
  const State turned = pair.press(pressure(1), monitor);
  EXPECT_LT(turned.overlap_fraction(), 1);
  ASSERT_EQ(monitor.all.size(), 1U);
  EXPECT_NE(monitor.all[0].find("the bodies face each other on"), std::string::npos);
  pair.press(pressure(2), monitor);
  EXPECT_EQ(monitor.all.size(), 1U);
  EXPECT_EQ(pair.plan().overlap, turned.overlap_fraction());
  pair.rotate(-1.5 * quarter);
  EXPECT_EQ(pair.press(pressure(1)).digest(), home);
  SpecimenPair flat(scene_of(random_surface(12, 12, 1), rigid_material(), 3.0, Boundary::free));
  flat.rotate(0.5 * quarter);
  EXPECT_EQ(flat.press(pressure(1)).overlap_fraction(), 1);
}

}  // namespace
}  // namespace asperity::specimen_pair_test
