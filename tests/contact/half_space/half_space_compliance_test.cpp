// SPDX-License-Identifier: GPL-3.0-or-later
// The operator against dense sums, on sizes no fast algorithm likes.
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::half_space_compliance_test {

namespace {

Field noise(int nx, int ny, std::uint64_t seed) {
  const Stream stream(seed, "compliance test");
  Field field(nx, ny);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = stream.normal(k);
  return field;
}

Field applied(HalfSpaceCompliance& compliance, const Field& p) {
  Field u(p.nx(), p.ny());
  compliance.apply(p.values(), u.values());
  return u;
}

double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

Field influences(int nx, int ny, double aspect, Boundary boundary) {
  Field k(nx, ny);
  const LoveKernel love(aspect);
  const double turn = 2 * std::numbers::pi;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      if (boundary == Boundary::free) {
        k(i, j) = love(i, j);
        continue;
      }
      double sum = 0;
      for (int b = 0; b < ny; ++b)
        for (int a = 0; a < nx; ++a) {
          if (a == 0 && b == 0) continue;
          const double qx = turn * std::min(a, nx - a) / nx, qy = turn * std::min(b, ny - b) / (ny * aspect);
          sum += 2 / std::hypot(qx, qy) * std::cos(turn * ((a * i) % nx) / nx) *
                 std::cos(turn * ((b * j) % ny) / ny);
        }
      k(i, j) = sum / (nx * ny);
    }
  return k;
}

Field dense(const Field& p, double aspect, Boundary boundary) {
  const int nx = p.nx(), ny = p.ny();
  const Field k = influences(nx, ny, aspect, boundary);
  const auto across = [&](int d, int n) {
    d = std::abs(d);
    return boundary == Boundary::periodic ? std::min(d, n - d) : d;
  };
  Field u(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int b = 0; b < ny; ++b)
        for (int a = 0; a < nx; ++a) u(i, j) += k(across(i - a, nx), across(j - b, ny)) * p(a, b);
  return u;
}

double relative_distance(const Field& a, const Field& b) {
  double difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k) difference += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(difference / dot(b, b));
}

struct Case {
  int nx, ny;
  double aspect;
};
constexpr Case cases[] = {{64, 64, 1}, {16, 8, 2},  {15, 9, 1},     {13, 17, 0.3}, {1, 12, 1},
                          {12, 1, 4},  {2, 3, 100}, {31, 32, 0.01}, {40, 24, 1},   {8, 6, 1}};

class Compliance : public ::testing::TestWithParam<std::tuple<Boundary, Case>> {
 protected:
  Boundary boundary = std::get<0>(GetParam());
  Case grid = std::get<1>(GetParam());
  HalfSpaceCompliance compliance{grid.nx, grid.ny, grid.aspect, boundary};
};

TEST_P(Compliance, IsTheDenseProduct) {
  const Field p = noise(grid.nx, grid.ny, 1);
  EXPECT_LT(relative_distance(applied(compliance, p), dense(p, grid.aspect, boundary)), 1e-13);
}

TEST_P(Compliance, IsSymmetricAndPositive) {
  const Field a = noise(grid.nx, grid.ny, 1), b = noise(grid.nx, grid.ny, 2);
  const Field ka = applied(compliance, a), kb = applied(compliance, b);
  EXPECT_NEAR(dot(a, kb), dot(b, ka), 1e-13 * std::sqrt(dot(a, a) * dot(kb, kb)));
  EXPECT_GT(dot(a, ka), 0);
}

TEST_P(Compliance, WorksInPlace) {
  const Field p = noise(grid.nx, grid.ny, 1);
  const Field u = applied(compliance, p);
  Field same = p;
  compliance.apply(same.values(), same.values());
  for (std::size_t k = 0; k < u.size(); ++k) ASSERT_EQ(same[k], u[k]) << k;
}

TEST_P(Compliance, PowersOfTwoChangeNoBit) {
  const Field p = noise(grid.nx, grid.ny, 1);
  Field scaled = p;
  for (double& value : scaled.values()) value = std::ldexp(value, -37);
  const Field u = applied(compliance, p), v = applied(compliance, scaled);
  for (std::size_t k = 0; k < u.size(); ++k) ASSERT_EQ(v[k], std::ldexp(u[k], -37)) << k;
}

std::string title(const ::testing::TestParamInfo<Compliance::ParamType>& tested) {
  const Case grid = std::get<1>(tested.param);
  return std::string(name(std::get<0>(tested.param))) + "_" + std::to_string(grid.nx) + "x" +
         std::to_string(grid.ny);
}

INSTANTIATE_TEST_SUITE_P(Grids, Compliance,
                         ::testing::Combine(::testing::Values(Boundary::periodic, Boundary::free),
                                            ::testing::ValuesIn(cases)),
                         title);

class Threads : public ::testing::TestWithParam<Boundary> {
 protected:
  void TearDown() override { set_thread_count(0); }
};

TEST_P(Threads, DoNotChangeABit) {
  for (const auto& [nx, ny] : {std::pair(96, 160), std::pair(101, 75)}) {
    const Field p = noise(nx, ny, 1);
    set_thread_count(1);
    HalfSpaceCompliance alone(nx, ny, 1.25, GetParam());
    const Field u = applied(alone, p);
    for (const int threads : {2, 3}) {
      set_thread_count(threads);
      HalfSpaceCompliance shared(nx, ny, 1.25, GetParam());
      const Field v = applied(shared, p);
      for (std::size_t k = 0; k < u.size(); ++k) ASSERT_EQ(u[k], v[k]) << threads << " threads, " << k;
    }
  }
}

TEST_P(Threads, AnUnalignedResultIsTheSame) {
  const int nx = 64, ny = 40;
  HalfSpaceCompliance compliance(nx, ny, 1, GetParam());
  const Field p = noise(nx, ny, 1);
  const Field u = applied(compliance, p);
  Array<double> shifted(u.size() + 1);
  compliance.apply(p.values(), std::span(shifted).subspan(1));
  for (std::size_t k = 0; k < u.size(); ++k) ASSERT_EQ(shifted[k + 1], u[k]) << k;
}

TEST_P(Threads, AnApplicationIsTwoWeightedTransforms) {
  HalfSpaceCompliance compliance(32, 20, 1, GetParam(), 0.25);
  const CostScope scope;
  applied(compliance, noise(32, 20, 1));
  EXPECT_DOUBLE_EQ(scope.so_far().transforms, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, Threads, ::testing::Values(Boundary::periodic, Boundary::free));

TEST(PeriodicCompliance, AWaveIsMultipliedByTwoOverItsNumber) {
  const int nx = 48, ny = 30;
  const double aspect = 1.5, qx = 2 * std::numbers::pi * 5 / nx,
               qy = 2 * std::numbers::pi * 3 / (ny * aspect);
  HalfSpaceCompliance compliance(nx, ny, aspect, Boundary::periodic);
  Field p(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) p(i, j) = std::cos(qx * i + qy * aspect * j);
  const Field u = applied(compliance, p);
  for (std::size_t k = 0; k < p.size(); ++k) ASSERT_NEAR(u[k], 2 / std::hypot(qx, qy) * p[k], 1e-13);
}

TEST(PeriodicCompliance, AConstantMovesNothing) {
  HalfSpaceCompliance compliance(20, 20, 1, Boundary::periodic);
  const Field u = applied(compliance, Field(20, 20, 3.0));
  for (const double value : u.values()) EXPECT_NEAR(value, 0, 1e-14);
}

TEST(PeriodicCompliance, PressureToDisplacementToPressure) {
  for (const auto& [nx, ny] : {std::pair(64, 64), std::pair(37, 50)}) {
    HalfSpaceCompliance compliance(nx, ny, 0.7, Boundary::periodic);
    Field p = noise(nx, ny, 1);
    const double average = mean(p.values());
    for (double& value : p.values()) value -= average;
    const Field u = applied(compliance, p);
    Field back(nx, ny);
    compliance.apply_inverse(u.values(), back.values());
    EXPECT_LT(relative_distance(back, p), 1e-12);
    EXPECT_NEAR(mean(back.values()), 0, 1e-14);
  }
}

TEST(PeriodicCompliance, AnInverseWithSpringsIsThatOfTheSum) {
  for (const double softer : {1e-3, 1.0, 1e6}) {
    HalfSpaceCompliance compliance(37, 50, 0.7, Boundary::periodic);
    const Field p = noise(37, 50, 1);
    Field u = applied(compliance, p), back(37, 50);
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += softer * p[k];
    compliance.apply_inverse(u.values(), back.values(), softer);
    EXPECT_LT(relative_distance(back, p), 1e-11) << softer;
  }
}

TEST(PeriodicCompliance, EnergyInFourierSpaceIsThatInRealSpace) {
  const int n = 16;
  const Field p = noise(n, n, 1);
  HalfSpaceCompliance compliance(n, n, 1, Boundary::periodic);
  const double turn = 2 * std::numbers::pi / n;
  double energy = 0;
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      if (a == 0 && b == 0) continue;
      double re = 0, im = 0;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          re += p(i, j) * std::cos(turn * (a * i + b * j));
          im += p(i, j) * std::sin(turn * (a * i + b * j));
        }
      energy += (re * re + im * im) / (turn * std::hypot(std::min(a, n - a), std::min(b, n - b))) / (n * n);
    }
  EXPECT_NEAR(0.5 * dot(p, applied(compliance, p)) / energy, 1, 1e-12);
}

TEST(FreeCompliance, DoesNotWrap) {
  const int n = 50;
  HalfSpaceCompliance compliance(n, n, 1, Boundary::free);
  Field p(n, n);
  p(0, 0) = 1;
  const Field u = applied(compliance, p);
  EXPECT_NEAR(u(n - 1, 0), LoveKernel(1)(n - 1, 0), 1e-15);
  EXPECT_NEAR(u(n - 1, n - 1), LoveKernel(1)(n - 1, n - 1), 1e-15);
  EXPECT_NEAR(u(0, 0), LoveKernel(1)(0, 0), 1e-14);
}

TEST(HalfSpaceCompliance, HoldsAGridAndAQuarterOrThree) {
  set_thread_count(1);
  const int n = 512;
  for (const auto& [boundary, grids] :
       {std::pair(Boundary::periodic, 1.25), std::pair(Boundary::free, 3.0)}) {
    const std::int64_t before = memory::held();
    HalfSpaceCompliance compliance(n, n, 1, boundary);
    Field p(n, n, 1.0);
    compliance.apply(p.values(), p.values());
    const double held =
        static_cast<double>(memory::held() - before) / static_cast<double>(sizeof(double) * p.size()) - 1;
    EXPECT_NEAR(held, grids, 0.1 * grids);
  }
  set_thread_count(0);
}

// Sides that are odd or have a large prime factor are padded.
TEST(HalfSpaceCompliance, OnPaddedTilesIsTheMultiplierOfTheTile) {
  for (const int nx : {1, 2, 15, 22, 37, 74, 101})
    for (const int ny : {1, 2, 15, 22, 37, 101}) {
      const double aspect = 1.3;
      HalfSpaceCompliance exact(nx, ny, aspect, Boundary::periodic);
      HalfSpaceCompliance rounded(nx, ny, aspect, Boundary::periodic, 1, true);
      EXPECT_TRUE(rounded.single());
      const Field p = noise(nx, ny, 1);
      Field expected(nx, ny);
      FourierFilter(nx, ny, nx, ny)
          .apply(p.values(), expected.values(), [&](int a, std::span<double> factors) {
            for (std::size_t b = 0; b < factors.size(); ++b) {
              const double q =
                  2 * std::numbers::pi *
                  std::hypot(static_cast<double>(a) / nx, static_cast<double>(b) / (ny * aspect));
              factors[b] = q > 0 ? 2 / q : 0;
            }
          });
      double most = 1e-3;
      for (const double value : expected.values()) most = std::max(most, std::abs(value));
      const Field u = applied(exact, p), v = applied(rounded, p);
      for (std::size_t k = 0; k < u.size(); ++k) {
        ASSERT_NEAR(u[k], expected[k], 2e-14 * most) << nx << " x " << ny;
        ASSERT_NEAR(v[k], expected[k], 4e-6 * most) << nx << " x " << ny;
      }
      Field back(nx, ny);
      exact.apply_inverse(u.values(), back.values());
      const double average = mean(p.values());
      for (std::size_t k = 0; k < u.size(); ++k)
        ASSERT_NEAR(back[k], p[k] - average, 1e-11) << nx << " x " << ny;
    }
}

TEST(HalfSpaceCompliance, MovesWithItsWorkSpace) {
  HalfSpaceCompliance first(16, 16, 1, Boundary::periodic);
  const Field p = noise(16, 16, 1);
  const Field u = applied(first, p);
  HalfSpaceCompliance second = std::move(first);
  const Field v = applied(second, p);
  for (std::size_t k = 0; k < u.size(); ++k) ASSERT_EQ(u[k], v[k]);
}

struct Known {
  double i, j, aspect, displacement;
};

// From F(x, y) = x asinh(y/|x|) + y asinh(x/|y|) at the four corners, in quadruple precision.
constexpr Known known[] = {
    {0, 0, 1, 1.1221997046783602543},           {0.5, 0.5, 1, 0.56109985233918012714},
    {1, 0, 1, 0.33042149328895688005},          {0, 1, 1, 0.33042149328895688005},
    {1, 1, 1, 0.23067835905022324708},          {2, 0, 1, 0.16077577164498577536},
    {2, 1, 1, 0.14358608454020144613},          {3, 0, 1, 0.10658968464026208849},
    {5, 0, 1, 0.063767707534653556277},         {10, 0, 1, 0.031844239912068025932},
    {7, 3, 1, 0.041826235364247554302},         {60, 80, 1, 0.0031831121251685484318},
    {250, 0, 1, 0.0012732403935603374838},      {0, 3000, 1, 0.0001061032958858158459},
    {65536, 0, 1, 4.8570234098339642923e-06},   {40000, 65536, 1, 4.1458103104294345009e-06},
    {0, 0, 0.25, 0.49092589867204937641},       {0.5, 0.5, 0.25, 0.24546294933602468821},
    {1, 0, 0.25, 0.087061990485130452642},      {0, 1, 0.25, 0.23744701524117173869},
    {1, 1, 0.25, 0.083208446472873592541},      {10, 0, 0.25, 0.007964180317228990802},
    {60, 80, 0.25, 0.0012582520108744590514},   {40000, 65536, 0.25, 1.8409885439342805625e-06},
    {0, 0, 1000, 5.4755046190010867358},        {0.5, 0.5, 1000, 2.7377523095005433679},
    {1, 0, 1000, 4.4264077979212473801},        {0, 1, 1000, 0.34969912898755558493},
    {1, 1, 1000, 0.3496988460461418854},        {10, 0, 1000, 2.9320715583710375},
    {7, 3, 1000, 0.10710213324709403343},       {60, 80, 1000, 0.003978924267590318473},
    {65536, 0, 1000, 0.0048569762917866387569}, {40000, 65536, 1000, 4.8570225051902268421e-06},
};

TEST(LoveKernel, CoefficientsAreThoseOfTheClosedForm) {
  for (const Known& k : known)
    EXPECT_NEAR(LoveKernel(k.aspect)(k.i, k.j) / k.displacement, 1, 1e-13)
        << k.i << ", " << k.j << ", aspect " << k.aspect;
}

TEST(LoveKernel, CentreOfASquare) {
  EXPECT_NEAR(LoveKernel(1)(0, 0), 4 * std::log(1 + std::numbers::sqrt2) / std::numbers::pi, 1e-15);
}

// A quarter of the element by the rule of Takahasi and Mori: the kernel is not smooth at the edges.
TEST(LoveKernel, MeanOverTheElement) {
  const LoveKernel kernel(1);
  constexpr double step = 1.0 / 16, quarter_turn = std::numbers::pi / 2;
  const auto integral = [&](const auto& f) {
    double sum = 0;
    for (int k = -60; k <= 60; ++k) {
      const double t = k * step, s = quarter_turn * std::sinh(t);
      sum += step * quarter_turn * std::cosh(t) / (2 * std::pow(std::cosh(s), 2)) * f((1 + std::tanh(s)) / 2);
    }
    return sum;
  };
  const double mean =
      integral([&](double x) { return integral([&](double y) { return kernel(x / 2, y / 2); }); });
  EXPECT_NEAR(mean, 0.946402008819, 1e-12);
}

TEST(LoveKernel, IsEven) {
  const LoveKernel kernel(1.7);
  for (const int i : {0, 1, 5, 300})
    for (const int j : {0, 1, 4, 200}) {
      EXPECT_EQ(kernel(i, j), kernel(-i, j));
      EXPECT_EQ(kernel(i, j), kernel(i, -j));
    }
}

// The turned rectangle uses the other integration.
TEST(LoveKernel, ATurnedRectangleGivesTheSame) {
  for (const double aspect : {1.0, 0.125, 3.0})
    for (const int i : {0, 1, 2, 7, 150})
      for (const int j : {0, 1, 3, 90})
        EXPECT_NEAR(LoveKernel(1 / aspect)(j, i) * aspect / LoveKernel(aspect)(i, j), 1, 1e-13)
            << i << ", " << j << ", aspect " << aspect;
}

TEST(LoveKernel, FarAwayIsAPointForce) {
  for (const double aspect : {1.0, 0.01, 1000.0}) {
    const double distance = std::hypot(3e4, 5e4 * aspect);
    const double side = std::max(1.0, aspect);
    EXPECT_NEAR(LoveKernel(aspect)(3e4, 5e4) / (aspect / (std::numbers::pi * distance)), 1,
                std::pow(side / distance, 2));
  }
}

// Second difference of 1/kernel, nearly the distance, across changes of the integration method.
TEST(LoveKernel, HasNoSeams) {
  const LoveKernel kernel(1);
  for (int i = 30; i < 120; ++i) {
    const auto distance = [&](double at) { return 1 / (std::numbers::pi * kernel(at, 0)); };
    const double bend = distance(i - 1) - 2 * distance(i) + distance(i + 1);
    // distance(i) = i − 1/(24 i) + …
    EXPECT_NEAR(bend, -1 / (12 * std::pow(i, 3)), 2e-13 + 3 / std::pow(i, 5)) << i;
  }
}

}  // namespace

}  // namespace asperity::half_space_compliance_test
