// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/gaussian_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/parallel.hpp"
#include "tests/metrology/test_fields.hpp"

namespace asperity::gaussian_filter_test {
namespace {

using testing::error_text;
using testing::make_profile;
using testing::make_surface;

constexpr auto none = std::nullopt;

double greatest_difference(std::span<const double> a, std::span<const double> b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

// ISO 16610-21: one half at the cut-off.
double transmission(double cut_off, double wavelength) {
  return std::exp2(-(cut_off / wavelength) * (cut_off / wavelength));
}

TEST(GaussianFilter, OnAPeriodicWaveIsItsTransmission) {
  const int nx = 61, ny = 36;  // 61/5 and 36/4 cells
  const double size_x = 6.1e-4, size_y = 1.8e-4, A = 1e-6;
  const Surface s = make_surface(
      nx, ny, size_x, size_y,
      [&](int i, int j) { return A * std::cos(2 * pi * (5.0 * i / nx + 4.0 * j / ny)); },
      testing::periodic());
  const double wave = 1 / std::hypot(5 / size_x, 4 / size_y);
  const double cases[][2] = {{wave, 1e9}, {0.5 * wave, 2 * wave}, {1e-9, wave}, {0.7 * wave, 0.9 * wave}};
  for (const auto& [low, high] : cases) {
    const Surface f = gaussian_filtered(s, {low, high});
    const double share = transmission(low, wave) * (1 - transmission(high, wave));
    double worst = 0;
    for (std::size_t k = 0; k < s.heights().size(); ++k)
      worst = std::max(worst, std::abs(f.heights()[k] - share * s.heights()[k]));
    EXPECT_LT(worst, 1e-14 * A);
    EXPECT_TRUE(f.traits().periodic);
  }
}

TEST(GaussianFilter, ShortAndLongWaveAddUpToTheSurface) {
  for (const bool wraps : {true, false}) {
    const Surface noise = testing::white_noise(45, 32, 1, 1, 3);
    const Surface s(noise.grid(), noise.heights(), wraps ? testing::periodic() : SurfaceTraits{});
    const Surface smooth = gaussian_filtered(s, {0.2, none}), rough = gaussian_filtered(s, {none, 0.2});
    double worst = 0;
    for (std::size_t k = 0; k < s.heights().size(); ++k)
      worst = std::max(worst, std::abs(smooth.heights()[k] + rough.heights()[k] - s.heights()[k]));
    EXPECT_LT(worst, 1e-14 * s.peak_to_valley());
  }
}

// The definition, with the kernel cut at the ends.
Array<double> direct_mean_line(std::span<const double> z, double spacing, double cut_off) {
  const double alpha = std::sqrt(std::log(2.0) / pi);
  Array<double> result;
  for (std::size_t i = 0; i < z.size(); ++i) {
    double sum = 0, weight = 0;
    for (std::size_t k = 0; k < z.size(); ++k) {
      const double x = (static_cast<double>(i) - static_cast<double>(k)) * spacing / (alpha * cut_off);
      sum += std::exp(-pi * x * x) * z[k];
      weight += std::exp(-pi * x * x);
    }
    result.push_back(sum / weight);
  }
  return result;
}

TEST(GaussianFilter, OnAProfileIsTheSumOfItsDefinition) {
  const Stream stream(4, "profile");
  for (const int n : {1, 2, 37, 200}) {
    const Profile p =
        make_profile(n, 0.5e-6, [&](int i) { return 3 + stream.normal(static_cast<std::uint64_t>(i)); });
    for (const double cut_off : {1e-7, 1e-6, 8e-6, 1e-3}) {
      const Profile smooth = gaussian_filtered(p, {cut_off, none});
      EXPECT_LT(greatest_difference(smooth.heights(), direct_mean_line(p.heights(), p.spacing(), cut_off)),
                2e-14)
          << n << " " << cut_off;
    }
  }
}

TEST(GaussianFilter, OnASurfaceIsThatOfRowsThenColumns) {
  const Surface s = testing::white_noise(29, 40, 2.9, 8, 9);
  const double cut_off = 1.1;
  Field z = s.heights();
  for (int j = 0; j < z.ny(); ++j) {
    const Array<double> line = direct_mean_line(z.row(j), s.grid().hx(), cut_off);
    std::copy(line.begin(), line.end(), z.row(j).begin());
  }
  for (int i = 0; i < z.nx(); ++i) {
    Array<double> column;
    for (int j = 0; j < z.ny(); ++j) column.push_back(z(i, j));
    const Array<double> line = direct_mean_line(column, s.grid().hy(), cut_off);
    for (int j = 0; j < z.ny(); ++j) z(i, j) = line[static_cast<std::size_t>(j)];
  }
  EXPECT_LT(greatest_difference(gaussian_filtered(s, {cut_off, none}).heights().values(), z.values()), 1e-14);
}

// Far from the ends, sampling and kernel length have no visible effect.
TEST(GaussianFilter, InsideATraceTransmitsAsTheStandardSays) {
  const double spacing = 0.25e-6, wave = 20e-6, cut_off = 25e-6;
  const Profile p = make_profile(4000, spacing, [&](int i) { return std::cos(2 * pi * i * spacing / wave); });
  const Profile smooth = gaussian_filtered(p, {cut_off, none});
  const double share = transmission(cut_off, wave);
  for (int i = 500; i < 3500; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(smooth.heights()[k], share * p.heights()[k], 1e-13);
  }
}

TEST(GaussianFilter, KeepsAConstantExactly) {
  const Surface s = make_surface(33, 20, 1, 1, [](int, int) { return 0.1; });
  EXPECT_EQ(gaussian_filtered(s, {0.3, none}).digest(), s.digest());
  EXPECT_EQ(gaussian_filtered(s, {none, 0.3}).height_range().max, 0);
}

TEST(GaussianFilter, IsIndifferentToAnOffset) {
  const auto height = [](int i, int j) { return std::round(64 * std::sin(1.0 * i * j)) / 64; };
  const Surface near = gaussian_filtered(make_surface(40, 40, 1, 1, height), {0.1, 0.4});
  const Surface far = gaussian_filtered(
      make_surface(40, 40, 1, 1, [&](int i, int j) { return 0x1p40 + height(i, j); }), {0.1, 0.4});
  EXPECT_LT(greatest_difference(near.heights().values(), far.heights().values()), 1e-13);
}

TEST(GaussianFilter, OfAClosedOutlineWraps) {
  const int n = 90;
  Array<double> z(n);
  for (std::size_t i = 0; i < n; ++i) z[i] = std::cos(2 * pi * 3 * static_cast<double>(i) / n + 0.4);
  const Profile outline(0.1, z, 1.5);
  const Profile f = gaussian_filtered(outline, {3.0, none});  // waves of 3 m
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(f.heights()[i], 0.5 * z[i], 1e-14);
  EXPECT_EQ(f.closed_radius(), 1.5);
}

TEST(GaussianFilter, SameBitsForAnyNumberOfThreads) {
  const Surface s = testing::white_noise(101, 67, 1, 1, 5);
  set_thread_count(1);
  const Surface one = gaussian_filtered(s, {0.05, 0.5});
  set_thread_count(2);
  const Surface two = gaussian_filtered(s, {0.05, 0.5});
  set_thread_count(0);
  EXPECT_EQ(one.digest(), two.digest());
}

TEST(GaussianFilter, AnInfiniteLongWaveTakesNothingAway) {
  const Surface s = testing::white_noise(8, 8, 1, 1, 5);
  EXPECT_EQ(gaussian_filtered(s, {none, std::numeric_limits<double>::infinity()}).digest(), s.digest());
}

TEST(GaussianFilter, RefusesCutOffsThatMeanNothing) {
  const Profile p(1, {0, 1, 0});
  EXPECT_EQ(error_text([&] { gaussian_filtered(p, {}); }),
            "a filter needs `short_wave` or `long_wave`, and neither is given; give one or both, as in "
            "`short_wave=\"2.5 um\", long_wave=\"0.8 mm\"`");
  EXPECT_EQ(error_text([&] {
              gaussian_filtered(p, {0.0, none});
            }),
            "`short_wave` is 0 m; give a finite length above zero");
  EXPECT_EQ(error_text([&] {
              gaussian_filtered(p, {none, std::nan("")});
            }),
            "`long_wave` is nan m; give a length above zero");
  EXPECT_EQ(
      error_text([&] {
        gaussian_filtered(p, {2.0, 2.0});
      }),
      "`short_wave` 2 m is not below `long_wave` 2 m; give a smaller `short_wave` or a larger `long_wave`");
}

// Only the robust mean surface ignores a groove of 10 um in a waviness of 1 um.
TEST(RobustFilter, GoesAcrossADeepGroove) {
  const int n = 256;
  Field z(n, n), waviness(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      waviness(i, j) = 1e-6 * std::sin(2 * std::numbers::pi * i / 256);
      z(i, j) = waviness(i, j) + 0.05e-6 * std::sin(1.9 * i + 2.3 * j) - (i >= 120 && i < 126 ? 10e-6 : 0);
    }
  const Surface s(Grid{n, n, 256e-6, 256e-6}, z);
  const auto worst = [&](bool robust) {
    const Surface rough = gaussian_filtered(s, {.short_wave = {}, .long_wave = 40e-6, .robust = robust});
    double error = 0;  // outside the groove and rims
    for (int i = 100; i < 146; ++i)
      if (i < 120 || i >= 126)
        error = std::max(error, std::abs(z(i, 128) - rough.height(i, 128) - waviness(i, 128)));
    return error;
  };
  EXPECT_GT(worst(false), 1e-6);
  EXPECT_LT(worst(true), 0.1e-6);
}

TEST(RobustFilter, LeavesHolesAloneAndRefusesWhatHasNoScale) {
  Field z(64, 64);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = 1e-6 * std::sin(0.37 * static_cast<double>(k));
  z(5, 5) = std::numeric_limits<double>::quiet_NaN();
  const Surface rough = gaussian_filtered(Surface::with_holes(Grid{64, 64, 64e-6, 64e-6}, z),
                                          {.short_wave = {}, .long_wave = 20e-6, .robust = true});
  EXPECT_EQ(rough.measured(), 64u * 64 - 1);
  EXPECT_TRUE(std::isnan(rough.height(5, 5)));
  EXPECT_THROW(gaussian_filtered(rough, {.short_wave = 5e-6, .long_wave = {}, .robust = true}), Error);
  const Surface flat(Grid{64, 64, 64e-6, 64e-6}, Field(64, 64, 3e-6));
  EXPECT_NEAR(gaussian_filtered(flat, {.short_wave = {}, .long_wave = 20e-6, .robust = true}).height(3, 3), 0,
              1e-18);
}

}  // namespace
}  // namespace asperity::gaussian_filter_test
