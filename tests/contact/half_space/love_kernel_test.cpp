// SPDX-License-Identifier: GPL-3.0-or-later
// Love's rectangle against its closed form in 34 digits (case V1), near and far, square and not.
#include "engine/contact/elasticity/half_space/operator/love_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace asperity::love_kernel_test {
namespace {

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

// A quarter of the element, by the rule of Takahasi and Mori: the kernel is not smooth at the edges.
TEST(LoveKernel, MeanOverTheElement) {
  const LoveKernel kernel(1);
  constexpr double step = 1.0 / 16, quarter_turn = std::numbers::pi / 2;
  const auto integral = [&](const auto& f) {  // over [0, 1]
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

// Turning the rectangle and rescaling lengths: the two ways of integrating agree.
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

// Where one way of integrating takes over from another there is no step: the second difference of
// 1/kernel, nearly the distance itself, stays at rounding level.
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
}  // namespace asperity::love_kernel_test
