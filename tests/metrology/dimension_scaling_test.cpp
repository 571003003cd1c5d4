// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/dimension_scaling.hpp"

#include <gtest/gtest.h>

#include "engine/metrology/fractal_dimension.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::dimension_scaling_test {
namespace {

using testing::fractional_brownian;

constexpr DimensionMethod differences[] = {DimensionMethod::structure, DimensionMethod::madogram};

std::vector<Profile> brownian_profiles(int count, int samples, double D, std::uint64_t seed,
                                       double factor = 1) {
  std::vector<Profile> profiles;
  for (int k = 0; k < count; ++k) {
    Array<double> z = fractional_brownian(samples, 2 - D, seed + static_cast<std::uint64_t>(k));
    for (double& value : z) value *= factor;
    profiles.emplace_back(1.0, std::move(z));
  }
  return profiles;
}

FractalDimensionOptions with(DimensionMethod method, std::vector<int> steps = {}) {
  FractalDimensionOptions options;
  options.method = method;
  options.steps = std::move(steps);
  return options;
}

Surface smooth_below(double cells, double hurst, int side = 256) {
  SelfAffineOptions options =
      test::self_affine(make_grid(side, side, side * 1e-6, side * 1e-6), hurst, cells * 1e-6, 5);
  options.rms_height = 1e-6;
  return self_affine_surface(options);
}

TEST(DimensionScaling, LocalDimensionsAreThoseBetweenNeighbours) {
  const std::vector<double> steps = {1, 2, 8, 16};
  std::vector<double> logs;
  for (const double s : steps) logs.push_back(1.6 * std::log(s));
  for (const double D : local_dimensions({steps, logs, 2, -0.5})) EXPECT_NEAR(D, 1.2, 1e-12);
  EXPECT_EQ(running_dimension({steps, logs, 2, -0.5}, 1.2, 100, 1, 0), "");
}

TEST(DimensionScaling, NamesTheStepsOverWhichADimensionIsConstant) {
  const std::vector<double> steps = {1, 2, 4, 8, 16, 32};
  std::vector<double> logs = {0};
  for (const double D : {1.05, 1.15, 1.28, 1.30, 1.31})
    logs.push_back(logs.back() + 2 * (2 - D) * std::log(2));
  EXPECT_EQ(running_dimension({steps, logs, 2, -0.5}, 1.21, 1 << 20, 1, 0.5),
            "D runs from 1.05 between steps of 1 and 2 to 1.31 between steps of 16 and 32: no one dimension "
            "describes these steps; it is constant within 0.042 over `steps={4, 8, 16, 32}`");
  // For one short profile, scatter is possible.
  EXPECT_EQ(running_dimension({steps, logs, 2, -0.5}, 1.21, 128, 1, 0.5), "");
}

// The scatter of a few looks like a trend.
TEST(DimensionScaling, OfFractionalBrownianProfilesIsBelieved) {
  int refused = 0, all = 0;
  for (const double D : {1.1, 1.3, 1.5, 1.8})
    for (const int samples : {150, 600})
      for (std::uint64_t seed = 1; seed <= 30; ++seed)
        for (const DimensionMethod method : differences) {
          const Profile one(1, fractional_brownian(samples, 2 - D, seed));
          const FractalDimension found = fractal_dimension(one, with(method));
          if (found.D < 1 || found.D > 2) continue;
          ++all;
          if (!found.resolved) ++refused;
        }
  EXPECT_LE(refused, 0.02 * all) << all;
  EXPECT_GT(all, 400);
}

TEST(DimensionScaling, OfAFaceThatIsSmoothOverShortStepsIsNotBelieved) {
  for (const double hurst : {0.3, 0.5, 0.7, 0.9})
    for (const double cells : {6.4, 12.8, 25.6}) {
      const Surface s = smooth_below(cells, hurst);
      for (const DimensionMethod method :
           {DimensionMethod::structure, DimensionMethod::madogram, DimensionMethod::box}) {
        const FractalDimension found = fractal_dimension(s, with(method));
        EXPECT_TRUE(!found.resolved || std::abs(found.D - (2 - hurst)) < found.error)
            << hurst << " " << cells << ": " << found.D << " ± " << found.error;
      }
    }
}

TEST(DimensionScaling, IsBelievedOverStepsThatScale) {
  const Surface s = smooth_below(6.4, 0.7);
  EXPECT_FALSE(fractal_dimension(s, with(DimensionMethod::structure)).resolved);
  const FractalDimension found = fractal_dimension(s, with(DimensionMethod::structure, {32, 8, 16}));
  EXPECT_TRUE(found.resolved) << found.reason;
  EXPECT_NEAR(found.D, 1.3, 0.04);
}

// The error covers the bias of box counting without much excess.
TEST(DimensionScaling, TheErrorOfBoxCountingHoldsWhatItMisses) {
  constexpr int count = 24;
  for (const double D : {1.1, 1.3, 1.5, 1.7, 1.9})
    for (const int samples : {150, 400, 1024, 4096}) {
      const FractalDimension found =
          fractal_dimension(brownian_profiles(count, samples, D, 40), with(DimensionMethod::box));
      EXPECT_TRUE(found.resolved) << found.reason;
      const double bias = box_counting_bias(found.D, samples);
      // Three standard errors of the mean, and the table's interpolation error.
      const double scatter = std::sqrt(found.error * found.error - bias * bias);
      EXPECT_NEAR(found.D + bias, D, 3 * 1.7 * scatter / std::sqrt(1.0 * count) + 0.012)
          << D << " " << samples;
      EXPECT_GE(found.error, 0.85 * (D - found.D)) << D << " " << samples;
    }
}

// Box counts hardly show the structure function's trend, and exceed their error.
TEST(DimensionScaling, BoxesAreBelievedOnlyWhereTheStructureFunctionIs) {
  for (const double hurst : {0.1, 0.3, 0.5, 0.8}) {
    const Surface s = smooth_below(2, hurst);
    const FractalDimension boxes = fractal_dimension(s, with(DimensionMethod::box));
    const FractalDimension lags = fractal_dimension(s, with(DimensionMethod::structure));
    EXPECT_LE(boxes.resolved, lags.resolved) << hurst << ": " << lags.reason;
  }
  const FractalDimension found = fractal_dimension(smooth_below(2, 0.3, 1024), with(DimensionMethod::box));
  EXPECT_NE(found.reason.find("by the method `structure` on the same profiles, D runs from"),
            std::string::npos)
      << found.reason;
}

TEST(DimensionScaling, TheBiasOfBoxCountingGoesToNothingWithD) {
  EXPECT_EQ(box_counting_bias(1, 1000), 0);
  EXPECT_EQ(box_counting_bias(0.9, 1000), 0);
  EXPECT_NEAR(box_counting_bias(1.331, 1024), 0.169, 1e-12);
  EXPECT_NEAR(box_counting_bias(1.393, 1 << 20), 0.107, 1e-12);
  EXPECT_NEAR(box_counting_bias(1.277, 20), 0.223, 1e-12);
  EXPECT_GT(box_counting_bias(1.99, 300), 0.3);
}

TEST(DimensionScaling, StepsThatATipMayHaveMadeAreNotBelieved) {
  const Surface s = smooth_below(2, 0.5);
  FractalDimensionOptions options = with(DimensionMethod::structure, {2, 4, 8, 16});
  EXPECT_TRUE(fractal_dimension(s, options).resolved) << fractal_dimension(s, options).reason;
  options.tip = 100e-6;
  const FractalDimension found = fractal_dimension(s, options);
  EXPECT_FALSE(found.resolved);
  EXPECT_EQ(found.reason.substr(0, 40), "steps of 2 um may show the tip of 100 um") << found.reason;
  options.tip = 1e-9;
  EXPECT_TRUE(fractal_dimension(s, options).resolved);
}

}  // namespace
}  // namespace asperity::dimension_scaling_test
