// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "engine/core/constants.hpp"
#include "engine/metrology/parameters/areal_parameters.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::areal_uncertainty_test {
namespace {

// A quarter of a scaled map: quarters differ as measured maps do.
Surface rough_map(std::uint64_t seed, double roll_off_cells) {
  constexpr int cells = 128;
  SelfAffineOptions options =
      test::self_affine(make_grid(2 * cells, 2 * cells, 2 * cells * 1e-6, 2 * cells * 1e-6), 0.8, 3e-6, seed);
  options.rms_height = 1e-6;
  options.roll_off = roll_off_cells * 1e-6;
  const Surface whole = self_affine_surface(options);
  return testing::make_surface(cells, cells, cells * 1e-6, cells * 1e-6,
                               [&](int i, int j) { return whole.height(i, j); });
}

TEST(ArealUncertainty, IsTheScatterOfSuchMaps) {
  constexpr int maps = 40;
  struct Sums {
    double value = 0, square = 0, u2 = 0;
    void add(double v, double u) {
      value += v;
      square += v * v;
      u2 += u * u;
    }
    double ratio() const {
      const double mean = value / maps;
      return std::sqrt(u2 / maps) / std::sqrt((square - maps * mean * mean) / (maps - 1));
    }
  } Sq, Sa, Sdq;
  for (int seed = 1; seed <= maps; ++seed) {
    const ArealParameters p(rough_map(static_cast<std::uint64_t>(seed), 8));
    const ArealUncertainty& u = p.uncertainty();
    ASSERT_EQ(u.why_not, "");
    Sq.add(p.heights().Rq, *u.Sq);
    Sa.add(p.heights().Ra, *u.Sa);
    Sdq.add(*p.slopes().Sdq, *u.Sdq);
  }
  // The scatter of forty maps is known to 11 %.
  for (const double ratio : {Sq.ratio(), Sa.ratio(), Sdq.ratio()}) {
    EXPECT_GT(ratio, 0.75);
    EXPECT_LT(ratio, 1.35);
  }
}

TEST(ArealUncertainty, IsNotSaidOfTilesThatAreTooSmall) {
  const ArealParameters p(rough_map(1, 100));
  EXPECT_FALSE(p.uncertainty().Sq);
  EXPECT_NE(p.why_not("u_Sq").find("is under ten autocorrelation lengths"), std::string::npos)
      << p.why_not("u_Sq");
  const ArealParameters flat(testing::make_surface(40, 40, 1, 1, [](int, int) { return 1.0; }));
  EXPECT_EQ(flat.why_not("u_Sa"), "no autocorrelation length Sal says how large independent tiles are");
}

TEST(ArealUncertainty, OfSixteenKnownTilesIsTheirScatter) {
  // Tile n has noise times n + 1, so Sa is proportional to 1 … 16.
  const Surface noise = testing::white_noise(10, 10, 10, 10, 3);
  const Surface map = testing::make_surface(41, 43, 41, 43, [&](int i, int j) {
    if (i >= 40 || j >= 40) return 0.0;
    return noise.height(i % 10, j % 10) * (1 + i / 10 + 4 * (j / 10));
  });
  const ArealUncertainty u = areal_uncertainty(map, 0.5);
  ASSERT_TRUE(u.Sa) << u.why_not;
  // s of 1 … 16 is √(68/3).
  EXPECT_NEAR(*u.Sa, ArealParameters(noise).heights().Ra * std::sqrt(68.0 / 3) / 4, 1e-12);
  EXPECT_NEAR(*u.Ssk, 0, 1e-12);
}

TEST(ArealUncertainty, OfTilesWithHolesNeedsHalfOfEach) {
  const Surface s = rough_map(2, 8);
  const auto with_hole = [&](int side) {
    Field z = s.heights();
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) z(i, j) = std::numeric_limits<double>::quiet_NaN();
    return Surface::with_holes(s.grid(), std::move(z));
  };
  EXPECT_TRUE(areal_uncertainty(with_hole(20), 2e-6).Sq);
  EXPECT_EQ(areal_uncertainty(with_hole(30), 2e-6).why_not,
            "less than half of one of the sixteen tiles was measured");
}

}  // namespace
}  // namespace asperity::areal_uncertainty_test
