// SPDX-License-Identifier: GPL-3.0-or-later
// Forty holes against other programs (map P4 of tests/reference/metrology_maps.csv), a plane, and very few
// points.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/metrology/fractal_dimension.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/metrology/spectrum.hpp"
#include "engine/metrology/stylus.hpp"
#include "engine/surface/operations/operations.hpp"
#include "tests/metrology/test_fields.hpp"

namespace asperity::holed_map_test {
namespace {

using testing::make_surface;

const double hole = std::numeric_limits<double>::quiet_NaN();
constexpr int cells = 256;

double fr(double v) { return v - std::floor(v); }

struct HoledMap {
  Surface complete, holed;
  std::map<std::string, double> reference;
};

bool in_a_hole(int i, int j) {
  const double G = (std::sqrt(5.0) - 1) / 2;
  for (int k = 1; k <= 40; ++k) {
    const double x = i - cells * fr(k * G + 0.05), y = j - cells * fr(k * std::sqrt(2.0) + 0.05);
    const double radius = 2 + 8 * fr(k * std::sqrt(3.0) + 0.05);
    if (x * x + y * y <= radius * radius) return true;
  }
  return false;
}

const HoledMap& holed_map() {
  static const HoledMap map = [] {
    const double G = (std::sqrt(5.0) - 1) / 2, s = 0.123;
    Field z(cells, cells);
    // cos(a x + b y + c) from tables.
    std::vector<double> cos_x(cells), sin_x(cells);
    for (int k = 1; k <= 400; ++k) {
      const double q = 4 * std::pow(15.0, (k - 1) / 399.0), t = 2 * pi * fr(k * std::sqrt(2.0) + s);
      const double u = std::rint(q * std::cos(t)), v = std::rint(q * std::sin(t));
      const double amplitude = 10 * std::pow(q, -1.8), phase = 2 * pi * fr(k * G + s);
      for (int i = 0; i < cells; ++i) {
        const double turns = std::fmod(u * i, cells) / cells;
        cos_x[static_cast<std::size_t>(i)] = std::cos(2 * pi * turns + phase);
        sin_x[static_cast<std::size_t>(i)] = std::sin(2 * pi * turns + phase);
      }
      for (int j = 0; j < cells; ++j) {
        const double turns = std::fmod(v * j, cells) / cells;
        const double c = amplitude * std::cos(2 * pi * turns), d = amplitude * std::sin(2 * pi * turns);
        for (int i = 0; i < cells; ++i)
          z(i, j) += c * cos_x[static_cast<std::size_t>(i)] - d * sin_x[static_cast<std::size_t>(i)];
      }
    }
    const Grid grid = make_grid(cells, cells, cells, cells);
    Field holes = z;
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        if (in_a_hole(i, j)) holes(i, j) = hole;
    std::map<std::string, double> reference;
    std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/metrology_maps.csv");
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with("P4,")) continue;
      const std::size_t name = 3, value = line.find(',', name) + 1;
      reference[line.substr(name, value - 1 - name)] = std::strtod(line.c_str() + value, nullptr);
    }
    return HoledMap{Surface(grid, z), Surface::with_holes(grid, std::move(holes)), std::move(reference)};
  }();
  return map;
}

Surface holed_plane(double p, double q) {
  const Grid grid = make_grid(101, 81, 101 * 0.5, 81 * 0.8);
  Field z(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      z(i, j) = (i - 40) * (i - 40) + (j - 30) * (j - 30) <= 200 ? hole : p * (i * 0.5) + q * (j * 0.8);
  return Surface::with_holes(grid, std::move(z));
}

Surface mostly_missing(int nx, int ny, std::vector<std::pair<int, int>> measured) {
  Field z(nx, ny, hole);
  double height = 1;
  for (const auto& [i, j] : measured) z(i, j) = height *= -1.5;
  return Surface::with_holes(make_grid(nx, ny, nx, ny), std::move(z));
}

TEST(HoledMap, HasTheParametersOfOtherPrograms) {
  const auto& [complete, holed, reference] = holed_map();
  const auto expect = [&reference = reference](const std::string& name, double value) {
    EXPECT_NEAR(value, reference.at(name), 1e-9 * std::abs(reference.at(name))) << name;
  };
  const Roughness r = roughness(holed);
  ASSERT_TRUE(r.measured.has_value());
  expect("n_measured", static_cast<double>(*r.measured));
  expect("Sa", r.Ra);
  expect("Sq", r.Rq);
  expect("Sp", r.peak - r.mean);
  expect("Sv", r.mean - r.valley);
  expect("Sz", r.amplitude);
  expect("Ssk", r.skewness);
  expect("Sku", r.kurtosis);
  expect("Sdq_edge", r.rms_slope);
  expect("Sq_after_form2", roughness(levelled(holed, 2)).Rq);
  EXPECT_FALSE(roughness(complete).measured.has_value());
}

// The reference cuts its kernel at 1e-6, this program at 1e-16.
TEST(HoledMap, IsFilteredAsByOtherPrograms) {
  const auto& [complete, holed, reference] = holed_map();
  const Surface smooth = gaussian_filtered(holed, {.short_wave = 20.0, .long_wave = {}});
  const Surface rough = gaussian_filtered(holed, {.short_wave = {}, .long_wave = 20.0});
  EXPECT_NEAR(roughness(smooth).Rq, reference.at("Sq_of_S20"), 1e-6);
  EXPECT_NEAR(roughness(rough).Rq, reference.at("Sq_after_L20"), 1e-6);
  EXPECT_EQ(smooth.measured(), holed.measured());
  for (std::size_t k = 0; k < smooth.measured_heights().size(); ++k)
    ASSERT_EQ(std::isnan(smooth.measured_heights()[k]), std::isnan(holed.measured_heights()[k]));
}

TEST(HoledMap, PlaneHasItsSlopeAndLeavesNothing) {
  const Surface plane = holed_plane(0.3, -0.2);
  EXPECT_NEAR(roughness(plane).rms_slope, std::sqrt(0.13), 1e-9);
  for (const int degree : {1, 2, 5}) {
    const Surface rest = levelled(plane, degree);
    EXPECT_EQ(rest.measured(), plane.measured());
    EXPECT_LT(roughness(rest).Rq, 1e-13) << degree;
  }
}

TEST(HoledMap, LevelledIsLeastSquaresOverWhatWasMeasured) {
  // 1e6 at missing points would change a fit.
  const Surface plane = holed_plane(0.3, -0.2);
  Field rough = plane.measured_heights();
  for (std::size_t k = 0; k < rough.size(); ++k)
    rough[k] += std::sin(12.9898 * static_cast<double>(k * k % 977));
  const Surface surface = Surface::with_holes(plane.grid(), rough);
  const Surface rest = levelled(surface, 2);
  // Orthogonal to every polynomial of the degree.
  const Field& z = rest.measured_heights();
  for (int a = 0; a <= 2; ++a)
    for (int b = 0; a + b <= 2; ++b) {
      double sum = 0;
      for (int j = 0; j < z.ny(); ++j)
        for (int i = 0; i < z.nx(); ++i)
          if (!std::isnan(z(i, j))) sum += z(i, j) * std::pow(i / 100.0, a) * std::pow(j / 80.0, b);
      EXPECT_NEAR(sum / static_cast<double>(rest.measured()), 0, 1e-14) << a << " " << b;
    }
  EXPECT_NEAR(roughness(levelled(rest, 2)).Rq, roughness(rest).Rq, 1e-14);
}

// A corner, a diagonal, and fewer points than terms.
TEST(HoledMap, LevellingTakesAwayWhatFewPointsShow) {
  Field corner(64, 64, hole), diagonal(64, 64, hole);
  for (int j = 0; j < 5; ++j)
    for (int i = 58; i < 64; ++i) corner(i, j) = 3 + 0.1 * i - 0.7 * j + 0.01 * i * j;
  for (int i = 0; i < 64; ++i) diagonal(i, i) = 2 - 0.3 * i + 0.002 * i * i;
  const Grid grid = make_grid(64, 64, 64, 64);
  EXPECT_LT(roughness(levelled(Surface::with_holes(grid, corner), 2)).Rq, 1e-12);
  EXPECT_GT(roughness(levelled(Surface::with_holes(grid, corner), 1)).Rq, 1e-4);
  EXPECT_LT(roughness(levelled(Surface::with_holes(grid, diagonal), 2)).Rq, 1e-12);
  EXPECT_LT(roughness(levelled(mostly_missing(64, 64, {{3, 60}, {50, 2}, {63, 63}}), 1)).Rq, 1e-14);
  EXPECT_EQ(roughness(levelled(mostly_missing(64, 64, {{3, 60}}), 3)).Rq, 0);
}

TEST(HoledMap, StatisticsOfNextToNothing) {
  const Roughness one = roughness(mostly_missing(9, 7, {{8, 6}}));
  EXPECT_EQ(one.measured, 1);
  EXPECT_EQ(one.Rq, 0);
  EXPECT_EQ(one.mean, -1.5);
  EXPECT_TRUE(std::isnan(one.rms_slope));  // no pair of neighbours
  const Roughness pair = roughness(mostly_missing(9, 7, {{3, 3}, {4, 3}}));
  EXPECT_EQ(pair.amplitude, 3.75);
  EXPECT_TRUE(std::isnan(pair.rms_slope));
  const Roughness row = roughness(mostly_missing(9, 1, {{3, 0}, {4, 0}, {8, 0}}));
  EXPECT_NEAR(row.rms_slope, 3.75, 1e-14);
  // Two rows share no pair.
  EXPECT_TRUE(std::isnan(roughness(mostly_missing(9, 7, {{8, 3}, {0, 4}, {0, 5}})).rms_slope));
  const Spectrum s = spectrum(mostly_missing(9, 7, {{8, 6}}));
  EXPECT_EQ(s.measured, 1);
  EXPECT_EQ(s.rms_height, 0);
  EXPECT_EQ(
      gaussian_filtered(mostly_missing(9, 7, {{8, 6}}), {.short_wave = 3.0, .long_wave = {}}).height(8, 6),
      -1.5);
}

TEST(HoledMap, FilterKeepsAConstantAndBendsNothingFarFromHoles) {
  Field z(64, 48, 7.25);
  for (int j = 10; j < 15; ++j)
    for (int i = 0; i < 9; ++i) z(i, j) = hole;
  z(63, 47) = hole;
  const Grid grid = make_grid(64, 48, 64, 48);
  for (const bool periodic : {false, true}) {
    const Surface surface =
        Surface::with_holes(grid, z, {.material = {}, .periodic = periodic, .aliased_share = {}});
    const Surface smooth = gaussian_filtered(surface, {.short_wave = 8.0, .long_wave = {}});
    EXPECT_EQ(smooth.digest(), surface.digest());
    EXPECT_EQ(gaussian_filtered(surface, {.short_wave = {}, .long_wave = 8.0}).height_range().max, 0);
  }
  const auto wave = [&](int i, int) { return std::cos(2 * pi * 4 * i / 64); };
  const Surface whole = make_surface(64, 48, 64, 48, wave);
  Field mask(64, 48, 1);
  mask(0, 0) = 0;
  const SurfaceTraits wraps{.material = {}, .periodic = true, .aliased_share = {}};
  const Surface complete(grid, whole.heights(), wraps);
  const Surface holed = masked(complete, mask);
  const GaussianFilter filter{.short_wave = 6.0, .long_wave = {}};
  const Surface a = gaussian_filtered(complete, filter), b = gaussian_filtered(holed, filter);
  EXPECT_NEAR(a.height(32, 24), b.height(32, 24), 1e-10);  // kernel cut at Nyquist
  EXPECT_GT(std::abs(a.height(1, 0) - b.height(1, 0)), 1e-3);
}

TEST(HoledMap, SpectrumSetsHolesToTheMean) {
  const auto& [complete, holed, reference] = holed_map();
  const Spectrum s = spectrum(holed, {.window = Window::none});
  EXPECT_EQ(s.measured, 60478);
  // Holes at the mean add nothing: the power is the measured share.
  const double share = 60478.0 / (cells * cells);
  EXPECT_NEAR(s.rms_height, roughness(holed).Rq * std::sqrt(share), 1e-12);
  Field at_mean = holed.measured_heights();
  const double mean = known_mean(at_mean.values());
  for (double& z : at_mean.values()) z = std::isnan(z) ? mean : z;
  const Spectrum same = spectrum(Surface(holed.grid(), at_mean), {.window = Window::none});
  ASSERT_EQ(s.C.size(), same.C.size());
  for (std::size_t k = 0; k < s.C.size(); ++k) EXPECT_NEAR(s.C[k], same.C[k], 1e-12 * same.C[k]);
  EXPECT_FALSE(spectrum(complete).measured.has_value());
}

TEST(HoledMap, DimensionByPairsThatWereMeasured) {
  const auto& [complete, holed, reference] = holed_map();
  for (const DimensionMethod method : {DimensionMethod::structure, DimensionMethod::madogram}) {
    FractalDimensionOptions options;
    options.method = method;
    options.pooled = true;
    const FractalDimension a = fractal_dimension(complete, options), b = fractal_dimension(holed, options);
    EXPECT_EQ(b.measured, 60478);
    EXPECT_FALSE(a.measured.has_value());
    EXPECT_NEAR(a.D, b.D, 0.01);  // effect of 8 % of the pairs
    EXPECT_NE(a.D, b.D);
  }
  // Structure function at step 1 by definition.
  FractalDimensionOptions options;
  options.method = DimensionMethod::structure;
  const FractalDimension found = fractal_dimension(holed, options);
  double mean_of_rows = 0;
  const Field& z = holed.measured_heights();
  for (int j = 0; j < cells; ++j) {
    double sum = 0;
    int pairs = 0;
    for (int i = 0; i + 1 < cells; ++i)
      if (const double d = z(i + 1, j) - z(i, j); !std::isnan(d)) sum += d * d, ++pairs;
    mean_of_rows += sum / pairs / cells;
  }
  EXPECT_NEAR(found.lengths.front(), mean_of_rows, 1e-12);
  for (const DimensionMethod method : {DimensionMethod::psd, DimensionMethod::box}) {
    options.method = method;
    EXPECT_NE(testing::error_text([&, &holed = holed] {
                fractal_dimension(holed, options);
              }).find("5058 of 65536 were not measured"),
              std::string::npos);
  }
}

TEST(HoledMap, ProfilesOfWhichNothingCanBeSaidGiveNoDimension) {
  Field z(32, 4, hole);
  for (int i = 0; i < 32; ++i) z(i, 0) = std::sin(i * 1.7) + 0.1 * i;  // complete
  for (int i = 0; i < 32; i += 2) z(i, 1) = i % 3;                     // no pair at step 1
  z(5, 2) = 1;                                                         // one sample
  const Surface surface = Surface::with_holes(make_grid(32, 4, 32, 4), z);
  FractalDimensionOptions options;
  options.method = DimensionMethod::structure;
  const FractalDimension found = fractal_dimension(surface, options);
  EXPECT_EQ(found.profiles, 1);
  EXPECT_EQ(found.D, fractal_dimension(profile_row(surface, 0), options).D);
  EXPECT_FALSE(fractal_dimension(profile_row(surface, 1), options).resolved);
}

TEST(HoledMap, NeedlesCrossHolesAndTipsRefuseThem) {
  const Surface& holed = holed_map().holed;
  const Stylus needle({.tip = 0, .spacing = 0.5, .length = 100, .speed = {}, .rate = {}});
  const StylusScan scan = needle.scan(holed, 12, 3);
  std::size_t measured = 0, all = 0;
  for (const Profile& trace : scan.traces) {
    measured += trace.measured();
    all += static_cast<std::size_t>(trace.size());
  }
  EXPECT_LT(measured, all);
  EXPECT_GT(measured, all / 2);
  EXPECT_EQ(scan.effect.ra_ratio, 1);
  EXPECT_EQ(scan.effect.greatest_lift, 0);
  const StylusScan whole = needle.scan(holed_map().complete, 12, 3);
  for (std::size_t t = 0; t < scan.traces.size(); ++t) {
    for (std::size_t k = 0; k < scan.traces[t].measured_heights().size(); ++k) {
      const double z = scan.traces[t].measured_heights()[k];
      ASSERT_TRUE(std::isnan(z) || z == whole.traces[t].heights()[k]);
    }
  }
  const Stylus tip({.tip = 2, .spacing = 0.5, .length = 100, .speed = {}, .rate = {}});
  EXPECT_NE(testing::error_text([&] { tip.scan(holed, 1, 3); }).find("a tip may rest on any of them"),
            std::string::npos);
  EXPECT_THROW(dilated(holed, 2), Error);
  EXPECT_THROW(closed(holed, 2), Error);
}

TEST(HoledMap, ProfilesAreMeasuredLikeMaps) {
  Array<double> z(200);
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = 0.01 * static_cast<double>(k) + std::sin(0.3 * static_cast<double>(k));
  for (std::size_t k = 40; k < 60; ++k) z[k] = hole;
  z[199] = hole;
  const Profile p = Profile::with_holes(0.5, z);
  const Roughness r = roughness(p);
  EXPECT_EQ(r.measured, 179);
  double mean = 0, square = 0, slope = 0;
  int pairs = 0;
  for (const double h : z)
    if (!std::isnan(h)) mean += h / 179;
  for (std::size_t k = 0; k < z.size(); ++k) {
    if (!std::isnan(z[k])) square += (z[k] - mean) * (z[k] - mean) / 179;
    if (k > 0 && !std::isnan(z[k]) && !std::isnan(z[k - 1]))
      slope += (z[k] - z[k - 1]) * (z[k] - z[k - 1]), ++pairs;
  }
  EXPECT_NEAR(r.Rq, std::sqrt(square), 1e-13);
  EXPECT_NEAR(r.rms_slope, std::sqrt(slope / pairs) / 0.5, 1e-13);
  EXPECT_EQ(levelled(p, 1).measured(), 179u);
  EXPECT_EQ(gaussian_filtered(p, {.short_wave = {}, .long_wave = 10.0}).measured(), 179u);
  EXPECT_EQ(spectrum(p).measured, 179);
  EXPECT_LT(roughness(levelled(p, 1)).Rq, r.Rq);
}

TEST(HoledMap, SameBitsForAnyNumberOfThreads) {
  const Surface& holed = holed_map().holed;
  const auto digests = [&] {
    return levelled(holed, 3).digest() +
           gaussian_filtered(holed, {.short_wave = 5.0, .long_wave = 40.0}).digest() +
           std::to_string(roughness(holed).rms_slope) + std::to_string(find_outliers(holed, {}).marked) +
           rotated(holed, 0.3).digest();
  };
  set_thread_count(1);
  const std::string alone = digests();
  set_thread_count(3);
  EXPECT_EQ(digests(), alone);
  set_thread_count(0);
}

}  // namespace
}  // namespace asperity::holed_map_test
