// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/fractal_dimension.hpp"

#include "engine/core/parallel.hpp"
#include "engine/metrology/profile_statistics.hpp"
#include "tests/metrology/test_fields.hpp"

namespace asperity::fractal_dimension_test {
namespace {

using testing::error_text;
using testing::fractional_brownian;
using testing::make_profile;
using testing::make_surface;

Profile scaled(std::span<const double> heights, double factor, double spacing = 1) {
  Array<double> z(heights.begin(), heights.end());
  for (double& value : z) value *= factor;
  return Profile(spacing, std::move(z));
}

FractalDimensionOptions with(DimensionMethod method, std::vector<int> steps = {}) {
  FractalDimensionOptions options;
  options.method = method;
  options.steps = std::move(steps);
  return options;
}

constexpr DimensionMethod all_methods[] = {DimensionMethod::length, DimensionMethod::psd,
                                           DimensionMethod::structure, DimensionMethod::box,
                                           DimensionMethod::madogram};

// Points 0 3 0 3 0 7, spacing 4: step 1 gives (4·5 + √(4² + 7²))/24; step 2 drops the last point.
TEST(LengthMethod, DropsTheLastIncompleteStep) {
  const Profile p(4, {0, 3, 0, 3, 0, 7});
  const FractalDimension d = fractal_dimension(p, with(DimensionMethod::length, {1, 2}));
  const double first = (4 * 5 + std::sqrt(65.0)) / 20;
  ASSERT_EQ(d.lengths.size(), 2u);
  EXPECT_DOUBLE_EQ(d.lengths[0], first);
  EXPECT_DOUBLE_EQ(d.lengths[1], 1);
  EXPECT_NEAR(d.D, 1 + std::log(first) / std::log(2.0), 1e-14);
  EXPECT_FALSE(d.resolved);
}

TEST(LengthMethod, WrapsAndAveragesOffsetsWhenAsked) {
  const Profile p(1, {0, 1, 3, 0});
  FractalDimensionOptions options = with(DimensionMethod::length, {1, 2});
  options.wrap = true;
  const double whole = (std::sqrt(2.0) + std::sqrt(5.0) + std::sqrt(10.0) + 1) / 4;
  EXPECT_DOUBLE_EQ(fractal_dimension(p, options).lengths[0], whole);
  EXPECT_DOUBLE_EQ(fractal_dimension(p, options).lengths[1], std::sqrt(13.0) / 2);
  options.offsets = true;
  EXPECT_DOUBLE_EQ(fractal_dimension(p, options).lengths[1], (std::sqrt(13.0) / 2 + std::sqrt(5.0) / 2) / 2);
  options.wrap = false;
  EXPECT_DOUBLE_EQ(fractal_dimension(p, options).lengths[1], (std::sqrt(13.0) / 2 + std::sqrt(5.0) / 2) / 2);
}

TEST(LengthMethod, WrapsAClosedOutlineByItself) {
  const Array<double> z = {0, 1, 3, 0};
  const std::vector<int> steps = {1, 2};
  const double whole = (std::sqrt(2.0) + std::sqrt(5.0) + std::sqrt(10.0) + 1) / 4;
  EXPECT_DOUBLE_EQ(fractal_dimension(Profile(1, z, 9.0), with(DimensionMethod::length, steps)).lengths[0],
                   whole);
  EXPECT_DOUBLE_EQ(fractal_dimension(Profile(1, z), with(DimensionMethod::length, steps)).lengths[0],
                   (4 * whole - 1) / 3);
}

TEST(LengthMethod, WithPeriodicLagsKnowsNoBeginning) {
  const Array<double> z = fractional_brownian(97, 0.5, 1);
  Array<double> turned(z);
  std::rotate(turned.begin(), turned.begin() + 31, turned.end());
  FractalDimensionOptions options =
      with(DimensionMethod::length, {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 15, 17, 20, 24, 28, 32});
  options.wrap = options.offsets = true;
  EXPECT_NEAR(fractal_dimension(Profile(1, z), options).D, fractal_dimension(Profile(1, turned), options).D,
              1e-13);
}

// Three standard errors of √(1 + s²g²) over n increments of rms slope s.
TEST(LengthMethod, FindsTheExpectedLengthOfAGaussianProfile) {
  const int n = 100000;
  for (const double s : {0.05, 0.3, 1.0, 3.0, 10.0}) {
    const Stream stream(20, "increments");
    double z = 0;
    const double spacing = 0.25e-6;
    const Profile p = make_profile(n + 1, spacing, [&](int i) {
      return i == 0 ? 0 : z += s * spacing * stream.normal(static_cast<std::uint64_t>(i));
    });
    const FractalDimension d = fractal_dimension(p, with(DimensionMethod::length, {1, 2}));
    const double expected = expected_length_ratio(s);
    const double deviation = std::sqrt(1 + s * s - expected * expected);
    EXPECT_NEAR(d.lengths[0], expected, 3 * deviation / std::sqrt(1.0 * n)) << s;
  }
}

// Predicted D for H = 1/2 over steps 1 … 1024 (true D 1.5), within three standard errors.
TEST(LengthMethod, FindsThePredictedDimensionOfFlatAndSteepProfiles) {
  const double known[][2] = {{0.05, 1.00013}, {0.3, 1.00444}, {1, 1.0351}, {5, 1.2008}, {100, 1.4867}};
  std::vector<int> steps;
  for (int s = 1; s <= 1024; s *= 2) steps.push_back(s);
  for (const auto& [slope, D] : known) {
    std::vector<Profile> profiles;
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
      profiles.push_back(scaled(fractional_brownian(1 << 14, 0.5, seed), slope));
    FractalDimensionOptions options = with(DimensionMethod::length, steps);
    options.pooled = true;
    const FractalDimension d = fractal_dimension(profiles, options);
    EXPECT_NEAR(d.D, D, 3 * d.error / std::sqrt(40.0) + 5e-6) << slope;
    EXPECT_EQ(d.resolved, slope == 100) << slope << " " << d.reason;
  }
}

TEST(LengthMethod, KeepsTheDigitsOfFlatProfiles) {
  const Array<double> z = fractional_brownian(500, 0.3, 4);
  const double larger = fractal_dimension(scaled(z, 1e-3)).D - 1,
               smaller = fractal_dimension(scaled(z, 1e-5)).D - 1;
  EXPECT_GT(smaller, 0);
  EXPECT_NEAR(larger / smaller, 1e4, 0.5);
}

TEST(LengthMethod, SaysWhenHeightsAreTooSmall) {
  const Array<double> z = fractional_brownian(2000, 0.5, 3);
  const FractalDimension flat = fractal_dimension(scaled(z, 0.1));
  EXPECT_FALSE(flat.resolved);
  EXPECT_EQ(flat.reason.substr(0, 84),
            "heights are too small for the length method: rms slopes run from 0.0984 at step 1 to");
  EXPECT_NE(flat.reason.find(
                "% of D - 1; a slope of 2 to 3.5 at the longest step is needed, or the method `structure`"),
            std::string::npos);
  const FractalDimension steep = fractal_dimension(scaled(z, 100));
  EXPECT_TRUE(steep.resolved) << steep.reason;
  EXPECT_EQ(steep.reason, "");
}

TEST(LengthMethod, HoldsForHeightsOfAnyMagnitude) {
  const Array<double> z = fractional_brownian(200, 0.5, 3);
  EXPECT_EQ(fractal_dimension(scaled(z, 1e-200)).D, 1);
  EXPECT_NEAR(fractal_dimension(scaled(z, 1e200)).D, fractal_dimension(scaled(z, 1e9)).D, 1e-9);
}

// D = 1.5 exactly by the structure function, without scaling.
TEST(FractalDimension, OfAFewJumpsIsNotResolved) {
  const auto reason = [](int samples, std::vector<int> jumps, DimensionMethod method) {
    Array<double> z(static_cast<std::size_t>(samples));
    for (int i = 0; i < samples; ++i)
      z[static_cast<std::size_t>(i)] = static_cast<double>(
          std::count_if(jumps.begin(), jumps.end(), [&](int jump) { return i >= jump; }) % 2);
    const FractalDimension d = fractal_dimension(Profile(1, std::move(z)), with(method));
    EXPECT_FALSE(d.resolved);
    return d.reason;
  };
  const std::string one = "one jump causes all height differences: the heights do not scale";
  for (const DimensionMethod method :
       {DimensionMethod::structure, DimensionMethod::psd, DimensionMethod::madogram}) {
    for (const int samples : {64, 101, 4096}) EXPECT_EQ(reason(samples, {samples / 3}, method), one);
    EXPECT_EQ(reason(4096, {1000, 3000}, method),
              "2 jumps cause most height differences: the heights do not scale");
  }
  const Surface surface = make_surface(64, 64, 1, 1, [](int i, int) { return i < 20 ? 0.0 : 1.0; });
  EXPECT_EQ(fractal_dimension(surface, with(DimensionMethod::structure)).reason, one);
}

TEST(FractalDimension, OfOtherMethodsIgnoresScaleAndOffset) {
  const Array<double> z = fractional_brownian(300, 0.6, 8);
  for (const DimensionMethod method : all_methods) {
    if (method == DimensionMethod::length) continue;
    const FractalDimension one = fractal_dimension(Profile(1, z), with(method));
    EXPECT_NEAR(fractal_dimension(scaled(z, 1e-160), with(method)).D, one.D, 1e-10);
    EXPECT_NEAR(fractal_dimension(scaled(z, 1e150, 1e-9), with(method)).D, one.D, 1e-10);
    Array<double> up(z);
    for (double& value : up) value += 1e4;
    if (method != DimensionMethod::box) {
      EXPECT_NEAR(fractal_dimension(Profile(1, up), with(method)).D, one.D, 1e-9);
    }
  }
}

TEST(StructureFunction, OfKnownHeights) {
  const Profile p(0.1, {0, 1, 3, 0});
  const FractalDimension d = fractal_dimension(p, with(DimensionMethod::structure, {1, 2}));
  EXPECT_NEAR(d.lengths[0], (1.0 + 4 + 9) / 3, 1e-14);
  EXPECT_NEAR(d.lengths[1], (9.0 + 1) / 2, 1e-14);
  EXPECT_NEAR(d.D, 2 - 0.5 * std::log(5 / (14.0 / 3)) / std::log(2.0), 1e-14);
  const FractalDimension m = fractal_dimension(p, with(DimensionMethod::madogram, {1, 2}));
  EXPECT_NEAR(m.lengths[0], 2, 1e-14);
  EXPECT_NEAR(m.lengths[1], 2, 1e-14);
  EXPECT_NEAR(m.D, 2, 1e-14);
}

TEST(StructureFunction, OfAStraightLineIsOne) {
  const Profile line = make_profile(100, 1, [](int i) { return 3.0 * i; });
  for (const DimensionMethod method : {DimensionMethod::structure, DimensionMethod::madogram}) {
    const FractalDimension d = fractal_dimension(line, with(method));
    EXPECT_NEAR(d.D, 1, 1e-12);
    EXPECT_NEAR(d.r_squared, 1, 1e-12);
    EXPECT_TRUE(d.resolved) << d.reason;
  }
}

// A diagonal meets 16, 8, 4 boxes of sides 1/16, 1/8, 1/4 and the next at all corners but the last; a full
// square meets all.
TEST(BoxCounting, OfADiagonalAndOfAFullSquare) {
  const Profile diagonal = make_profile(17, 1, [](int i) { return i / 16.0; });
  const FractalDimension d = fractal_dimension(diagonal, with(DimensionMethod::box, {1, 2, 4}));
  EXPECT_EQ(d.lengths, (std::vector<double>{31, 15, 7}));
  const Profile full = make_profile(1025, 1, [](int i) { return i % 2; });
  const FractalDimension f = fractal_dimension(full, with(DimensionMethod::box, {1, 2, 4, 8}));
  EXPECT_EQ(f.lengths, (std::vector<double>{1024. * 1024, 512. * 512, 256. * 256, 128. * 128}));
  EXPECT_NEAR(f.D, 2, 1e-12);
}

TEST(FractalDimension, DefaultStepsEndWhereTwoFit) {
  const auto steps_of = [](int n, DimensionMethod method) {
    return fractal_dimension(Profile(1, fractional_brownian(n, 0.5, 1)), with(method)).steps;
  };
  EXPECT_EQ(steps_of(150, DimensionMethod::length), (std::vector<double>{1, 2, 4, 8, 16}));
  EXPECT_EQ(steps_of(33, DimensionMethod::structure), (std::vector<double>{1, 2, 4, 8, 16}));
  EXPECT_EQ(steps_of(32, DimensionMethod::length), (std::vector<double>{1, 2, 4, 8}));
  EXPECT_EQ(steps_of(150, DimensionMethod::box), (std::vector<double>{1, 2, 4, 8, 16, 32}));
}

TEST(FractalDimension, OfProfilesTooShortIsNotResolved) {
  for (const DimensionMethod method : all_methods) {
    for (const int n : {1, 2, 3, 4}) {
      const FractalDimension d =
          fractal_dimension(make_profile(n, 1, [](int i) { return 1.0 * (i % 2); }), with(method));
      EXPECT_EQ(d.D, 1);
      EXPECT_EQ(d.error, 0);
      EXPECT_FALSE(d.resolved);
      EXPECT_NE(d.reason.find("are too short"), std::string::npos) << d.reason;
    }
  }
  EXPECT_EQ(fractal_dimension(Profile(1, {0, 1, 0})).reason,
            "profiles of 3 samples are too short: 1 step of at least 3 fits");
}

TEST(FractalDimension, OfEqualHeightsIsOneAndNotResolved) {
  for (const DimensionMethod method : all_methods) {
    const FractalDimension d =
        fractal_dimension(make_surface(40, 40, 1, 1, [](int, int) { return 0.1; }), with(method));
    EXPECT_EQ(d.D, 1);
    EXPECT_FALSE(d.resolved);
    EXPECT_EQ(d.reason, "all heights of a profile are equal");
  }
  const Profile rounding = make_profile(50, 1, [](int i) { return 1e6 + 1e-10 * (i % 3); });
  EXPECT_EQ(fractal_dimension(rounding, with(DimensionMethod::structure)).reason,
            "all heights of a profile are equal");
}

TEST(FractalDimension, SaysWhenSomeProfilesAreFlat) {
  const Array<double> z = fractional_brownian(60, 0.5, 1);
  const Surface s =
      make_surface(60, 4, 60, 4, [&](int i, int j) { return j == 2 ? 1.0 : z[static_cast<std::size_t>(i)]; });
  const FractalDimension d = fractal_dimension(s, with(DimensionMethod::structure));
  EXPECT_EQ(d.profiles, 3);
  EXPECT_FALSE(d.resolved);
  EXPECT_EQ(d.reason, "1 of 4 profiles have equal heights");
  EXPECT_NEAR(d.D, fractal_dimension(Profile(1, z), with(DimensionMethod::structure)).D, 1e-14);
}

// Differences over 4, 8 and 16 are zero and have no logarithm.
TEST(FractalDimension, SaysWhenHeightsDoNotScale) {
  const Profile p = make_profile(100, 1, [](int i) { return i % 4 == 0 ? 1.0 : 0.0; });
  const FractalDimension d = fractal_dimension(p, with(DimensionMethod::structure));
  EXPECT_TRUE(std::isfinite(d.D));
  EXPECT_FALSE(d.resolved);
  EXPECT_EQ(d.reason, "heights a step of 4 apart never differ: they repeat");
  const Profile smooth = make_profile(512, 1, [](int i) { return std::exp(-std::pow((i - 256) / 60.0, 2)); });
  const FractalDimension s = fractal_dimension(smooth, with(DimensionMethod::psd));
  EXPECT_FALSE(s.resolved);
  EXPECT_NE(s.reason.find("is outside 1 … 2: the heights do not scale over these bands"), std::string::npos)
      << s.reason;
}

TEST(FractalDimension, OfTwoStepsIsNotResolved) {
  const FractalDimension d = fractal_dimension(Profile(1, fractional_brownian(99, 0.5, 1)),
                                               with(DimensionMethod::structure, {1, 4}));
  EXPECT_EQ(d.reason, "2 steps always lie on a line; 3 or more are needed");
  EXPECT_GT(d.D, 1);
}

TEST(FractalDimension, OfASurfaceIsThatOfItsProfiles) {
  const Surface s = testing::white_noise(40, 24, 40, 24, 6);
  std::vector<Profile> rows, columns, both;
  for (int j = 0; j < 24; ++j)
    rows.emplace_back(1.0, Array<double>(s.heights().row(j).begin(), s.heights().row(j).end()));
  for (int i = 0; i < 40; ++i) columns.push_back(make_profile(24, 1, [&](int j) { return s.height(i, j); }));
  both = rows;
  both.insert(both.end(), columns.begin(), columns.end());
  for (const DimensionMethod method : all_methods) {
    for (const bool pooled : {false, true}) {
      FractalDimensionOptions options = with(method);
      options.pooled = pooled;
      const auto expect_equal = [&](Along along, std::span<const Profile> profiles) {
        options.along = along;
        const FractalDimension a = fractal_dimension(s, options), b = fractal_dimension(profiles, options);
        EXPECT_NEAR(a.D, b.D, 1e-13);
        EXPECT_NEAR(a.error, b.error, 1e-13);
        ASSERT_EQ(a.lengths.size(), b.lengths.size());
        for (std::size_t k = 0; k < a.lengths.size(); ++k) EXPECT_NEAR(a.lengths[k] / b.lengths[k], 1, 1e-13);
        EXPECT_EQ(a.profiles, static_cast<int>(profiles.size()));
      };
      expect_equal(Along::x, rows);
      expect_equal(Along::y, columns);
      expect_equal(Along::both, both);
    }
  }
}

TEST(FractalDimension, ErrorIsTheScatterOverProfiles) {
  const Profile a(1, fractional_brownian(80, 0.5, 1)), b(1, fractional_brownian(80, 0.5, 2));
  const FractalDimensionOptions options = with(DimensionMethod::structure);
  const double Da = fractal_dimension(a, options).D, Db = fractal_dimension(b, options).D;
  const Profile pair[] = {a, b};
  const FractalDimension d = fractal_dimension(pair, options);
  EXPECT_NEAR(d.D, (Da + Db) / 2, 1e-15);
  EXPECT_NEAR(d.error, std::abs(Da - Db) / std::sqrt(2.0), 1e-14);
  EXPECT_GT(fractal_dimension(a, options).error, 0);
}

TEST(FractalDimension, SameBitsForAnyNumberOfThreads) {
  const Surface s = testing::white_noise(70, 60, 1, 1, 6);
  for (const DimensionMethod method : all_methods) {
    set_thread_count(1);
    const FractalDimension one = fractal_dimension(s, with(method));
    set_thread_count(2);
    const FractalDimension two = fractal_dimension(s, with(method));
    set_thread_count(0);
    EXPECT_EQ(one.D, two.D);
    EXPECT_EQ(one.error, two.error);
  }
}

TEST(FractalDimension, RefusesStepsThatMeanNothing) {
  const Profile p(1, fractional_brownian(50, 0.5, 1));
  const auto text = [&](DimensionMethod method, std::vector<int> steps) {
    return error_text([&] { fractal_dimension(p, with(method, steps)); });
  };
  EXPECT_EQ(text(DimensionMethod::length, {0, 1}),
            "`steps` holds 0 for profiles of 50 samples; a step is a whole number of samples from 1 to 49");
  EXPECT_EQ(text(DimensionMethod::structure, {1, 50}),
            "`steps` holds 50 for profiles of 50 samples; a step is a whole number of samples from 1 to 49");
  EXPECT_EQ(text(DimensionMethod::structure, {1, 49}), "no error");
  EXPECT_EQ(text(DimensionMethod::box, {1, 2, 1}), "`steps` holds 1 more than once; give each step once");
  EXPECT_EQ(text(DimensionMethod::length, {3}), "`steps` holds one step; a slope needs two steps or more");
  EXPECT_EQ(
      text(DimensionMethod::psd, {1, 2}),
      "`steps` were given for the method `psd`; it fits bands of wavelengths of its own; leave `steps` out");
  EXPECT_EQ(error_text([] { fractal_dimension(std::span<const Profile>(), {}); }),
            "a fractal dimension needs profiles, and there are none; give one profile or more");
  FractalDimensionOptions options;
  options.along = Along::both;
  options.pooled = true;
  EXPECT_EQ(error_text([&] { fractal_dimension(testing::white_noise(20, 20, 1, 2, 1), options); }),
            "`pooled` needs square cells, and these are 0.05 m x 0.1 m; use `along=\"x\"`, `along=\"y\"` or "
            "leave `pooled` out");
}

}  // namespace
}  // namespace asperity::fractal_dimension_test
