// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements under a plane: known answers, prescribed quantities, rescaling, few nodes, equal heights, any
// magnitude.
#include "engine/contact/elasticity/box/box_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/contact/contacts.hpp"

namespace asperity::box_solver_test {
namespace {

using test::boxes;
using test::error_of;
using test::press;
using test::random_surface;
using test::ready;
using test::row_of;

// Heights {0, 1, 3, 6}/6 with E/A = 1.
TEST(BoxSolver, FourBoxesByHand) {
  const auto solver = ready(boxes(row_of({0, 1.0 / 6, 3.0 / 6, 1}), 1));
  auto at = [&](double pressure) { return solver->press({PressBy::pressure, pressure, {}}); };
  EXPECT_NEAR(at(0.05).approach(), 0.2, 1e-16);
  EXPECT_EQ(at(0.05).contacts(), 1);
  EXPECT_NEAR(at(0.125).approach(), 0.5, 1e-16);
  const State st = at(0.2);
  EXPECT_NEAR(st.approach(), 0.65, 2e-16);
  const auto pressure = st.field("pressure");
  EXPECT_EQ((*pressure)[0], 0);
  EXPECT_EQ((*pressure)[1], 0);
  EXPECT_NEAR((*pressure)[2], 0.15, 2e-16);
  EXPECT_NEAR((*pressure)[3], 0.65, 2e-16);
  EXPECT_EQ(st.area_fraction(), 0.5);
  EXPECT_NEAR(st.energy(), 0.5 * (0.15 * 0.15 + 0.65 * 0.65), 1e-15);
  EXPECT_NEAR(st.mean_gap(), (0.35 + (5.0 / 6 - 0.65)) / 4, 1e-15);
}

// F = π k R δ², A = 2 π R δ.
TEST(BoxSolver, Paraboloid) {
  const int n = 1024;
  const double size = 0.5;
  const Surface cap = test::surface_of(Grid{n, n, size, size}, [&](int i, int j) {
    const double x = (i - n / 2) * size / n, y = (j - n / 2) * size / n;
    return -(x * x + y * y) / 2;
  });
  const State st = press(boxes(cap, 1), PressBy::load, 1e-3);
  EXPECT_NEAR(st.approach(), 0.0178412, 3e-3 * 0.0178412);
  EXPECT_NEAR(st.area(), 0.1120998, 3e-3 * 0.1120998);
  EXPECT_NEAR(st.energy(), std::numbers::pi / 3 * std::pow(0.0178412, 3), 5e-3 * 5.9e-6);
  EXPECT_EQ(st.spots(), 1);
}

// Gaussian heights, A/A0 = Q(t), p/(kσ) = φ(t) − t Q(t), plane t σ above the mean.
TEST(BoxSolver, GaussianHeights) {
  const int n = 250;
  auto above = [](double t) { return 0.5 * std::erfc(t / std::numbers::sqrt2); };
  const Surface gaussian = test::surface_of(Grid{n, n, 1, 1}, [&](int i, int j) {
    const double share = (j * n + i + 0.5) / (n * n);
    double low = -9, high = 9;
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (low + high);
      (above(middle) > share ? low : high) = middle;
    }
    return low;
  });
  const double sigma = 1, k = 7;
  for (const double t : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
    const double density = std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi);
    const double pressure = k * sigma * (density - t * above(t));
    const State st = press(boxes(gaussian, k), PressBy::pressure, pressure);
    EXPECT_NEAR(st.area_fraction(), above(t), 3e-3 * above(t)) << t;
    EXPECT_NEAR(gaussian.height_range().max - st.approach(), t, 3e-3) << t;
  }
}

TEST(BoxSolver, AgreesWithBisectionToTheSortedSum) {
  for (const int n : {1, 2, 7, 40, 150}) {
    const Surface rough = random_surface(n, n, static_cast<std::uint64_t>(n));
    const auto solver = ready(boxes(rough, 3));
    const double peak = rough.height_range().max;
    for (double pressure = 1e-9; pressure < 30; pressure *= 3.7) {
      long double low = 0, high = 1;
      auto carried = [&](long double d) {
        long double sum = 0;
        for (const double h : rough.heights().values())
          sum += std::max<long double>(0, d - static_cast<long double>(peak - h));
        return 3 * sum / (n * n);
      };
      while (carried(high) < pressure) high *= 2;
      for (int k = 0; k < 120; ++k) {
        const long double middle = (low + high) / 2;
        (carried(middle) < pressure ? low : high) = middle;
      }
      const double approach = solver->press({PressBy::pressure, pressure, {}}).approach();
      EXPECT_NEAR(approach, static_cast<double>(low), 1e-12 * approach) << n << " " << pressure;
    }
  }
}

TEST(BoxSolver, EveryWayOfPrescribingGivesTheSameState) {
  const Surface rough = random_surface(31, 17, 5, 3e-3, 2e-3);
  const auto solver = ready(boxes(rough, 2e9));
  for (const double pressure : {1e3, 1e8, 1e9, 1e11}) {
    const State st = solver->press({PressBy::pressure, pressure, {}});
    EXPECT_EQ(st.pressure(), pressure);
    const State by_load = solver->press({PressBy::load, st.load(), {}});
    EXPECT_EQ(by_load.load(), st.load());
    EXPECT_NEAR(by_load.approach(), st.approach(), 1e-14 * st.approach());
    const State by_approach = solver->press({PressBy::approach, st.approach(), {}});
    EXPECT_EQ(by_approach.approach(), st.approach());
    EXPECT_NEAR(by_approach.pressure(), pressure, 1e-12 * pressure);
    const State by_indentation = solver->press({PressBy::indentation, st.indentation(), {}});
    EXPECT_NEAR(by_indentation.pressure(), pressure, 1e-12 * pressure);
    if (st.indentation() < 1) {
      const State by_flatten = solver->press({PressBy::flatten, st.indentation(), {}});
      EXPECT_NEAR(by_flatten.pressure(), pressure, 1e-12 * pressure);
      EXPECT_EQ(by_flatten.flatten(), by_flatten.indentation());
    }
  }
}

TEST(BoxSolver, FlattenIsTheLossOfPeakToValleyUnderLoad) {
  const Surface rough = random_surface(20, 20, 5);
  const State st = press(boxes(rough, 1), PressBy::flatten, 0.35);
  EXPECT_NEAR(st.deformed("lower").peak_to_valley(), 0.65 * rough.peak_to_valley(), 1e-14);
  const State flat = press(boxes(rough, 1), PressBy::flatten, 1);
  EXPECT_EQ(flat.deformed("lower").peak_to_valley(), 0);
  EXPECT_EQ(flat.flatten(), 1);
  const State beyond = press(boxes(rough, 1), PressBy::indentation, 2.5);
  EXPECT_EQ(beyond.flatten(), 1);
  EXPECT_NEAR(beyond.indentation(), 2.5, 1e-15);
}

TEST(BoxSolver, BeyondFullContactThePressureIsLinear) {
  const Surface rough = random_surface(12, 12, 2);
  const auto solver = ready(boxes(rough, 4));
  const State touching_all = solver->press({PressBy::indentation, 1, {}});
  EXPECT_EQ(touching_all.contacts(), 143);
  for (const double more : {1e-3, 1.0, 1e6}) {
    const State st = solver->press({PressBy::pressure, touching_all.pressure() + more, {}});
    EXPECT_EQ(st.area_fraction(), 1);
    EXPECT_NEAR(st.approach(), touching_all.approach() + more / 4, 1e-14 * st.approach());
    EXPECT_EQ(st.stiffness(), 4);
    EXPECT_EQ(st.mean_gap(), 0);
  }
}

TEST(BoxSolver, EqualPeaksShareEqually) {
  const State st = press(boxes(row_of({0, 5, 2, 5}), 1), PressBy::load, 1);
  EXPECT_EQ(st.contacts(), 2);
  const auto p = st.field("pressure");
  EXPECT_EQ((*p)[1], 0.5);
  EXPECT_EQ((*p)[3], 0.5);
}

TEST(BoxSolver, EqualHeightsAndSingleNodes) {
  const State plane = press(boxes(row_of({7, 7, 7}), 2), PressBy::pressure, 1);
  EXPECT_EQ(plane.area_fraction(), 1);
  EXPECT_EQ(plane.approach(), 0.5);
  EXPECT_EQ(plane.flatten(), 0);
  EXPECT_TRUE(plane.converged());
  const State node = press(boxes(row_of({-3}), 2), PressBy::load, 8);
  EXPECT_EQ(node.approach(), 4);
  EXPECT_EQ(node.spots(), 1);
  EXPECT_EQ(node.corrected_area_fraction(), 1);
  for (const PressBy by : {PressBy::indentation, PressBy::flatten})
    EXPECT_NE(error_of([&] {
                press(boxes(row_of({7, 7}), 1), by, 0.5);
              }).find("all combined heights are equal"),
              std::string::npos);
}

TEST(BoxSolver, ZeroLoadTouchesNothing) {
  for (const PressBy by :
       {PressBy::pressure, PressBy::load, PressBy::approach, PressBy::indentation, PressBy::flatten}) {
    const State st = press(boxes(row_of({0, 1, 3, 3}), 2), by, 0);
    EXPECT_EQ(st.load(), 0);
    EXPECT_EQ(st.approach(), 0);
    EXPECT_EQ(st.contacts(), 0);
    EXPECT_EQ(st.spots(), 0);
    EXPECT_EQ(st.spots8(), 0);
    EXPECT_TRUE(st.spot_areas().empty());
    EXPECT_EQ(st.stiffness(), 0);
    EXPECT_EQ(st.secant_stiffness(), 0);
    EXPECT_EQ(st.energy(), 0);
    EXPECT_EQ(st.mean_gap(), 1.25);
    EXPECT_EQ(st.residual(), 0);
    EXPECT_TRUE(st.converged());
  }
}

TEST(BoxSolver, OneUlpEitherSideOfTheSecondTouch) {
  const auto solver = ready(boxes(row_of({0, 1}), 1));
  EXPECT_EQ(solver->press({PressBy::approach, 1, {}}).contacts(), 1);
  EXPECT_EQ(solver->press({PressBy::approach, std::nextafter(1.0, 2.0), {}}).contacts(), 2);
  EXPECT_EQ(solver->press({PressBy::load, 1, {}}).contacts(), 1);
  EXPECT_EQ(solver->press({PressBy::load, 1 + 0x1p-51, {}}).contacts(), 2);
}

TEST(BoxSolver, RescalingByPowersOfTwoKeepsEveryBit) {
  const Surface rough = random_surface(33, 20, 8);
  const State base = press(boxes(rough, 3), PressBy::pressure, 0.4);
  for (const int power : {-90, -30, 1, 40, 90}) {
    const double length = std::ldexp(1.0, power), modulus = std::ldexp(1.0, -2 * power);
    const Grid& g = rough.grid();
    const Surface scaled = test::surface_of(Grid{g.nx, g.ny, g.size_x * length, g.size_y * length},
                                            [&](int i, int j) { return rough.height(i, j) * length; });
    const State st = press(boxes(scaled, 3 * modulus / length), PressBy::pressure, 0.4 * modulus);
    EXPECT_EQ(st.approach(), base.approach() * length);
    EXPECT_EQ(st.contacts(), base.contacts());
    EXPECT_EQ(st.energy(), base.energy() * modulus * length * length * length);
    EXPECT_EQ(st.mean_gap(), base.mean_gap() * length);
    EXPECT_EQ(st.residual(), base.residual());
  }
}

TEST(BoxSolver, SiScalesFromNanonewtonsToGigapascals) {
  const Surface rough = random_surface(64, 64, 3, 1e-6, 1e-6);
  const Surface fine =
      test::surface_of(rough.grid(), [&](int i, int j) { return rough.height(i, j) * 1e-9; });
  const Scene scene = test::scene_of(fine.with_material(test::elastic(70e9, 0.33)), rigid_material());
  const State st = press(scene, PressBy::load, 1e-9);
  EXPECT_EQ(st.load(), 1e-9);
  EXPECT_GT(st.contacts(), 0);
  EXPECT_LT(st.residual(), 1e-13);
}

TEST(BoxSolver, LoadsTooSmallToMeanAnythingAreRefused) {
  const Scene scene = test::scene_of(row_of({0, 1}).with_material(test::elastic(1e9)), rigid_material());
  EXPECT_EQ(error_of([&] { press(scene, PressBy::pressure, 0.9e-271); }),
            "`pressure` is 9e-272, a pressure under 1e-280 of the modulus: too small to mean anything; give "
            "zero for no "
            "load, or check its unit");
  EXPECT_EQ(error_of([&] { press(scene, PressBy::pressure, 1.1e-271); }), "");
  EXPECT_NE(error_of([&] { press(scene, PressBy::load, 1e-272); }).find("`load` is 1e-272"),
            std::string::npos);
  EXPECT_NE(error_of([&] { press(scene, PressBy::approach, 1e-300); }).find("too small to mean anything"),
            std::string::npos);
}

TEST(BoxSolver, LoadsTooLargeForADoubleAreRefused) {
  const Scene scene = boxes(row_of({0, 1}), 1e-3);
  EXPECT_NE(error_of([&] { press(scene, PressBy::pressure, 1e307); }).find("leave the range of a double"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              press(boxes(row_of({0, 1}), 1e10), PressBy::approach, 1e300);
            }).find("check its unit"),
            std::string::npos);
}

TEST(BoxSolver, TheCertificateIsRoundingForAnyOrdinaryLoad) {
  const auto solver = ready(boxes(random_surface(150, 150, 4), 1));
  for (double pressure = 1e-7; pressure < 10; pressure *= 5) {
    const State st = solver->press({PressBy::pressure, pressure, {}});
    EXPECT_LT(st.residual(), 1e-13) << pressure;
    EXPECT_EQ(st.certificate().tension, 0);
    EXPECT_EQ(st.certificate().cap, 0);
    EXPECT_TRUE(st.converged());
  }
}

TEST(BoxSolver, AToleranceBelowRoundingIsAnErrorUnlessTheBestIsWanted) {
  Scene scene = boxes(random_surface(20, 20, 1), 0.7);
  scene.accuracy.tolerance = 1e-15;
  // An ulp of the depth is large against the roughness.
  const std::string text = error_of([&] { press(scene, PressBy::approach, 3.14159e6); });
  EXPECT_NE(text.find("above the `tolerance` of 1e-15"), std::string::npos) << text;
  scene.accuracy.on_failure = Accuracy::OnFailure::best;
  const State best = press(scene, PressBy::approach, 3.14159e6);
  EXPECT_FALSE(best.converged());
  EXPECT_GT(best.residual(), 1e-15);
}

TEST(BoxSolver, SplitPartsTheContactAtAPressure) {
  const Surface rough = random_surface(60, 60, 4);
  const State st = press(boxes(rough, 2), PressBy::pressure, 0.5);
  const auto field = st.field("pressure");
  for (const double share : {1e-6, 0.2, 0.5, 0.99, 1.0, 1.5}) {
    const double threshold = share * st.peak_pressure();
    std::int64_t above = 0, below = 0;
    long double sum = 0;
    for (const double p : field->values()) {
      if (p >= threshold) ++above;
      if (p > 0 && p < threshold) {
        ++below;
        sum += p;
      }
    }
    const PressureSplit split = st.split(threshold);
    EXPECT_EQ(split.above, above);
    EXPECT_EQ(split.below, below);
    EXPECT_NEAR(split.sum_below, static_cast<double>(sum), 1e-13 * static_cast<double>(sum));
  }
}

TEST(BoxSolver, FieldsAndScalarsAgree) {
  const State st = press(boxes(random_surface(70, 31, 4), 2), PressBy::pressure, 0.3);
  EXPECT_NEAR(mean(st.field("pressure")->values()), 0.3, 1e-15);
  EXPECT_NEAR(mean(st.field("gap")->values()), st.mean_gap(), 1e-14);
  EXPECT_EQ(block_sum(st.field("contact")->values()), static_cast<double>(st.contacts()));
  EXPECT_EQ(range(st.field("pressure")->values()).max, st.peak_pressure());
  EXPECT_EQ(range(st.field("displacement")->values()).max, st.approach());
  double energy = 0;
  for (std::size_t k = 0; k < 70 * 31; ++k)
    energy += 0.5 * (*st.field("pressure"))[k] * (*st.field("displacement"))[k] / (70 * 31);
  EXPECT_NEAR(st.energy(), energy, 1e-14);
}

TEST(BoxSolver, NothingIsAllocatedOnTheGridByAPressWhoseFieldsNobodyReads) {
  const auto solver = ready(boxes(random_surface(100, 100, 4), 2));
  const std::int64_t before = memory::held();
  const State st = solver->press({PressBy::pressure, 0.3, {}});
  EXPECT_GT(st.area_fraction() + st.mean_gap() + st.energy() + st.secant_stiffness() + st.residual(), 0);
  EXPECT_EQ(memory::held(), before);
  EXPECT_EQ(st.cost().total.bytes, 0);
  EXPECT_EQ(st.cost().total.transforms, 0);
}

}  // namespace
}  // namespace asperity::box_solver_test
