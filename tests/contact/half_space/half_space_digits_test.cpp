// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy to the last digits on flats, at the lightest loads and close to the hardness, where hardly a node
// fixes the offset. Tolerances name the measured error.
#include <gtest/gtest.h>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::half_space_digits_test {
namespace {

using namespace half_space_test;

// --- flats

struct Shape {
  int nx, ny;
};
Grid oblong(const Shape& shape) { return make_grid(shape.nx, shape.ny, 1, .5); }

std::string label(const Shape& shape, double height, double pressure) {
  return std::to_string(shape.nx) + " x " + std::to_string(shape.ny) + " at " + std::to_string(height) +
         " m under " + std::to_string(pressure);
}

const Shape flat_cells[] = {{7, 7}, {11, 11}, {31, 31}, {32, 32}, {1, 9}, {9, 1}, {13, 17}, {1, 1}};
// For some levels the mean differs from the height by rounding.
const double levels[] = {0, 1e-6, .1, -3};

TEST(FlatCell, CarriesTheMeanPressureAtEveryNode) {
  for (const Shape& shape : flat_cells)
    for (const double level : levels)
      for (const double pressure : {1e-30, 1e-6, .5, 40.0})
        for (const double over : {infinity, 2.0, 1 + 1e-9}) {
          HalfSpaceProblem problem =
              problem_of(oblong(shape), Field(shape.nx, shape.ny, level), Boundary::periodic, 1, 1e-12);
          problem.yield.cap = over * pressure;
          const HalfSpaceAnswer answer = solve(problem, pressure);
          const std::string which = label(shape, level, pressure);
          for (std::size_t k = 0; k < answer.pressure.size(); ++k) {
            ASSERT_EQ(answer.pressure[k], pressure) << which;
            ASSERT_EQ(answer.gap[k], 0) << which;
          }
          EXPECT_EQ(answer.approach, 0) << which;
          EXPECT_EQ(answer.offset, -level) << which;
          EXPECT_EQ(answer.iterations, 0) << which;
          EXPECT_EQ(answer.yielded, 0) << which;
          EXPECT_LE(answer.certificate.worst(), 1e-14) << which;  // of the sum; measured 3e-15
          EXPECT_TRUE(answer.converged) << which;
        }
}

TEST(FlatCell, GivesWayEvenlyPastItsYieldPressure) {
  for (const Shape& shape : flat_cells)
    for (const double level : levels) {
      HalfSpaceProblem problem =
          problem_of(oblong(shape), Field(shape.nx, shape.ny, level), Boundary::periodic, 1, 1e-9);
      problem.yield.cap = .2;
      problem.yield.hardening = 3;
      const HalfSpaceAnswer answer = solve(problem, .5);
      const std::string which = label(shape, level, .5);
      for (const double p : answer.pressure.values()) ASSERT_DOUBLE_EQ(p, .5) << which;
      EXPECT_NEAR(answer.approach, .1, 2e-15) << which;  // (.5 − .2)/3; measured 2e-16
      EXPECT_EQ(answer.yielded, shape.nx * shape.ny) << which;
      EXPECT_TRUE(answer.converged) << which;
    }
}

Field nearly_level(const Shape& shape, double level) {
  const Stream stream(1, "rounding");
  Field h(shape.nx, shape.ny, level);
  for (std::size_t k = 0; k < h.size(); ++k)
    h[k] *= 1 + (std::floor(5 * stream.uniform(k)) - 2) * std::numeric_limits<double>::epsilon();
  return h;
}

bool all_finite(const HalfSpaceAnswer& answer) {
  double sum = answer.approach + answer.offset + answer.peak_pressure + answer.certificate.worst();
  for (std::size_t k = 0; k < answer.gap.size(); ++k) sum += answer.pressure[k] + answer.gap[k];
  return std::isfinite(sum);
}

TEST(FlatCell, HeightsThatDifferByRoundingAreAFlat) {
  for (const Shape& shape : flat_cells)
    for (const double pressure : {1e-3, .5, 40.0})
      for (const double over : {infinity, 2.0, 1.01}) {
        HalfSpaceProblem problem =
            problem_of(oblong(shape), nearly_level(shape, .1), Boundary::periodic, 1, 1e-9);
        problem.yield.cap = over * pressure;
        const HalfSpaceAnswer answer = solve(problem, pressure);
        const std::string which = label(shape, .1, pressure);
        EXPECT_TRUE(answer.converged && all_finite(answer)) << which;
        // π/8 of 6e-17 m over a cell of at most 1/64 m; measured 7e-15.
        for (const double p : answer.pressure.values()) ASSERT_NEAR(p, pressure, 7e-14) << which;
      }
}

const Shape free_tiles[] = {{17, 13}, {1, 16}, {16, 1}, {7, 7}, {31, 2}, {61, 67}};

class FreeFlat : public testing::TestWithParam<bool> {
 protected:
  static Field heights(const Shape& shape) {
    return GetParam() ? nearly_level(shape, .1) : Field(shape.nx, shape.ny, .1);
  }
};
TEST_P(FreeFlat, MeetsItsCertificateWithoutLimit) {
  for (const Shape& shape : free_tiles)
    for (const double pressure : {1e-3, .5, 40.0})
      for (const double tolerance : {1e-6, 1e-10}) {
        const HalfSpaceProblem problem =
            problem_of(oblong(shape), heights(shape), Boundary::free, 1, tolerance);
        const HalfSpaceAnswer answer = solve(problem, pressure);
        const std::string which = label(shape, .1, pressure);
        EXPECT_TRUE(answer.converged && all_finite(answer)) << which;
        EXPECT_LE(answer.certificate.worst(), tolerance) << which;
        EXPECT_EQ(answer.contacts, shape.nx * shape.ny) << which;
        EXPECT_GT(answer.approach, 0) << which;
        // Gaps relative to the displacement of the tile as a punch.
        if (answer.pressure.size() < 1000) {
          HalfSpaceProblem measured = problem;
          measured.rms = pressure * std::sqrt(problem.grid.area());
          EXPECT_LT(dense_violation(measured, answer), 5 * tolerance) << which;  // measured 0.9 of this bound
        }
      }
}
TEST_P(FreeFlat, MeetsItsCertificateUnderACapAndUnderHardening) {
  for (const Shape& shape : free_tiles)
    for (const double pressure : {1e-3, .5, 40.0})
      for (const double over : {1.01, 2.0, .5}) {
        HalfSpaceProblem problem = problem_of(oblong(shape), heights(shape), Boundary::free, 1, 1e-8);
        problem.yield.cap = over * pressure;
        if (over < 1) problem.yield.hardening = 3;
        const HalfSpaceAnswer answer = solve(problem, pressure);
        const std::string which = label(shape, .1, pressure) + " over " + std::to_string(over);
        EXPECT_TRUE(answer.converged && all_finite(answer)) << which;
        EXPECT_LE(answer.certificate.worst(), 1e-8) << which;
        EXPECT_EQ(answer.contacts, shape.nx * shape.ny) << which;
      }
}
INSTANTIATE_TEST_SUITE_P(Heights, FreeFlat, testing::Values(false, true),
                         [](const auto& noise) { return noise.param ? "Nearly" : "Exactly"; });

// --- light loads

Scene light_scene(Boundary boundary, const std::optional<PlasticityOptions>& plasticity = {}) {
  SelfAffineOptions options = test::self_affine(make_grid(32, 32, 10e-6, 10e-6), 0.8, 1e-6, 1);
  options.rms_height = 50e-9;
  Material metal = test::elastic(70e9, 0.33);
  metal.hardness = 1.1e9;
  Scene scene{self_affine_surface(options).with_material(metal), rigid_material(), boundary,
              HalfSpaceOptions{}, Accuracy{}};
  if (plasticity) scene.effects.set(*plasticity);
  return scene;
}

// Displacement per newton at a single node: K for a single cell.
double sinking_of_one_node(const Scene& scene) {
  const Grid& grid = scene.lower.grid();
  HalfSpaceProblem problem =
      problem_of(grid, Field(grid.nx, grid.ny), scene.boundary, 70e9 / (1 - .33 * .33));
  Field p(grid.nx, grid.ny);
  p(0, 0) = 1 / grid.cell_area();
  return dense_displacement(problem, p)[0];
}

class LightLoad : public testing::TestWithParam<Boundary> {
 protected:
  static std::vector<Scene> scenes() {
    return {light_scene(GetParam()), light_scene(GetParam(), PlasticityOptions{}),
            light_scene(GetParam(), PlasticityOptions{{}, 8e13})};
  }
};
const double lightest[] = {1e-21, 1e-20, 1e-18, 1e-15, 1e-13, 1e-12};

TEST_P(LightLoad, OneNodeSinksInProportion) {
  for (const Scene& scene : scenes()) {
    const double per_newton = sinking_of_one_node(scene);
    const double flattened_per_newton = test::press(scene, PressBy::load, 1e-15).flatten() / 1e-15;
    for (const double load : lightest) {
      const State state = test::press(scene, PressBy::load, load);
      EXPECT_TRUE(state.converged()) << load;
      EXPECT_EQ(state.contacts(), 1) << load;
      EXPECT_NEAR(state.approach() / load / per_newton, 1, 3e-14) << load;              // measured 4e-15
      EXPECT_NEAR(state.energy() / (.5 * load * load * per_newton), 1, 3e-14) << load;  // measured 4e-15
      EXPECT_NEAR(state.flatten() / load / flattened_per_newton, 1, 3e-15) << load;     // measured 3e-16
      if (scene.effects.find<PlasticityOptions>()) {
        EXPECT_EQ(state.plastic_volume(), 0) << load;
      }
    }
  }
}
TEST_P(LightLoad, IsFoundAgainByApproachAndByFlattening) {
  for (const Scene& scene : scenes())
    for (const double load : lightest) {
      const State state = test::press(scene, PressBy::load, load);
      // One node in contact: all proportional; measured 7e-16.
      EXPECT_NEAR(test::press(scene, PressBy::approach, state.approach()).load() / load, 1, 4e-15) << load;
      EXPECT_NEAR(test::press(scene, PressBy::indentation, state.indentation()).load() / load, 1, 4e-15)
          << load;
      EXPECT_NEAR(test::press(scene, PressBy::flatten, state.flatten()).load() / load, 1, 4e-15) << load;
    }
}
INSTANTIATE_TEST_SUITE_P(Boundaries, LightLoad, testing::Values(Boundary::periodic, Boundary::free),
                         [](const auto& boundary) { return std::string(name(boundary.param)); });

// Products of pressures and displacements underflow.
TEST(LeastLoad, ApproachKeepsItsDigitsDownToTheLeastLoad) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    Field h(16, 16);
    h(8, 8) = 1e-3;
    const HalfSpaceProblem problem = problem_of(make_grid(16, 16, 1, 1), h, boundary);
    const double usual = solve(problem, 1e-9).approach / 1e-9;
    for (const double pressure : {1e-30, 1e-100, 1e-200, 1e-279})
      EXPECT_NEAR(solve(problem, pressure).approach / pressure / usual, 1, 1e-10)
          << pressure;  // measured 1e-11
  }
}

// --- close to the hardness

class CloseToHardness : public testing::TestWithParam<Boundary> {};

TEST_P(CloseToHardness, NoNodeIsLeftWithinRoundingOfABound) {
  HalfSpaceProblem problem = rough_problem(32, GetParam(), 3, 1e-9);
  // At a small cap, n nodes carry the share n/1024 exactly.
  for (const double cap : {.05, 7e-6})
    for (const double part :
         {101 / 1024.0, .5, 777 / 1024.0, .9, .99, 1 - 1e-4, 1 - 1e-6, 1 - 1e-9, 1 - 1e-12}) {
      problem.yield.cap = cap;
      const HalfSpaceAnswer answer = solve(problem, part * cap);
      EXPECT_TRUE(answer.converged) << part;
      for (const double p : answer.pressure.values())
        EXPECT_TRUE(p == 0 || p == cap || (p > 1e-13 * cap && p < cap * (1 - 1e-13)))
            << p / cap << " at " << part;
    }
}

// The last nodes to yield fix the approach; closest to the hardness a single node follows its own compliance.
TEST_P(CloseToHardness, TheApproachRisesSteadilyToItsEnd) {
  HalfSpaceProblem problem = rough_problem(32, GetParam(), 3, 1e-9);
  const double cap = problem.yield.cap = .05;
  double before = 0;
  for (const double part : {.9, .99, .999, 1 - 1e-4, 1 - 1e-5, 1 - 1e-6}) {
    const double approach = solve(problem, part * cap).approach;
    EXPECT_GT(approach, before) << part;
    before = approach;
  }
  Field one(32, 32);
  one(0, 0) = 32 * 32;
  const double compliance = dense_displacement(problem, one)[0];  // single node
  const double end = solve(problem, (1 - 1e-6) * cap).approach + 1e-6 * cap * compliance;
  for (const double short_of : {1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const double approach = solve(problem, (1 - short_of) * cap).approach;
    EXPECT_NEAR(approach, end - short_of * cap * compliance, 2e-15) << short_of;  // measured 3e-16
  }
}

// At a small cap, approaches between those of n and n + 1 nodes have the load of whole nodes.
TEST_P(CloseToHardness, SoftGroundReachesEveryApproach) {
  for (const double cap : {2e-5, 2e-3})
    for (int k = 1; k <= 12; ++k) {
      HalfSpaceProblem problem = rough_problem(32, GetParam(), 1, 1e-8);
      problem.yield.cap = cap;
      const double approach = problem.rms * (.3 + .17 * k + .0123 * std::sin(k));
      const HalfSpaceAnswer answer = solve_at_approach(problem, approach, Monitor::silent());
      EXPECT_TRUE(answer.converged) << approach;
      EXPECT_NEAR(answer.approach / approach, 1, 1e-8) << approach;
      EXPECT_LT(dense_violation(problem, answer), 1e-8) << approach;
      // About as many nodes as above the plane.
      const double peak = range(problem.heights->values()).max;
      const auto cut = std::count_if(problem.heights->values().begin(), problem.heights->values().end(),
                                     [&](double h) { return h > peak - approach; });
      EXPECT_NEAR(static_cast<double>(answer.contacts), static_cast<double>(cut), cap < 1e-3 ? 1 : 40)
          << approach;
    }
}

// Three of nine nodes carry the load exactly; rounding decides about a fourth.
TEST_P(CloseToHardness, LoadsThatBracketAnExactlyCappedOneBracketItsApproach) {
  const double heights[] = {5, 1, 7, 3, 8, 2, 0, 4, 6};
  Field h(3, 3);
  for (std::size_t k = 0; k < 9; ++k) h[k] = heights[k];
  std::vector<double> shifts;
  for (const double modulus : {1e2, 5e2, 1e3, 2e3, 5e3, 1e4, 3e4}) {
    HalfSpaceProblem problem = problem_of(make_grid(3, 3, 3, 3), h, GetParam(), modulus, 1e-10);
    problem.yield.cap = .03;
    const HalfSpaceAnswer exact = solve(problem, .01);
    EXPECT_EQ(exact.contacts, 3);
    EXPECT_EQ(exact.yielded, 3);
    const double less = solve(problem, .01 * (1 - 1e-9)).approach,
                 more = solve(problem, .01 * (1 + 1e-9)).approach;
    // 8 - 6 and 8 - 5 (third and fourth highest node), plus displacements.
    EXPECT_NEAR(less, 2, .4 / modulus);
    EXPECT_NEAR(more, 3, .15 / modulus);
    EXPECT_NEAR(exact.approach, (less + more) / 2, 4e-15);  // measured 4e-16
    shifts.push_back((exact.approach - 2.5) * modulus);
  }
  for (const double shift : shifts) EXPECT_NEAR(shift, shifts[0], 1e-9 * shifts[0]);  // measured 5e-10
}
INSTANTIATE_TEST_SUITE_P(Boundaries, CloseToHardness, testing::Values(Boundary::periodic, Boundary::free),
                         [](const auto& boundary) { return std::string(name(boundary.param)); });

// --- flattening with yield

struct Yield {
  const char* what;
  std::optional<PlasticityOptions> plasticity;
};
const Yield yields[] = {{"elastic", {}},
                        {"capped", PlasticityOptions{.5e9, infinity}},
                        {"hardening", PlasticityOptions{.5e9, 8e13}}};

Scene rough_pair(Boundary boundary, const std::optional<PlasticityOptions>& plasticity) {
  const auto body = [](std::uint64_t seed) {
    SelfAffineOptions options = test::self_affine(make_grid(60, 54, 300e-6, 270e-6), 0.8, 40e-6, seed);
    options.ra = 1e-6;
    options.roll_off = 100e-6;
    Material metal = test::elastic(70e9, 0.33);
    metal.hardness = 1.1e9;
    return self_affine_surface(options).with_material(metal);
  };
  Scene scene{body(1), body(2), boundary, HalfSpaceOptions{}, Accuracy{1e-8}};
  if (plasticity) scene.effects.set(*plasticity);
  return scene;
}

double peak_to_valley(const Surface& lower, const Surface& upper) {
  Field sum = lower.heights();
  for (int j = 0; j < sum.ny(); ++j)
    for (int i = 0; i < sum.nx(); ++i) sum(i, j) += upper.heights()(sum.nx() - 1 - i, j);
  return range(sum.values()).span();
}

class Flattening : public testing::TestWithParam<Boundary> {};

TEST_P(Flattening, IsThatOfTheDeformedBodies) {
  for (const Yield& yield : yields)
    for (const double pressure : {1e3, 1e6, 50e6, 200e6, 450e6}) {
      const Scene scene = rough_pair(GetParam(), yield.plasticity);
      const State state = test::press(scene, PressBy::pressure, pressure);
      const double before = peak_to_valley(scene.lower, std::get<Surface>(scene.upper));
      const double after = peak_to_valley(state.deformed("lower"), state.deformed("upper"));
      // Measured 2e-16.
      EXPECT_NEAR(state.flatten(), 1 - after / before, 2e-15) << yield.what << " " << pressure;
      EXPECT_EQ(yield.plasticity && pressure >= 1e6, yield.plasticity && state.plastic_volume() > 0);
    }
}
TEST_P(Flattening, ApproachAndIndentationLeadBackToThePressure) {
  for (const Yield& yield : yields)
    for (const double pressure : {1e3, 1e6, 50e6, 200e6, 450e6}) {
      const auto contact = test::ready(rough_pair(GetParam(), yield.plasticity));
      const State state = contact->press({PressBy::pressure, pressure, {}});
      for (const auto& [by, value] : {std::pair{PressBy::approach, state.approach()},
                                      std::pair{PressBy::indentation, state.indentation()},
                                      std::pair{PressBy::flatten, state.flatten()}}) {
        const State again = contact->press({by, value, {}});
        EXPECT_TRUE(again.converged()) << yield.what << " " << pressure << " " << name(by);
        // Measured 9e-8, at a tolerance of 1e-8 on flattening.
        EXPECT_NEAR(again.pressure() / pressure, 1, 5e-7) << yield.what << " " << pressure << " " << name(by);
      }
    }
}
TEST_P(Flattening, TheLeastSharesAreMet) {
  for (const Yield& yield : yields)
    for (const double share : {1e-12, 1e-9, 1e-6, 1e-3, .01, .1}) {
      const State state = test::press(rough_pair(GetParam(), yield.plasticity), PressBy::flatten, share);
      EXPECT_TRUE(state.converged()) << yield.what << " " << share;
      EXPECT_NEAR(state.flatten() / share, 1, 1e-8) << yield.what << " " << share;
    }
}
INSTANTIATE_TEST_SUITE_P(Boundaries, Flattening, testing::Values(Boundary::periodic, Boundary::free),
                         [](const auto& boundary) { return std::string(name(boundary.param)); });

// Nearly all nodes are at the limit: after a snap the others must rebalance the load.
TEST(CloseToHardness, WhatIsSnappedToTheLimitIsJudgedAgain) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Grid grid = make_grid(24, 47, 24, 624);
    Field h(grid.nx, grid.ny);
    const Stream stream(seed, "heights");
    for (std::size_t k = 0; k < h.size(); ++k) h[k] = std::round(2 * stream.normal(k));
    for (int event = 0; event < 3; ++event) {
      HalfSpaceProblem problem = problem_of(grid, h, Boundary::periodic, 1, 1e-10);
      problem.yield.cap = 7.4;
      const HalfSpaceAnswer answer = solve(problem, 0.9985 * problem.yield.cap);
      EXPECT_TRUE(answer.converged) << seed;
      EXPECT_LE(answer.certificate.worst(), problem.tolerance) << seed << " event " << event;
      for (std::size_t k = 0; k < h.size(); ++k) h[k] += std::min(0.0, answer.gap[k]);
    }
  }
}

// --- heights of any size

TEST(HeightsOfAnySize, AreRightOrRefusedByName) {
  const auto pressed = [](double amplitude, Boundary boundary, bool box) {
    const Surface wave = test::surface_of(Grid{8, 8, 1, 1}, [&](int i, int j) {
      return amplitude * std::cos(2 * pi * i / 8) * std::cos(2 * pi * j / 8);
    });
    Scene scene{wave.with_material(test::elastic(1e11)), rigid_material(), boundary, HalfSpaceOptions{},
                Accuracy{}};
    if (box) scene.elasticity = BoxOptions{};
    return test::press(scene, PressBy::pressure, box ? 1e10 : 1e11 * amplitude);
  };
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const bool box : {false, true}) {
      const State known = pressed(1e-6, boundary, box);
      int right = 0, refused = 0;
      for (int power = -320; power <= 308; power += 4) {
        const double amplitude = std::pow(10.0, power);
        try {
          const State state = pressed(amplitude, boundary, box);
          EXPECT_EQ(state.contacts(), known.contacts()) << power;
          EXPECT_NEAR(state.approach() / amplitude, known.approach() / 1e-6, 1e-4) << power;
          EXPECT_TRUE(std::isfinite(state.energy())) << power;
          EXPECT_NEAR(state.mean_gap() / amplitude, known.mean_gap() / 1e-6, 1e-4) << power;
          ++right;
        } catch (const Error& error) {
          const std::string why = error.what();
          EXPECT_TRUE(why.find("range of a double") != std::string::npos ||
                      why.find("1e-280") != std::string::npos ||
                      why.find("check the units") != std::string::npos)
              << power << ": " << why;
          ++refused;
        }
      }
      EXPECT_GT(right, 70);
      EXPECT_GT(refused, 10);
    }
}

}  // namespace
}  // namespace asperity::half_space_digits_test
