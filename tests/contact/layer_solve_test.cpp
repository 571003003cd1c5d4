// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts on a layer against a dense solution and the limits of half-space and Winkler foundation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/contact/elasticity/half_space/half_space_solution.hpp"
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/cost.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::layer_solve_test {
namespace {

using half_space_test::area_fraction;
using half_space_test::problem_from;
using half_space_test::problem_of;
using half_space_test::rough_problem;
using half_space_test::solve;

HalfSpaceAnswer at_approach(const HalfSpaceProblem& problem, double approach) {
  return solve_at_approach(problem, approach, Monitor::silent());
}

// m/Pa, row by row: a sum over the waves of the grid.
std::vector<double> dense_compliance(const Grid& grid, double modulus, const ElasticLayer& layer) {
  const int n = static_cast<int>(grid.nodes());
  const double two_pi = 2 * std::numbers::pi;
  std::vector<double> between(grid.nodes());  // by distance between nodes
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      double sum = layer.thickness * uniform_share(layer.poisson) / modulus;
      for (int b = 0; b < grid.ny; ++b)
        for (int a = 0; a < grid.nx; ++a) {
          if (a == 0 && b == 0) continue;
          const double qx = two_pi * std::min(a, grid.nx - a) / grid.size_x;
          const double qy = two_pi * std::min(b, grid.ny - b) / grid.size_y;
          const double q = std::sqrt(qx * qx + qy * qy);
          sum += 2 / (modulus * q) * layer_share(q * layer.thickness, layer.poisson, layer.base) *
                 std::cos(two_pi *
                          (static_cast<double>(a * i) / grid.nx + static_cast<double>(b * j) / grid.ny));
        }
      between[static_cast<std::size_t>(j * grid.nx + i)] = sum / n;
    }
  std::vector<double> all(grid.nodes() * grid.nodes());
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) {
      const int i = ((k - l) % grid.nx + grid.nx) % grid.nx;
      const int j = (k / grid.nx - l / grid.nx + grid.ny) % grid.ny;
      all[static_cast<std::size_t>(k) * grid.nodes() + static_cast<std::size_t>(l)] =
          between[static_cast<std::size_t>(j * grid.nx + i)];
    }
  return all;
}

// Projected Gauss-Seidel sweeps: 0 <= p <= cap; gap 0 between the bounds, >= 0 at 0, <= 0 at the cap. K is
// positive definite, except for the mean if K(0) = 0; the mean is still unique short of full contact.
std::vector<double> projected_sweeps(const std::vector<double>& compliance, const Field& h, double approach,
                                     double cap) {
  const std::size_t n = h.size();
  const double peak = range(h.values()).max;
  std::vector<double> p(n);
  double change = 1, most = 1;
  for (int sweep = 0; sweep < 20000 && change > 1e-13 * most; ++sweep) {
    change = most = 0;
    for (std::size_t k = 0; k < n; ++k) {
      double gap = (peak - h[k]) - approach;
      const double* const row = compliance.data() + k * n;
      for (std::size_t l = 0; l < n; ++l) gap += row[l] * p[l];
      const double next = std::clamp(p[k] - gap / row[k], 0.0, cap);
      change = std::max(change, std::abs(next - p[k]));
      most = std::max(most, next);
      p[k] = next;
    }
  }
  return p;
}

struct Small {
  int nx, ny;
  double size_y;
  ElasticLayer layer;
  double cap;  // of the peak pressure without a cap; infinite: none
};

TEST(LayerContact, IsThatOfADenseSolution) {
  for (const Small& small : {Small{12, 9, 1.0, {0.1, 0.3, LayerBase::bonded}, infinity},
                             Small{9, 10, 2.5, {0.3, 0.45, LayerBase::bonded}, infinity},
                             Small{12, 10, 0.9, {0.15, 0.5, LayerBase::bonded}, infinity},
                             Small{10, 10, 1.0, {0.05, 0.2, LayerBase::frictionless}, infinity},
                             Small{10, 8, 1.3, {0.2, 0.3, LayerBase::bonded}, 0.6}}) {
    const Grid grid = make_grid(small.nx, small.ny, 1, small.size_y);
    const double modulus = 3;
    const Field h = test::random_surface(small.nx, small.ny, 7).heights();
    const std::vector<double> compliance = dense_compliance(grid, modulus, small.layer);
    const double approach = 0.8 * (range(h.values()).max - mean(h.values()));
    std::vector<double> expected = projected_sweeps(compliance, h, approach, infinity);
    const double cap = small.cap * *std::max_element(expected.begin(), expected.end());
    if (small.cap < 1) expected = projected_sweeps(compliance, h, approach, cap);
    double sum = 0, most = 0;
    for (const double p : expected) sum += p, most = std::max(most, p);
    const double mean_pressure = sum / static_cast<double>(grid.nodes());

    HalfSpaceProblem problem = problem_of(grid, h, Boundary::periodic, modulus, 1e-11);
    problem.share = wave_share(small.layer);
    problem.yield.cap = cap;
    for (const HalfSpaceAnswer& found : {at_approach(problem, approach), solve(problem, mean_pressure)}) {
      EXPECT_TRUE(found.converged);
      EXPECT_GT(found.contacts, 5);
      EXPECT_LT(found.contacts, static_cast<std::int64_t>(grid.nodes()) - 5);
      EXPECT_NEAR(found.approach, approach, 1e-9 * approach);
      EXPECT_NEAR(found.mean_pressure, mean_pressure, 1e-9 * mean_pressure);
      for (std::size_t k = 0; k < expected.size(); ++k)
        EXPECT_NEAR(found.pressure[k], expected[k], 2e-9 * most) << k;
    }
    EXPECT_EQ(solve(problem, mean_pressure).yielded > 0, small.cap < 1);
  }
}

TEST(LayerContact, OnAThickLayerIsThatOfAHalfSpace) {
  const HalfSpaceProblem half_space = rough_problem(64, Boundary::periodic, 3, 1e-9);
  const HalfSpaceAnswer expected = solve(half_space, 0.01);
  for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless}) {
    HalfSpaceProblem layer = half_space;
    layer.share = wave_share({20, 0.3, base});
    const HalfSpaceAnswer found = solve(layer, 0.01);
    EXPECT_EQ(found.contacts, expected.contacts);
    for (std::size_t k = 0; k < found.pressure.size(); ++k)
      EXPECT_NEAR(found.pressure[k], expected.pressure[k], 1e-6 * expected.peak_pressure);
    const double compression = 20 * uniform_share(0.3) * 0.01;
    EXPECT_NEAR(found.approach, expected.approach + compression, 1e-8 * found.approach);
  }
}

TEST(LayerContact, OnAThinCompressibleLayerIsThatOfAWinklerFoundation) {
  const double thickness = 1e-5, amplitude = 1e-3;
  HalfSpaceProblem problem = problem_from(
      make_grid(30, 24, 1, 1), Boundary::periodic,
      [&](double x, double y) {
        return amplitude * std::cos(2 * std::numbers::pi * x) * std::cos(2 * std::numbers::pi * y);
      },
      2, 1e-9);
  problem.share = wave_share({thickness, 0.3, LayerBase::bonded});
  const double stiffness = 1 / uniform_compliance(problem);
  EXPECT_NEAR(stiffness, 2 * 0.49 / 0.4 / thickness, 1e-9 * stiffness);
  const double approach = 0.6 * amplitude;
  const HalfSpaceAnswer found = at_approach(problem, approach);
  for (std::size_t k = 0; k < found.pressure.size(); ++k) {
    const double box = stiffness * std::max(0.0, approach - (amplitude - (*problem.heights)[k]));
    EXPECT_NEAR(found.pressure[k], box, 1e-6 * stiffness * approach);
  }
}

TEST(LayerContact, InFullContactIsAnExactFilter) {
  const double amplitude = 0.01, thickness = 0.2, modulus = 5;
  for (const auto& [nx, ny] : {std::pair{32, 20}, {15, 9}})
    for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless}) {
      const double wave = 2 * std::numbers::pi * 2;
      HalfSpaceProblem problem = problem_from(
          make_grid(nx, ny, 1, 0.7), Boundary::periodic,
          [&](double x, double) { return amplitude * std::cos(wave * x); }, modulus, 1e-10);
      problem.share = wave_share({thickness, 0.4, base});
      const double of_wave = 2 / (modulus * wave) * layer_share(wave * thickness, 0.4, base);
      const double swing = amplitude / of_wave, mean_pressure = 1.25 * swing;
      const double uniform = uniform_compliance(problem);
      const double crest = range(problem.heights->values()).max;
      for (const HalfSpaceAnswer& found :
           {solve(problem, mean_pressure), at_approach(problem, crest + uniform * mean_pressure)}) {
        EXPECT_NEAR(found.approach, crest + uniform * mean_pressure, 1e-13);
        EXPECT_NEAR(found.mean_pressure, mean_pressure, 1e-12 * mean_pressure);
        for (std::size_t k = 0; k < found.pressure.size(); ++k)
          EXPECT_NEAR(found.pressure[k], mean_pressure + swing / amplitude * (*problem.heights)[k],
                      1e-12 * swing);
      }
      EXPECT_NEAR(contact_stiffness(problem, solve(problem, mean_pressure), Monitor::silent()), 1 / uniform,
                  1e-12 / uniform);
    }
}

struct Case {
  double thickness, poisson;
  LayerBase base;
};
class LayerContacts : public testing::TestWithParam<Case> {
 protected:
  HalfSpaceProblem rough(int n, double tolerance) const {
    HalfSpaceProblem problem = rough_problem(n, Boundary::periodic, 5, tolerance);
    problem.share = wave_share({GetParam().thickness, GetParam().poisson, GetParam().base});
    return problem;
  }
};
INSTANTIATE_TEST_SUITE_P(OfEachKind, LayerContacts,
                         testing::Values(Case{1.0, 0.3, LayerBase::bonded}, Case{0.1, 0.5, LayerBase::bonded},
                                         Case{0.02, 0.3, LayerBase::frictionless},
                                         Case{0.02, 0.5, LayerBase::bonded},
                                         Case{0.002, 0.2, LayerBase::bonded}));

TEST_P(LayerContacts, AreTheSameHoweverTheyAreAskedFor) {
  const HalfSpaceProblem problem = rough(64, 1e-8);
  const HalfSpaceAnswer by_pressure = solve(problem, 0.02);
  EXPECT_GT(by_pressure.contacts, 50);
  EXPECT_LT(by_pressure.contacts, 4000);
  const double sought = flattened(problem, by_pressure);
  for (const HalfSpaceAnswer& found : {at_approach(problem, by_pressure.approach),
                                       solve_at_flattening(problem, sought, Monitor::silent())}) {
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.approach, by_pressure.approach, 1e-5 * by_pressure.approach);
    EXPECT_NEAR(found.mean_pressure, 0.02, 1e-5 * 0.02);
    EXPECT_NEAR(static_cast<double>(found.contacts), static_cast<double>(by_pressure.contacts), 2);
  }
}

TEST_P(LayerContacts, AreSolvedOnNestedGridsInSomeTensOfTransforms) {
  const HalfSpaceProblem problem = rough(128, 1e-6);
  const double before = cost::transforms();
  const HalfSpaceAnswer by_pressure = solve(problem, 0.02);
  EXPECT_LT(cost::transforms() - before, 80);
  EXPECT_LE(by_pressure.certificate.worst(), 1e-6);
  EXPECT_NE(by_pressure.solver.find("on 3 nested grids"), std::string::npos) << by_pressure.solver;
  const double between = cost::transforms();
  EXPECT_TRUE(at_approach(problem, by_pressure.approach).converged);
  EXPECT_LT(cost::transforms() - between, 80);
}

TEST_P(LayerContacts, HaveTheStiffnessOfTheirSlope) {
  HalfSpaceProblem problem = rough(64, 1e-12);
  const double step = 1e-7;
  const HalfSpaceAnswer here = solve(problem, 0.02), further = solve(problem, 0.02 + step);
  const double slope = step / (further.approach - here.approach);
  EXPECT_NEAR(contact_stiffness(problem, here, Monitor::silent()), slope, 1e-3 * slope);
}

TEST_P(LayerContacts, InSinglePrecisionAreTheSame) {
  HalfSpaceProblem problem = rough(64, 1e-6);
  const HalfSpaceAnswer exact = solve(problem, 0.02);
  problem.single = true;
  for (const HalfSpaceAnswer& found : {solve(problem, 0.02), at_approach(problem, exact.approach)}) {
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.mean_pressure, 0.02, 1e-5 * 0.02);
    EXPECT_NEAR(found.approach, exact.approach, 1e-5 * exact.approach);
  }
}

TEST(LayerContact, OnLongCellsIsSolved) {
  for (const double aspect : {12.0, 1 / 30.0}) {
    HalfSpaceProblem problem = rough_problem(32, Boundary::periodic, 2, 1e-7);
    problem.grid.size_y = aspect;
    problem.share = wave_share({0.1, 0.3, LayerBase::bonded});
    const HalfSpaceAnswer by_pressure = solve(problem, 0.01);
    EXPECT_TRUE(by_pressure.converged);
    EXPECT_NEAR(at_approach(problem, by_pressure.approach).mean_pressure, 0.01, 1e-4 * 0.01);
  }
}

// Constant volume: a uniform pressure moves nothing.
TEST(LayerContact, OnAnIncompressibleLayerComesNoNearerThanFullContact) {
  HalfSpaceProblem problem = rough_problem(32, Boundary::periodic, 2, 1e-8);
  const double full = approach_of_full_contact(problem);
  problem.share = wave_share({0.3, 0.5, LayerBase::bonded});
  EXPECT_NE(test::error_of([&] { at_approach(problem, 1.01 * full); }).find("full contact"),
            std::string::npos);
  EXPECT_NEAR(at_approach(problem, 0.5 * full).approach, 0.5 * full, 1e-15);
  problem.share = wave_share({0.3, 0.4, LayerBase::bonded});
  EXPECT_TRUE(at_approach(problem, 1.01 * full).converged);
  // Compression at the hardness.
  problem.yield.cap = 0.01;
  const double most = range(problem.heights->values()).span() + uniform_compliance(problem) * 0.01;
  EXPECT_NE(test::error_of([&] { at_approach(problem, 1.01 * most); }).find("hardness"), std::string::npos);
}

// Heights matter at a billion times the modulus: the layer is stiff to long waves.
TEST(LayerContact, OfUnequalHeightsIsMeasuredByThem) {
  HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 9, 1e-6);
  problem.share = wave_share({1e-4, 0.5, LayerBase::bonded});
  double area = 0, flat = 0;
  for (int power = 3; power <= 9; ++power) {
    const HalfSpaceAnswer answer = solve(problem, std::pow(10.0, power));
    EXPECT_LE(answer.certificate.worst(), 1e-6);
    EXPECT_GE(area_fraction(answer), area) << power;
    EXPECT_GE(flattened(problem, answer), flat - 1e-5) << power;
    area = area_fraction(answer);
    flat = flattened(problem, answer);
    const double open = std::ranges::max(answer.gap.values());
    EXPECT_NEAR(flat, 1 - open / range(problem.heights->values()).span(), 1e-5) << power;
  }
}

TEST(LayerContact, OfAFlatIsEven) {
  HalfSpaceProblem problem = problem_of(make_grid(8, 6, 1, 1), Field(8, 6, 1e-3), Boundary::periodic, 2);
  problem.share = wave_share({0.5, 0.25, LayerBase::bonded});
  const double compression = 0.5 * uniform_share(0.25) / 2 * 0.3;
  for (const HalfSpaceAnswer& found : {solve(problem, 0.3), at_approach(problem, compression)}) {
    EXPECT_NEAR(found.approach, compression, 1e-15);
    EXPECT_NEAR(found.mean_pressure, 0.3, 1e-15);
    EXPECT_NEAR(found.pressure(3, 2), 0.3, 1e-15);
    EXPECT_EQ(found.contacts, 48);
  }
}

TEST(LayerContact, ThatHardensIsSolvedByPressureAndApproach) {
  HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 5, 1e-8);
  problem.share = wave_share({0.05, 0.4, LayerBase::bonded});
  problem.yield.cap = 0.1;
  problem.yield.hardening = 20;
  const HalfSpaceAnswer by_pressure = solve(problem, 0.02);
  EXPECT_TRUE(by_pressure.converged);
  EXPECT_GT(by_pressure.yielded, 10);
  EXPECT_NEAR(at_approach(problem, by_pressure.approach).mean_pressure, 0.02, 1e-5 * 0.02);
}

}  // namespace
}  // namespace asperity::layer_solve_test
