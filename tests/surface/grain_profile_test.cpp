// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/grain_profile.hpp"
#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::grain_profile_test {
namespace {

GrainProfileOptions example(int points = 360) {
  GrainProfileOptions options;
  options.radius = 0.25e-3;
  options.D = 1.3;
  options.points = points;
  return options;
}

std::string refusal(const GrainProfileOptions& options) {
  return test::refusal([&] { grain_profile(options); });
}

double measured_structure_function(const Array<double>& w, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double step = w[(i + lag) % w.size()] - w[i];
    sum += step * step;
  }
  return sum / static_cast<double>(w.size());
}

// Exact: Σ_n γ^(2(D-2)n) (1 - cos(2πk_n lag/K)), with 1 - cos x = 2 sin²(x/2).
double structure_function(const GrainProfileOptions& options, int lag) {
  double sum = 0;
  for (const GrainTerm& term : grain_terms(options)) {
    const double sine = std::sin(pi * term.waves * lag / options.points);
    sum += 2 * term.amplitude * term.amplitude * sine * sine;
  }
  return sum;
}

TEST(GrainProfile, StructureFunctionIsExactForEverySeed) {
  for (const int points : {7, 97, 360, 1000})
    for (const double D : {1.05, 1.3, 1.8})
      for (const double gamma : {1.05, 1.5, 2.0})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
          GrainProfileOptions options = example(points);
          options.D = D;
          options.gamma = gamma;
          options.seed = seed;
          const Array<double> w = grain_outline(options);
          const double largest = structure_function(options, points / 2);
          for (const int lag : {0, 1, 2, 5, points / 3, points - 1})
            EXPECT_NEAR(measured_structure_function(w, static_cast<std::size_t>(lag)),
                        structure_function(options, lag), 1e-12 * largest)
                << points << " D " << D << " gamma " << gamma << " lag " << lag;
        }
}

TEST(GrainProfile, StructureFunctionIsTheWrittenSum) {
  const GrainProfileOptions options = example(20);  // k = 3, 5, 7; 10, half the points, is excluded
  const Array<double> w = grain_outline(options);
  for (const int q : {1, 4, 19}) {
    const auto term = [&](int k, int n) {
      return std::pow(1.5, 2 * (1.3 - 2) * n) * (1 - std::cos(2 * pi * k * q / 20));
    };
    EXPECT_NEAR(measured_structure_function(w, static_cast<std::size_t>(q)),
                term(3, 0) + term(5, 1) + term(7, 2), 1e-13);
  }
}

TEST(GrainProfile, TermsStopBeforeHalfThePoints) {
  const auto waves = [](int points, double gamma) {
    GrainProfileOptions options = example(points);
    options.gamma = gamma;
    std::vector<int> k;
    for (const GrainTerm& term : grain_terms(options)) k.push_back(term.waves);
    return k;
  };
  EXPECT_EQ(waves(7, 1.5), (std::vector<int>{3}));
  EXPECT_EQ(waves(20, 1.5), (std::vector<int>{3, 5, 7}));
  EXPECT_EQ(waves(21, 1.5), (std::vector<int>{3, 5, 7, 10}));
  EXPECT_EQ(waves(100, 1.5), (std::vector<int>{3, 5, 7, 10, 15, 23, 34}));
  EXPECT_EQ(waves(100, 100), (std::vector<int>{3}));
  const std::vector<int> dense = waves(1000, 1.01);
  EXPECT_EQ(std::set<int>(dense.begin(), dense.end()).size(), dense.size());
  EXPECT_LT(dense.back(), 500);
}

TEST(GrainProfile, ATermKeepsItsPhaseOnMorePoints) {
  const std::vector<GrainTerm> few = grain_terms(example(100));
  const std::vector<GrainTerm> many = grain_terms(example(10000));
  ASSERT_GT(many.size(), few.size());
  for (std::size_t n = 0; n < few.size(); ++n) {
    EXPECT_EQ(few[n].phase, many[n].phase);
    EXPECT_EQ(few[n].waves, many[n].waves);
    EXPECT_EQ(few[n].amplitude, many[n].amplitude);
  }
}

TEST(GrainProfile, AmplitudeIsMetExactly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    GrainProfileOptions options = example();
    options.seed = seed;
    options.amplitude = 0.07;
    const Profile grain = grain_profile(options);
    EXPECT_EQ(grain.height_range().max, 0.07 * 0.25e-3);
    EXPECT_EQ(grain.height_range().min, -0.07 * 0.25e-3);
  }
}

TEST(GrainProfile, HeightsAreTheOutlineScaled) {
  const GrainProfileOptions options = example();
  const Array<double> w = grain_outline(options);
  const Profile grain = grain_profile(options);
  const Range range_of_w = range(w);
  for (std::size_t i = 1; i < w.size(); ++i)
    EXPECT_NEAR(grain.heights()[i] - grain.heights()[0],
                2 * 0.1 * 0.25e-3 / range_of_w.span() * (w[i] - w[0]), 1e-15 * 0.25e-3);
  EXPECT_EQ(w[0], 0.0);
}

TEST(GrainProfile, IsAClosedProfile) {
  const Profile grain = grain_profile(example(1000));
  EXPECT_EQ(grain.size(), 1000);
  EXPECT_EQ(grain.closed_radius(), 0.25e-3);
  EXPECT_DOUBLE_EQ(grain.length(), 2 * std::numbers::pi * 0.25e-3);
}

TEST(GrainProfile, NoAmplitudeIsACircle) {
  GrainProfileOptions options = example();
  options.amplitude = 0;
  const Profile circle = grain_profile(options);
  for (const double height : circle.heights()) EXPECT_EQ(height, 0.0);
}

TEST(GrainProfile, SameBitsForAnyNumberOfThreads) {
  set_thread_count(1);
  const std::string one = grain_profile(example(100000)).digest();
  set_thread_count(2);
  EXPECT_EQ(grain_profile(example(100000)).digest(), one);
  set_thread_count(0);
}

TEST(GrainProfile, Refusals) {
  const auto with = [](auto member, auto value) {
    GrainProfileOptions options = example();
    options.*member = value;
    return refusal(options);
  };
  EXPECT_EQ(with(&GrainProfileOptions::radius, 0.0), "`radius` is 0; give a finite length above zero");
  const std::string dimension = "; give a dimension between 1 and 2, both excluded";
  EXPECT_EQ(with(&GrainProfileOptions::D, 1.0), "`D` is 1" + dimension);
  EXPECT_EQ(with(&GrainProfileOptions::D, 2.0), "`D` is 2" + dimension);
  EXPECT_EQ(with(&GrainProfileOptions::D, std::nan("")), "`D` is nan" + dimension);
  EXPECT_EQ(with(&GrainProfileOptions::D, std::nextafter(1.0, 2.0)), "accepted");
  EXPECT_EQ(with(&GrainProfileOptions::D, std::nextafter(2.0, 1.0)), "accepted");
  EXPECT_EQ(with(&GrainProfileOptions::amplitude, 1.0),
            "`amplitude` is 1; give a fraction of the radius, from 0 to below 1");
  EXPECT_EQ(with(&GrainProfileOptions::points, 6), "`points` is 6; give a whole number from 7 to 16777216");
  EXPECT_EQ(with(&GrainProfileOptions::gamma, 1.0), "`gamma` is 1; give a number from 1.01 to 1e6");
}

}  // namespace
}  // namespace asperity::grain_profile_test
