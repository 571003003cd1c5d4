// SPDX-License-Identifier: GPL-3.0-or-later
// The preconditioner against its definition by sweeps over the whole grid.
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::contact_preconditioner_test {
namespace {

using Mask = Array<std::uint8_t>;

Field noise(int nx, int ny, std::uint64_t seed) {
  const Stream stream(seed, "preconditioner test");
  Field field(nx, ny);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = stream.normal(k);
  return field;
}

// `share` of the nodes free, in patches.
Mask patches(int nx, int ny, double share) {
  const Stream stream(7, "patches");
  Field heights(nx, ny);
  for (int wave = 0; wave < 12; ++wave) {
    const auto w = static_cast<std::uint64_t>(wave);
    const int a = static_cast<int>(6 * stream.uniform(3 * w)),
              b = static_cast<int>(6 * stream.uniform(3 * w + 1));
    const double phase = 6.28 * stream.uniform(3 * w + 2);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        heights(i, j) += std::cos(2 * std::numbers::pi *
                                      (a * i / static_cast<double>(nx) + b * j / static_cast<double>(ny)) +
                                  phase);
  }
  Array<double> sorted(heights.values().begin(), heights.values().end());
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const auto count = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  Mask free(heights.size(), 0);
  if (count > 0)
    for (std::size_t k = 0; k < free.size(); ++k) free[k] = heights[k] >= sorted[count - 1] ? 1 : 0;
  return free;
}

double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

Field applied(ContactPreconditioner& preconditioner, const Field& r) {
  Field z(r.nx(), r.ny());
  preconditioner.apply(r.values(), z.values());
  return z;
}

// Smooth field C r and its transpose: hats about 32 nodes apart (free boundary: from rim to rim) times the
// residual beneath, divided by the free nodes beneath plus 3 % of the nodes beneath.
class SmoothField {
 public:
  SmoothField(int nx, int ny, Boundary boundary, const Mask& free)
      : x_(hats(nx, boundary)), y_(hats(ny, boundary)), nx_(nx), free_(free) {
    for (const auto& along : x_)
      for (const auto& across : y_) {
        double here = 0, all = 0;
        for (int k = 0; k < nx * ny; ++k) {
          all += value(along, across, k);
          here += free[static_cast<std::size_t>(k)] != 0 ? value(along, across, k) : 0;
        }
        divisors_.push_back(here + 0.03 * all);
      }
  }
  void add(const Field& from, bool from_free, bool to_free, Field& to) const {
    std::size_t hat = 0;
    for (const auto& along : x_)
      for (const auto& across : y_) {
        double sum = 0;
        for (std::size_t k = 0; k < from.size(); ++k)
          sum += !from_free || free_[k] != 0 ? value(along, across, static_cast<int>(k)) * from[k] : 0;
        sum /= divisors_[hat++];
        for (std::size_t k = 0; k < to.size(); ++k)
          to[k] += !to_free || free_[k] != 0 ? value(along, across, static_cast<int>(k)) * sum : 0;
      }
  }

 private:
  using Hat = std::vector<double>;
  static std::vector<Hat> hats(int n, Boundary boundary) {
    const bool wraps = boundary == Boundary::periodic;
    const int steps = std::max(1, n / 32);
    std::vector<Hat> all;
    for (int i = 0; i < (wraps ? steps : steps + 1); ++i) {
      Hat hat;
      for (int k = 0; k < n; ++k) {
        double apart = std::abs((wraps ? k : k + 0.5) * steps / n - i);
        if (wraps) apart = std::min(apart, steps - apart);
        hat.push_back(wraps && steps == 1 ? 1 : std::max(0.0, 1 - apart));
      }
      all.push_back(hat);
    }
    return all;
  }
  double value(const Hat& along, const Hat& across, int k) const {
    return along[static_cast<std::size_t>(k % nx_)] * across[static_cast<std::size_t>(k / nx_)];
  }
  std::vector<Hat> x_, y_;
  int nx_;
  const Mask& free_;
  std::vector<double> divisors_;
};

// In double precision: sweeps set one chessboard colour to the mean of the neighbours (not across the seam of
// an odd periodic side), for the residual minus its smooth field.
Field defined(const Field& r, const Mask& free, double aspect, Boundary boundary, int sweeps) {
  const int nx = r.nx(), ny = r.ny();
  const bool wraps_x = boundary == Boundary::periodic && nx % 2 == 0;
  const bool wraps_y = boundary == Boundary::periodic && ny % 2 == 0;
  const double share = nx == 1 || ny == 1 ? 0.5 : 0.25;
  const auto neighbours = [&](int i, int j, const auto& call) {
    const int places[4][2] = {{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}};
    for (const auto& [x, y] : places) {
      if ((!wraps_x && (x < 0 || x >= nx)) || (!wraps_y && (y < 0 || y >= ny))) continue;
      call((x + nx) % nx, (y + ny) % ny);
    }
  };
  const auto bound_of_colour = [&](int colour, const auto& call) {
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        if ((i + j) % 2 == colour &&
            free[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i)] ==
                0)
          call(i, j);
  };
  const SmoothField smooth(nx, ny, boundary, free);
  Field c(nx, ny), e(nx, ny), z(nx, ny);
  smooth.add(r, true, false, c);
  for (std::size_t k = 0; k < e.size(); ++k) e[k] = free[k] != 0 ? r[k] - c[k] : 0;
  for (int s = 1; s <= sweeps; ++s)
    bound_of_colour(s % 2, [&](int i, int j) {
      double sum = 0;
      neighbours(i, j, [&](int x, int y) { sum += e(x, y); });
      e(i, j) = share * sum;
    });
  for (std::size_t k = 0; k < e.size(); ++k) e[k] += c[k];
  HalfOrderPyramid pyramid(nx, ny, aspect, boundary);
  std::transform(e.values().begin(), e.values().end(), pyramid.input().begin(),
                 [](double v) { return static_cast<float>(v); });
  const auto product = pyramid.apply();
  Field y(nx, ny);
  std::copy(product.begin(), product.end(), y.values().begin());
  const Field before = y;
  for (int s = sweeps; s >= 1; --s)
    bound_of_colour(s % 2, [&](int i, int j) {
      neighbours(i, j, [&](int x, int other) { y(x, other) += share * y(i, j); });
      y(i, j) = 0;
    });
  Field left = before;
  for (std::size_t k = 0; k < y.size(); ++k) {
    z[k] = free[k] != 0 ? y[k] : 0;
    left[k] -= z[k];
  }
  smooth.add(left, false, true, z);
  return z;
}

struct Case {
  int nx, ny;
  double aspect, share;
  int sweeps;
};
constexpr Case cases[] = {
    {64, 64, 1, 0.2, 8},   {320, 192, 1, 0.4, 8},  {320, 192, 1, 0.02, 8}, {64, 64, 1, 1, 8},
    {64, 64, 1, 0.9, 3},   {64, 64, 1, 0.3, 0},    {257, 70, 1, 0.3, 8},   {257, 134, 1, 0.3, 8},
    {300, 130, 1, 0.1, 8}, {5, 7, 1, 0.5, 8},      {1, 30, 1, 0.4, 8},     {900, 1, 1, 0.6, 8},
    {72, 40, 2.5, 0.3, 8}, {40, 300, 0.1, 0.5, 1}, {96, 80, 1, 0.35, 11},  {640, 8, 1, 0.3, 8}};

class Preconditioner : public ::testing::TestWithParam<std::tuple<Boundary, Case>> {
 protected:
  Boundary boundary = std::get<0>(GetParam());
  Case tested = std::get<1>(GetParam());
  Mask free = patches(tested.nx, tested.ny, tested.share);
  ContactPreconditioner preconditioner{tested.nx, tested.ny, tested.aspect, boundary, 1, tested.sweeps};
  void SetUp() override { preconditioner.set_free(free); }
};

TEST_P(Preconditioner, IsItsDefinition) {
  const Field r = noise(tested.nx, tested.ny, 1);
  const Field z = applied(preconditioner, r);
  const Field expected = defined(r, free, tested.aspect, boundary, tested.sweeps);
  const double size = std::sqrt(dot(expected, expected) / static_cast<double>(z.size()));
  for (std::size_t k = 0; k < z.size(); ++k) ASSERT_NEAR(z[k], expected[k], 2e-5 * size + 1e-6) << k;
}

TEST_P(Preconditioner, IsSymmetricPositiveAndZeroOffTheFreeSet) {
  const Field a = noise(tested.nx, tested.ny, 1), b = noise(tested.nx, tested.ny, 2);
  const Field ma = applied(preconditioner, a), mb = applied(preconditioner, b);
  EXPECT_NEAR(dot(a, mb), dot(b, ma), 1e-5 * std::sqrt(dot(a, a) * dot(mb, mb)));
  EXPECT_GT(dot(a, ma), 0);
  for (std::size_t k = 0; k < free.size(); ++k) ASSERT_TRUE(free[k] != 0 || ma[k] == 0) << k;
}

TEST_P(Preconditioner, ReadsOnlyTheFreeSetAndWorksInPlace) {
  Field r = noise(tested.nx, tested.ny, 1);
  const Field z = applied(preconditioner, r);
  for (std::size_t k = 0; k < free.size(); ++k)
    if (free[k] == 0) r[k] = std::numeric_limits<double>::quiet_NaN();
  preconditioner.apply(r.values(), r.values());
  for (std::size_t k = 0; k < z.size(); ++k) ASSERT_EQ(r[k], z[k]) << k;
}

TEST_P(Preconditioner, PowersOfTwoChangeNoBit) {
  const Field r = noise(tested.nx, tested.ny, 1);
  const Field z = applied(preconditioner, r);
  for (const int power : {-200, 30, 400}) {
    Field scaled = r;
    for (double& value : scaled.values()) value = std::ldexp(value, power);
    const Field y = applied(preconditioner, scaled);
    for (std::size_t k = 0; k < z.size(); ++k) ASSERT_EQ(y[k], std::ldexp(z[k], power)) << k;
  }
}

TEST_P(Preconditioner, ThreadsDoNotChangeABit) {
  const Field r = noise(tested.nx, tested.ny, 1);
  set_thread_count(1);
  const Field alone = applied(preconditioner, r);
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    preconditioner.set_free(free);
    const Field shared = applied(preconditioner, r);
    for (std::size_t k = 0; k < r.size(); ++k) ASSERT_EQ(alone[k], shared[k]);
  }
  set_thread_count(0);
}

std::string title(const ::testing::TestParamInfo<Preconditioner::ParamType>& tested) {
  const Case c = std::get<1>(tested.param);
  return std::string(name(std::get<0>(tested.param))) + "_" + std::to_string(c.nx) + "x" +
         std::to_string(c.ny) + "_" + std::to_string(static_cast<int>(100 * c.share)) + "_" +
         std::to_string(c.sweeps);
}

INSTANTIATE_TEST_SUITE_P(Grids, Preconditioner,
                         ::testing::Combine(::testing::Values(Boundary::periodic, Boundary::free),
                                            ::testing::ValuesIn(cases)),
                         title);

TEST(ContactPreconditioner, NothingFreeGivesNothing) {
  ContactPreconditioner preconditioner(32, 32, 1, Boundary::periodic);
  const Field none = applied(preconditioner, noise(32, 32, 1));
  EXPECT_EQ(dot(none, none), 0);
}

TEST(ContactPreconditioner, ANewFreeSetForgetsTheOld) {
  const Mask first = patches(300, 200, 0.5), second = patches(300, 200, 0.03);
  const Field r = noise(300, 200, 1);
  ContactPreconditioner used(300, 200, 1, Boundary::periodic), fresh(300, 200, 1, Boundary::periodic);
  used.set_free(first);
  applied(used, r);
  used.set_free(second);
  fresh.set_free(second);
  const Field a = applied(used, r), b = applied(fresh, r);
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(a[k], b[k]) << k;
}

// In the first tile, the row below the end of the shorter second tile has values a thousand times larger.
TEST(ContactPreconditioner, ATileTakesNothingFromTheTileBefore) {
  constexpr int nx = 128, sweeps = 8;
  set_thread_count(1);
  for (const int height : {8, 16, 32, 48}) {
    const int ny = 64 + height;
    Field r = noise(nx, ny, 1);
    Mask free(r.size(), 0);
    const auto stripe = [&](int from, int to, double factor) {
      for (int j = from; j < to; ++j)
        for (int i = 0; i < nx; ++i) {
          const std::size_t k = static_cast<std::size_t>(j) * nx + static_cast<std::size_t>(i);
          free[k] = 1;
          r[k] = factor * std::abs(r[k]);
        }
    };
    stripe(height, height + sweeps, 1000);
    stripe(ny - 4, ny, 1);
    ContactPreconditioner preconditioner(nx, ny, 1, Boundary::periodic, 1, sweeps);
    preconditioner.set_free(free);
    const Field z = applied(preconditioner, r), expected = defined(r, free, 1, Boundary::periodic, sweeps);
    for (std::size_t k = z.size() - 4 * nx; k < z.size(); ++k)
      EXPECT_NEAR(z[k], expected[k], 1e-4) << height << ", " << k;
  }
  set_thread_count(0);
}

TEST(ContactPreconditioner, OneFreeNodeAnywhere) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const int at : {0, 255, 256, 63, 64, 299}) {
      ContactPreconditioner preconditioner(300, 300, 1, boundary);
      Mask free(300 * 300, 0);
      const std::size_t k = static_cast<std::size_t>(at) * 300 + static_cast<std::size_t>(at);
      free[k] = 255;
      preconditioner.set_free(free);
      Field r(300, 300);
      r[k] = 1e-300;
      const double z = applied(preconditioner, r)[k];
      EXPECT_GT(z, 0.2e-300) << at;
      EXPECT_LT(z, 1.4e-300) << at;
    }
}

// To a residual of 1e-8; the free boundary avoids the singular mean.
int iterations(const Mask& free, int nx, int ny, double aspect, int sweeps) {
  HalfSpaceCompliance compliance(nx, ny, aspect, Boundary::free);
  ContactPreconditioner preconditioner(nx, ny, aspect, Boundary::free, 1, std::max(sweeps, 0));
  preconditioner.set_free(free);
  Field r = noise(nx, ny, 5), p(nx, ny), q(nx, ny), d(nx, ny);
  for (std::size_t k = 0; k < r.size(); ++k)
    if (free[k] == 0) r[k] = 0;
  const double start = std::sqrt(dot(r, r));
  double old = 0;
  int count = 0;
  for (; std::sqrt(dot(r, r)) > 1e-8 * start && count < 1000; ++count) {
    const Field z = sweeps < 0 ? r : applied(preconditioner, r);
    const double now = dot(r, z);
    for (std::size_t k = 0; k < d.size(); ++k) d[k] = z[k] + (count == 0 ? 0 : now / old * d[k]);
    old = now;
    compliance.apply(d.values(), q.values());
    const double step = now / dot(d, q);
    for (std::size_t k = 0; k < d.size(); ++k)
      if (free[k] != 0) {
        p[k] += step * d[k];
        r[k] -= step * q[k];
      }
  }
  return count;
}

TEST(ContactPreconditioner, HalvesTheDigitsInAFewIterations) {
  const Mask free = patches(150, 131, 0.3);
  const int plain = iterations(free, 150, 131, 1, -1), extended = iterations(free, 150, 131, 1, 4);
  EXPECT_LT(extended, 20);
  EXPECT_LT(3 * extended, plain);
  EXPECT_LT(iterations(free, 150, 131, 4, 4), 45);
}

// z·K z/z·r for a residual as long as the tile: the overestimate of stiffness. A residual cut near each
// contact would give 2.6, 4.6 and 8.6 (measured with a `reluctance` of 1e9).
TEST(ContactPreconditioner, ALongResidualIsCarriedOverTheGroundBetweenContacts) {
  for (const int n : {160, 320, 640}) {
    Mask free(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        free[static_cast<std::size_t>(j * n + i)] = std::hypot(i % 20 - 10, j % 20 - 10) < 6 ? 1 : 0;
    ContactPreconditioner preconditioner(n, n, 1, Boundary::periodic);
    HalfSpaceCompliance compliance(n, n, 1, Boundary::periodic);
    preconditioner.set_free(free);
    Field r(n, n), image(n, n);
    double sum = 0, count = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (free[static_cast<std::size_t>(j * n + i)] != 0) {
          r(i, j) = std::cos(2 * std::numbers::pi * i / n);
          sum += r(i, j), count += 1;
        }
    for (std::size_t k = 0; k < r.size(); ++k)
      if (free[k] != 0) r[k] -= sum / count;
    const Field z = applied(preconditioner, r);
    compliance.apply(z.values(), image.values());
    EXPECT_LT(dot(z, image) / dot(z, r), 1.3) << n;
  }
}

TEST(ContactPreconditioner, RefusesAnotherGrid) {
  ContactPreconditioner preconditioner(8, 8, 1, Boundary::periodic);
  Field small(8, 7);
  EXPECT_THROW(preconditioner.set_free(Mask(63, 1)), Error);
  EXPECT_THROW(preconditioner.apply(small.values(), small.values()), Error);
}

TEST(ContactPreconditioner, HoldsTwoGridsAtMost) {
  set_thread_count(1);
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const auto& [nx, ny] : {std::pair(512, 512), std::pair(401, 600)}) {
      const std::int64_t before = memory::held();
      ContactPreconditioner preconditioner(nx, ny, 1, boundary);
      Mask free = patches(nx, ny, 0.4);
      preconditioner.set_free(free);
      Field r = noise(nx, ny, 1);
      preconditioner.apply(r.values(), r.values());
      const double held =
          static_cast<double>(memory::held() - before) / static_cast<double>(sizeof(double) * r.size()) -
          9.0 / 8;
      EXPECT_LE(held, 2.0);
      EXPECT_GE(held, 1.0);
    }
  set_thread_count(0);
}

}  // namespace
}  // namespace asperity::contact_preconditioner_test
