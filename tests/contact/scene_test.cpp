// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes refused before any computation, with the error texts.
#include "engine/contact/scene/scene.hpp"

#include <limits>

#include "tests/contact/contacts.hpp"

namespace asperity::scene_test {
namespace {

using test::error_of;
using test::random_surface;
using test::scene_of;

TEST(Scene, BodiesOfDifferentCellsAreRefused) {
  EXPECT_EQ(error_of([] { check(scene_of(random_surface(4, 4, 1), random_surface(4, 5, 2))); }),
            "the lower body has 4 x 4 cells on 1 m x 1 m, the upper body 4 x 5 cells on 1 m x 1 m; both need "
            "the same "
            "`cells` and `size`: bring one to the other with `:resampled{cells=}` or `:cropped{...}`");
}

TEST(Scene, BodiesOfDifferentSizeAreRefused) {
  const std::string text = error_of(
      [] { check(scene_of(random_surface(4, 4, 1, 1e-3, 1e-3), random_surface(4, 4, 2, 1e-3, 2e-3))); });
  EXPECT_NE(text.find("4 x 4 cells on 1 mm x 1 mm, the upper body 4 x 4 cells on 1 mm x 2 mm"),
            std::string::npos)
      << text;
}

TEST(Scene, SizesEqualButForRoundingAreTheSame) {
  EXPECT_NO_THROW(check(scene_of(random_surface(4, 4, 1, 0.3, 1), random_surface(4, 4, 2, 0.1 * 3, 1))));
}

TEST(Scene, AreasAreWithinTheRangeOfADouble) {
  for (const double size : {1e-200, 1e200})
    EXPECT_NE(error_of([&] {
                check(test::boxes(random_surface(3, 3, 1, size, size), 1));
              }).find("an area outside the range of a double; check the unit of `size`"),
              std::string::npos)
        << size;
}

TEST(Scene, StiffnessMustBeFiniteAndPositive) {
  for (const double stiffness :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(error_of([&] {
                check(test::boxes(random_surface(2, 2, 1), stiffness));
              }).find("`stiffness` of elasticity=\"box\" is "),
              std::string::npos);
}

TEST(Scene, ToleranceAndPrecisionAreChecked) {
  Scene scene = test::boxes(random_surface(2, 2, 1), 1);
  scene.accuracy.tolerance = 0;
  EXPECT_EQ(error_of([&] { check(scene); }), "`tolerance` is 0; give a number from 1e-15 to below 1");
  scene.accuracy.tolerance = 1;
  EXPECT_NE(error_of([&] { check(scene); }), "");
  scene.accuracy.tolerance = 1e-15;
  EXPECT_EQ(error_of([&] { check(scene); }), "");
  scene.accuracy.precision = Accuracy::Precision::single;
  EXPECT_EQ(error_of([&] { check(scene); }),
            "`precision` is \"single\" for box elements; leave `precision` out: they have a closed form in "
            "double precision");
}

TEST(Scene, FlatMaterialIsChecked) {
  EXPECT_NE(
      error_of([] { check(scene_of(random_surface(2, 2, 1), test::elastic(-1))); }).find("`young` is -1"),
      std::string::npos);
}

}  // namespace
}  // namespace asperity::scene_test
