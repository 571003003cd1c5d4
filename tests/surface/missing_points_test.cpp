// SPDX-License-Identifier: GPL-3.0-or-later
// Operations move holes with heights, unite holes of combined surfaces, and spread holes over stencils.
#include "engine/surface/operations/missing_points.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/operations/operations.hpp"
#include "tests/surface/files.hpp"

namespace asperity::missing_points_test {
namespace {

using testing::message_of;

const double hole = std::numeric_limits<double>::quiet_NaN();

Field random_heights(int nx, int ny, std::uint64_t seed = 1) {
  const Stream stream(seed, "missing points");
  Field z(nx, ny);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = stream.uniform(k) - 0.5;
  return z;
}

Surface with_holes_at(int nx, int ny, const std::vector<std::pair<int, int>>& holes, bool periodic = false) {
  Field z = random_heights(nx, ny);
  for (const auto& [i, j] : holes) z(i, j) = hole;
  return Surface::with_holes(
      make_grid(nx, ny, nx, 2 * ny), std::move(z),
      {.material = named_material("Al-2011"), .periodic = periodic, .aliased_share = 0.1});
}
Surface complete(int nx, int ny, bool periodic = false) { return with_holes_at(nx, ny, {}, periodic); }

const std::vector<std::pair<int, int>> corners{{0, 0}, {11, 0}, {0, 8}, {11, 8}};
Surface with_corners_missing(bool periodic = false) { return with_holes_at(12, 9, corners, periodic); }

bool missing(const Surface& s, int i, int j) { return std::isnan(s.measured_heights()(i, j)); }

// Heights equal those on the complete map, or are missing if they depend on a hole.
template <class Operation>
void expect_stencils_respected(const Surface& holed, const Operation& operation) {
  Field one = holed.measured_heights(), other = one;
  for (std::size_t k = 0; k < one.size(); ++k)
    if (std::isnan(one[k])) one[k] = 3, other[k] = -40;
  const SurfaceTraits traits = holed.traits();
  const Surface result = operation(holed), a = operation(Surface(holed.grid(), one, traits)),
                b = operation(Surface(holed.grid(), other, traits));
  ASSERT_EQ(result.grid(), a.grid());
  std::size_t holes = 0;
  for (std::size_t k = 0; k < a.heights().size(); ++k) {
    if (std::isnan(result.measured_heights()[k])) {
      ++holes;
      continue;
    }
    ASSERT_NEAR(result.measured_heights()[k], a.heights()[k], 1e-14) << k;
    ASSERT_EQ(a.heights()[k], b.heights()[k]) << k;
  }
  EXPECT_GT(holes, 0u);
  EXPECT_LT(holes, result.measured_heights().size());
}

TEST(MissingPoints, MoveWithTheHeights) {
  const Surface s = with_corners_missing();
  const Surface right = shifted(s, 2, -2);
  EXPECT_TRUE(missing(right, 2, 8));
  EXPECT_TRUE(missing(right, 1, 7));
  EXPECT_EQ(right.measured(), s.measured());
  EXPECT_EQ(shifted(right, -2, 2).digest(), s.digest());
  const Surface turned = rotated(s, std::numbers::pi / 2);
  EXPECT_EQ(turned.grid().nx, 9);
  EXPECT_TRUE(missing(turned, 0, 0));
  EXPECT_EQ(turned.measured(), s.measured());
  EXPECT_EQ(rotated(turned, -std::numbers::pi / 2).digest(), s.digest());
  EXPECT_EQ(mirrored(mirrored(s)).digest(), s.digest());
  EXPECT_TRUE(missing(mirrored(with_holes_at(12, 9, {{0, 3}})), 11, 3));
  EXPECT_EQ(s.with_material(named_material("quartz")).digest(), s.digest());
}

TEST(MissingPoints, CroppedAwayLeaveACompleteSurface) {
  const Surface s = with_corners_missing();
  const Surface inside = cropped(s, 1, 1, 10, 7);
  EXPECT_TRUE(inside.complete());
  EXPECT_EQ(inside.digest(), cropped(complete(12, 9), 1, 1, 10, 7).digest());
  EXPECT_EQ(cropped(s, 0, 0, 3, 3).measured(), 8u);
  EXPECT_EQ(message_of([&] { cropped(s, 11, 8, 1, 1); }),
            "no point of this part of the surface was measured; give a part with measured points");
}

TEST(MissingPoints, SpreadAsFarAsAnInterpolationTouches) {
  const Surface s = with_holes_at(40, 32, {{20, 16}, {21, 16}, {5, 5}});
  expect_stencils_respected(s, [](const Surface& z) { return rotated(z, 0.4); });
  expect_stencils_respected(s, [](const Surface& z) { return resampled(z, 55, 47); });
  expect_stencils_respected(s, [](const Surface& z) { return resampled(z, 16, 9); });
  expect_stencils_respected(s, [](const Surface& z) { return resampled(z, 80, 32); });
}

// Old nodes are nodes of the finer surface.
TEST(MissingPoints, DoNotSpreadToNodesThatStay) {
  const Surface s = with_holes_at(8, 5, {{3, 2}});
  const Surface finer = resampled(s, 16, 5);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 8; ++i) EXPECT_EQ(missing(finer, 2 * i, j), i == 3 && j == 2);
  for (int i = 0; i < 16; ++i)
    EXPECT_EQ(missing(finer, i, 2), i == 6 || i == 3 || i == 5 || i == 7 || i == 9) << i;
}

TEST(MissingPoints, PeriodicSurfacesAreShiftedBetweenNodesByInterpolation) {
  const Surface s = with_corners_missing(true);
  const Surface moved = shifted(s, 0.25, 0);
  EXPECT_TRUE(moved.traits().periodic);
  // Holes of columns 0 and 11 spread two columns and more along their rows.
  EXPECT_EQ(moved.measured(), 12u * 9 - 2 * 5);
  for (int i = 0; i < 12; ++i) EXPECT_FALSE(missing(moved, i, 4));
  EXPECT_EQ(shifted(shifted(s, 3, 2), 0.25, 0).measured(), moved.measured());
  // The remaining error is that of cubic interpolation.
  SineOptions wave;
  wave.grid = make_grid(64, 64, 1, 1);
  wave.amplitude = 1;
  wave.wavelength = 0.5;
  const Surface smooth = sine_surface(wave);
  Field mask(64, 64, 1);
  mask(3, 3) = 0;
  const Surface exact = shifted(smooth, 0.3 / 64, 0), near = shifted(masked(smooth, mask), 0.3 / 64, 0);
  for (int i = 0; i < 64; ++i) EXPECT_NEAR(near.measured_heights()(i, 40), exact.heights()(i, 40), 2e-4);
}

TEST(MissingPoints, AreRefusedWhereNothingRemains) {
  const Surface one = with_holes_at(3, 3, {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}});
  EXPECT_EQ(one.measured(), 1u);
  EXPECT_NE(message_of([&] { rotated(one, 0.1); }).find("no measured point of the surface remains"),
            std::string::npos);
  EXPECT_NE(message_of([&] { resampled(one, 2, 2); }).find("no measured point of the surface remains"),
            std::string::npos);
  EXPECT_EQ(scaled(one, ScaleTo::amplitude, 0).measured(), 1u);
  EXPECT_THROW(scaled(one, ScaleTo::rms, 1), Error);
  EXPECT_EQ(rotated(one, std::numbers::pi).height(1, 1), one.height(1, 1));
}

TEST(MissingPoints, ScalingAndCuttingSeeWhatWasMeasured) {
  const Surface s = with_corners_missing();
  EXPECT_NEAR(scaled(s, ScaleTo::amplitude, 2e-6).peak_to_valley(), 2e-6, 1e-17);
  const MeasuredValues before(s);
  const Surface rms = scaled(s, ScaleTo::rms, 3);
  const MeasuredValues after(rms);
  ASSERT_EQ(after.values().size(), 104u);
  double square = 0;
  for (const double z : after.values())
    square += (z - mean(before.values())) * (z - mean(before.values())) / 104;
  EXPECT_NEAR(square, 9, 1e-12);
  const Surface low = cut(s, 0.5);
  EXPECT_EQ(low.measured(), s.measured());
  EXPECT_NEAR(low.peak_to_valley(), 0.5 * s.peak_to_valley(), 1e-15);
  EXPECT_EQ(cut(s, 0).digest(), s.digest());
}

TEST(Arithmetic, JoinsHoles) {
  const Surface a = with_holes_at(6, 5, {{0, 0}, {3, 2}}), b = with_holes_at(6, 5, {{3, 2}, {5, 4}});
  for (const Surface& both : {plus(a, b), minus(a, b)}) {
    EXPECT_EQ(both.measured(), 27u);
    EXPECT_TRUE(missing(both, 0, 0) && missing(both, 3, 2) && missing(both, 5, 4));
  }
  EXPECT_EQ(minus(a, b).height(2, 2), 0);
  EXPECT_EQ(plus(a, b).height(2, 2), 2 * a.height(2, 2));
  Field left(6, 5, hole), right(6, 5, hole);
  left(0, 0) = right(1, 0) = 1;
  const Grid grid = a.grid();
  EXPECT_NE(message_of([&] {
              minus(Surface::with_holes(grid, left), Surface::with_holes(grid, right));
            }).find("no measured point in common"),
            std::string::npos);
}

TEST(Arithmetic, OfCompleteSurfacesIsExact) {
  const Surface a = complete(7, 6, true), b(a.grid(), random_heights(7, 6, 9), a.traits());
  EXPECT_EQ(minus(a, a).height_range().max, 0);
  EXPECT_EQ(plus(minus(a, b), b).height(3, 3), a.height(3, 3) - b.height(3, 3) + b.height(3, 3));
  EXPECT_EQ(times(times(a, 2), 0.5).digest(), a.digest());
  EXPECT_EQ(over(a, 2).digest(), times(a, 0.5).digest());
  EXPECT_EQ(times(times(a, -1), -1).digest(), a.digest());
  EXPECT_EQ(plus(a, times(b, -1)).digest(), minus(a, b).digest());
  EXPECT_EQ(over(a, 3).height(1, 1), a.height(1, 1) / 3);
  EXPECT_TRUE(times(a, 2).traits().periodic);
  EXPECT_EQ(times(a, 2).material()->name, a.material()->name);
  EXPECT_EQ(*times(a, 2).traits().aliased_share, 0.1);
  EXPECT_FALSE(times(a, 0).traits().aliased_share.has_value());
  EXPECT_THROW(times(a, hole), Error);
  EXPECT_THROW(times(a, std::numeric_limits<double>::infinity()), Error);
  EXPECT_THROW(over(a, 0), Error);
  EXPECT_THROW(times(times(a, 1e308), 1e10), Error);  // overflow
  EXPECT_EQ(
      message_of([&] { minus(a, complete(7, 5)); }),
      "surfaces of 7 x 6 and 7 x 5 cells cannot be subtracted; bring one to the cells of the other with "
      "`resampled`");
}

TEST(Arithmetic, IsMadeAgainOnOtherCells) {
  SineOptions wave;
  wave.grid = make_grid(32, 32, 1, 1);
  wave.amplitude = 1;
  wave.wavelength = 0.5;
  const Surface a = sine_surface(wave);
  wave.wavelength = 0.25;
  const Surface b = sine_surface(wave);
  const Surface combined = minus(times(a, 3), over(b, 2));
  const Surface finer = *combined.remade(64, 64);
  for (int i = 0; i < 32; ++i) EXPECT_NEAR(finer.height(2 * i, 8), combined.height(i, 4), 1e-15);
  Field mask(32, 32, 1);
  mask(0, 0) = 0;
  EXPECT_EQ(masked(a, mask).recipe(), nullptr);
}

TEST(Mask, MarksMorePoints) {
  const Surface s = with_holes_at(6, 5, {{0, 0}});
  Field mask = mask_of(s);
  EXPECT_EQ(block_sum(mask.values()), 29);
  EXPECT_EQ(masked(s, mask).digest(), s.digest());
  mask(4, 4) = 0;
  mask(5, 4) = hole;
  mask(1, 1) = 0.25;  // any number but NaN: measured
  const Surface more = masked(s, mask);
  EXPECT_EQ(more.measured(), 27u);
  EXPECT_TRUE(missing(more, 4, 4) && missing(more, 5, 4));
  EXPECT_FALSE(more.traits().aliased_share.has_value());
  EXPECT_EQ(message_of([&] { masked(s, Field(5, 6, 1)); }),
            "the mask has 5 x 6 points, and the surface 6 x 5; give a mask of the same cells");
  EXPECT_NE(message_of([&] { masked(s, Field(6, 5)); }).find("leaves no measured point"), std::string::npos);
  // No copy.
  const Surface whole = complete(6, 5);
  EXPECT_EQ(&masked(whole, Field(6, 5, 1)).heights(), &whole.heights());
}

TEST(Outliers, AreSpikesAndNoOthers) {
  Field z = random_heights(60, 50);
  const auto rule = [](double factor) { return OutlierRule{.factor = factor, .window = 5}; };
  const Grid grid = make_grid(60, 50, 60, 50);
  EXPECT_EQ(find_outliers(Surface(grid, z), rule(6)).marked, 0u);
  z(30, 20) += 40;
  z(0, 0) -= 30;
  z(59, 49) += 25;
  z(10, 10) = hole;
  const Outliers found = find_outliers(Surface::with_holes(grid, z), rule(6));
  EXPECT_EQ(found.marked, 3u);
  EXPECT_EQ(found.mask(30, 20), 0);
  EXPECT_EQ(found.mask(0, 0), 0);
  EXPECT_EQ(found.mask(59, 49), 0);
  EXPECT_EQ(found.mask(10, 10), 0);  // missing, not counted
  EXPECT_EQ(block_sum(found.mask.values()), 60 * 50 - 4);
  EXPECT_DOUBLE_EQ(found.limit, 6 * found.deviation);
  EXPECT_NEAR(found.deviation, 0.3, 0.1);
  for (double& h : z.values()) h *= 1e-9;
  const Outliers small = find_outliers(Surface::with_holes(grid, z), rule(6));
  EXPECT_EQ(block_sum(small.mask.values()), 60 * 50 - 4);
}

// For Gaussian residuals the scaled deviation is the standard deviation.
TEST(Outliers, DeviationIsThatOfAGaussian) {
  const Stream stream(3, "noise");
  Field z(120, 120);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = stream.normal(k);
  const Outliers found = find_outliers(Surface(make_grid(120, 120, 1, 1), z), {.factor = 3, .window = 15});
  EXPECT_NEAR(found.deviation, 1, 0.03);
  EXPECT_NEAR(static_cast<double>(found.marked), 14400 * 0.0027, 20);
}

TEST(Outliers, RefuseWhatTheRuleCannotTell) {
  Field steps(20, 20);
  for (std::size_t k = 0; k < steps.size(); k += 7) steps[k] = 1;
  const Surface quantised(make_grid(20, 20, 1, 1), steps);
  EXPECT_NE(message_of([&] { find_outliers(quantised, {}); }).find("the rule \"mad\" would mark all others"),
            std::string::npos);
  EXPECT_EQ(find_outliers(Surface(make_grid(4, 4, 1, 1), Field(4, 4, 2)), {}).marked, 0u);  // flat
  EXPECT_THROW(find_outliers(quantised, {.factor = 0, .window = 5}), Error);
  EXPECT_THROW(find_outliers(quantised, {.factor = 6, .window = 4}), Error);
  EXPECT_THROW(find_outliers(quantised, {.factor = 6, .window = 33}), Error);
}

TEST(Filled, ByAHeightOrFromAround) {
  const Surface s = with_holes_at(12, 9, {{0, 0}, {5, 5}, {6, 5}});
  EXPECT_EQ(filled(s, 0.125).heights()(5, 5), 0.125);
  const Surface smooth = filled(s, {});
  EXPECT_TRUE(smooth.complete());
  EXPECT_EQ(smooth.material()->name, s.material()->name);
  Field again = smooth.heights();
  for (const auto& [i, j] : {std::pair{0, 0}, std::pair{5, 5}, std::pair{6, 5}}) again(i, j) = hole;
  EXPECT_EQ(Surface::with_holes(s.grid(), again).digest(), s.digest());
  const Surface whole = complete(12, 9);
  EXPECT_EQ(&filled(whole, {}).heights(), &whole.heights());
  EXPECT_EQ(&filled(whole, 3).heights(), &whole.heights());
  EXPECT_THROW(filled(s, hole), Error);
  EXPECT_FALSE(filled(with_holes_at(12, 9, {{0, 4}}, true), {}).traits().periodic);
  EXPECT_TRUE(filled(with_holes_at(12, 9, {{4, 4}}, true), {}).traits().periodic);
  Field z(5, 4, hole);
  z(4, 0) = 7;
  EXPECT_EQ(filled(Surface::with_holes(make_grid(5, 4, 1, 1), z), {}).height_range().min, 7);
}

TEST(Filled, ProfilesByStraightLines) {
  const Profile p = Profile::with_holes(1, {hole, 2, hole, hole, 8, hole});
  const Profile f = filled(p, {});
  const std::vector<double> expected{2, 2, 4, 6, 8, 8};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(f.heights()[k], expected[k], 1e-11);
  EXPECT_EQ(filled(p, 1).heights()[0], 1);
  // A gap at the first sample of a closed outline has two neighbours.
  const Profile round = filled(Profile::with_holes(1, {hole, 2, 5, 8, hole, hole}, 10.0), {});
  EXPECT_NEAR(round.heights()[4], 6.5, 1e-11);
  EXPECT_NEAR(round.heights()[5], 5, 1e-11);
  EXPECT_NEAR(round.heights()[0], 3.5, 1e-11);
}

TEST(Sections, OfHoledSurfacesHaveHoles) {
  const Surface s = with_holes_at(6, 5, {{2, 1}, {0, 3}, {1, 3}, {2, 3}, {3, 3}, {4, 3}, {5, 3}});
  EXPECT_EQ(profile_row(s, 1).measured(), 5u);
  EXPECT_EQ(profile_column(s, 2).measured(), 3u);
  EXPECT_EQ(message_of([&] { profile_row(s, 3); }),
            "no point of row 3 was measured; take another line, or fill the holes first, "
            "`surface:filled{ by=\"interpolate\" }`");
  EXPECT_THROW(profiles(s, LineDirection::x), Error);
  EXPECT_EQ(profiles(s, LineDirection::y).size(), 6u);
  // On a line through nodes, nodes of zero weight do not count.
  const Profile along = profile_between(s, {0, 2}, {5, 2}, 11);
  for (std::size_t k = 0; k < 11; ++k)
    EXPECT_EQ(std::isnan(along.measured_heights()[k]), k >= 3 && k <= 5) << k;
  EXPECT_TRUE(std::isnan(height_between(s, {2.5, 1.9})));
  EXPECT_FALSE(std::isnan(height_between(s, {3, 1.9})));
}

TEST(Profiles, WithHolesAreMaskedAndCut) {
  const Profile p(1, {0, 3, 2, 5, 100, 7, 6, 9, 7, 9});
  const Outliers found = find_outliers(p, {.factor = 20, .window = 3});
  EXPECT_EQ(found.marked, 1u);
  const Profile m = masked(p, found.mask.values());
  EXPECT_EQ(m.measured(), 9u);
  EXPECT_EQ(m.height_range().max, 9);
  EXPECT_EQ(cut(m, 0.5).height_range().max, 4.5);
  EXPECT_EQ(cut(m, 0.5).measured(), 9u);
  const std::vector<double> short_mask{1, 0};
  EXPECT_EQ(message_of([&] { masked(p, short_mask); }),
            "the mask has 2 points, and the profile 10; give a number a sample: 1 measured, 0 not");
}

}  // namespace
}  // namespace asperity::missing_points_test
