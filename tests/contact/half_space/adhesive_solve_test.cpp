// SPDX-License-Identifier: GPL-3.0-or-later
// An adhesive paraboloid (R = E* = 1, w = 0.01): Johnson, Kendall & Roberts (1971) at a Tabor number above 5,
// to 3 %; Derjaguin, Muller & Toporov (1975) below 0.05.
#include "engine/contact/elasticity/half_space/adhesion/adhesive_solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/parallel.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::adhesive_solve_test {
namespace {

using half_space_test::dense_displacement;
using half_space_test::problem_from;

constexpr double work = 0.01, short_range = 0.009, long_range = 0.95;

double tabor(double range) { return std::cbrt(work * work / (range * range * range)); }

AdhesiveProblem paraboloid(int n, double size, GapLaw law, double range, double tolerance) {
  AdhesiveProblem problem;
  const double middle = 0.5 * size * (1 - 1.0 / n);
  problem.contact = problem_from(
      make_grid(n, n, size, size), Boundary::free,
      [&](double x, double y) { return -0.5 * ((x - middle) * (x - middle) + (y - middle) * (y - middle)); },
      1, tolerance);
  problem.attraction = {{"adhesion", law, work, range}};
  return problem;
}

double force(const AdhesiveProblem& problem, const AdhesiveAnswer& answer) {
  return answer.contact.mean_pressure * problem.contact.grid.area();
}
// Outer radius of attraction; the theory's crack is inside.
double radius(const AdhesiveProblem& problem, const AdhesiveAnswer& answer) {
  return std::sqrt(static_cast<double>(answer.contact.contacts) * problem.contact.grid.cell_area() /
                   std::numbers::pi);
}

AdhesiveAnswer at(const AdhesiveProblem& problem, double approach, const AdhesiveAnswer* start = nullptr) {
  return adhere_at_approach(problem, approach, start, Monitor::silent());
}
AdhesiveAnswer under(const AdhesiveProblem& problem, double load, const AdhesiveAnswer* start = nullptr) {
  return adhere_at_pressure(problem, load / problem.contact.grid.area(), start, Monitor::silent());
}

// By bisection to 0.1 % of 2πwR; each load starts from zero.
double pull_off(const AdhesiveProblem& problem) {
  const AdhesiveAnswer rest = under(problem, 0);
  double held = 0.5, lost = 1.1;
  const double unit = 2 * std::numbers::pi * work;
  AdhesiveAnswer last = under(problem, -held * unit, &rest);
  while (lost - held > 1e-3) {
    const double middle = 0.5 * (held + lost);
    try {
      last = under(problem, -middle * unit, &last);
      held = middle;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::infeasible) << error.what();
      lost = middle;
    }
  }
  return -held * unit;
}

class Paraboloid : public testing::TestWithParam<GapLaw> {};

TEST_P(Paraboloid, OfShortRangePullsOffAsJohnsonKendallAndRobertsSay) {
  ASSERT_GT(tabor(short_range), 5);
  const AdhesiveProblem problem = paraboloid(144, 0.9, GetParam(), short_range, 1e-3);
  const AdhesiveAnswer pressed = at(problem, 0.02);
  double least = 0;
  AdhesiveAnswer retracted = pressed;
  for (const double approach : {-0.02, -0.03, -0.0358988, -0.042}) {
    retracted = at(problem, approach, &retracted);
    least = std::min(least, force(problem, retracted));
    if (approach == -0.0358988) {
      EXPECT_NEAR(radius(problem, retracted), 0.3281715, 0.03 * 0.3281715);
    }
  }
  EXPECT_NEAR(least, -0.0471238898, 0.03 * 0.0471238898);
  // Beyond the largest pull.
  retracted = at(problem, -0.97 * 0.0746726, &retracted);
  EXPECT_GT(radius(problem, retracted), 0.1577684);
  EXPECT_GT(force(problem, retracted), least);
  EXPECT_LT(force(problem, retracted), -0.0261799);
  retracted = at(problem, -1.03 * 0.0746726, &retracted);
  EXPECT_EQ(retracted.contact.contacts, 0);
}

TEST_P(Paraboloid, OfShortRangeTouchesWithoutLoadAsJohnsonKendallAndRobertsSay) {
  const AdhesiveProblem problem = paraboloid(192, 1.3, GetParam(), short_range, 1e-3);
  const AdhesiveAnswer rest = under(problem, 0);
  EXPECT_NEAR(radius(problem, rest), 0.5209397, 0.03 * 0.5209397);
  EXPECT_NEAR(rest.contact.approach, 0.0904594, 0.03 * 0.0904594);
}

TEST_P(Paraboloid, OfLongRangePullsOffAsDerjaguinMullerAndToporovSay) {
  ASSERT_LT(tabor(long_range), 0.05);
  const double size = 8;
  ASSERT_GE(size, 8 * std::sqrt(long_range));
  const double pull = pull_off(paraboloid(128, size, GetParam(), long_range, 1e-5));
  EXPECT_NEAR(pull, -0.0628318531, 0.03 * 0.0628318531);
}

TEST_P(Paraboloid, MeetsTheContactConditionsBySumsOfItsOwn) {
  const AdhesiveProblem problem = paraboloid(24, 1.4, GetParam(), 0.05, 1e-6);
  const AdhesiveAnswer answer = at(problem, 0.02);
  Field net(24, 24);
  const GapTerm& law = problem.attraction.front();
  for (std::size_t k = 0; k < net.size(); ++k) {
    EXPECT_GE(answer.contact.pressure[k], 0);
    EXPECT_GE(answer.contact.gap[k], -1e-6 * law.range);
    EXPECT_NEAR(answer.attraction[k], law.traction(std::max(0.0, answer.contact.gap[k])),
                1e-6 * law.greatest());
    EXPECT_NEAR(answer.contact.pressure[k] > 0 ? answer.contact.gap[k] : 0.0, 0, 1e-6 * law.range);
    net[k] = answer.contact.pressure[k] - answer.attraction[k];
  }
  const std::vector<double> u = dense_displacement(problem.contact, net);
  const double peak = range(problem.contact.heights->values()).max;
  for (std::size_t k = 0; k < net.size(); ++k)
    EXPECT_NEAR(answer.contact.gap[k], u[k] + (peak - (*problem.contact.heights)[k]) - 0.02, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(OfEachLaw, Paraboloid, testing::Values(GapLaw::exponential, GapLaw::dugdale),
                         [](const auto& law) {
                           return std::string(law.param == GapLaw::dugdale ? "Dugdale" : "Exponential");
                         });

TEST(AdhesiveSolve, JumpsInLaterThanItPullsOff) {
  const AdhesiveProblem problem = paraboloid(96, 0.9, GapLaw::exponential, 0.02, 1e-4);
  const AdhesiveAnswer pressed = at(problem, 0.05);
  const double between = -0.065;
  const AdhesiveAnswer coming = at(problem, between), leaving = at(problem, between, &pressed);
  EXPECT_EQ(coming.contact.contacts, 0);
  EXPECT_GT(leaving.contact.contacts, 100);
  EXPECT_LT(force(problem, leaving), 2 * force(problem, coming));
  EXPECT_EQ(at(problem, -0.3, &pressed).contact.contacts, 0);
}

TEST(AdhesiveSolve, UnderALoadOfShortRangeItSeparatesAtThePullOffOfJohnsonKendallAndRoberts) {
  const AdhesiveProblem problem = paraboloid(160, 1.2, GapLaw::exponential, short_range, 1e-3);
  AdhesiveAnswer held = under(problem, 0);
  EXPECT_NO_THROW(held = under(problem, -0.97 * 0.0471238898, &held));
  EXPECT_GT(radius(problem, held), 0.3281715);
  EXPECT_THROW(under(problem, -1.03 * 0.0471238898, &held), Error);
}

TEST(AdhesiveSolve, ADisturbedStateComesBack) {
  const AdhesiveProblem problem = paraboloid(96, 0.9, GapLaw::exponential, 0.02, 1e-5);
  const AdhesiveAnswer pressed = at(problem, 0.05), state = at(problem, -0.055, &pressed);
  for (const double factor : {0.97, 1.03}) {
    AdhesiveAnswer disturbed = state;
    for (double& pull : disturbed.attraction.values()) pull *= factor;
    const AdhesiveAnswer back = at(problem, -0.055, &disturbed);
    EXPECT_NEAR(force(problem, back), force(problem, state), 1e-3 * std::abs(force(problem, state)));
  }
}

TEST(AdhesiveSolve, APullPastThePullOffIsRefused) {
  const AdhesiveProblem problem = paraboloid(64, 8, GapLaw::dugdale, long_range, 1e-4);
  const AdhesiveAnswer rest = under(problem, 0);
  try {
    under(problem, -0.07, &rest);
    FAIL() << "was carried";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::infeasible);
    EXPECT_NE(std::string(error.what()).find("the bodies separate under a mean pressure of"),
              std::string::npos)
        << error.what();
  }
}

TEST(AdhesiveSolve, TheSameBitsEachTimeOnAnyNumberOfThreads) {
  const AdhesiveProblem problem = paraboloid(160, 0.9, GapLaw::exponential, 0.03, 1e-4);
  const int threads = thread_count();
  set_thread_count(1);
  const AdhesiveAnswer once = under(problem, 0.01);
  set_thread_count(3);
  const AdhesiveAnswer again = under(problem, 0.01);
  set_thread_count(threads);
  EXPECT_EQ(once.contact.approach, again.contact.approach);
  for (std::size_t k = 0; k < once.attraction.size(); ++k)
    EXPECT_EQ(once.contact.pressure[k], again.contact.pressure[k]);
}

TEST(AdhesiveSolve, DoesNotDependOnTheUnits) {
  const AdhesiveProblem problem = paraboloid(48, 0.9, GapLaw::exponential, 0.03, 1e-6);
  AdhesiveProblem small = problem;  // lengths in 2⁻²⁰, pressures in 2³⁰
  const double length = std::ldexp(1.0, -20), pressure = std::ldexp(1.0, 30);
  Field h = *problem.contact.heights;
  for (double& z : h.values()) z *= length;
  small.contact = half_space_test::problem_of(make_grid(48, 48, 0.9 * length, 0.9 * length), std::move(h),
                                              Boundary::free, pressure, 1e-6);
  small.attraction.front().work *= length * pressure;
  small.attraction.front().range *= length;
  const AdhesiveAnswer a = at(problem, 0.01), b = at(small, 0.01 * length);
  EXPECT_EQ(a.contact.contacts, b.contact.contacts);
  EXPECT_NEAR(b.contact.mean_pressure / pressure, a.contact.mean_pressure,
              1e-9 * std::abs(a.contact.mean_pressure));
}

TEST(AdhesiveSolve, APeriodicTileCarriesItsLoadAndItsAttraction) {
  AdhesiveProblem problem;
  problem.contact = half_space_test::rough_problem(64, Boundary::periodic, 3, 1e-5);
  const double rms = problem.contact.rms;
  problem.attraction = {{"adhesion", GapLaw::exponential, 1e-3 * rms, 0.3 * rms}};
  const AdhesiveAnswer answer = adhere_at_pressure(problem, 1e-3, nullptr, Monitor::silent());
  EXPECT_NEAR(mean(answer.contact.pressure.values()) - mean(answer.attraction.values()), 1e-3, 1e-9);
  EXPECT_GT(answer.contact.contacts, half_space_test::solve(problem.contact, 1e-3).contacts);
  EXPECT_TRUE(answer.contact.converged);
}

TEST(GapTerm, TractionFallsAndItsWorkIsTheWork) {
  for (const GapTerm& term : {GapTerm{"", GapLaw::exponential, 2, 3}, GapTerm{"", GapLaw::dugdale, 2, 3}}) {
    double sum = 0, before = term.traction(0);
    for (double g = 0.0005; g < 120; g += 0.001) {
      const double now = term.traction(g);
      EXPECT_LE(now, before);
      sum += 0.001 * now;
      before = now;
    }
    EXPECT_NEAR(sum, 2, 1e-6);
  }
  EXPECT_EQ((GapTerm{"", GapLaw::dugdale, 2, 3}.traction(4.5)), 0);
  EXPECT_EQ((GapTerm{"", GapLaw::dugdale, 2, 3}.traction(1.5)), 2.0 / 3.0);
}

}  // namespace
}  // namespace asperity::adhesive_solve_test
