// SPDX-License-Identifier: GPL-3.0-or-later
// Flattening prescribed: the share by its definition, its ends, and near full contact, where the load is
// sought.
#include "engine/contact/elasticity/half_space/solver/flattening_solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/contact/elasticity/half_space/solver/full_contact.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::flattening_solve_test {
namespace {

using namespace half_space_test;

TEST(FlatteningSolve, PressesTheShareAskedFor) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const HalfSpaceProblem problem = rough_problem(64, boundary, 2, 1e-6);
    for (const double share : {.01, .3, .8}) {
      const HalfSpaceAnswer answer = solve_at_flattening(problem, share, Monitor::silent());
      EXPECT_NEAR(flattened(problem, answer), share, 1e-6 * share);
      // h − u by its definition.
      double low = 1e9, high = -1e9;
      for (std::size_t k = 0; k < answer.gap.size(); ++k) {
        low = std::min(low, -answer.gap[k] - answer.offset);
        high = std::max(high, -answer.gap[k] - answer.offset);
      }
      EXPECT_NEAR(1 - (high - low) / range(problem.heights->values()).span(), share, 2e-6 * share);
    }
    EXPECT_EQ(solve_at_flattening(problem, 0, Monitor::silent()).contacts, 0);
    EXPECT_THROW(solve_at_flattening(problem, 1.1, Monitor::silent()), Error);
  }
}

TEST(FlatteningSolve, OneIsFullContactOfAPeriodicTile) {
  const HalfSpaceProblem problem = problem_from(
      make_grid(32, 32, 1, 1), Boundary::periodic,
      [](double x, double y) { return .01 * std::cos(2 * pi * x) * std::cos(2 * pi * y); }, 1, 1e-6);
  const HalfSpaceAnswer answer = solve_at_flattening(problem, 1, Monitor::silent());
  EXPECT_NEAR(flattened(problem, answer), 1, 1e-6);
}

// Entry V1: where the deepest gap hardly follows from the approach. Its load is found back to what the share
// tells of it.
TEST(FlatteningSolve, V1_NearFullContactTakesAboutWhatItTakesByPressure) {
  for (const double tolerance : {1e-4, 1e-8})
    for (const double share_of_load : {.3, .6, .9, .99}) {
      const HalfSpaceProblem problem = rough_problem(96, Boundary::periodic, 5, tolerance);
      const double full = pressure_of_full_contact(problem).value();
      const HalfSpaceAnswer there = solve(problem, share_of_load * full);
      const double pressed = flattened(problem, there);
      const HalfSpaceAnswer back = solve_at_flattening(problem, pressed, Monitor::silent());
      const std::string scene = std::to_string(tolerance) + " " + std::to_string(share_of_load);
      EXPECT_TRUE(back.converged) << scene;
      EXPECT_LE(back.iterations, 10 * there.iterations + 30) << scene;
      EXPECT_NEAR(flattened(problem, back), pressed, tolerance * pressed) << scene;
      EXPECT_LE(back.certificate.worst(), tolerance) << scene;
    }
}

TEST(FlatteningSolve, V1_TheLeastLoadOfFullContactIsOne) {
  const HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 5, 1e-8);
  const double full = pressure_of_full_contact(problem).value();
  const auto nodes = static_cast<std::int64_t>(problem.grid.nodes());
  EXPECT_EQ(solve(problem, full).contacts, nodes);
  EXPECT_LT(solve(problem, full * (1 - 1e-6)).contacts, nodes);
  EXPECT_NEAR(solve(problem, full).approach, approach_of_full_contact(problem), 1e-8 * problem.rms);
}

}  // namespace
}  // namespace asperity::flattening_solve_test
