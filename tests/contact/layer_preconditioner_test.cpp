// SPDX-License-Identifier: GPL-3.0-or-later
// Preconditioner on a layer: near the inverse for every wave (exact unpadded), symmetric on the free set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/core/arithmetic/random.hpp"

namespace asperity::layer_preconditioner_test {
namespace {

struct Ratios {
  double least, greatest;  // of K B, over waves
};

Ratios ratios_of(int nx, int ny, const ComplianceMultiplier& multiplier) {
  HalfOrderPyramid pyramid(nx, ny, 1, Boundary::periodic, 1, multiplier);
  Ratios found{1e9, 0};
  for (int a = 0; a <= nx / 2; a += a < 4 ? 1 : 3)
    for (int b = 0; b <= ny / 2; b += b < 4 ? 1 : 3) {
      if (a == 0 && b == 0) continue;
      const double qx = 2 * std::numbers::pi * a / nx, qy = 2 * std::numbers::pi * b / ny;
      const double q = std::hypot(qx, qy);
      const std::span<float> in = pyramid.input();
      double squares = 0;
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          const auto value = static_cast<float>(std::cos(qx * i + qy * j + 0.4));
          in[static_cast<std::size_t>(j * nx + i)] = value;
          squares += static_cast<double>(value) * static_cast<double>(value);
        }
      pyramid.apply();
      const double ratio = pyramid.product() / squares * 2 / q * multiplier.share(q);
      found.least = std::min(found.least, ratio);
      found.greatest = std::max(found.greatest, ratio);
    }
  return found;
}

TEST(LayerPreconditioner, OnALayerIsCloseToTheInverseOfItsCompliance) {
  for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless})
    for (const double poisson : {0.2, 0.5})
      for (const double thickness : {1.5, 2.5, 4.0, 11.0, 100.0}) {
        const Ratios found = ratios_of(64, 48, in_cells(wave_share({thickness, poisson, base}), 1, false));
        EXPECT_GT(found.least, 0.45) << thickness << " " << poisson;
        EXPECT_LT(found.greatest, 1.4) << thickness << " " << poisson;
      }
}

TEST(LayerPreconditioner, OnAThinLayerIsTheInverseOfItsCompliance) {
  for (const double poisson : {0.2, 0.5})
    for (const double thickness : {0.02, 1.0}) {
      const Ratios found =
          ratios_of(32, 32, in_cells(wave_share({thickness, poisson, LayerBase::bonded}), 1, false));
      EXPECT_NEAR(found.least, 1, 1e-5);
      EXPECT_NEAR(found.greatest, 1, 1e-5);
    }
}

TEST(LayerPreconditioner, HoldsWhatItSaysOnALayer) {
  const ComplianceMultiplier thin = in_cells(wave_share({0.5, 0.3, LayerBase::bonded}), 1, false);
  EXPECT_GT(HalfOrderPyramid::bytes(256, 256, 1, Boundary::periodic, thin),
            HalfOrderPyramid::bytes(256, 256, 1, Boundary::periodic));
  EXPECT_EQ(HalfOrderPyramid(256, 256, 1, Boundary::periodic, 1, thin).transform_share(), 1);
  const ComplianceMultiplier thick = in_cells(wave_share({200, 0.3, LayerBase::bonded}), 1, false);
  EXPECT_EQ(HalfOrderPyramid::bytes(256, 256, 1, Boundary::periodic, thick),
            HalfOrderPyramid::bytes(256, 256, 1, Boundary::periodic));
}

TEST(LayerPreconditioner, IsSymmetricOnTheFreeSet) {
  for (const double thickness : {0.5, 5.0, 50.0}) {
    const int nx = 40, ny = 36;
    ContactPreconditioner m(nx, ny, 1, Boundary::periodic, 1, 4,
                            in_cells(wave_share({thickness, 0.4, LayerBase::bonded}), 1, false));
    const std::size_t n = nx * ny;
    const Stream stream(3, "residuals on a layer");
    std::vector<std::uint8_t> free(n);
    std::vector<double> r(n), s(n), mr(n), ms(n);
    for (std::size_t k = 0; k < n; ++k) {
      free[k] = stream.normal(3 * k) > 0.3 ? 1 : 0;
      r[k] = stream.normal(3 * k + 1);
      s[k] = stream.normal(3 * k + 2);
    }
    m.set_free(free);
    m.apply(r, mr);
    m.apply(s, ms);
    double there = 0, back = 0, own = 0, other = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (free[k] == 0) {
        EXPECT_EQ(mr[k], 0);
        continue;
      }
      there += s[k] * mr[k];
      back += r[k] * ms[k];
      own += r[k] * mr[k];
      other += s[k] * ms[k];
    }
    EXPECT_GT(own, 0);
    EXPECT_NEAR(there, back, 2e-6 * std::sqrt(own * other)) << thickness;
  }
}

}  // namespace
}  // namespace asperity::layer_preconditioner_test
