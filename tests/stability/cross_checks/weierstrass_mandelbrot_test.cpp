// SPDX-License-Identifier: GPL-3.0-or-later
// Heights against the multiprecision sum of engine/study/exact/weierstrass_mandelbrot_height.hpp, for
// orders whose phases no hardware float holds.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "engine/core/arithmetic/random.hpp"
#include "engine/study/exact/closed_forms.hpp"

namespace asperity::stability::weierstrass_mandelbrot_test {
namespace {

struct Case {
  double D, span, gamma;
  int M, n_max, cells, points;
};
void PrintTo(const Case& c, std::ostream* out) { *out << "D " << c.D << ", orders to " << c.n_max; }
class Multiprecision : public testing::TestWithParam<Case> {};

TEST_P(Multiprecision, HeightsAreTheSumOfTheDefinition) {
  const Case& c = GetParam();
  WeierstrassMandelbrotOptions o;
  o.nx = o.ny = c.cells;
  o.D = c.D;
  o.span = c.span;
  o.gamma = c.gamma;
  o.M = c.M;
  o.n_max = c.n_max;
  o.seed = 5;
  const Surface surface = weierstrass_mandelbrot(o);
  const Stream stream(o.seed, "points");
  const double amplitude = surface.peak_to_valley();
  for (int k = 0; k < c.points; ++k) {
    const auto draw = static_cast<std::uint64_t>(2 * k);
    const int i = static_cast<int>(stream.below(draw, static_cast<std::uint64_t>(o.nx)));
    const int j = static_cast<int>(stream.below(draw + 1, static_cast<std::uint64_t>(o.ny)));
    const double error =
        std::abs(surface.height(i, j) - exact::weierstrass_mandelbrot_height(o, i, j)) / amplitude;
    EXPECT_LE(error, 1e-14) << i << ", " << j;  // measured 1.5e-15
  }
}
INSTANTIATE_TEST_SUITE_P(Orders, Multiprecision,
                         testing::Values(Case{2.5, 1, 1.5, 10, 0, 64, 3}, Case{2.5, 3, 1.5, 10, 100, 150, 6},
                                         Case{2.99, 3, 1.5, 10, 100, 150, 6},
                                         Case{2.9, .37, 1.37, 7, 400, 97, 4},
                                         Case{2.99, 1, 1.5, 4, 1500, 61, 3}, Case{3, 1, 1.5, 3, 1500, 61, 3},
                                         Case{2.999, 2.6, 2, 3, 2000, 128, 3},
                                         Case{2.995, 1, 1.01, 3, 2000, 128, 3}),
                         [](const auto& c) {
                           return "Orders" + std::to_string(c.param.n_max) + "Case" + std::to_string(c.index);
                         });

}  // namespace
}  // namespace asperity::stability::weierstrass_mandelbrot_test
