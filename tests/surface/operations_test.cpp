// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/operations/operations.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/parallel.hpp"
#include "tests/surface/files.hpp"

namespace asperity::operations_test {
namespace {

using std::numbers::pi;
using testing::message_of;

template <class Height>
Surface surface_of(int nx, int ny, double size_x, double size_y, Height height, bool periodic = false) {
  const Grid grid = make_grid(nx, ny, size_x, size_y);
  Field heights(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) heights(i, j) = height(i * grid.hx(), j * grid.hy());
  SurfaceTraits traits;
  traits.periodic = periodic;
  traits.material = named_material("Al-2011");
  traits.aliased_share = 0.25;
  return Surface(grid, std::move(heights), traits);
}

Surface numbered(int nx, int ny, bool periodic = false) {
  int k = -1;
  const auto height = [&](double, double) {
    ++k;
    return 1e-9 * (k * 37 % 101 + 0.1 * k);
  };
  return surface_of(nx, ny, nx * 1e-6, ny * 2e-6, height, periodic);
}

double rough(double x, double y) {
  return 1e-7 * std::sin(2 * pi * (3 * x + 0.2)) * std::cos(2 * pi * (2 * y - x)) +
         2e-8 * std::cos(2 * pi * 5 * y);
}

void expect_equal(const Surface& a, const Surface& b) { EXPECT_EQ(a.digest(), b.digest()); }

TEST(Scaled, ReachesItsMeasure) {
  const Surface surface = numbered(17, 12);
  const double average = mean(surface.heights().values());
  for (const double target : {1e-12, 3e-7, 0.5, 1e150}) {
    const Surface about_mean = scaled(surface, ScaleTo::amplitude, target);
    EXPECT_NEAR(about_mean.peak_to_valley(), target, 1e-15 * (target + average));
    EXPECT_NEAR(mean(about_mean.heights().values()), average, 1e-14 * (target + average));
    const Surface about_base = scaled(surface, ScaleTo::amplitude, target, ScaleAbout::base);
    EXPECT_EQ(about_base.height_range().min, surface.height_range().min);
    EXPECT_NEAR(about_base.peak_to_valley(), target, 1e-15 * (target + average));
  }
  const Surface rms = scaled(surface, ScaleTo::rms, 2e-6), ra = scaled(surface, ScaleTo::ra, 2e-6);
  double square = 0, absolute = 0;
  for (const double h : rms.heights().values()) square += (h - average) * (h - average);
  for (const double h : ra.heights().values()) absolute += std::abs(h - average);
  EXPECT_NEAR(std::sqrt(square / 204), 2e-6, 1e-19);
  EXPECT_NEAR(absolute / 204, 2e-6, 1e-19);
  EXPECT_EQ(rms.traits().aliased_share, 0.25);
  EXPECT_EQ(rms.material()->name, "Al-2011");
}

TEST(Scaled, Extremes) {
  const Surface surface = numbered(4, 4);
  EXPECT_EQ(scaled(surface, ScaleTo::rms, 0).peak_to_valley(), 0);
  const Surface tiny = surface_of(2, 1, 1, 1, [](double x, double) { return x > 0 ? 1e-310 : 0.0; });
  EXPECT_NEAR(scaled(tiny, ScaleTo::amplitude, 1.0).peak_to_valley(), 1, 1e-12);
  const Surface flat = surface_of(3, 3, 1, 1, [](double, double) { return 5.0; });
  EXPECT_NE(message_of([&] {
              scaled(flat, ScaleTo::ra, 1e-6);
            }).find("a flat surface cannot be scaled to `ra` = 1e-06 m"),
            std::string::npos);
  EXPECT_EQ(scaled(flat, ScaleTo::ra, 0).height(1, 1), 5);
  for (const double target : {-1e-9, double(NAN), double(INFINITY)})
    EXPECT_NE(message_of([&] { scaled(surface, ScaleTo::amplitude, target); }).find("`amplitude` is"),
              std::string::npos);
}

TEST(Shifted, WholeCellsMoveHeightsUntouched) {
  const Surface surface = numbered(7, 5);
  const Surface moved = shifted(surface, 2e-6, -2e-6);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 7; ++i) EXPECT_EQ(moved.height((i + 2) % 7, (j + 4) % 5), surface.height(i, j));
  expect_equal(shifted(moved, -2e-6, 2e-6), surface);
  expect_equal(shifted(surface, 7e-6 * 3, -10e-6 * 4), surface);
  expect_equal(shifted(surface, 1e-6 * (2 + 0.9e-9), 0), shifted(surface, 2e-6, 0));
  EXPECT_NE(message_of([&] {
              shifted(surface, 1e-6 * (2 + 1e-8), 0);
            }).find("is 2 cells, and this surface is not periodic"),
            std::string::npos);
  EXPECT_NE(message_of([&] { shifted(surface, 0, 3e-6); }).find("`y` = 3e-06 m is 1.5 cells"),
            std::string::npos);
  EXPECT_NE(message_of([&] { shifted(surface, NAN, 0); }).find("a shift is nan"), std::string::npos);
}

TEST(Shifted, FractionsOfACellAreExactForPeriodicSurfaces) {
  for (const auto& [nx, ny] : {std::pair{32, 24}, {31, 25}}) {
    const Surface surface = surface_of(nx, ny, 1, 1, rough, true);
    const Surface moved = shifted(surface, 0.0123, -7.0351);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        ASSERT_NEAR(moved.height(i, j),
                    rough(static_cast<double>(i) / nx - 0.0123, static_cast<double>(j) / ny + 7.0351), 1e-20);
    EXPECT_TRUE(moved.traits().periodic);
  }
}

TEST(Rotated, QuarterTurnsAreExactAndSwapTheSides) {
  const Surface surface = numbered(4, 3);
  const Surface turned = rotated(surface, pi / 2);
  EXPECT_EQ(turned.grid(), (Grid{3, 4, surface.grid().size_y, surface.grid().size_x}));
  // Counter-clockwise from above.
  EXPECT_EQ(turned.height(2, 3), surface.height(3, 0));
  EXPECT_EQ(turned.height(0, 0), surface.height(0, 2));
  EXPECT_EQ(turned.height(2, 0), surface.height(0, 0));
  expect_equal(rotated(turned, pi / 2), rotated(surface, pi));
  expect_equal(rotated(turned, pi), rotated(surface, -pi / 2));
  expect_equal(rotated(turned, -pi / 2), surface);
  expect_equal(rotated(surface, 20 * pi), surface);
  EXPECT_EQ(rotated(surface, pi).height(0, 0), surface.height(3, 2));
}

TEST(Rotated, OtherAnglesKeepParabolasExactly) {
  // Cubic convolution is exact for parabolas.
  const auto bowl = [](double u, double v) { return 0.3 * u * u - 0.2 * u * v + 0.1 * v * v + 0.5 * u - v; };
  const Surface surface =
      surface_of(41, 31, 41, 31, [&](double x, double y) { return bowl(x - 20, y - 15); });
  const double angle = 0.3;
  const Surface turned = rotated(surface, angle);
  const int nx = turned.grid().nx, ny = turned.grid().ny;
  EXPECT_GT(nx, 20);
  EXPECT_LT(nx, 41);
  EXPECT_DOUBLE_EQ(turned.grid().hx(), 1);
  EXPECT_DOUBLE_EQ(turned.grid().hy(), 1);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double x = i - 0.5 * (nx - 1), y = j - 0.5 * (ny - 1);
      const double u = std::cos(angle) * x + std::sin(angle) * y,
                   v = std::cos(angle) * y - std::sin(angle) * x;
      EXPECT_NEAR(turned.height(i, j), bowl(u, v), 1e-11);
    }
}

TEST(Rotated, LargestPartInsideAndNothingLeft) {
  const Surface surface = numbered(21, 21);  // 1 x 2 um; 20 x 40 um between the outer nodes
  const Surface turned = rotated(surface, pi / 4);
  const double share = std::min(20 / (60 * std::sqrt(0.5)), 40 / (60 * std::sqrt(0.5)));
  EXPECT_EQ(turned.grid().nx, static_cast<int>(share * 20) + 1);
  EXPECT_FALSE(turned.traits().aliased_share);
  for (const auto& [nx, ny] : {std::pair{1, 1}, {9, 1}, {2, 2}})
    EXPECT_NE(
        message_of([&, nx = nx, ny = ny] { rotated(numbered(nx, ny), 0.4); }).find("nothing of a surface"),
        std::string::npos);
  EXPECT_NE(message_of([&] { rotated(surface, INFINITY); }).find("the angle of a rotation is inf"),
            std::string::npos);
}

TEST(Rotated, PeriodicSurfacesKeepTheirGrid) {
  const auto wave = [](double x, double y) { return std::cos(2 * pi * x) + std::sin(2 * pi * y); };
  const int n = 128;
  const Surface surface = surface_of(n, n, 1, 1, wave, true), turned = rotated(surface, 0.7);
  EXPECT_EQ(turned.grid(), surface.grid());
  EXPECT_FALSE(turned.traits().periodic);
  const double middle = 0.5 * (n - 1) / n;
  double worst = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = static_cast<double>(i) / n - middle, y = static_cast<double>(j) / n - middle;
      worst = std::max(worst,
                       std::abs(turned.height(i, j) - wave(std::cos(0.7) * x + std::sin(0.7) * y + middle,
                                                           std::cos(0.7) * y - std::sin(0.7) * x + middle)));
    }
  EXPECT_LT(worst, 1e-5);  // third order in 2 pi / 128
}

TEST(Mirrored, TurnsTheRowsRound) {
  const Surface surface = numbered(5, 3, true), mirror = mirrored(surface);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 5; ++i) EXPECT_EQ(mirror.height(4 - i, j), surface.height(i, j));
  expect_equal(mirrored(mirror), surface);
  EXPECT_TRUE(mirror.traits().periodic);
}

TEST(Cropped, TakesNodesAsTheyAre) {
  const Surface surface = numbered(8, 6, true);
  const Surface part = cropped(surface, 2, 1, 3, 4);
  EXPECT_DOUBLE_EQ(part.grid().size_x, 3e-6);
  EXPECT_DOUBLE_EQ(part.grid().size_y, 8e-6);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(part.height(i, j), surface.height(i + 2, j + 1));
  EXPECT_FALSE(part.traits().periodic);
  expect_equal(cropped_to(surface, 2.2e-6, 1.6e-6, 2.9e-6, 8.3e-6), part);
  expect_equal(cropped(surface, 0, 0, 8, 6), surface);
  EXPECT_TRUE(cropped(surface, 0, 0, 8, 6).traits().periodic);
  EXPECT_EQ(cropped(surface, 7, 5, 1, 1).height(0, 0), surface.height(7, 5));
  EXPECT_NE(
      message_of([&] { cropped(surface, 6, 0, 3, 3); }).find("a crop of 3 cells from node 6 along x exceeds"),
      std::string::npos);
  for (const auto& [first, count] :
       {std::pair{-1.0, 2.0}, {0.0, 0.0}, {0.5, 2.0}, {0.0, 2.5}, {1e300, 1.0}, {double(NAN), 1.0}})
    EXPECT_NE(message_of([&, first = first, count = count] {
                cropped(surface, 0, first, 2, count);
              }).find("along y exceeds"),
              std::string::npos);
}

TEST(Resampled, PeriodicSurfacesAreExactOnFinerCells) {
  for (const auto& [nx, ny] : {std::pair{32, 24}, {31, 25}}) {
    const Surface coarse = surface_of(nx, ny, 1, 1, rough, true);
    for (const auto& [mx, my] : {std::pair{64, 48}, {37, 24}, {96, 101}}) {
      const Surface fine = resampled(coarse, mx, my), direct = surface_of(mx, my, 1, 1, rough, true);
      for (std::size_t k = 0; k < fine.heights().size(); ++k)
        ASSERT_NEAR(fine.heights()[k], direct.heights()[k], 1e-20);
      EXPECT_TRUE(fine.traits().periodic);
      EXPECT_FALSE(fine.traits().aliased_share);
    }
  }
}

TEST(Resampled, UpAndDownAgainIsTheIdentity) {
  // All waves of the grid, including Nyquist.
  for (const auto& [nx, ny] : {std::pair{8, 6}, {7, 5}, {2, 4}, {1, 6}, {1, 1}}) {
    const Surface surface = numbered(nx, ny, true);
    for (const auto& [mx, my] : {std::pair{16, 12}, {9, 7}, {10, 6}, {8, 13}}) {
      const Surface back = resampled(resampled(surface, mx, my), nx, ny);
      for (std::size_t k = 0; k < back.heights().size(); ++k)
        ASSERT_NEAR(back.heights()[k], surface.heights()[k], 1e-21)
            << nx << " " << ny << " " << mx << " " << my;
    }
    const Surface twice = resampled(surface, 2 * nx, 2 * ny);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) ASSERT_NEAR(twice.height(2 * i, 2 * j), surface.height(i, j), 1e-21);
  }
}

TEST(Resampled, CoarserPeriodicCellsDropWaves) {
  const Surface fine = surface_of(
      64, 64, 1, 1, [](double x, double y) { return std::cos(2 * pi * 3 * x) + std::sin(2 * pi * 20 * y); },
      true);
  const Surface coarse = resampled(fine, 32, 32);
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) ASSERT_NEAR(coarse.height(i, j), std::cos(2 * pi * 3 * i / 32), 1e-14);
}

TEST(Resampled, OtherSurfacesKeepPlanesAndParabolas) {
  const auto plane = [](double x, double y) { return 2 * x - 3 * y + 0.5; };
  const auto bowl = [](double x, double y) { return x * x - 2 * x * y; };
  for (const auto& [nx, ny] : {std::pair{20, 15}, {40, 30}, {7, 4}, {23, 3}, {1, 1}, {2, 31}, {20, 14}}) {
    const Surface moved = resampled(surface_of(20, 15, 2, 3, plane), nx, ny),
                  direct = surface_of(nx, ny, 2, 3, plane);
    for (std::size_t k = 0; k < moved.heights().size(); ++k)
      ASSERT_NEAR(moved.heights()[k], direct.heights()[k], 1e-13) << nx << " " << ny;
    EXPECT_EQ(moved.grid().size_x, 2);
  }
  const Surface fine = resampled(surface_of(20, 15, 2, 3, bowl), 60, 45),
                direct = surface_of(60, 45, 2, 3, bowl);
  for (int j = 0; j <= 42; ++j)
    for (int i = 0; i <= 57; ++i) ASSERT_NEAR(fine.height(i, j), direct.height(i, j), 1e-13);
}

TEST(Resampled, CoarseningAveragesAndRefiningPassesThroughNodes) {
  const Surface surface = numbered(6, 1);
  const Surface fine = resampled(surface, 18, 1);
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(fine.height(3 * i, 0), surface.height(i, 0));
  const Surface saw = surface_of(8, 1, 8, 1, [](double x, double) { return std::fmod(x, 2.0); });
  EXPECT_DOUBLE_EQ(resampled(saw, 4, 1).height(1, 0), 0.5);  // without averaging: 0
  for (const auto& [nx, ny] : {std::pair{1, 5}, {2, 2}, {3, 1}})
    EXPECT_EQ(resampled(numbered(nx, ny), 9, 7).grid().nx, 9);
  EXPECT_NE(message_of([&] { resampled(surface, 0, 4); }).find("`cells` is 0"), std::string::npos);
  EXPECT_NE(message_of([&] { resampled(surface, 65537, 4); }).find("`cells` is 65537"), std::string::npos);
}

TEST(Resampled, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  std::vector<std::string> digests;
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    digests.push_back(resampled(numbered(61, 47), 90, 33).digest() +
                      resampled(numbered(61, 47, true), 90, 33).digest() +
                      rotated(numbered(61, 47), 0.3).digest());
  }
  set_thread_count(before);
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

TEST(Plus, AddsNodeByNode) {
  const Surface a = numbered(4, 3, true), b = mirrored(a);
  const Surface sum = plus(a, b);
  EXPECT_EQ(sum.height(1, 2), a.height(1, 2) + b.height(1, 2));
  EXPECT_TRUE(sum.traits().periodic);
  EXPECT_FALSE(plus(a, numbered(4, 3)).traits().periodic);
  EXPECT_EQ(message_of([&] { plus(a, numbered(5, 3)); }),
            "surfaces of 4 x 3 and 5 x 3 cells cannot be added; bring one to the cells of the other with "
            "`resampled`");
  const Surface other = surface_of(4, 3, 5e-6, 6e-6, rough);
  EXPECT_NE(message_of([&] { plus(a, other); }).find("`cropped`"), std::string::npos);
}

TEST(Cut, LowersPeaksOnly) {
  const Surface surface = numbered(5, 5);
  const Range range = surface.height_range();
  const Surface lower = cut(surface, 0.25);
  for (std::size_t k = 0; k < 25; ++k)
    EXPECT_EQ(lower.heights()[k], std::min(surface.heights()[k], range.max - 0.25 * range.span()));
  expect_equal(cut(surface, 0), surface);
  EXPECT_EQ(cut(surface, 1).peak_to_valley(), 0);
  EXPECT_EQ(cut(surface, 1).height(0, 0), range.min);
  for (const double wrong : {-1e-12, 1.0000001, double(NAN)})
    EXPECT_NE(message_of([&] { cut(surface, wrong); }).find("`fraction` is"), std::string::npos);
  const Profile outline = cut(Profile(1e-6, {0.0, 2.0, 1.0}, 5e-3), 0.25);
  EXPECT_EQ(outline.heights()[1], 1.5);
  EXPECT_EQ(outline.closed_radius(), 5e-3);
}

TEST(Sections, RowsAndColumns) {
  const Surface surface = numbered(4, 3);
  const Profile row = profile_row(surface, 2), column = profile_column(surface, 1);
  EXPECT_EQ(row.size(), 4);
  EXPECT_DOUBLE_EQ(row.spacing(), 1e-6);
  EXPECT_EQ(row.heights()[3], surface.height(3, 2));
  EXPECT_EQ(column.size(), 3);
  EXPECT_DOUBLE_EQ(column.spacing(), 2e-6);
  EXPECT_EQ(column.heights()[0], surface.height(1, 0));
  EXPECT_EQ(profiles(surface, LineDirection::x).size(), 3U);
  EXPECT_EQ(profiles(surface, LineDirection::y)[3].digest(), profile_column(surface, 3).digest());
  EXPECT_EQ(message_of([&] { profile_row(surface, 3); }), "there is no row 3; `row` runs from 0 to 2");
  for (const double wrong : {-1.0, 0.5, 4.0, double(NAN)})
    EXPECT_NE(message_of([&] { profile_column(surface, wrong); }).find("there is no column"),
              std::string::npos);
}

TEST(Sections, LinesAreBilinear) {
  const auto saddle = [](double x, double y) { return 1 + 2 * x - y + 3 * x * y; };
  const Surface surface = surface_of(11, 6, 11, 6, saddle);
  const Profile line = profile_between(surface, {0.5, 0.25}, {9.5, 4.75}, 10);
  EXPECT_EQ(line.size(), 10);
  EXPECT_DOUBLE_EQ(line.spacing(), std::hypot(1, 0.5));
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(line.heights()[k], saddle(0.5 + static_cast<double>(k), 0.25 + 0.5 * static_cast<double>(k)),
                1e-12);
  EXPECT_EQ(profile_between(surface, {0, 0}, {10, 0}).digest(), profile_row(surface, 0).digest());
  EXPECT_EQ(profile_between(surface, {10, 5}, {10, 0}).heights()[0], surface.height(10, 5));
}

TEST(Sections, LinesNeverLeaveTheHeightsOfTheirNodes) {
  const Surface level = surface_of(7, 7, 7, 7, [](double, double) { return 3e-6; });
  for (const double share : {0.1, 0.3, 1.0 / 3, 0.7, 0.999})
    EXPECT_EQ(height_between(level, {share, 2.9 * share}), 3e-6) << share;
}

TEST(Sections, LinesWrapOnPeriodicSurfacesOnly) {
  const Surface open = numbered(6, 4), closed = numbered(6, 4, true);
  EXPECT_NE(message_of([&] {
              profile_between(open, {0, 0}, {5.5e-6, 0});
            }).find("outside a surface that is not periodic"),
            std::string::npos);
  const Profile line = profile_between(closed, {-2e-6, 0}, {8e-6, 0}, 11);
  EXPECT_DOUBLE_EQ(line.heights()[0], closed.height(4, 0));
  EXPECT_DOUBLE_EQ(line.heights()[8], closed.height(0, 0));
  EXPECT_NEAR(height_between(closed, {5.5e-6, 0}), 0.5 * (closed.height(5, 0) + closed.height(0, 0)), 1e-22);
  EXPECT_NE(message_of([&] {
              profile_between(open, {0, 0}, {0, 0});
            }).find("the same point"),
            std::string::npos);
  for (const double wrong : {1.0, 0.0, 2.5, 1e9, double(NAN)})
    EXPECT_NE(message_of([&] {
                profile_between(open, {0, 0}, {1e-6, 0}, wrong);
              }).find("`points` is"),
              std::string::npos);
}

}  // namespace
}  // namespace asperity::operations_test
