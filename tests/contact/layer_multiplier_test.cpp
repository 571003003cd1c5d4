// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a layer against integrated elasticity, limits, and sixty-digit arithmetic.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/core/memory.hpp"

namespace asperity::layer_multiplier_test {
namespace {

// Plane strain, t = 1, E/(1−ν²) = 1: u = U(z) sin qx, w = W(z) cos qx, σ_xz = T(z) sin qx, σ_zz = S(z) cos qx
// give four linear equations from the base, z = 0; fourth-order Runge-Kutta.
using Through = std::array<double, 4>;

Through surface_from(Through y, double q, double poisson) {
  constexpr int steps = 2000;
  constexpr double h = 1.0 / steps;
  const double shear = (1 - poisson) / 2, ratio = poisson / (1 - poisson);
  const double squeeze = (1 - 2 * poisson) / (2 * shear * (1 - poisson));  // 1/(λ + 2μ)
  const auto slope = [=](const Through& at) -> Through {
    const auto [u, w, t, s] = at;
    return {t / shear + q * w, squeeze * s - ratio * q * u,
            q * (2 * shear / (1 - poisson) * q * u + ratio * s), -q * t};
  };
  const auto stepped = [](const Through& from, double by, const Through& along) {
    Through to;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + by * along[i];
    return to;
  };
  for (int step = 0; step < steps; ++step) {
    const Through a = slope(y), b = slope(stepped(y, h / 2, a)), c = slope(stepped(y, h / 2, b)),
                  d = slope(stepped(y, h, c));
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return y;
}

// Displacement under a pressure cos qx without shear.
double integrated_compliance(double q, double poisson, LayerBase base) {
  const bool bonded = base == LayerBase::bonded;  // else frictionless: no shear
  const Through one = surface_from(bonded ? Through{0, 0, 1, 0} : Through{1, 0, 0, 0}, q, poisson);
  const Through two = surface_from({0, 0, 0, 1}, q, poisson);
  const double determinant = one[2] * two[3] - two[2] * one[3];
  return (one[2] * two[1] - two[2] * one[1]) / determinant;
}

TEST(LayerShare, SolvesTheEquationsOfPlaneStrain) {
  for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless})
    for (const double poisson : {-0.5, 0.0, 0.3, 0.49, 0.5})
      for (const double x : {0.1, 0.5, 1.0, 2.5, 5.0}) {
        const double expected = integrated_compliance(x, poisson, base);
        EXPECT_NEAR(2 / x * layer_share(x, poisson, base), expected, 2e-11 * expected)
            << static_cast<int>(base) << " " << poisson << " " << x;
      }
}

TEST(LayerShare, HasAllDigits) {
  struct Known {
    LayerBase base;
    double poisson, x, share;
  };
  // The formulas of elastic_layer.hpp in sixty digits.
  constexpr auto bonded = LayerBase::bonded, frictionless = LayerBase::frictionless;
  for (const auto& [base, poisson, x, share] : {Known{bonded, 0.5, 1e-3, 6.66665466668857180481e-10},
                                                {bonded, 0.5, 0.25, 9.36476175786895661454e-3},
                                                {bonded, 0.5, 0.4999, 5.75461691641329864124e-2},
                                                {bonded, 0.5, 0.5001, 5.76010932961474726298e-2},
                                                {bonded, 0.499999, 1e-3, 4.66664146667250258426e-9},
                                                {bonded, 0.49, 0.1, 4.42549745420559463424e-3},
                                                {bonded, 0.3, 0.3, 1.23138581660434592759e-1},
                                                {bonded, -0.5, 2.0, 8.40730019198271600738e-1},
                                                {bonded, 0.3, 25.0, 9.99999999999999999721e-1},
                                                {frictionless, 0.5, 1e-3, 4.99999999999988899299e-4},
                                                {frictionless, 0.5, 0.5, 2.49669150790368482232e-1},
                                                {frictionless, 0.5, 4.0, 9.93994132995085757000e-1}})
    EXPECT_NEAR(layer_share(x, poisson, base), share, 4e-15 * share) << poisson << " " << x;
}

TEST(LayerShare, OfShortWavesIsThatOfAHalfSpace) {
  for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless})
    for (const double poisson : {-0.5, 0.0, 0.3, 0.5}) {
      EXPECT_NEAR(layer_share(12, poisson, base), 1, 1e-6);
      for (const double x : {40.0, 1e3, 1e200, std::numeric_limits<double>::infinity()})
        EXPECT_EQ(layer_share(x, poisson, base), 1) << poisson << " " << x;
    }
}

TEST(LayerShare, OfLongWavesIsThatOfAWinklerFoundation) {
  for (const double x : {1e-4, 1e-8, 1e-150, 1e-300}) {
    for (const double poisson : {-0.5, 0.0, 0.3, 0.45}) {
      const double bonded = 2 * (layer_share(x, poisson, LayerBase::bonded) / x),
                   uniform = uniform_share(poisson);
      EXPECT_NEAR(bonded, uniform, 1e-6 * uniform) << poisson << " " << x;
    }
    // Sideways expansion: t (1 − ν²)/E.
    EXPECT_NEAR(2 * (layer_share(x, 0.3, LayerBase::frictionless) / x), 1, 1e-6);
    if (x < 1e-100) continue;
    const double cubic = 2.0 / 3 * x * x * x;
    EXPECT_NEAR(layer_share(x, 0.5, LayerBase::bonded), cubic, 1e-6 * cubic);
  }
  EXPECT_EQ(layer_share(0, 0.3, LayerBase::bonded), 0);
  EXPECT_EQ(uniform_share(0.5), 0);
  // t (1+ν)(1−2ν)/(E (1−ν)) over t (1−ν²)/E.
  EXPECT_NEAR(uniform_share(0.3), 1.3 * 0.4 / 0.7 / (1 - 0.09), 1e-15);
}

TEST(LayerShare, GrowsWithTheWaveNumber) {
  for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless})
    for (const double poisson : {0.0, 0.3, 0.49, 0.5}) {
      double before = 0;
      for (double x = 1e-3; x < 20; x *= 1.01) {
        const double share = layer_share(x, poisson, base);
        EXPECT_GE(share, before) << poisson << " " << x;
        EXPECT_LE(share, 1);
        before = share;
      }
    }
}

TEST(ComplianceMultiplier, FindsTheSoftestWave) {
  ComplianceMultiplier multiplier = in_cells(wave_share({5, 0.5, LayerBase::bonded}), 1, false);
  double most = 0;
  for (double q = 1e-3; q < 3; q *= 1.001) most = std::max(most, 2 / q * multiplier.share(q));
  EXPECT_NEAR(multiplier.greatest_from(1e-3), most, 0.01 * most);
  EXPECT_EQ(ComplianceMultiplier{}.greatest_from(0.5), 4);
}

// Oblong cells, even and odd counts.
TEST(LayerCompliance, TakesEachWaveByItself) {
  for (const auto& [nx, ny] : {std::pair{16, 24}, {15, 11}, {1, 8}}) {
    const double aspect = 1.7;
    const ElasticLayer layer{3e-6, 0.4, LayerBase::bonded};
    const double hx = 1e-6;
    for (const bool with_mean : {false, true}) {
      const ComplianceMultiplier multiplier = in_cells(wave_share(layer), hx, with_mean);
      EXPECT_EQ(multiplier.uniform, with_mean ? 3 * uniform_share(0.4) : 0);
      HalfSpaceCompliance compliance(nx, ny, aspect, Boundary::periodic, 1, false, multiplier);
      const int a = nx > 1 ? 2 : 0, b = 3;
      const double qx = 2 * std::numbers::pi * a / nx, qy = 2 * std::numbers::pi * b / (ny * aspect);
      const double q = std::sqrt(qx * qx + qy * qy);
      const double factor = 2 / q * layer_share(3 * q, 0.4, LayerBase::bonded);
      Array<double> p(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)), u(p.size()),
          back(p.size());
      const auto wave = [&](int i, int j) { return std::cos(qx * i + qy * aspect * j + 0.3); };
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          p[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i)] =
              5 + wave(i, j);
      compliance.apply(p, u);
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          const std::size_t k =
              static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
          EXPECT_NEAR(u[k], 5 * multiplier.uniform + factor * wave(i, j), 1e-13);
        }
      compliance.apply_inverse(u, back);
      for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(back[k], with_mean ? p[k] : p[k] - 5, 1e-12);
      EXPECT_EQ(compliance.spectrum().greatest <= multiplier.greatest_from(0.01) * 1.01, true);
    }
  }
}

}  // namespace
}  // namespace asperity::layer_multiplier_test
