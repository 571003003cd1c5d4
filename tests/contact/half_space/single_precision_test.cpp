// SPDX-License-Identifier: GPL-3.0-or-later
// Half-space solves in single precision: tolerance, agreement with double precision, memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::single_precision_test {
namespace {

using half_space_test::rough_problem;

HalfSpaceAnswer solved(HalfSpaceProblem problem, double pressure, bool single) {
  problem.single = single;
  return solve_at_pressure(problem, pressure, nullptr, Monitor::silent());
}

double most(std::span<const double> values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

double apart(std::span<const double> a, std::span<const double> b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

class SinglePrecision : public ::testing::TestWithParam<Boundary> {
 protected:
  void TearDown() override { set_thread_count(0); }
};

// Two pressures within a tolerance on energy differ at most by its root.
TEST_P(SinglePrecision, MeetsEachToleranceAndAgreesWithDouble) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-11}) {
    const HalfSpaceProblem problem = rough_problem(64, GetParam(), 1, tolerance);
    const HalfSpaceAnswer single = solved(problem, 0.02, true), exact = solved(problem, 0.02, false);
    EXPECT_TRUE(single.converged);
    EXPECT_LE(single.certificate.worst(), tolerance);
    EXPECT_NE(single.solver.find(" in single precision"), std::string::npos) << single.solver;
    EXPECT_EQ(exact.solver.find("single"), std::string::npos) << exact.solver;
    EXPECT_LE(apart(single.pressure.values(), exact.pressure.values()),
              10 * std::sqrt(tolerance) * most(exact.pressure.values()));
    EXPECT_NEAR(single.approach, exact.approach, 10 * tolerance * problem.rms);
    EXPECT_NEAR(mean(single.pressure.values()), 0.02, 1e-13);
  }
}

TEST_P(SinglePrecision, GapsAreDouble) {
  for (const auto& [n, single] : {std::pair(48, true), std::pair(256, false)}) {
    const HalfSpaceProblem problem = rough_problem(n, GetParam(), 2);
    const HalfSpaceAnswer answer = solved(problem, 0.02, single);
    const Grid& grid = problem.grid;
    HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), GetParam());
    Field u(grid.nx, grid.ny);
    compliance.apply(answer.pressure.values(), u.values());
    for (std::size_t k = 0; k < u.size(); ++k)
      ASSERT_NEAR(u[k] * grid.hx() / problem.modulus - (*problem.heights)[k] - answer.offset, answer.gap[k],
                  1e-13 * problem.rms * 100)
          << k;
  }
}

TEST_P(SinglePrecision, ThreadsChangeNoBit) {
  const HalfSpaceProblem problem = rough_problem(128, GetParam(), 3);
  set_thread_count(1);
  const HalfSpaceAnswer one = solved(problem, 0.01, true);
  set_thread_count(2);
  const HalfSpaceAnswer two = solved(problem, 0.01, true);
  for (std::size_t k = 0; k < one.pressure.size(); ++k) {
    ASSERT_EQ(one.pressure[k], two.pressure[k]);
    ASSERT_EQ(one.gap[k], two.gap[k]);
  }
}

TEST_P(SinglePrecision, CapsAndHardens) {
  for (const double hardening : {0.0, 0.5}) {
    HalfSpaceProblem problem = rough_problem(64, GetParam(), 4, 1e-7);
    problem.yield.cap = 0.05;
    if (hardening > 0) problem.yield.hardening = hardening;
    const HalfSpaceAnswer single = solved(problem, 0.02, true), exact = solved(problem, 0.02, false);
    EXPECT_TRUE(single.converged);
    EXPECT_GT(single.yielded, 0);
    EXPECT_NEAR(static_cast<double>(single.contacts), static_cast<double>(exact.contacts), 4);
    EXPECT_NEAR(static_cast<double>(single.yielded), static_cast<double>(exact.yielded), 4);
  }
}

TEST_P(SinglePrecision, SpansManyDecadesOfLoad) {
  const HalfSpaceProblem problem = rough_problem(64, GetParam(), 5, 1e-6);
  for (const double pressure : {1e-60, 1e-25, 1e-9, 1e-4}) {
    const HalfSpaceAnswer answer = solved(problem, pressure, true);
    EXPECT_TRUE(answer.converged) << pressure;
    EXPECT_NEAR(mean(answer.pressure.values()), pressure, 1e-12 * pressure);
  }
}

TEST_P(SinglePrecision, HoldsHalfInItsTransforms) {
  set_thread_count(1);
  const auto held = [](bool single) {
    const std::int64_t before = memory::held();
    HalfSpaceCompliance compliance(1024, 1024, 1, GetParam(), 1, single);
    Field p(1024, 1024, 1.0);
    compliance.apply(p.values(), p.values());
    return static_cast<double>(memory::held() - before) - static_cast<double>(p.size() * sizeof(double));
  };
  EXPECT_NEAR(held(true) / held(false), 0.5, 0.05);
  // Periodic: temporary double-precision gaps need less than the saving.
  const HalfSpaceProblem problem = rough_problem(512, GetParam(), 1, 1e-3);
  std::int64_t peak[2];
  for (const bool single : {false, true}) {
    const CostScope scope;
    solved(problem, 0.01, single);
    peak[single] = scope.so_far().bytes;
  }
  const std::int64_t grid = 512 * 512 * 8;
  EXPECT_LE(peak[1], GetParam() == Boundary::periodic ? peak[0] - grid / 3 : peak[0] + grid);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, SinglePrecision, ::testing::Values(Boundary::periodic, Boundary::free));

TEST(SinglePrecisionOf, OddAndPrimeSidesMeetsTheTolerance) {
  for (const auto& [nx, ny] : {std::pair(45, 40), std::pair(44, 40), std::pair(40, 37), std::pair(41, 43)}) {
    const Grid grid = make_grid(nx, ny, nx, ny);
    Field heights(nx, ny);
    const Stream stream(1, "heights");
    for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = stream.normal(k);
    const HalfSpaceProblem problem = half_space_test::problem_of(grid, heights, Boundary::periodic);
    const HalfSpaceAnswer single = solved(problem, 0.05, true), exact = solved(problem, 0.05, false);
    EXPECT_NE(single.solver.find("single"), std::string::npos) << single.solver;
    EXPECT_LE(single.certificate.worst(), problem.tolerance);
    EXPECT_LE(apart(single.pressure.values(), exact.pressure.values()),
              10 * std::sqrt(problem.tolerance) * most(exact.pressure.values()));
  }
}

TEST(SinglePrecisionOf, AnOperatorIsTheOperatorRounded) {
  const int n = 96;
  HalfSpaceCompliance exact(n, n, 1.5, Boundary::periodic), single(n, n, 1.5, Boundary::periodic, 1, true);
  EXPECT_TRUE(single.single());
  EXPECT_FALSE(exact.single());
  const Stream stream(1, "pressures");
  Field p(n, n), u(n, n), v(n, n), w(n, n);
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = stream.normal(k);
  exact.apply(p.values(), u.values());
  single.apply(p.values(), v.values());
  single.apply_in_double([&](int j, double*) { return p.row(j).data(); }, {}, w.values());
  EXPECT_GT(apart(u.values(), v.values()), 1e-9 * most(u.values()));
  EXPECT_LE(apart(u.values(), v.values()), 1e-6 * most(u.values()));
  EXPECT_LE(apart(u.values(), w.values()), 1e-14 * most(u.values()));

  // A double-precision operator rounds only on request.
  for (int time = 0; time < 2; ++time) {
    exact.apply_rounded([&](int j, double*) { return p.row(j).data(); },
                        [&](int j, const double* row) { std::copy_n(row, n, w.row(j).data()); }, {});
    EXPECT_EQ(apart(v.values(), w.values()), 0);
    exact.apply(p.values(), w.values());
    EXPECT_EQ(apart(u.values(), w.values()), 0);
  }
}

TEST(SinglePrecisionOf, ATolerancePastRoundingSaysWhatItReached) {
  HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 1, 1e-15);
  problem.best_effort = true;
  const HalfSpaceAnswer best = solved(problem, 0.02, true);
  EXPECT_LE(best.certificate.worst(), 1e-12);
  if (!best.converged) {
    EXPECT_EQ(best.solver.find("single"), std::string::npos) << best.solver;
    problem.best_effort = false;
    EXPECT_THROW(solved(problem, 0.02, true), Error);
  }
}

}  // namespace
}  // namespace asperity::single_precision_test
