// SPDX-License-Identifier: GPL-3.0-or-later
// Contact stiffness against closed forms, dense elimination and the slope of load with approach.
#include "engine/contact/elasticity/half_space/half_space_solution.hpp"

#include <gtest/gtest.h>

#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::half_space_solution_test {
namespace {

using namespace half_space_test;

double stiffness_of(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  return contact_stiffness(problem, answer, Monitor::silent());
}

TEST(ContactStiffness, OfAHertzContactIsTwiceRadiusTimesModulus) {
  const HalfSpaceProblem problem = problem_from(
      make_grid(256, 256, 5, 5), Boundary::free,
      [](double x, double y) { return -((x - 2.5) * (x - 2.5) + (y - 2.5) * (y - 2.5)) / 40; }, 102);
  const double radius = 1.301749588;  // at a force of 15
  EXPECT_NEAR(stiffness_of(problem, solve(problem, 15.0 / 25)) * 25, 2 * radius * 102,
              .01 * 2 * radius * 102);
}

// A constant contact set: load is linear in approach.
TEST(ContactStiffness, IsTheSlopeOfLoadAgainstApproach) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const double over : {0.0, 3.0, -3.0}) {
      HalfSpaceProblem problem = rough_problem(64, boundary, 1, 1e-12);
      const double pressure = .02;
      if (over != 0) problem.yield.cap = std::abs(over) * pressure;
      if (over < 0) problem.yield.hardening = .01 / problem.grid.hx();
      const HalfSpaceAnswer at = solve(problem, pressure), above = solve(problem, pressure * (1 + 1e-7), &at);
      ASSERT_EQ(at.contacts, above.contacts);
      ASSERT_EQ(at.yielded, above.yielded);
      const double slope = pressure * 1e-7 / (above.approach - at.approach);
      EXPECT_NEAR(stiffness_of(problem, at), slope, 1e-3 * slope) << name(boundary) << " " << over;
    }
}

TEST(ContactStiffness, NothingFreeIsNoneAndFullPeriodicContactIsWithoutBound) {
  HalfSpaceProblem problem = rough_problem(32, Boundary::periodic, 1);
  EXPECT_EQ(stiffness_of(problem, solve(problem, 0)), 0);
  EXPECT_EQ(stiffness_of(problem, solve(problem, 10)), std::numeric_limits<double>::infinity());
  problem.yield.cap = 1;
  EXPECT_EQ(stiffness_of(problem, solve(problem, std::nextafter(1.0, 0.0))) < 1e3, true);
}

}  // namespace
}  // namespace asperity::half_space_solution_test
