// SPDX-License-Identifier: GPL-3.0-or-later
// Palettes: their ends, order of lightness, and line colours that differ.
#include "engine/plot/palette.hpp"

#include <cmath>
#include <set>

#include "tests/support/run_fixture.hpp"

namespace asperity::palette_test {
namespace {

// Relative luminance of the sRGB colour, roughly what grey print shows.
double lightness(unsigned rgb) {
  return 0.2126 * (rgb >> 16 & 255U) + 0.7152 * (rgb >> 8 & 255U) + 0.0722 * (rgb & 255U);
}

TEST(Palette, EndsAndMiddle) {
  EXPECT_EQ(palette("grey").colour(0), 0x000000U);
  EXPECT_EQ(palette("grey").colour(1), 0xffffffU);
  EXPECT_EQ(palette("grey").colour(0.5), 0x808080U);
  EXPECT_EQ(palette("viridis").colour(-1), 0x440154U);
  EXPECT_EQ(palette("viridis").colour(2), 0xfde725U);
}

TEST(Palette, OrderedOnesAreOrderedInGreyPrint) {
  for (const std::string name : {"viridis", "cividis", "grey"})
    for (int k = 0; k < 20; ++k)
      EXPECT_LT(lightness(palette(name).colour(k / 20.0)), lightness(palette(name).colour((k + 1) / 20.0)))
          << name << k;
  for (int k = 0; k < 20; ++k)
    EXPECT_GT(lightness(palette("heat").colour(k / 20.0)), lightness(palette("heat").colour((k + 1) / 20.0)));
}

// Of sRGB colours, as WCAG 2 has it.
double luminance(unsigned rgb) {
  const auto linear = [rgb](unsigned shift) {
    const double share = (rgb >> shift & 255U) / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(16) + 0.7152 * linear(8) + 0.0722 * linear(0);
}

TEST(Palette, NothingStandsOutFromEachPressureByThreeToOne) {
  const Palette& heat = palette(palette_of_field("pressure"));
  const double nothing = luminance(heat.colour(0));
  EXPECT_EQ(heat.colour(0), *heat.none);
  for (int k = 1; k <= 1000; ++k)
    EXPECT_GE((nothing + 0.05) / (luminance(heat.colour(k / 1000.0)) + 0.05), 3) << k;
}

TEST(Palette, OfAFieldIsOneThatIsKnown) {
  for (const char* field : {"height", "gap", "pressure", "plastic", "contact", "displacement"})
    EXPECT_NO_THROW(palette(palette_of_field(field))) << field;
  EXPECT_EQ(palette_of_field("gap"), "cividis");
}

TEST(Palette, NamesTheNearest) {
  EXPECT_EQ(error_of([] { palette("viridus"); }),
            "unknown_name: `palette` `viridus` is not known (did you mean `viridis`?); palettes are viridis, "
            "cividis, "
            "grey, heat, balance and contact");
}

TEST(LineColour, DiffersFromLineToLine) {
  for (const int lines : {1, 2, 7, 8, 30}) {
    std::set<unsigned> seen;
    for (int k = 0; k < lines; ++k) seen.insert(line_colour(k, lines));
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(lines));
  }
}

}  // namespace
}  // namespace asperity::palette_test
