// SPDX-License-Identifier: GPL-3.0-or-later
// Independent values: 15 Weierstrass–Mandelbrot surfaces, means over 20 seeds, whole and cut; fractional
// Brownian profiles.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "engine/core/parallel.hpp"
#include "engine/metrology/fractal_dimension.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "tests/metrology/test_fields.hpp"

namespace asperity::dimension_reference_test {
namespace {

// 150 x 150 cells; peak-to-valley 0.1·(cells - 1) cell widths.
Surface published_surface(double D, double span, std::uint64_t seed) {
  WeierstrassMandelbrotOptions options;
  options.nx = options.ny = 150;
  options.D = D;
  options.span = span;
  options.seed = seed;
  const Surface raw = weierstrass_mandelbrot(options);
  const double factor = 0.1 * 149 * raw.grid().hx() / raw.peak_to_valley();
  Field z = raw.heights();
  for (double& value : z.values()) value *= factor;
  return Surface(raw.grid(), std::move(z));
}

// Each row is cut at its maximum less `fraction` of its peak-to-valley.
double dimension_cut(const Surface& surface, double fraction) {
  std::vector<Profile> profiles;
  for (int j = 0; j < surface.grid().ny; ++j) {
    Array<double> z(surface.heights().row(j).begin(), surface.heights().row(j).end());
    const Range r = range(z);
    for (double& value : z) value = std::min(value, r.max - fraction * r.span());
    profiles.emplace_back(surface.grid().hx(), std::move(z));
  }
  return fractal_dimension(profiles).D;
}

TEST(DimensionReference, OfSingleSurfacesToTwelveDigits) {
  std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/box_contact.csv");
  ASSERT_TRUE(file);
  std::string line;
  std::getline(file, line);
  std::getline(file, line);
  int cases = 0;
  while (std::getline(file, line)) {
    std::vector<std::string> columns;
    std::istringstream text(line);
    for (std::string column; std::getline(text, column, ',');) columns.push_back(column);
    ASSERT_EQ(columns.size(), 15u);
    const Surface surface =
        published_surface(std::stod(columns[1]), columns[0] == "A" ? 1 : 3, std::stoull(columns[2]));
    const FractalDimension whole = fractal_dimension(surface);
    EXPECT_NEAR(whole.D, std::stod(columns[13]), 1e-11) << line;
    EXPECT_NEAR(dimension_cut(surface, 0.2), std::stod(columns[14]), 1e-11) << line;
    EXPECT_FALSE(whole.resolved);
    ++cases;
  }
  EXPECT_EQ(cases, 15);
}

struct Row {
  double span, D, whole, tenth, fifth, scatter;  // 0: not tabulated
};

constexpr Row table[] = {
    {1, 2.0, 1.0051, 1.0047, 1.0042, .0012}, {1, 2.1, 1.0080, 1.0073, 1.0065, .0017},
    {1, 2.2, 1.0125, 1.0115, 1.0104, .0025}, {1, 2.3, 1.0199, 1.0185, 1.0166, .0035},
    {1, 2.4, 1.0311, 1.0292, 1.0264, .0047}, {1, 2.5, 1.0481, 1.0457, 1.0416, .0063},
    {1, 2.6, 1.0727, 1.0697, 1.0642, .0081}, {1, 2.7, 1.1066, 1.1033, 1.0963, .0101},
    {1, 2.8, 1.1520, 1.1485, 1.1402, .0106}, {1, 2.9, 1.2110, 1.2074, 1.1982, .0123},
    {3, 2.0, 1.0238, 0, 1.0211, .0026},      {3, 2.1, 1.0307, 0, 1.0273, 0},
    {3, 2.3, 1.0528, 0, 1.0473, 0},          {3, 2.5, 1.0911, 0, 1.0827, .0085},
    {3, 2.7, 1.1501, 0, 1.1391, 0},          {3, 2.8, 1.1898, 0, 1.1778, 0},
    {3, 2.9, 1.2355, 0, 1.2226, .0125},
};

constexpr int seeds = 20;

// Within half a unit of the last printed digit.
TEST(DimensionReference, OfTwentySeedsToTheLastDigit) {
  std::vector<double> values(std::size(table) * seeds * 3);
  parallel_for(static_cast<std::int64_t>(std::size(table)) * seeds, [&](std::int64_t k) {
    const Row& row = table[k / seeds];
    const Surface surface = published_surface(row.D, row.span, static_cast<std::uint64_t>(k % seeds) + 1);
    double* out = &values[static_cast<std::size_t>(3 * k)];
    out[0] = fractal_dimension(surface).D;
    out[1] = dimension_cut(surface, 0.1);
    out[2] = dimension_cut(surface, 0.2);
  });
  const double half_unit = 0.5e-4 * (1 + 1e-6);
  std::map<std::pair<double, double>, double> kept;
  for (std::size_t t = 0; t < std::size(table); ++t) {
    const Row& row = table[t];
    double sum[3] = {}, squares = 0;
    for (std::size_t k = 0; k < seeds; ++k)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += values[3 * (t * seeds + k) + c] / seeds;
    for (std::size_t k = 0; k < seeds; ++k) squares += std::pow(values[3 * (t * seeds + k)] - sum[0], 2);
    EXPECT_NEAR(sum[0], row.whole, half_unit) << row.span << " " << row.D;
    if (row.tenth > 0) {
      EXPECT_NEAR(sum[1], row.tenth, half_unit) << row.span << " " << row.D;
    }
    EXPECT_NEAR(sum[2], row.fifth, half_unit) << row.span << " " << row.D;
    if (row.scatter > 0) {
      EXPECT_NEAR(std::sqrt(squares / (seeds - 1)), row.scatter, half_unit) << row.span << " " << row.D;
    }
    EXPECT_GT(sum[0], sum[1]);
    EXPECT_GT(sum[1], sum[2]);
    kept[{row.span, row.D}] = (sum[2] - 1) / (sum[0] - 1);
  }
  // Share of D - 1 left by a cut of 20 %.
  const double left[][3] = {
      {2.1, .822, .889}, {2.3, .835, .895}, {2.5, .865, .908}, {2.7, .904, .927}, {2.9, .939, .945}};
  for (const auto& [D, A, B] : left) {
    EXPECT_NEAR((kept[{1.0, D}]), A, 0.5e-3 * (1 + 1e-6)) << D;
    EXPECT_NEAR((kept[{3.0, D}]), B, 0.5e-3 * (1 + 1e-6)) << D;
  }
}

// Over 30 exact fractional Brownian profiles; 0: unknown.
struct Estimate {
  double mean, scatter;
};
struct EstimatorRow {
  int n;
  double D;
  Estimate steep;  // length, slopes much over 1
  double tenth;    // length, standard deviation 0.1·n spacings
  double one;      // length, standard deviation 1 spacing
  Estimate structure, psd;
  double box;
};

constexpr EstimatorRow estimators[] = {
    {150, 1.1, {1.143, .08}, 1.046, 1.000, {1.147, .07}, {0.991, .24}, 1.064},
    {150, 1.5, {1.490, .08}, 1.309, 1.009, {1.499, .07}, {1.489, .15}, 1.267},
    {150, 1.9, {1.922, .08}, 1.791, 1.110, {1.917, .04}, {2.147, .19}, 1.526},
    {1024, 1.5, {1.511, .05}, 1.389, 1.001, {1.505, .05}, {1.520, .12}, 1.352},
    {8000, 1.1, {1.105, .06}, 1.047, 1.000, {1.117, .05}, {1.048, .05}, 1.074},
    {8000, 1.5, {1.493, .02}, 1.409, 1.000, {1.498, .02}, {1.503, .05}, 1.386},
    {8000, 1.9, {1.907, .03}, 1.863, 1.015, {1.900, .01}, {1.956, .05}, 1.700},
};

FractalDimension measured(std::span<const Array<double>> heights, DimensionMethod method,
                          double relative_deviation, const std::vector<int>& steps) {
  std::vector<Profile> profiles;
  for (const Array<double>& one : heights) {
    const double centre = mean(one);
    double squares = 0;
    for (const double z : one) squares += (z - centre) * (z - centre);
    const double factor = relative_deviation / std::sqrt(squares / static_cast<double>(one.size()));
    Array<double> z(one);
    for (double& value : z) value *= factor;
    profiles.emplace_back(1.0, std::move(z));
  }
  FractalDimensionOptions options;
  options.method = method;
  options.steps = steps;
  return fractal_dimension(profiles, options);
}

// Three standard errors of the difference of two means of 30, and half a printed digit.
TEST(DimensionReference, OfFractionalBrownianProfiles) {
  const int count = 30;
  for (const EstimatorRow& row : estimators) {
    std::vector<Array<double>> heights;
    for (std::uint64_t seed = 1; seed <= count; ++seed)
      heights.push_back(testing::fractional_brownian(row.n, 2 - row.D, seed));
    // Steps double up to an eighth of the profile.
    std::vector<int> steps;
    for (int s = 1; s <= row.n / 8; s *= 2) steps.push_back(s);
    const auto check = [&](const FractalDimension& d, Estimate known, const char* name) {
      const double scatter = known.scatter > 0 ? known.scatter : d.error;
      EXPECT_NEAR(d.D, known.mean, 3 * std::hypot(d.error, scatter) / std::sqrt(1.0 * count) + 0.5e-3)
          << name << " of " << row.n << " samples of D " << row.D;
    };
    check(measured(heights, DimensionMethod::length, 1e9, steps), row.steep, "steep length");
    check(measured(heights, DimensionMethod::structure, 1, steps), row.structure, "structure");
    check(measured(heights, DimensionMethod::madogram, 1, steps), row.structure, "madogram");
    check(measured(heights, DimensionMethod::psd, 1, {}), row.psd, "psd");
    check(measured(heights, DimensionMethod::length, 0.1 * row.n, steps), {row.tenth, 0}, "length, tenth");
    check(measured(heights, DimensionMethod::length, 1, steps), {row.one, 0}, "length, one");
    // Box counting ignores segments between samples; the loss depends on the box sides.
    EXPECT_NEAR(measured(heights, DimensionMethod::box, 1, {}).D, row.box, 0.03);
  }
}

}  // namespace
}  // namespace asperity::dimension_reference_test
