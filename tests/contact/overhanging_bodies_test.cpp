// SPDX-License-Identifier: GPL-3.0-or-later
// Outside the overlap of turned bodies there is no pressure and no gap.
#include <cmath>
#include <numbers>
#include <string>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/plan.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::overhanging_bodies_test {
namespace {

using test::error_of;
using test::surface_of;

constexpr double degree = std::numbers::pi / 180;
constexpr double never = std::numeric_limits<double>::infinity();

Material metal(double hardness) {
  Material material = test::elastic(70e9, 0.33);
  material.hardness = hardness;
  return material;
}

// Contacts away from the middle, too.
Surface dome(const Grid& grid, std::uint64_t seed, double rms = 2e-7) {
  SelfAffineOptions options = test::self_affine(grid, 0.8, 6 * std::max(grid.hx(), grid.hy()), seed);
  options.rms_height = rms;
  const Field waves = self_affine_surface(options).heights();
  return surface_of(grid,
                    [&](int i, int j) {
                      const double x = (i - 0.5 * (grid.nx - 1)) * grid.hx(),
                                   y = (j - 0.5 * (grid.ny - 1)) * grid.hy();
                      return waves(i, j) - (x * x + y * y) / 20;
                    })
      .with_material(metal(1e9));
}

Scene two_domes(const Grid& grid, const Elasticity& elasticity, double tolerance = 1e-9) {
  Scene scene{dome(grid, 1), dome(grid, 2), Boundary::free, elasticity, Accuracy{}};
  scene.accuracy.tolerance = tolerance;
  return scene;
}

struct Turned {
  std::shared_ptr<const ContactGeometry> geometry;
  Plan plan;
  std::shared_ptr<const Solver> solver;
  Turned(const Scene& scene, double angle)
      : geometry(std::make_shared<const ContactGeometry>(
            scene, Pose(LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny))
                       .turned(angle, scene.lower.grid()))),
        plan(make_plan(scene, *geometry)),
        solver(make_solver(plan, geometry)) {}
  State press(PressBy by, double value) const { return solver->press({by, value, {}}); }
};

void expect_nothing_off_the_overlap(const State& state, const std::string& what) {
  SCOPED_TRACE(what);
  const Field& h = state.geometry().combined();
  const auto pressure = state.field("pressure"), gap = state.field("gap"), contact = state.field("contact");
  std::int64_t facing = 0, touching = 0;
  double gaps = 0;
  for (std::size_t k = 0; k < h.size(); ++k) {
    if (std::isnan(h[k])) {
      ASSERT_EQ((*pressure)[k], 0);
      ASSERT_EQ((*contact)[k], 0);
      ASSERT_TRUE(std::isnan((*gap)[k]));
      continue;
    }
    ++facing;
    touching += (*pressure)[k] > 0;
    ASSERT_TRUE(std::isfinite((*gap)[k]) && (*gap)[k] >= 0);
    gaps += (*gap)[k];
  }
  const auto nodes = static_cast<double>(h.size());
  EXPECT_LT(state.overlap_fraction(), 1);
  EXPECT_EQ(state.overlap_fraction(), static_cast<double>(facing) / nodes);
  EXPECT_EQ(state.geometry().facing(), facing);
  EXPECT_EQ(state.contacts(), touching);
  EXPECT_LE(state.area_fraction(), state.overlap_fraction());
  EXPECT_NEAR(block_sum(pressure->values()) * state.grid().cell_area(), state.load(), 1e-9 * state.load());
  EXPECT_NEAR(state.pressure() * state.grid().area(), state.load(), 1e-12 * state.load());
  EXPECT_TRUE(state.converged()) << state.residual();
  EXPECT_NEAR(state.mean_gap(), gaps / static_cast<double>(facing),
              std::max(1e-9, 2 * state.residual()) * state.geometry().peak_to_valley());
  const double yielded = state.plastic_volume() / (static_cast<double>(facing) * state.grid().cell_area());
  EXPECT_NEAR(state.separation(),
              state.geometry().combined_range().max - known_mean(h.values()) - state.approach() + yielded,
              1e-18);
  for (const double number : {state.energy(), state.stiffness(), state.secant_stiffness(), state.flatten(),
                              state.indentation(), state.corrected_area_fraction()})
    EXPECT_TRUE(std::isfinite(number));
  for (const char* body : {"lower", "upper"}) EXPECT_NO_THROW(state.deformed(body));
  EXPECT_EQ(state.distribution("gap").values + touching,
            facing - std::count(gap->values().begin(), gap->values().end(), 0.0) + touching);
}

TEST(OverhangingBodies, NothingPressesWhereNothingFacesInAnyControl) {
  const Grid square{40, 40, 1e-3, 1e-3}, oblong{24, 40, 0.6e-3, 1e-3}, cells{20, 40, 1e-3, 1e-3};
  const PlasticityOptions capped{}, hardening{{}, 5e13};
  for (const Grid& grid : {square, oblong, cells})
    for (const double angle : {20.0, 45.0, 90.0, -133.0})
      for (int model = 0; model < 5; ++model) {
        Scene scene = two_domes(grid, BoxOptions{});
        if (model >= 3) scene.elasticity = HalfSpaceOptions{};
        if (model == 1) scene.effects.set(capped);
        if (model == 2 || model == 4) scene.effects.set(hardening);
        if (grid.nx == grid.ny && angle == 90) continue;  // lattice turn: full cover
        const Turned turned(scene, angle * degree);
        const std::string what = std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " at " +
                                 std::to_string(angle) + ", model " + std::to_string(model);
        expect_nothing_off_the_overlap(turned.press(PressBy::pressure, 2e7), what + ", pressure");
        expect_nothing_off_the_overlap(turned.press(PressBy::load, 1), what + ", load");
        expect_nothing_off_the_overlap(turned.press(PressBy::approach, 1e-6), what + ", approach");
        expect_nothing_off_the_overlap(turned.press(PressBy::indentation, 0.1), what + ", indentation");
        expect_nothing_off_the_overlap(turned.press(PressBy::flatten, 0.05), what + ", flatten");
      }
}

// 96 kN/mm² on bodies of 77 GPa: the whole overlap touches.
TEST(OverhangingBodies, NoLoadIsGreatEnoughToReachGroundThatNothingFaces) {
  const Grid grid{32, 32, 1e-3, 1e-3};
  for (const double pressure : {1e9, 1e11, 1e15}) {
    const State state =
        Turned(two_domes(grid, HalfSpaceOptions{}, 1e-7), 45 * degree).press(PressBy::pressure, pressure);
    // An octagon of the square between the nodes, 31 of 32 cells a side.
    EXPECT_NEAR(state.overlap_fraction(), 2 * (std::sqrt(2.0) - 1) * std::pow(31.0 / 32, 2), 0.02);
    EXPECT_LE(state.contacts(), state.geometry().facing());
    EXPECT_NEAR(block_sum(state.field("pressure")->values()) / 1024, pressure, 1e-7 * pressure);
    if (pressure > 1e9) {
      EXPECT_EQ(state.contacts(), state.geometry().facing());
    }
  }
  const Surface flat = surface_of(grid, [](int, int) { return 0.0; }).with_material(metal(1e9));
  Scene scene{flat, flat, Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  for (const double pressure : {1.0, 1e9}) {
    const State state = Turned(scene, 30 * degree).press(PressBy::pressure, pressure);
    EXPECT_EQ(state.contacts(), state.geometry().facing());
    EXPECT_TRUE(state.converged());
  }
}

// Crossed bars of 1 mm by 4 mm overlap on 1 mm².
class CrossedBars : public ::testing::TestWithParam<int> {};

TEST_P(CrossedBars, CarryAsTheirCommonSquareDoes) {
  const Grid bar{16, 64, 1e-3, 4e-3}, square{16, 16, 1e-3, 1e-3};
  const Surface lower = dome(bar, 3), upper = dome(bar, 4);
  const auto middle = [&](const Surface& body) {
    return surface_of(square, [&](int i, int j) { return body.height(i, j + 24); })
        .with_material(*body.material());
  };
  Scene scene{lower, upper, Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.tolerance = 1e-12;
  if (GetParam() < 2) scene.elasticity = BoxOptions{1e14};
  if (GetParam() % 2 == 1) scene.effects.set(PlasticityOptions{{}, GetParam() == 1 ? never : 5e13});
  Scene cropped = scene;
  cropped.lower = middle(lower);
  cropped.upper = middle(upper);
  for (const double angle : {90.0, -90.0, 270.0}) {
    const Turned bars(scene, angle * degree), squares(cropped, angle * degree);
    EXPECT_EQ(bars.geometry->facing(), 256);
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        ASSERT_EQ(bars.geometry->combined()(i, j + 24), squares.geometry->combined()(i, j));
    for (const PressBy by : {PressBy::load, PressBy::approach, PressBy::indentation, PressBy::flatten}) {
      const double value = by == PressBy::load ? 80 : by == PressBy::approach ? 1e-6 : 0.2;
      const State all = bars.press(by, value), part = squares.press(by, value);
      EXPECT_EQ(all.contacts(), part.contacts());
      EXPECT_NEAR(all.load(), part.load(), 1e-9 * part.load());
      EXPECT_NEAR(all.approach(), part.approach(), 1e-9 * part.approach());
      EXPECT_NEAR(all.mean_gap(), part.mean_gap(), 1e-9 * part.approach());
      EXPECT_NEAR(all.separation(), part.separation(), 1e-9 * part.approach());
      EXPECT_NEAR(all.energy(), part.energy(), 1e-8 * part.energy());
      EXPECT_NEAR(all.area(), part.area(), 1e-9 * part.area());
      EXPECT_NEAR(all.pressure(), part.pressure() / 4, 1e-9 * part.pressure());
      EXPECT_NEAR(all.stiffness(), part.stiffness() / 4, 1e-7 * part.stiffness());
      if (scene.effects.find<PlasticityOptions>()) {
        EXPECT_NEAR(all.plastic_volume(), part.plastic_volume(), 1e-8 * part.plastic_volume() + 1e-30);
      }
      const auto p = all.field("pressure"), q = part.field("pressure");
      const double tolerance = GetParam() < 2 ? 1e-12 : 1e-7;
      for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i)
          ASSERT_NEAR((*p)(i, j + 24), (*q)(i, j), tolerance * part.peak_pressure()) << i << " " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, CrossedBars, ::testing::Range(0, 4));

// The error names the overlap's share.
TEST(OverhangingBodies, TheHardnessIsThatOfTheOverlap) {
  const Grid bar{8, 32, 1e-3, 4e-3};
  Scene scene{dome(bar, 3), dome(bar, 4), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  scene.effects.set(PlasticityOptions{});
  for (const bool boxes : {false, true}) {
    if (boxes) scene.elasticity = BoxOptions{};
    const Turned turned(scene, 90 * degree);
    EXPECT_NO_THROW(turned.press(PressBy::pressure, 0.2e9));
    const std::string error = error_of([&] { turned.press(PressBy::pressure, 0.25e9); });
    EXPECT_NE(error.find("cannot be carried"), std::string::npos) << error;
    EXPECT_NE(error.find("25 % of the tile"), std::string::npos) << error;
  }
}

TEST(OverhangingBodies, WhatYieldsIsTakenWhereTheBodiesFaceEachOther) {
  const Grid grid{32, 32, 1e-3, 1e-3};
  for (const bool half_space : {false, true})
    for (const double hardening : {never, 5e13}) {
      Scene scene = two_domes(grid, BoxOptions{});
      if (half_space) scene.elasticity = HalfSpaceOptions{};
      scene.effects.set(PlasticityOptions{4e8, hardening});
      const Turned turned(scene, 40 * degree);
      const State state = turned.press(PressBy::pressure, 1e8);
      const auto plastic = state.field("plastic");
      for (std::size_t k = 0; k < plastic->size(); ++k)
        if (std::isnan(state.geometry().combined()[k])) {
          ASSERT_EQ((*plastic)[k], 0);
        }
      const auto change = state.plastic_change();
      ASSERT_TRUE(change.has_value());
      EXPECT_NEAR(block_sum(change->approach.values()) * grid.cell_area(), state.plastic_volume(),
                  1e-12 * state.plastic_volume());
      const YieldedBodies after = yielded_bodies(*turned.geometry, *turned.plan.yield, *change);
      scene.lower = after.lower;
      scene.upper = after.upper;
      auto geometry = std::make_shared<const ContactGeometry>(
          scene, *turned.geometry, BodyMemory{{std::string(hardness_memory), after.hardness}},
          change->approach);
      EXPECT_EQ(geometry->facing(), turned.geometry->facing());
      EXPECT_TRUE(std::isfinite(geometry->peak_to_valley()));
      Plan plan = make_plan_like(turned.plan, scene, *geometry);
      const State again = make_solver(plan, geometry)->press({PressBy::pressure, 1e8, {}});
      expect_nothing_off_the_overlap(again, "again");
      EXPECT_LT(again.plastic_volume(), 1e-5 * state.plastic_volume());
    }
}

TEST(OverhangingBodies, CertificatesAreOfTheOverlap) {
  const Grid grid{48, 48, 1e-3, 1e-3};
  for (const PressBy by : {PressBy::pressure, PressBy::approach}) {
    const double value = by == PressBy::pressure ? 3e7 : 2e-6;
    const State loose = Turned(two_domes(grid, HalfSpaceOptions{}, 1e-3), 33 * degree).press(by, value);
    const State tight = Turned(two_domes(grid, HalfSpaceOptions{}, 1e-11), 33 * degree).press(by, value);
    const AlgebraicError& error = loose.algebraic_error();
    EXPECT_LE(std::abs(loose.approach() - tight.approach()), error.approach + 1e-18);
    EXPECT_LE(std::abs(loose.mean_gap() - tight.mean_gap()), error.mean_gap);
    EXPECT_LE(std::abs(loose.energy() - tight.energy()), error.energy);
    EXPECT_LE(std::abs(loose.peak_pressure() - tight.peak_pressure()), error.peak_pressure);
    EXPECT_LE(error.mean_gap, 0.1 * loose.mean_gap());
    EXPECT_GE(tight.contacts(), error.contact_bracket.low);
    EXPECT_LE(tight.contacts(), error.contact_bracket.high);
    EXPECT_LE(error.contact_bracket.high, loose.geometry().facing());
  }
}

TEST(OverhangingBodies, GroundThatNothingFacesSinksWithTheRest) {
  const Grid grid{24, 24, 1e-3, 1e-3};
  const Turned turned(two_domes(grid, HalfSpaceOptions{}, 1e-10), 45 * degree);
  const State state = turned.press(PressBy::pressure, 5e7);
  const auto u = state.field("displacement"), p = state.field("pressure");
  const double modulus = turned.plan.elasticity->modulus, cell = grid.hx();
  // Far from pressed nodes: point loads, u = p h²/(π E* r).
  double by_points = 0;
  for (int j = 0; j < 24; ++j)
    for (int i = 0; i < 24; ++i)
      if ((*p)(i, j) > 0)
        by_points += (*p)(i, j) * cell * cell / (std::numbers::pi * modulus * cell * std::hypot(i, j));
  EXPECT_TRUE(std::isnan(turned.geometry->combined()(0, 0)));
  EXPECT_NEAR((*u)(0, 0), by_points, 2e-3 * by_points);
  EXPECT_NEAR(state.deformed("lower").height(0, 0), dome(grid, 1).height(0, 0) - 0.5 * by_points,
              2e-3 * by_points);
}

TEST(OverhangingBodies, AnAttractionPullsOnlyWhereTheBodiesFaceEachOther) {
  const Grid bar{12, 24, 1e-3, 2e-3}, square{12, 12, 1e-3, 1e-3};
  const auto dome_of = [](const Grid& grid) {
    return surface_of(grid,
                      [&](int i, int j) {
                        const double x = (i - 0.5 * (grid.nx - 1)) * grid.hx(),
                                     y = (j - 0.5 * (grid.ny - 1)) * grid.hy();
                        return -(x * x + y * y) / 20;
                      })
        .with_material(test::elastic(1e6, 0.3));
  };
  for (const GapLaw law : {GapLaw::exponential, GapLaw::dugdale}) {
    Scene scene{dome_of(bar), dome_of(bar), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
    scene.accuracy.tolerance = 1e-8;
    scene.effects.set(AdhesionOptions{0.05, 2e-5, law});
    Scene cropped = scene;
    cropped.lower = dome_of(square);
    cropped.upper = dome_of(square);
    const Turned bars(scene, 90 * degree), squares(cropped, 90 * degree);
    for (const PressBy by : {PressBy::load, PressBy::approach}) {
      const double value = by == PressBy::load ? 1e-5 : -1e-6;
      const State all = bars.press(by, value), part = squares.press(by, value);
      EXPECT_NEAR(all.approach(), part.approach(), 1e-5 * std::abs(part.approach()));
      EXPECT_NEAR(all.attraction(), part.attraction(), 1e-5 * part.attraction());
      EXPECT_NEAR(all.load(), part.load(), 1e-5 * part.attraction());
      EXPECT_NEAR(all.mean_gap(), 0, 1e-9 * all.geometry().peak_to_valley());
      EXPECT_NEAR(part.mean_gap(), 0, 1e-9 * part.geometry().peak_to_valley());
      EXPECT_NEAR(all.energy(), part.energy(), 1e-4 * part.energy());
      EXPECT_EQ(all.contacts(), part.contacts());
      const auto pressure = all.field("pressure");
      for (std::size_t k = 0; k < pressure->size(); ++k)
        if (std::isnan(bars.geometry->combined()[k])) {
          ASSERT_EQ((*pressure)[k], 0);
        }
    }
  }
}

TEST(OverhangingBodies, EstimatesGoOverTheOverlap) {
  const Grid grid{32, 32, 1e-3, 1e-3};
  for (const bool half_space : {false, true}) {
    Scene scene = two_domes(grid, BoxOptions{}, 1e-7);
    if (half_space) scene.elasticity = HalfSpaceOptions{};
    scene.accuracy.estimate = Accuracy::Estimate::coarser;
    const Turned turned(scene, 45 * degree);
    const PressRequest request{PressBy::pressure, 2e7, {}};
    const State state = turned.solver->press(request);
    for (const auto& other :
         {solve_coarser(scene, *turned.geometry, turned.plan, request, Monitor::silent()),
          solve_finer(scene, *turned.geometry, turned.plan, request, Monitor::silent())}) {
      for (const CompanionGrids::Level& level : other->levels()) {
        expect_nothing_off_the_overlap(level.state, std::to_string(level.state.grid().nx));
        EXPECT_NEAR(level.state.overlap_fraction(), state.overlap_fraction(), 0.12);
      }
      const State beside = state.beside(other);
      for (const char* name : {"mean_gap", "separation", "approach", "area_fraction"}) {
        const DiscretisationEstimate estimate = discretisation_estimate(beside, name);
        EXPECT_TRUE(std::isfinite(estimate.error)) << name;
      }
    }
  }
}

TEST(OverhangingBodies, ThePlanSaysOnWhichShareTheyFaceEachOther) {
  const Grid bar{16, 64, 1e-3, 4e-3};
  Scene scene{dome(bar, 3), dome(bar, 4), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  EXPECT_EQ(Turned(scene, 0).plan.text().find("overlap"), std::string::npos);
  const Plan plan = Turned(scene, 90 * degree).plan;
  EXPECT_EQ(plan.overlap, 0.25);
  EXPECT_NE(plan.text().find("the bodies face each other on 25 % of the tile"), std::string::npos);
}

TEST(OverhangingBodies, BodiesThatDoNotMeetAreRefused) {
  const Grid line{1, 64, 1e-6, 1e-3};
  const Surface body = surface_of(line, [](int, int j) { return j * 1e-9; }).with_material(metal(1e9));
  // 64 nodes in a line across another.
  Scene scene{body, body, Boundary::free, BoxOptions{1e12}, Accuracy{}};
  EXPECT_NE(error_of([&] { Turned(scene, 90 * degree); }).find("no node of one body faces the other"),
            std::string::npos);
}

TEST(OverhangingBodies, OneNodeThatFacesCarriesAll) {
  const Grid line{1, 65, 1e-6, 1e-3};
  const Surface body =
      surface_of(line, [](int, int j) { return 1e-9 * ((7 * j) % 5); }).with_material(metal(1e9));
  for (const bool half_space : {false, true}) {
    Scene scene{body, body, Boundary::free, BoxOptions{1e12}, Accuracy{}};
    if (half_space) scene.elasticity = HalfSpaceOptions{};
    const State state = Turned(scene, 90 * degree).press(PressBy::pressure, 1e6);
    EXPECT_EQ(state.geometry().facing(), 1);
    EXPECT_EQ(state.contacts(), 1);
    EXPECT_NEAR((*state.field("pressure"))(0, 32), 65e6, 65e-3);
  }
}

}  // namespace
}  // namespace asperity::overhanging_bodies_test
