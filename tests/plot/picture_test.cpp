// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/picture.hpp"

#include <cmath>
#include <limits>

#include "engine/plot/gnuplot.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::picture_test {
namespace {

using PictureTest = InFolder;

Field ramp(int nx, int ny) {
  Field field(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) field(i, j) = 1e-6 * (i + 2 * j);
  return field;
}

TEST(Reduced, KeepsTheMean) {
  const Field field = ramp(97, 53);
  for (const auto& [columns, rows] :
       {std::pair{10, 10}, std::pair{96, 52}, std::pair{1, 1}, std::pair{97, 7}}) {
    const Field small = reduced(field, columns, rows);
    EXPECT_EQ(small.nx(), columns);
    EXPECT_EQ(small.ny(), rows);
    EXPECT_NEAR(mean(small.values()), mean(field.values()), 1e-18);
  }
}

TEST(Reduced, AveragesByArea) {
  Field field(3, 1);
  field(0, 0) = 1;
  field(1, 0) = 4;
  field(2, 0) = 10;
  const Field small = reduced(field, 2, 1);
  EXPECT_NEAR(small(0, 0), (1 + 0.5 * 4) / 1.5, 1e-15);
  EXPECT_NEAR(small(1, 0), (10 + 0.5 * 4) / 1.5, 1e-15);
}

// The colour range excludes missing points, which stay blank.
TEST_F(PictureTest, LeavesPointsBlankThatWereNotMeasured) {
  Field z = ramp(40, 30);
  z(39, 29) = std::numeric_limits<double>::quiet_NaN();
  const Grid grid{40, 30, 4e-3, 3e-3};
  const Surface surface = Surface::with_holes(grid, z);
  EXPECT_TRUE(draw(surface, {}, folder / "holes.png").empty());
  const PictureScript picture = picture_script(grid, surface.measured_heights(), {});
  EXPECT_NE(picture.script.find("set cbrange [0:96]"), std::string::npos);
}

TEST(Reduced, NeverEnlarges) {
  const Field field = ramp(3, 2);
  const Field same = reduced(field, 100, 100);
  EXPECT_EQ(same.nx(), 3);
  EXPECT_EQ(same(2, 1), field(2, 1));
}

TEST(Reduced, LeavesOutWhatIsNotFinite) {
  Field field(4, 1, 2.0);
  field(0, 0) = std::nan("");
  field(2, 0) = field(3, 0) = std::numeric_limits<double>::infinity();
  const Field small = reduced(field, 2, 1);
  EXPECT_EQ(small(0, 0), 2.0);
  EXPECT_TRUE(std::isnan(small(1, 0)));
}

TEST(Picture, CarriesUnitsScaleBarAndColourBar) {
  const PictureScript picture = picture_script(make_grid(64, 64, 1e-4, 1e-4), ramp(64, 64), {});
  for (const std::string part : {"set xlabel 'x (µm)'", "set ylabel 'y (µm)'", "set cblabel 'height (µm)'",
                                 "set label 1 '20 µm'", "set colorbox user", "array=(64,64)"})
    EXPECT_NE(picture.script.find(part), std::string::npos) << part;
  EXPECT_EQ(picture.cells.size(), 64U * 64U * sizeof(float));
}

TEST(Picture, AReliefNamesItsBarAboveIt) {
  PictureOptions options;
  options.view = PictureOptions::View::relief;
  const std::string script = picture_script(make_grid(8, 8, 1e-4, 1e-4), ramp(8, 8), options).script;
  EXPECT_EQ(script.find("set cblabel"), std::string::npos);
  EXPECT_NE(script.find("set label 1 'height (µm)' at screen 0.985, screen 0.8 right front"),
            std::string::npos)
      << script;
  EXPECT_NE(script.find("set colorbox user origin screen 0.88, screen 0.25 size screen 0.022, screen 0.5"),
            std::string::npos);
}

TEST(Picture, NodesStandAtTheirPlaces) {
  const PictureScript picture = picture_script(make_grid(4, 4, 4e-6, 4e-6), ramp(4, 4), {});
  EXPECT_NE(picture.script.find("origin=(0,0) dx=1 dy=1 "), std::string::npos) << picture.script;
  EXPECT_NE(picture.script.find("set xrange [-0.5:3.5]"), std::string::npos);
}

TEST(Picture, LargeGridsAreReducedToPixels) {
  PictureOptions options;
  options.width = 200;
  const PictureScript picture = picture_script(make_grid(1000, 500, 1e-3, 5e-4), ramp(1000, 500), options);
  EXPECT_NE(picture.script.find("array=(140,70)"), std::string::npos) << picture.script;
}

TEST(Picture, DrawsEveryShapeWithoutAComplaint) {
  using Shape = std::pair<int, int>;
  for (const auto& [nx, ny] :
       {Shape{1, 1}, Shape{2, 1}, Shape{500, 1}, Shape{1, 500}, Shape{7, 5}, Shape{30, 400}})
    for (const auto view : {PictureOptions::View::map, PictureOptions::View::relief}) {
      PictureOptions options;
      options.width = 300;
      options.view = view;
      options.title = "a'b`touch x`";
      const PictureScript picture =
          picture_script(make_grid(nx, ny, 1e-6 * nx, 1e-6 * ny), ramp(nx, ny), options);
      const GnuplotData cells{"cells", picture.cells};
      const GnuplotResult result = run_gnuplot(picture.script, {&cells, 1});
      EXPECT_EQ(result.messages, "") << nx << " " << ny;
      EXPECT_TRUE(result.picture.starts_with("\x89PNG"));
    }
}

TEST_F(PictureTest, DrawsMasksBlanksAndConstants) {
  const Grid grid = make_grid(20, 20, 1e-3, 1e-3);
  Field mask(20, 20);
  for (int i = 0; i < 10; ++i) mask(i, 3) = 1;
  PictureOptions contact;
  contact.palette = "contact";
  draw(grid, mask, contact, folder / "contact.png");
  Field blank = ramp(20, 20);
  blank(3, 3) = std::nan("");
  draw(grid, blank, {}, folder / "blank.png");
  draw(grid, Field(20, 20, 0.0), {}, folder / "zero.png");
  draw(Surface(grid, ramp(20, 20)), {}, folder / "surface.png");
  EXPECT_EQ(files_in(folder), 4U);
}

TEST_F(PictureTest, IsTheSameTwice) {
  const Grid grid = make_grid(20, 20, 1e-3, 1e-3);
  draw(grid, ramp(20, 20), {}, folder / "a.png");
  draw(grid, ramp(20, 20), {}, folder / "b.png");
  EXPECT_EQ(content_of(folder / "a.png"), content_of(folder / "b.png"));
}

TEST_F(PictureTest, RefusesWhatItCannotShow) {
  const Grid grid = make_grid(2, 2, 1, 1);
  const auto refusal = [&](const PictureOptions& options) {
    return error_of([&] { picture_script(grid, ramp(2, 2), options); });
  };
  PictureOptions options;
  options.width = 199;
  EXPECT_EQ(refusal(options), "bad_value: `width` is 199 pixels; give 200 to 4000");
  options = {};
  options.range = Range{1, 1};
  EXPECT_EQ(refusal(options),
            "bad_value: `range` is from 1 to 1; give two finite numbers, the lower one first");
  options = {};
  options.palette = "viridi";
  EXPECT_NE(refusal(options).find("did you mean `viridis`?"), std::string::npos);
  EXPECT_EQ(error_of([&] { picture_script(grid, Field(2, 2, std::nan("")), {}); }),
            "bad_value: the picture of `height` has no finite value to show");
  EXPECT_EQ(error_of([&] { picture_script(grid, Field(3, 2), {}); }),
            "bad_value: the field has 3 × 2 values on a grid of 2 × 2");
  EXPECT_EQ(error_of([&] { draw(grid, ramp(2, 2), {}, folder / "a.svg"); }),
            "bad_value: the picture `" + (folder / "a.svg").string() +
                "` ends in .svg; pictures of surfaces are .png");
}

}  // namespace
}  // namespace asperity::picture_test
