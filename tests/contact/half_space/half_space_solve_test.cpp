// SPDX-License-Identifier: GPL-3.0-or-later
// Half-space contact against dense sums on small grids, closed forms (Hertz, punch, Westergaard,
// bi-sinusoid), its own cost in transforms, and the cases where solvers go wrong.
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

#include <gtest/gtest.h>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::half_space_solve_test {
namespace {

using namespace half_space_test;

Field noise(int nx, int ny, std::uint64_t seed) {
  Field h(nx, ny);
  for (std::size_t k = 0; k < h.size(); ++k)
    h[k] = std::sin(12.9898 * static_cast<double>(k + 1) + 78.233 * static_cast<double>(seed)) +
           0.3 * std::cos(4.1 * static_cast<double>(k * k % 1013));
  return h;
}

struct Tile {
  int nx, ny;
  double size_x, size_y;
};
const Tile small_tiles[] = {{8, 8, 1, 1},   {16, 16, 1, 1}, {7, 5, 1, 1}, {13, 13, 2, 1}, {16, 8, 1, 1},
                            {1, 16, .1, 1}, {16, 1, 1, .1}, {2, 2, 1, 1}, {1, 2, 1, 1},   {12, 20, 1, .5}};

TEST(HalfSpaceSolve, MeetsEveryConditionByDenseSums) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const Tile& tile : small_tiles)
      for (const double part : {.02, .3, 2.0}) {
        HalfSpaceProblem problem = problem_of(make_grid(tile.nx, tile.ny, tile.size_x, tile.size_y),
                                              noise(tile.nx, tile.ny, 3), boundary, 2.5, 1e-10);
        const double pressure = part * problem.modulus * problem.rms / problem.grid.hx() * .3;
        const HalfSpaceAnswer answer = solve(problem, pressure);
        EXPECT_TRUE(answer.converged);
        // Complementarity averages: one node may be further off than the tolerance.
        EXPECT_LT(dense_violation(problem, answer), 1e-7)
            << tile.nx << " x " << tile.ny << " " << name(boundary) << " " << part << " " << answer.solver;
      }
}

TEST(HalfSpaceSolve, MeetsEveryConditionUnderACapByDenseSums) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const Tile& tile : small_tiles)
      for (const double over : {1.003, 1.5, 5.0}) {
        HalfSpaceProblem problem = problem_of(make_grid(tile.nx, tile.ny, tile.size_x, tile.size_y),
                                              noise(tile.nx, tile.ny, 5), boundary, 1, 1e-10);
        const double pressure = .1 * problem.rms / problem.grid.hx();
        problem.yield.cap = over * pressure;
        const HalfSpaceAnswer answer = solve(problem, pressure);
        EXPECT_TRUE(answer.converged);
        EXPECT_LT(dense_violation(problem, answer), 1e-7)
            << tile.nx << " x " << tile.ny << " " << name(boundary) << " " << over << " " << answer.solver;
        EXPECT_LE(answer.peak_pressure, problem.yield.cap);
      }
}

TEST(HalfSpaceSolve, MeetsEveryConditionUnderHardeningByDenseSums) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const Tile& tile : small_tiles)
      for (const double give : {.01, 1.0, 30.0, 1000.0}) {
        HalfSpaceProblem problem = problem_of(make_grid(tile.nx, tile.ny, tile.size_x, tile.size_y),
                                              noise(tile.nx, tile.ny, 7), boundary, 1, 1e-10);
        const double pressure = .1 * problem.rms / problem.grid.hx();
        Field yield(tile.nx, tile.ny);
        for (std::size_t k = 0; k < yield.size(); ++k) yield[k] = pressure * (1 + static_cast<double>(k % 3));
        problem.yield.yield = std::make_shared<const Field>(std::move(yield));
        problem.yield.hardening = 1 / (give * problem.grid.hx());
        const HalfSpaceAnswer answer = solve(problem, pressure);
        EXPECT_TRUE(answer.converged);
        EXPECT_LT(dense_violation(problem, answer), 1e-7)
            << tile.nx << " x " << tile.ny << " " << name(boundary) << " " << give << " " << answer.solver;
      }
}

struct Hertz {
  int nx, ny;
};
class HertzContact : public testing::TestWithParam<Hertz> {
 protected:
  HalfSpaceProblem sphere() const {
    return problem_from(
        make_grid(GetParam().nx, GetParam().ny, 5, 5), Boundary::free,
        [](double x, double y) { return -((x - 2.5) * (x - 2.5) + (y - 2.5) * (y - 2.5)) / (2 * 20.0); }, 102,
        1e-8);
  }
};
TEST_P(HertzContact, ApproachPeakAreaAndEnergyFollowTheForce) {
  const HalfSpaceProblem problem = sphere();
  const HalfSpaceAnswer answer = solve(problem, 15.0 / 25);
  const double cell = problem.grid.cell_area();
  const double area = static_cast<double>(answer.contacts) * cell -
                      (pi - 1 + std::log(2)) / 24 * contact_edges(answer, false) * cell;
  EXPECT_NEAR(answer.approach, .084727599, 1e-3 * .084727599);
  EXPECT_NEAR(answer.peak_pressure, 4.226469584, 3e-3 * 4.226469584);
  EXPECT_NEAR(area, pi * 1.301749588 * 1.301749588, 5e-3 * pi * 1.301749588 * 1.301749588);
  EXPECT_NEAR(mean_energy(problem, answer) * 25, .508365597, 1e-3 * .508365597);
  EXPECT_LE(answer.certificate.worst(), problem.tolerance);
}
INSTANTIATE_TEST_SUITE_P(Grids, HertzContact, testing::Values(Hertz{512, 512}, Hertz{511, 512}),
                         [](const auto& grid) {
                           return std::to_string(grid.param.nx) + "x" + std::to_string(grid.param.ny);
                         });

// A rigid flat punch is heights at one level inside a circle and far below it outside.
TEST(HalfSpaceSolve, FlatPunchHasTheStiffnessOfItsRadius) {
  const int n = 256;
  const double radius = .2;
  const HalfSpaceProblem problem =
      problem_from(make_grid(n, n, 1, 1), Boundary::free,
                   [&](double x, double y) { return std::hypot(x - .5, y - .5) < radius ? 0.0 : -10.0; });
  const HalfSpaceAnswer answer = solve(problem, .01);
  const double a = std::sqrt(static_cast<double>(answer.contacts) / (n * n) / pi);
  EXPECT_NEAR(.01 / (2 * a * answer.approach), 1, 5e-3);
}

// A flat over the whole free tile is a square punch: stiffness about 2.3 E* √(area/π)/√... from dense sums.
TEST(HalfSpaceSolve, FlatHeightsAreUniformOnAPeriodicTileAndAPunchOnAFreeOne) {
  const Grid grid = make_grid(16, 16, 1, 1);
  const HalfSpaceProblem periodic = problem_of(grid, Field(16, 16, 3e-6), Boundary::periodic, 1e9);
  const HalfSpaceAnswer even = solve(periodic, 5e5);
  for (const double p : even.pressure.values()) EXPECT_EQ(p, 5e5);
  EXPECT_EQ(even.approach, 0);

  HalfSpaceProblem punch = problem_of(grid, Field(16, 16, 3e-6), Boundary::free, 1e9, 1e-10);
  const HalfSpaceAnswer square = solve(punch, 5e5);
  EXPECT_GT(square.pressure(0, 0), 2 * square.pressure(8, 8));
  punch.rms = square.approach;  // the length the certificate takes
  EXPECT_LT(dense_violation(punch, square), 1e-7);
  // Force over 2 E* δ √(area/π) of a square punch is 1.01 (Conway & Farnham 1968); edges on 16 cells add 2 %.
  EXPECT_NEAR(5e5 / (2 * 1e9 * square.approach * std::sqrt(1 / pi)), 1.02, .03);
}

struct Westergaard {
  double f, contact, peak, gap;
};
TEST(HalfSpaceSolve, SinusoidFollowsWestergaard) {
  const Westergaard cases[] = {{.05, .143566, 8.944272, .400107},
                               {.25, .333333, 4, .201713},
                               {.5, .5, 2.828427, .0767132},
                               {.9, .795167, 2.108185, .00258777}};
  const int n = 1024;
  const double h = .01;
  for (const int rows : {1, 4}) {
    const HalfSpaceProblem problem =
        problem_from(make_grid(n, rows, 1, rows / static_cast<double>(n)), Boundary::periodic,
                     [&](double x, double) { return h * std::cos(2 * pi * x); });
    for (const Westergaard& known : cases) {
      const double pressure = known.f * pi * h;
      const HalfSpaceAnswer answer = solve(problem, pressure);
      EXPECT_NEAR(area_fraction(answer), known.contact, 2.0 / n) << known.f;
      EXPECT_NEAR(answer.peak_pressure / pressure, known.peak, 1e-3 * known.peak) << known.f;
      EXPECT_NEAR(mean_gap(answer) / (2 * h), known.gap, 1e-3 * known.gap) << known.f;
    }
  }
}

struct BiSinusoid {
  double f, area, peak, gap, energy;
};
HalfSpaceProblem bi_sinusoid(int n, double tolerance = 1e-8) {
  return problem_from(
      make_grid(n, n, 1, 1), Boundary::periodic,
      [](double x, double y) { return .01 * std::cos(2 * pi * x) * std::cos(2 * pi * y); }, 1, tolerance);
}
TEST(HalfSpaceSolve, BiSinusoidMatchesReference) {
  const BiSinusoid cases[] = {{.05, .11453, .031518, .0055637, 3.47073e-6},
                              {.20, .34610, .048673, .0020465, 2.04873e-5},
                              {.50, .70615, .065725, .00045079, 4.28476e-5},
                              {.80, .89828, .079898, 3.8462e-5, 5.40732e-5},
                              {.95, .97604, .086634, 1.130e-6, 5.54876e-5}};
  const HalfSpaceProblem problem = bi_sinusoid(256);
  for (const BiSinusoid& known : cases) {
    const HalfSpaceAnswer answer = solve(problem, known.f * std::sqrt(2) * pi * .01);
    EXPECT_NEAR(area_fraction(answer), known.area, .01 * known.area) << known.f;
    EXPECT_NEAR(answer.peak_pressure, known.peak, 1e-3 * known.peak) << known.f;
    EXPECT_NEAR(mean_energy(problem, answer), known.energy, 1e-3 * known.energy) << known.f;
    if (known.f <= .5) {
      EXPECT_NEAR(mean_gap(answer), known.gap, 1e-3 * known.gap) << known.f;
    }
  }
}

TEST(HalfSpaceSolve, FullContactIsTheExactFilter) {
  const HalfSpaceProblem problem = bi_sinusoid(64, 1e-12);
  const double full = std::sqrt(2) * pi * .01;
  for (const double f : {1.001, 1.5, 10.0}) {
    const CostScope scope;
    const HalfSpaceAnswer answer = solve(problem, f * full);
    EXPECT_LE(answer.iterations, 2);
    EXPECT_LE(scope.so_far().transforms, 4);
    EXPECT_EQ(answer.contacts, 64 * 64);
    double worst = 0;
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i) {
        const double exact = f * full + full * std::cos(2 * pi * i / 64.0) * std::cos(2 * pi * j / 64.0);
        worst = std::max(worst, std::abs(answer.pressure(i, j) - exact));
      }
    EXPECT_LT(worst, 1e-12 * f * full);
    EXPECT_NEAR(mean_energy(problem, answer), pi * 1e-4 / (4 * std::sqrt(2)), 1e-15);
  }
}

// The mean pressure moves nothing, however much larger it is than what flattens the surface.
TEST(HalfSpaceSolve, FullContactKeepsItsGapsUnderAnyMeanPressure) {
  const HalfSpaceProblem problem = bi_sinusoid(64, 1e-12);
  for (const double pressure : {1e3, 1e15, 1e100}) {
    const HalfSpaceAnswer answer = solve(problem, pressure);
    EXPECT_EQ(answer.contacts, 64 * 64);
    EXPECT_LT(range(answer.gap.values()).span(), 1e-16) << pressure;  // measured: 2e-17, of heights of 0.01
  }
}

// The last open nodes close one by one.
TEST(HalfSpaceSolve, NearFullContactDoesNotChatter) {
  const HalfSpaceProblem problem = bi_sinusoid(128);
  const double full = std::sqrt(2) * pi * .01;
  double before = 0;
  for (const double f : {.98, .99, .995, .999, .9995, .9999, .99999, 1.0}) {
    const CostScope scope;
    const HalfSpaceAnswer answer = solve(problem, f * full);
    EXPECT_GE(area_fraction(answer), before) << f;
    EXPECT_LE(scope.so_far().transforms / 2, 30) << f << " " << answer.solver;
    before = area_fraction(answer);
  }
  EXPECT_GT(before, .999);
}

TEST(HalfSpaceSolve, CappedBiSinusoidMatchesReference) {
  struct Known {
    double over, area, capped, gap, energy;
  };
  const double pressure = .00888577;
  for (const Known& known :
       {Known{3, .41806, .26944, .0017541, 1.31773e-5}, Known{1.5, .67282, .65927, -1, 3.45966e-6}}) {
    HalfSpaceProblem problem = bi_sinusoid(256);
    problem.yield.cap = known.over * pressure;
    const HalfSpaceAnswer answer = solve(problem, pressure);
    EXPECT_NEAR(area_fraction(answer), known.area, .01 * known.area);
    EXPECT_NEAR(static_cast<double>(answer.yielded) / (256 * 256), known.capped, .01 * known.capped);
    if (known.gap > 0) {
      EXPECT_NEAR(mean_gap(answer), known.gap, 5e-3 * known.gap);
    }
    EXPECT_NEAR(mean_energy(problem, answer), known.energy, 5e-3 * known.energy);
    for (const double p : answer.pressure.values()) EXPECT_TRUE(p >= 0 && p <= problem.yield.cap);
  }
}

TEST(HalfSpaceSolve, SoftGroundTouchesOnLoadOverHardness) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    HalfSpaceProblem problem = rough_problem(128, boundary, 1, 1e-6);
    problem.yield.cap = 1e-4;
    for (const double part : {.1, .5, .95, .997}) {
      const HalfSpaceAnswer answer = solve(problem, part * problem.yield.cap);
      EXPECT_NEAR(area_fraction(answer), part, .01 * part);
    }
  }
}

// Weak hardening is the cap, strong hardening no yield at all.
TEST(HalfSpaceSolve, HardeningRunsFromTheCapToElastic) {
  HalfSpaceProblem problem = rough_problem(128, Boundary::periodic, 2);
  const double pressure = .03;
  const HalfSpaceAnswer elastic = solve(problem, pressure);
  problem.yield.cap = 2 * pressure;
  const HalfSpaceAnswer capped = solve(problem, pressure);
  problem.yield.hardening = 1e-6 / problem.grid.hx();
  const HalfSpaceAnswer soft = solve(problem, pressure);
  EXPECT_NEAR(area_fraction(soft), area_fraction(capped), 1e-3);
  EXPECT_NEAR(soft.approach, capped.approach, 1e-4 * capped.approach);
  EXPECT_NEAR(soft.peak_pressure, problem.yield.cap, 1e-3 * problem.yield.cap);
  problem.yield.hardening = 1e6 / problem.grid.hx();
  const HalfSpaceAnswer hard = solve(problem, pressure);
  EXPECT_NEAR(hard.peak_pressure, elastic.peak_pressure, 1e-4 * elastic.peak_pressure);
  EXPECT_NEAR(hard.approach, elastic.approach, 1e-4 * elastic.approach);
}

TEST(HalfSpaceSolve, GapOfYieldedGroundIsWhatItGaveWay) {
  HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 2);
  problem.yield.cap = .06;
  problem.yield.hardening = .05 / problem.grid.hx();
  const HalfSpaceAnswer answer = solve(problem, .03);
  ASSERT_GT(answer.yielded, 100);
  for (std::size_t k = 0; k < answer.gap.size(); ++k)
    if (answer.pressure[k] > problem.yield.cap) {
      EXPECT_NEAR(answer.gap[k], -(answer.pressure[k] - problem.yield.cap) / problem.yield.hardening,
                  1e-6 * problem.rms);
    }
}

// The cost, in pairs of transforms of the finest grid with the nested grids counted.
TEST(HalfSpaceSolve, TakesFewTransforms) {
  for (const int n : {256, 512})
    for (const double load : {.005, .03})
      for (const std::uint64_t seed : {1, 2}) {
        const CostScope scope;
        const HalfSpaceAnswer answer = solve(rough_problem(n, Boundary::periodic, seed), load);
        EXPECT_TRUE(answer.converged);
        EXPECT_LE(scope.so_far().transforms / 2, 24) << n << " " << load << " seed " << seed;
      }
}
TEST(HalfSpaceSolve, TakesFewTransformsUnderACap) {
  for (const double over : {1.5, 2.5, 5.0}) {
    HalfSpaceProblem problem = rough_problem(256, Boundary::periodic, 1);
    problem.yield.cap = over * .03;
    const CostScope scope;
    EXPECT_TRUE(solve(problem, .03).converged);
    EXPECT_LE(scope.so_far().transforms / 2, 26) << over;
  }
}
TEST(HalfSpaceSolve, TakesFewTransformsOnAFreeTile) {
  for (const double load : {.005, .03}) {
    const CostScope scope;
    EXPECT_TRUE(solve(rough_problem(256, Boundary::free, 1), load).converged);
    EXPECT_LE(scope.so_far().transforms / 2, 32) << load;
  }
}
TEST(HalfSpaceSolve, TakesFewTransformsUnderHardening) {
  HalfSpaceProblem problem = rough_problem(256, Boundary::periodic, 1);
  problem.yield.cap = .075;
  problem.yield.hardening = 1 / (300 * problem.grid.hx());
  const CostScope scope;
  EXPECT_TRUE(solve(problem, .03).converged);
  EXPECT_LE(scope.so_far().transforms / 2, 45);
}

TEST(HalfSpaceSolve, OneNodeCarriesTheLeastLoads) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    HalfSpaceProblem problem = problem_from(make_grid(64, 64, 1, 1), boundary, [](double x, double y) {
      return -(x - .5) * (x - .5) - (y - .5) * (y - .5);
    });
    const HalfSpaceAnswer answer = solve(problem, 1e-12);
    EXPECT_EQ(answer.contacts, 1);
    EXPECT_DOUBLE_EQ(answer.pressure(32, 32), 64 * 64 * 1e-12);
    EXPECT_TRUE(answer.converged);
    const HalfSpaceAnswer lighter = solve(problem, 1e-200);
    EXPECT_EQ(lighter.contacts, 1);
  }
}
TEST(HalfSpaceSolve, EqualPeaksShareEqually) {
  Field h(64, 64, -1.0);
  h(10, 20) = h(42, 52) = 0;  // half a tile apart: each sees the other alike
  const HalfSpaceProblem problem = problem_of(make_grid(64, 64, 1, 1), h, Boundary::periodic);
  const HalfSpaceAnswer answer = solve(problem, 1e-4);
  EXPECT_EQ(answer.contacts, 2);
  EXPECT_NEAR(answer.pressure(10, 20), 64 * 64 * .5e-4, 1e-10 * 64 * 64);
  EXPECT_NEAR(answer.pressure(42, 52), 64 * 64 * .5e-4, 1e-10 * 64 * 64);
}
TEST(HalfSpaceSolve, SingleNodeTile) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const HalfSpaceAnswer answer = solve(problem_of(make_grid(1, 1, 2, 2), Field(1, 1, .5), boundary), 3);
    EXPECT_EQ(answer.pressure[0], 3);
    EXPECT_NEAR(answer.approach, boundary == Boundary::free ? 1.122199704678 * 3 * 2 : 0, 1e-9);
  }
}
TEST(HalfSpaceSolve, ZeroLoadIsFirstTouch) {
  const HalfSpaceProblem problem = bi_sinusoid(16);
  const HalfSpaceAnswer answer = solve(problem, 0);
  EXPECT_EQ(answer.contacts, 0);
  EXPECT_EQ(answer.approach, 0);
  EXPECT_EQ(range(answer.gap.values()).min, 0);
  EXPECT_TRUE(answer.converged);
}

TEST(HalfSpaceSolve, RefusesALoadTheHardnessCannotCarry) {
  HalfSpaceProblem problem = bi_sinusoid(16);
  problem.yield.cap = 2;
  for (const double pressure : {2.0, 3.0}) try {
      solve(problem, pressure);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::infeasible);
      EXPECT_NE(error.sentence().find("`hardness`"), std::string::npos);
    }
  const HalfSpaceAnswer nearly = solve(problem, std::nextafter(2.0, 0.0));
  EXPECT_TRUE(nearly.converged);
}
// Twelve of sixteen nodes can carry the load exactly: all touching ground at the cap, nothing between.
TEST(HalfSpaceSolve, EverythingAtTheCapTakesTheMiddleOfTheBracket) {
  Field h(4, 4, 1.0);
  for (int i = 0; i < 4; ++i) h(i, 0) = -50;
  HalfSpaceProblem problem = problem_of(make_grid(4, 4, 1, 1), h, Boundary::periodic);
  problem.yield.cap = 1e-3;
  const HalfSpaceAnswer answer = solve(problem, .75e-3);
  EXPECT_EQ(answer.contacts, 12);
  EXPECT_EQ(answer.yielded, 12);
  double open = std::numeric_limits<double>::infinity(), capped = -open;
  for (std::size_t k = 0; k < 16; ++k)
    (answer.pressure[k] > 0 ? capped = std::max(capped, answer.gap[k])
                            : open = std::min(open, answer.gap[k]));
  EXPECT_NEAR(open, -capped, 1e-12 * open);
}

TEST(HalfSpaceSolve, PowersOfTwoChangeNoBit) {
  HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 3);
  problem.yield.cap = .09;
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const double hardening : {std::numeric_limits<double>::infinity(), .5}) {
      problem.boundary = boundary;
      problem.yield.hardening = hardening;
      const HalfSpaceAnswer one = solve(problem, .03);
      const double length = std::ldexp(1.0, -30), stress = std::ldexp(1.0, 37);
      HalfSpaceProblem scaled = problem;
      Field h = *problem.heights;
      for (double& z : h.values()) z *= length;
      scaled.heights = std::make_shared<const Field>(h);
      scaled.rms *= length;
      scaled.grid = make_grid(64, 64, length, length);
      scaled.modulus *= stress;
      scaled.yield.cap *= stress;
      scaled.yield.hardening *= stress / length;
      const HalfSpaceAnswer two = solve(scaled, .03 * stress);
      for (std::size_t k = 0; k < h.size(); ++k) {
        ASSERT_EQ(two.pressure[k], one.pressure[k] * stress);
        ASSERT_EQ(two.gap[k], one.gap[k] * length);
      }
      EXPECT_EQ(two.approach, one.approach * length);
    }
}
TEST(HalfSpaceSolve, RefusesLoadsTooSmallToMeanAnything) {
  HalfSpaceProblem problem = bi_sinusoid(16);
  try {
    solve(problem, 1e-290);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_value);
  }
  for (const double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(solve(problem, bad), Error);
}

// The certificate is that of the fields handed out.
TEST(HalfSpaceSolve, CertificateIsThatOfTheFieldsHandedOut) {
  const HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 4, 1e-4);
  const HalfSpaceAnswer answer = solve(problem, .03);
  double sum = 0, apart = 0, least = 0;
  for (std::size_t k = 0; k < answer.gap.size(); ++k) least = std::min(least, answer.gap[k]);
  for (std::size_t k = 0; k < answer.gap.size(); ++k) {
    sum += answer.pressure[k];
    apart += answer.pressure[k] * (answer.gap[k] - least);
  }
  EXPECT_NEAR(answer.certificate.complementarity, apart / sum / problem.rms, 1e-12);
  EXPECT_NEAR(answer.certificate.penetration, -least / problem.rms, 1e-12);
  EXPECT_EQ(answer.certificate.tension, 0);
  EXPECT_LT(answer.certificate.load, 1e-14);
  EXPECT_LE(answer.certificate.worst(), 1e-4);
  EXPECT_GT(answer.certificate.worst(), 0);
}
TEST(HalfSpaceSolve, SaysWhatItReachedWhenToleranceIsBelowRoundOff) {
  HalfSpaceProblem problem = rough_problem(64, Boundary::periodic, 4, 1e-30);
  try {
    solve(problem, .03);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_converged);
    EXPECT_NE(error.sentence().find("residual"), std::string::npos);
  }
  problem.best_effort = true;
  const HalfSpaceAnswer best = solve(problem, .03);
  EXPECT_FALSE(best.converged);
  EXPECT_LT(best.certificate.worst(), 1e-12);
}

TEST(HalfSpaceSolve, OddPrimeAndOblongGrids) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const Tile& tile :
         {Tile{101, 101, 1, 1}, Tile{96, 150, 1, 1}, Tile{64, 256, 1, 1}, Tile{127, 64, 2, 1},
          Tile{100, 100, 1, 3}, Tile{1, 509, 1, 1}, Tile{200, 2, 1, .01}}) {
      const Grid grid = make_grid(tile.nx, tile.ny, tile.size_x, tile.size_y);
      HalfSpaceProblem problem = problem_from(grid, boundary, [&](double x, double y) {
        const double u = 2 * pi * x / grid.size_x, v = 2 * pi * y / grid.size_y;
        return .01 *
               (std::cos(u + 1) + .4 * std::sin(3 * u + v) + .3 * std::cos(2 * v) + .1 * std::cos(9 * u));
      });
      for (const double over : {0.0, 2.0}) {
        if (over > 0) problem.yield.cap = over * .01;
        const CostScope scope;
        const HalfSpaceAnswer answer = solve(problem, .01);
        EXPECT_TRUE(answer.converged);
        EXPECT_LE(scope.so_far().transforms / 2, 90)
            << tile.nx << " x " << tile.ny << " " << name(boundary) << " " << over << " " << answer.solver;
      }
    }
}

TEST(HalfSpaceSolve, ThreadsChangeNoBit) {
  HalfSpaceProblem problem = rough_problem(256, Boundary::periodic, 5);
  problem.yield.cap = .09;
  set_thread_count(1);
  const HalfSpaceAnswer one = solve(problem, .03);
  set_thread_count(2);
  const HalfSpaceAnswer two = solve(problem, .03);
  set_thread_count(0);
  for (std::size_t k = 0; k < one.pressure.size(); ++k) {
    ASSERT_EQ(one.pressure[k], two.pressure[k]);
    ASSERT_EQ(one.gap[k], two.gap[k]);
  }
}

TEST(HalfSpaceSolve, StartNearbyChangesNothingButTheCost) {
  for (const double over : {0.0, 2.5}) {
    HalfSpaceProblem problem = rough_problem(128, Boundary::periodic, 6, 1e-10);
    if (over > 0) problem.yield.cap = over * .03;
    const HalfSpaceAnswer near = solve(problem, .0299), alone = solve(problem, .03);
    const HalfSpaceAnswer led = solve(problem, .03, &near);
    EXPECT_EQ(led.contacts, alone.contacts);
    EXPECT_NEAR(led.approach, alone.approach, 1e-9 * problem.rms);
    const HalfSpaceAnswer again = solve(problem, .03, &alone);
    EXPECT_LE(again.iterations, 2);
  }
}

// Heights at random from node to node: lines along the short side are contacts nearly by themselves.
TEST(HalfSpaceSolve, OfLongCellsThatHardenTakesFourHundredTransforms) {
  for (const double aspect : {0.01, 0.1, 10., 30., 100., 1000.}) {
    double x = 5;
    HalfSpaceProblem problem = problem_from(
        make_grid(48, 48, 5e-4 * std::max(1.0, 1 / aspect), 5e-4 * std::max(1.0, aspect)), Boundary::periodic,
        [&](double, double) {
          x = std::fmod(x * 16807, 2147483647);
          return 1e-7 * x / 2147483647;
        },
        1e11, 1e-6);
    problem.yield.cap = 2e8;
    problem.yield.hardening = 2e15;
    EXPECT_LE(solve(problem, 1e8).iterations, 200) << aspect;
  }
}

}  // namespace
}  // namespace asperity::half_space_solve_test
