// SPDX-License-Identifier: GPL-3.0-or-later
// Planes, grooves, cosines, a brute-force maximum, and laws of mathematical morphology.
#include "engine/metrology/stylus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/metrology/roughness.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::spherical_tip_test {
namespace {

using testing::make_surface;
using testing::periodic;
using testing::white_noise;

Surface rough(int nx, int ny, double height, std::uint64_t seed = 1, bool wraps = true) {
  const Stream stream(seed, "rough");
  return make_surface(
      nx, ny, 1e-6 * nx, 1.5e-6 * ny,
      [&](int i, int j) { return height * stream.normal(static_cast<std::uint64_t>(j * nx + i)); },
      wraps ? periodic() : SurfaceTraits{});
}

// A lattice over the disc, refined around its forty best points.
double tried(const Surface& s, Point at, double radius) {
  struct Try {
    double x, y, t;
  };
  const auto try_at = [&](double dx, double dy) {
    const double d2 = dx * dx + dy * dy;
    return Try{dx, dy,
               d2 > radius * radius
                   ? -std::numeric_limits<double>::infinity()
                   : height_between(s, {at.x + dx, at.y + dy}) + std::sqrt(radius * radius - d2) - radius};
  };
  constexpr int steps = 300;
  std::vector<Try> tries;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i)
      tries.push_back(try_at(radius * (2.0 * i / steps - 1), radius * (2.0 * j / steps - 1)));
  std::partial_sort(tries.begin(), tries.begin() + 40, tries.end(),
                    [](const Try& a, const Try& b) { return a.t > b.t; });
  tries.resize(40);
  double best = -std::numeric_limits<double>::infinity();
  for (Try now : tries) {
    for (double step = radius / steps; step > 1e-7 * radius; step *= 0.7) {
      const Try from = now;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i)
          if (const Try next = try_at(from.x + i * step, from.y + j * step); next.t > now.t) now = next;
    }
    best = std::max(best, now.t);
  }
  return best;
}

std::string refusal(const Surface& s, double radius) {
  return test::refusal([&] { SphericalTip(s, radius); });
}

TEST(SphericalTip, RestsOnAPlaneBesideItsAxis) {
  for (const auto& [gx, gy] : {std::pair{0.0, 0.0}, {0.1, 0.0}, {0.3, -0.4}, {1.0, 2.0}}) {
    const Surface plane = make_surface(
        60, 40, 60e-6, 80e-6, [&, gx = gx, gy = gy](int i, int j) { return gx * i * 1e-6 + gy * j * 2e-6; });
    const SphericalTip tip(plane, 2e-6);
    const double lift = 2e-6 * (std::sqrt(1 + gx * gx + gy * gy) - 1);
    for (const Point at : {Point{30e-6, 40e-6}, {20.3e-6, 30.7e-6}, {33.99e-6, 50.01e-6}})
      EXPECT_NEAR(tip.height(at), gx * at.x + gy * at.y + lift, 1e-19 + 1e-15 * 200e-6) << gx << ", " << gy;
  }
}

TEST(SphericalTip, BottomsInAGrooveWhereBothWallsMeetIt) {
  // R (1/cos b - 1) for cells smaller or larger than the tip.
  for (const double h : {0.05e-6, 0.25e-6, 0.7e-6, 5e-6})
    for (const double half_slope : {0.05, 0.2, 0.7, 1.3}) {
      const Surface groove = make_surface(
          401, 7, 401 * h, 7 * h, [&](int i, int) { return std::tan(half_slope) * std::abs(i - 200) * h; });
      const SphericalTip tip(groove, 2e-6);
      const double expected = 2e-6 * (1 / std::cos(half_slope) - 1);
      EXPECT_NEAR(tip.height({200 * h, 3 * h}), expected, 1e-13 * 2e-6 * 200) << h << ", " << half_slope;
      EXPECT_NEAR(tip.height({200 * h, 3.4 * h}), expected, 1e-13 * 2e-6 * 200) << h << ", " << half_slope;
    }
}

// Peak to valley relative to A cos(2πx/λ).
double kept(double radius, double wavelength, double amplitude, int cells) {
  const Surface wave = make_surface(
      cells, 4, wavelength, 4 * wavelength / cells,
      [&](int i, int) { return amplitude * std::cos(2 * pi * i / cells); }, periodic());
  const SphericalTip tip(wave, radius);
  return (tip.height({0, 0}) - tip.height({0.5 * wavelength, 0})) / (2 * amplitude);
}

TEST(SphericalTip, LosesAmplitudeWhereTheCosineCurvesMoreThanTheTip) {
  // R = 2 µm, λ = 2 µm, A = 0.1 µm; A q² R = 1.97.
  EXPECT_NEAR(kept(2e-6, 2e-6, 0.1e-6, 4096), 0.80538, 5e-6);
  EXPECT_NEAR(kept(2e-6, 2e-6, 0.1e-6, 64), 0.80538, 2e-3);
  // The amplitude is complete for A q² R < 1 only.
  const double critical = 0.1e-6 * std::pow(2 * pi / 2e-6, 2);
  EXPECT_NEAR(kept(0.99 / critical, 2e-6, 0.1e-6, 4096), 1, 1e-6);
  EXPECT_LT(kept(1.2 / critical, 2e-6, 0.1e-6, 4096), 1 - 1e-4);
}

TEST(SphericalTip, IsTheGreatestOverTheDisc) {
  // Gentle patches: inner points; twisted patches: edges.
  for (const bool wraps : {true, false})
    for (const double height : {0.02e-6, 0.3e-6, 3e-6}) {
      const Surface s = rough(12, 9, height, 3, wraps);
      for (const double radius : {0.4e-6, 2e-6, 5e-6}) {
        const SphericalTip tip(s, radius);
        const Stream stream(7, "places");
        for (std::uint64_t k = 0; k < 20; ++k) {
          const Point at{stream.uniform(2 * k, 5e-6, 6e-6), stream.uniform(2 * k + 1, 5e-6, 6e-6)};
          const double t = tip.height(at), by_hand = tried(s, at, radius);
          EXPECT_GE(t, by_hand - 1e-13 * radius) << height << ", " << radius << ", " << k;
          EXPECT_LE(t, by_hand + 1e-5 * std::min(height, radius)) << height << ", " << radius << ", " << k;
        }
      }
    }
}

TEST(SphericalTip, NeverBelowTheSurfaceAndRisesWithTheRadius) {
  for (const bool wraps : {true, false})
    for (const double height : {0.05e-6, 1e-6, 20e-6}) {
      const Surface s = rough(31, 17, height, 5, wraps);
      const Stream stream(8, "places");
      for (std::uint64_t k = 0; k < 200; ++k) {
        const Point at{stream.uniform(2 * k, 0, 30e-6), stream.uniform(2 * k + 1, 0, 24e-6)};
        double before = height_between(s, at);
        EXPECT_EQ(SphericalTip(s, 0).height(at), before);
        for (const double radius : {1e-9, 0.3e-6, 1e-6, 2e-6, 2.0000001e-6, 7e-6, 50e-6, 1e-3}) {
          const double t = SphericalTip(s, radius).height(at);
          EXPECT_GE(t, height_between(s, at));
          EXPECT_GE(t, before - 4e-15 * height) << radius << ", " << k;
          before = t;
        }
        EXPECT_LE(before, s.height_range().max);
      }
    }
}

TEST(SphericalTip, AVeryLargeSphereRestsOnTheHighestNode) {
  const Surface s = rough(16, 16, 1e-6);
  EXPECT_NEAR(SphericalTip(s, 1e6).height({3e-6, 4e-6}), s.height_range().max, 1e-16);
}

TEST(SphericalTip, ASpikeIsSeenAsTheTipItself) {
  Surface spike =
      make_surface(21, 21, 21e-6, 21e-6, [](int i, int j) { return i == 10 && j == 10 ? 1e-3 : 0.0; });
  const SphericalTip tip(spike, 4e-6);
  for (const double d : {0.0, 1e-6, 2.5e-6, 3.99e-6})
    EXPECT_NEAR(tip.height({10e-6 + d, 10e-6}),
                std::max(1e-3 + std::sqrt(16e-12 - d * d) - 4e-6, height_between(spike, {10e-6 + d, 10e-6})),
                1e-17);
  EXPECT_EQ(tip.height({15.001e-6, 10e-6}), 0);  // the spike is one cell wide
}

TEST(SphericalTip, WrapsOnAPeriodicSurfaceAndEndsWithAnyOther) {
  const auto ridge = [](int i, int) { return i == 0 ? 1e-6 : 0.0; };
  const Surface wraps = make_surface(16, 4, 16e-6, 4e-6, ridge, periodic());
  const Surface ends = make_surface(16, 4, 16e-6, 4e-6, ridge);
  EXPECT_GT(SphericalTip(wraps, 10e-6).height({14e-6, 1e-6}), 0.5e-6);
  EXPECT_EQ(SphericalTip(ends, 10e-6).height({14e-6, 1e-6}), 0);
  EXPECT_EQ(SphericalTip(ends, 10e-6).height({-50e-6, 300e-6}), 1e-6);  // the rim's height
  EXPECT_NEAR(SphericalTip(wraps, 10e-6).height({14e-6, 1e-6}),
              SphericalTip(wraps, 10e-6).height({14e-6 - 48e-6, 1e-6 + 40e-6}), 1e-20);
}

TEST(SphericalTip, StandsOnFlatsAndOnSingleNodes) {
  for (const bool wraps : {true, false})
    for (const auto& [nx, ny] : {std::pair{1, 1}, {1, 5}, {6, 1}, {2, 2}}) {
      const Surface flat = make_surface(
          nx, ny, 1e-6 * nx, 1e-6 * ny, [](int, int) { return 3e-6; }, wraps ? periodic() : SurfaceTraits{});
      EXPECT_EQ(SphericalTip(flat, 2e-6).height({0.3e-6, 0.4e-6}), 3e-6);
      for (const Surface& s : {dilated(flat, 2e-6), closed(flat, 2e-6)})
        for (const double h : s.heights().values()) EXPECT_EQ(h, 3e-6);
    }
  const Surface line = make_surface(5, 1, 5e-6, 1e-6, [](int i, int) { return 0.5e-6 * i; });
  EXPECT_NEAR(SphericalTip(line, 1e-6).height({2.2e-6, 0}), 1.1e-6 + 1e-6 * (std::sqrt(1.25) - 1), 1e-20);
}

TEST(SphericalTip, RefusesRadiiThatAreNone) {
  const Surface s = rough(4, 4, 1e-6);
  EXPECT_EQ(refusal(s, -1e-9), "`tip` is -1e-09 m; give a finite radius of 0 or more");
  EXPECT_EQ(refusal(s, std::nan("")), "`tip` is nan m; give a finite radius of 0 or more");
  EXPECT_EQ(refusal(s, std::numeric_limits<double>::infinity()),
            "`tip` is inf m; give a finite radius of 0 or more");
  EXPECT_EQ(refusal(s, 0), "accepted");
  EXPECT_THROW(dilated(s, -1), Error);
  EXPECT_THROW(closed(s, std::nan("")), Error);
}

TEST(Dilation, IsTheGreatestOverTheNodes) {
  for (const bool wraps : {true, false}) {
    const Surface s = rough(11, 8, 0.5e-6, 2, wraps);
    for (const double radius : {0.5e-6, 1.2e-6, 3e-6, 40e-6}) {
      const Surface d = dilated(s, radius);
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 11; ++i) {
          double best = -1;
          for (int q = -60; q <= 60; ++q)
            for (int p = -60; p <= 60; ++p) {
              const int a = i + p, b = j + q;
              const double d2 = p * p * 1e-12 + q * q * 2.25e-12;
              if (d2 > radius * radius || (!wraps && (a < 0 || b < 0 || a > 10 || b > 7))) continue;
              best = std::max(best, s.heights()((a % 11 + 11) % 11, (b % 8 + 8) % 8) +
                                        std::sqrt(radius * radius - d2) - radius);
            }
          ASSERT_NEAR(d.heights()(i, j), best, 1e-20 + 1e-15 * radius) << i << ", " << j << ", " << radius;
        }
    }
  }
}

TEST(Dilation, IsBelowTheTipOnTheBilinearSurfaceAndNearsItWithFinerCells) {
  double before = 1;
  for (const int n : {32, 64, 128}) {
    const Surface s = make_surface(
        n, n, 8e-6, 8e-6,
        [n](int i, int j) { return 0.2e-6 * std::sin(4 * pi * i / n) * std::cos(2 * pi * (i + 2 * j) / n); },
        periodic());
    const Surface d = dilated(s, 2e-6);
    const SphericalTip tip(s, 2e-6);
    double worst = 0;
    for (int j = 0; j < n; j += 3)
      for (int i = 0; i < n; i += 3) {
        const double t = tip.height({i * s.grid().hx(), j * s.grid().hy()});
        EXPECT_GE(t, d.heights()(i, j) - 1e-21);
        worst = std::max(worst, t - d.heights()(i, j));
      }
    EXPECT_LT(worst, 0.5 * before);
    before = worst;
  }
}

TEST(Closing, TwiceIsOnceAndFillsOnly) {
  for (const bool wraps : {true, false})
    for (const double radius : {0.7e-6, 2e-6, 9e-6, 1e-3}) {
      const Surface s = rough(40, 33, 1e-6, 4, wraps);
      const Surface once = closed(s, radius), twice = closed(once, radius);
      const Surface lifted = dilated(s, radius), again = dilated(once, radius);
      for (std::size_t k = 0; k < s.heights().size(); ++k) {
        ASSERT_NEAR(twice.heights()[k], once.heights()[k], 4e-21) << radius;  // a few ulps of 1e-6
        ASSERT_NEAR(again.heights()[k], lifted.heights()[k], 4e-21) << radius;
        ASSERT_GE(once.heights()[k], s.heights()[k] - 4e-21);
        ASSERT_LE(once.heights()[k], lifted.heights()[k]);
        ASSERT_GE(lifted.heights()[k], s.heights()[k]);
      }
    }
}

TEST(Closing, GrowsWithTheRadiusAndNeedlesChangeNothing) {
  const Surface s = rough(24, 20, 1e-6, 6);
  EXPECT_EQ(dilated(s, 0).digest(), s.digest());
  EXPECT_EQ(closed(s, 0).digest(), s.digest());
  EXPECT_EQ(dilated(s, 0.99e-6).digest(), s.digest());  // no other node within reach
  const Surface* before = &s;
  Surface small = s;
  for (const double radius : {1.1e-6, 2e-6, 4e-6, 30e-6}) {
    const Surface now = dilated(s, radius);
    for (std::size_t k = 0; k < now.heights().size(); ++k)
      ASSERT_GE(now.heights()[k], before->heights()[k]) << radius;
    small = now;
    before = &small;
  }
}

TEST(Closing, LeavesWhatTheTipCanEnter) {
  // A sphere wider than the tip.
  const Surface bowl = make_surface(64, 64, 32e-6, 32e-6, [](int i, int j) {
    const double r2 = std::pow((i - 32) * 0.5e-6, 2) + std::pow((j - 32) * 0.5e-6, 2);
    return r2 / (2 * 50e-6);
  });
  const Surface c = closed(bowl, 20e-6);
  for (int j = 20; j < 44; ++j)
    for (int i = 20; i < 44; ++i)
      ASSERT_NEAR(c.heights()(i, j), bowl.heights()(i, j), 1e-8) << i << ", " << j;
}

TEST(Dilation, SameBitsForAnyNumberOfThreads) {
  const Surface s = rough(300, 530, 1e-6, 9);
  set_thread_count(1);
  const std::string one = closed(s, 3e-6).digest();
  set_thread_count(3);
  EXPECT_EQ(closed(s, 3e-6).digest(), one);
  set_thread_count(2);
}

}  // namespace
}  // namespace asperity::spherical_tip_test
