// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/levelling.hpp"

#include "tests/metrology/test_fields.hpp"

namespace asperity::levelling_test {
namespace {

using testing::error_text;
using testing::make_profile;
using testing::make_surface;

double power(double x, int n) { return n == 0 ? 1 : x * power(x, n - 1); }

double polynomial(double x, double y, int degree) {
  double sum = 0;
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b) sum += (1 + 0.3 * a - 0.7 * b) * power(x, a) * power(y, b);
  return sum;
}

double greatest(const Field& z) { return std::max(range(z.values()).max, -range(z.values()).min); }

TEST(Levelling, RemovesAPolynomialOfItsDegree) {
  for (int degree = 0; degree <= max_levelling_degree; ++degree) {
    const Surface s = make_surface(
        61, 47, 3e-3, 2e-3, [&](int i, int j) { return polynomial(i / 30.0 - 1, j / 23.0 - 0.4, degree); });
    EXPECT_LT(greatest(levelled(s, degree).heights()), 1e-12 * greatest(s.heights())) << degree;
    const Profile p = make_profile(53, 1e-6, [&](int i) { return polynomial(i / 20.0 - 1, 0, degree); });
    EXPECT_LT(range(levelled(p, degree).heights()).span(), 1e-12 * p.height_range().max) << degree;
  }
}

TEST(Levelling, LeavesAPolynomialOfHigherDegree) {
  for (int degree = 0; degree < max_levelling_degree; ++degree) {
    const auto height = [&](int i, int j) { return power(i / 15.0 - 1, degree) * (j / 15.0 - 1); };
    EXPECT_GT(greatest(levelled(make_surface(31, 31, 1, 1, height), degree).heights()), 0.01) << degree;
  }
}

TEST(Levelling, OfFourNodes) {
  const double z[2][2] = {{0, 1}, {2, 7}};
  const Surface s = levelled(make_surface(2, 2, 1, 1, [&](int i, int j) { return z[j][i]; }));
  EXPECT_NEAR(s.height(0, 0), 1, 1e-14);
  EXPECT_NEAR(s.height(1, 0), -1, 1e-14);
  EXPECT_NEAR(s.height(0, 1), -1, 1e-14);
  EXPECT_NEAR(s.height(1, 1), 1, 1e-14);
}

TEST(Levelling, KeepsRoughnessThatIsLevel) {
  const auto wave = [](int i, int j) { return std::cos(0.7 * i) * std::cos(0.9 * j + 0.3); };
  const Surface level = levelled(make_surface(40, 30, 1, 1, wave), 2);
  const Surface tilted = levelled(
      make_surface(40, 30, 1, 1,
                   [&](int i, int j) { return wave(i, j) + 1e4 + 20.0 * i - 3.0 * j + 0.5 * i * j; }),
      2);
  double worst = 0;
  for (std::size_t k = 0; k < level.heights().size(); ++k)
    worst = std::max(worst, std::abs(level.heights()[k] - tilted.heights()[k]));
  EXPECT_LT(worst, 1e-11);  // rounding of heights near 1e4
  EXPECT_LT(std::abs(mean(level.heights().values())), 1e-15);
}

TEST(Levelling, OfANarrowSurfaceUsesTheDegreeItCarries) {
  const Surface two = make_surface(2, 40, 1, 1, [](int i, int j) { return 3.0 * i + 0.1 * j * j * i; });
  EXPECT_LT(greatest(levelled(two, 5).heights()), 1e-11);
  const Surface one = make_surface(1, 1, 1, 1, [](int, int) { return 4.25; });
  EXPECT_EQ(levelled(one, 5).height(0, 0), 0);
}

TEST(Levelling, KeepsMaterialAndForgetsPeriodicity) {
  SurfaceTraits traits = testing::periodic();
  traits.material = rigid_material();
  traits.aliased_share = 0.25;
  const Surface s = make_surface(
      8, 8, 1, 1, [](int i, int j) { return 1.0 * i * j; }, traits);
  EXPECT_TRUE(levelled(s, 0).traits().periodic);
  EXPECT_EQ(levelled(s, 0).traits().aliased_share, 0.25);
  EXPECT_FALSE(levelled(s, 1).traits().periodic);
  EXPECT_FALSE(levelled(s, 1).traits().aliased_share.has_value());
  EXPECT_TRUE(levelled(s, 1).material().has_value());
}

TEST(Levelling, RefusesOtherDegrees) {
  const Surface s = make_surface(4, 4, 1, 1, [](int i, int) { return 1.0 * i; });
  EXPECT_EQ(error_text([&] { levelled(s, 6); }),
            "`degree` of levelling is 6; give 0 (mean), 1 (plane), 2 (quadratic) … 5");
  EXPECT_EQ(error_text([&] { levelled(s, -1); }),
            "`degree` of levelling is -1; give 0 (mean), 1 (plane), 2 (quadratic) … 5");
}

TEST(Levelling, OfAClosedOutlineIsItsMeanOnly) {
  const Profile outline(0.1, {1, 2, 3, 6}, 5.0);
  EXPECT_EQ(levelled(outline, 0).heights()[3], 3);
  EXPECT_EQ(levelled(outline, 0).closed_radius(), 5.0);
  EXPECT_EQ(error_text([&] { levelled(outline); }),
            "a closed outline cannot be levelled with `degree` 1; give `degree` 0: an outline has no tilt");
}

}  // namespace
}  // namespace asperity::levelling_test
