// SPDX-License-Identifier: GPL-3.0-or-later
// One refinement of pose and plane, on maps whose fits, refits and weakest directions can be computed by
// hand.
#include "engine/metrology/registration/refinement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/core/arithmetic/random.hpp"

namespace asperity::registration::refinement_test {
namespace {

double rough(double x, double y) {
  return std::sin(0.5 * x + 0.3) + std::cos(0.4 * y) + 0.5 * std::sin(0.3 * x + 0.2 * y);
}

// Heights h(x, y) about the centre, in cells.
template <class Height>
SmoothMap map_of(int nx, int ny, const Height& h) {
  SmoothMap made{{Field(nx, ny), 1, 1}, Field(nx, ny, 1.0)};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) made.map.heights(i, j) = h(made.map.x(i), made.map.y(j));
  return made;
}

// The after-map with a residual of e(x, y) at the pose 0.
template <class Residual>
MapPair pair_with(int nx, int ny, const Residual& e) {
  return MapPair(map_of(nx, ny, rough),
                 map_of(nx, ny, [&](double x, double y) { return rough(x, y) + e(x, y); }), 0.9);
}

// The after-map has every node at a node of the before-map: there the spline is exact.
TEST(Refinement, FindsAWholeShiftAndAPlane) {
  const MapPair maps(
      map_of(48, 40, rough),
      map_of(30, 28, [](double x, double y) { return rough(x + 3, y - 2) + 0.5 + 0.01 * x - 0.02 * y; }),
      0.9);
  for (const int stride : {1, 2}) {
    RefinementOptions options;
    options.stride = stride;
    options.tolerance = 1e-9;
    const Refined found = refined(maps, {2.8, -1.9, 0.005}, options);
    EXPECT_TRUE(found.possible && found.relief && found.converged);
    EXPECT_NEAR(found.pose.x, 3, 1e-9);
    EXPECT_NEAR(found.pose.y, -2, 1e-9);
    EXPECT_NEAR(found.pose.turn, 0, 1e-10);
    EXPECT_NEAR(found.plane.height, 0.5, 1e-9);
    EXPECT_NEAR(found.plane.slope_x, 0.01, 1e-10);
    EXPECT_NEAR(found.plane.slope_y, -0.02, 1e-10);
    EXPECT_NEAR(found.explained, 1, 1e-12);
    EXPECT_EQ(found.overlap, 1);
  }
}

// Half of the residuals are -a, the others a: the level is -a, there the residuals are 0 and 2a.
TEST(Refinement, ReportsLevelScaleAndExplainedShareOfAHeldPose) {
  constexpr double a = 0.1;
  int row = 0;
  const MapPair maps = pair_with(32, 24, [&](double x, double y) {
    row = static_cast<int>(y + 11.5);
    return (static_cast<int>(x + 15.5) + row) % 2 == 0 ? a : -a;
  });
  RefinementOptions options;
  options.plane_alone = true;
  options.most_steps = 0;
  options.tuning = 1e6;  // all weights are 1 to 1e-12
  const Refined found = refined(maps, {}, options);
  EXPECT_NEAR(found.plane.height, -a, 1e-14);
  EXPECT_NEAR(found.residual, 1.4826 * 2 * a, 1e-13);
  double sum = 0, squares = 0;
  for (const double h : maps.after().heights.values()) sum += h, squares += h * h;
  const double variance = squares - sum * sum / (32 * 24);
  EXPECT_NEAR(found.explained, 1 - 32 * 24 / 2 * 4 * a * a / variance, 1e-10);
}

TEST(Refinement, NeedsSixtyFourSamplesAndTheLeastOverlap) {
  const auto none = [](double, double) { return 0.0; };
  EXPECT_TRUE(refined(pair_with(8, 8, none), {}, {}).possible);
  EXPECT_FALSE(refined(pair_with(9, 7, none), {}, {}).possible);
  // 20 of 40 columns overlap.
  const MapPair maps = pair_with(40, 20, none);
  RefinementOptions options;
  options.most_steps = 0;
  for (const auto& [least, possible] : {std::pair(0.5, true), {0.501, false}}) {
    options.least_overlap = least;
    const Refined found = refined(maps, {20, 0, 0}, options);
    EXPECT_DOUBLE_EQ(found.overlap, 0.5);
    EXPECT_EQ(found.possible, possible);
  }
}

TEST(Refinement, HasNoReliefOnAPlane) {
  const auto plane = [](double x, double y) { return 0.1 * x - 0.2 * y; };
  const Refined found = refined(MapPair(map_of(20, 20, plane), map_of(20, 20, plane), 0.9), {}, {});
  EXPECT_FALSE(found.relief || found.possible);
}

TEST(MapPair, CountsPlacesWhoseFourNodesCount) {
  SmoothMap before = map_of(12, 10, rough), after = map_of(6, 5, rough);
  before.share(5, 4) = 0.89;
  before.share(0, 9) = 0.9;
  after.share(2, 2) = 0.5;
  after.map.hx = after.map.hy = 2;
  const MapPair maps(before, after, 0.9);
  EXPECT_EQ(maps.smaller_area(), 29 * 4);
  EXPECT_FALSE(maps.after_counts(2, 2));
  EXPECT_TRUE(maps.after_counts(3, 2));
  EXPECT_TRUE(maps.before_counts(0, 0) && maps.before_counts(11, 9) && maps.before_counts(0, 9));
  EXPECT_FALSE(maps.before_counts(-1e-300, 0) || maps.before_counts(0, -1e-300));
  EXPECT_FALSE(maps.before_counts(std::nextafter(11, 12), 0) || maps.before_counts(0, std::nextafter(9, 10)));
  for (const double x : {4.0, 4.5, 5.5})
    for (const double y : {3.0, 3.5, 4.5}) EXPECT_FALSE(maps.before_counts(x, y)) << x << ", " << y;
  EXPECT_TRUE(maps.before_counts(6, 4) && maps.before_counts(std::nextafter(4, 0), 4));
  EXPECT_TRUE(maps.before_counts(4, 5) && maps.before_counts(4, std::nextafter(3, 0)));
}

// -- Standard uncertainties

// Solves a x = b by elimination without pivots; a is positive definite.
std::array<double, 6> solved(std::array<std::array<long double, 7>, 6> a) {
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t i = 0; i < 6; ++i)
      if (i != p) {
        const long double share = a[i][p] / a[p][p];
        for (std::size_t j = p; j < 7; ++j) a[i][j] -= share * a[p][j];
      }
  std::array<double, 6> x{};
  for (std::size_t i = 0; i < 6; ++i) x[i] = static_cast<double>(a[i][6] / a[i][i]);
  return x;
}

// The linear least-squares fit of pose and plane to the samples outside one of 4 x 4 tiles.
std::array<double, 6> refit_without(const MapPair& maps, const Pose& pose, int tile) {
  const HeightMap& after = maps.after();
  const NaturalSpline& before = maps.before();
  std::array<std::array<long double, 7>, 6> normal{};
  for (int j = 0; j < after.ny(); ++j)
    for (int i = 0; i < after.nx(); ++i) {
      if (j * 4 / after.ny() * 4 + i * 4 / after.nx() == tile) continue;
      const double x = after.x(i), y = after.y(j), c = std::cos(pose.turn), s = std::sin(pose.turn);
      const double turned_x = c * x - s * y, turned_y = s * x + c * y;
      const NaturalSpline::Value value =
          before.at(turned_x + pose.x + 0.5 * (before.nx() - 1), turned_y + pose.y + 0.5 * (before.ny() - 1));
      const std::array<double, 6> row = {
          value.along_x, value.along_y, value.along_y * turned_x - value.along_x * turned_y, 1, x, y};
      const double residual = after.heights(i, j) - value.height;
      for (std::size_t a = 0; a < 6; ++a) {
        for (std::size_t b = 0; b < 6; ++b) normal[a][b] += row[a] * row[b];
        normal[a][6] += row[a] * residual;
      }
    }
  return solved(normal);
}

TEST(Jackknife, IsTheScatterOfRefitsWithoutATile) {
  const Pose pose{0.3, -0.2, 0.02};
  const Stream noise(1, "jackknife");
  std::uint64_t k = 0;
  const MapPair maps(
      map_of(44, 40, rough),
      map_of(33, 29, [&](double x, double y) { return rough(x + 0.3, y - 0.2) + 0.1 * noise.normal(k++); }),
      0.9);
  Refined found;
  found.pose = pose;
  found.residual = 1;
  RefinementOptions options;
  options.tuning = 1e7;  // linear: all weights are 1
  std::array<double, 6> sum{}, squares{};
  for (int tile = 0; tile < 16; ++tile) {
    const std::array<double, 6> change = refit_without(maps, pose, tile);
    for (std::size_t p = 0; p < 6; ++p) sum[p] += change[p], squares[p] += change[p] * change[p];
  }
  const PoseUncertainty u = jackknifed(maps, found, options);
  ASSERT_TRUE(u.possible);
  const std::array<double, 6> got = {u.pose.x,       u.pose.y,        u.pose.turn,
                                     u.plane.height, u.plane.slope_x, u.plane.slope_y};
  for (std::size_t p = 0; p < 6; ++p) {
    const double wanted = std::sqrt(15.0 / 16 * (squares[p] - sum[p] * sum[p] / 16));
    EXPECT_NEAR(got[p] / wanted, 1, 1e-6) << p;
  }
}

// All tiles want the plane 0.7 higher. At u = 0.7 of the biweight its curvature is negative, and the weights
// serve.
TEST(Jackknife, IsZeroIfAllTilesAgreeAlsoFarFromTheFit) {
  const MapPair maps = pair_with(32, 32, [](double, double) { return 0.7; });
  RefinementOptions options;
  options.tuning = 1;
  Refined found;
  for (const double scale : {1.0, 100.0}) {
    found.residual = scale;
    const PoseUncertainty u = jackknifed(maps, found, options);
    EXPECT_TRUE(u.possible);
    for (const double value :
         {u.pose.x, u.pose.y, u.pose.turn, u.plane.height, u.plane.slope_x, u.plane.slope_y})
      EXPECT_NEAR(value, 0, 1e-12) << scale;
  }
}

TEST(Jackknife, NeedsFourTiles) {
  SmoothMap before = map_of(32, 32, rough), after = before;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) after.share(i, j) = i < 8 && j < 24 ? 1 : 0;
  EXPECT_FALSE(jackknifed(MapPair(before, after, 0.9), {}, {}).possible);
  for (int j = 24; j < 32; ++j)
    for (int i = 0; i < 8; ++i) after.share(i, j) = 1;
  EXPECT_TRUE(jackknifed(MapPair(before, after, 0.9), {}, {}).possible);
}

// -- The weakest direction

TEST(WeakestChange, IsAlongRidgesAndTurnsADome) {
  const double angle = 0.6, c = std::cos(angle), s = std::sin(angle);
  const auto ridges = [&](double x, double y) { return std::sin(0.3 * (c * x + s * y)); };
  Refined found;
  found.residual = 1;
  const Pose along =
      weakest_change(MapPair(map_of(40, 40, ridges), map_of(20, 20, ridges), 0.9), found, {}, 2);
  EXPECT_NEAR(along.x * c + along.y * s, 0, 1e-3);
  EXPECT_NEAR(std::abs(along.y * c - along.x * s), 2, 1e-3);
  EXPECT_NEAR(along.turn, 0, 1e-3);
  const auto dome = [](double x, double y) { return -0.01 * (x * x + y * y); };
  const Pose turned = weakest_change(MapPair(map_of(60, 60, dome), map_of(21, 15, dome), 0.9), found, {}, 2);
  EXPECT_NEAR(std::abs(turned.turn), 2 / 10.0, 1e-4);  // 10 cells to the rim
  EXPECT_NEAR(turned.x, 0, 1e-3);
  EXPECT_NEAR(turned.y, 0, 1e-3);
}

// -- The plane of the unworn surface

TEST(UnwornGround, IsThePlaneWithoutTheWornPatch) {
  const MapPair maps = pair_with(40, 36, [](double x, double y) {
    return 0.02 + 0.001 * x - 0.002 * y - (std::abs(x) < 6 && std::abs(y) < 5 ? 0.4 : 0);
  });
  RefinementOptions options;
  options.plane_alone = true;
  const Refined found = refined(maps, {}, options);
  const UnwornPlane unworn = plane_of_unworn_ground(maps, found, 2, options);
  ASSERT_TRUE(unworn.possible);
  EXPECT_NEAR(unworn.plane.height, 0.02, 1e-12);
  EXPECT_NEAR(unworn.plane.slope_x, 0.001, 1e-13);
  EXPECT_NEAR(unworn.plane.slope_y, -0.002, 1e-13);
  Refined far_off = found;
  far_off.plane.height += 1;
  EXPECT_FALSE(plane_of_unworn_ground(maps, far_off, 2, options).possible);
}

}  // namespace
}  // namespace asperity::registration::refinement_test
