// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/picture.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/run_fixture.hpp"

namespace asperity::picture_profile_test {
namespace {

using PictureProfileTest = InFolder;

Profile spike(std::size_t samples, std::size_t place) {
  Array<double> heights(samples, 0.0);
  heights[place] = 5e-6;
  return Profile(1e-6, heights);
}

TEST(PictureProfile, TraceRunsAlongX) {
  const NamedProfile item{"", spike(10, 3)};
  const LineChart chart = profile_chart({&item, 1});
  ASSERT_EQ(chart.series[0].x.size(), 10U);
  EXPECT_EQ(chart.series[0].x[3], 3e-6);
  EXPECT_EQ(chart.series[0].y[3], 5e-6);
  EXPECT_FALSE(chart.equal_axes);
}

TEST(PictureProfile, LongTracesKeepTheirPeaks) {
  const NamedProfile item{"", spike(1000003, 777777)};
  const LineChart chart = profile_chart({&item, 1});
  EXPECT_LE(chart.series[0].x.size(), 4000U);
  EXPECT_EQ(*std::ranges::max_element(chart.series[0].y), 5e-6);
  EXPECT_TRUE(std::ranges::is_sorted(chart.series[0].x));
}

// Gaps break the line without a warning; peaks next to gaps remain.
TEST(PictureProfile, GapsBreakTheLine) {
  const double hole = std::nan("");
  const NamedProfile item{"", Profile::with_holes(1e-6, {hole, 1e-6, 2e-6, hole, hole, 1e-6, 3e-6, hole})};
  std::vector<std::string> warnings;
  const std::string script = chart_script(profile_chart({&item, 1}), PictureFormat::svg, warnings);
  EXPECT_TRUE(warnings.empty());
  const std::size_t begin = script.find("$line0 << EOD\n"), end = script.find("EOD\n", begin + 14);
  const std::string data = script.substr(begin + 14, end - begin - 14);
  EXPECT_EQ(std::ranges::count(data, '\n'), 5);  // four points and an empty line
  EXPECT_NE(data.find("\n\n"), std::string::npos);

  Array<double> heights(100003, 0.0);
  heights[77777] = 5e-6;
  for (std::size_t k = 77778; k < 77790; ++k) heights[k] = hole;
  for (std::size_t k = 20000; k < 40000; ++k) heights[k] = hole;
  const NamedProfile long_item{"", Profile::with_holes(1e-6, heights)};
  const LineChart chart = profile_chart({&long_item, 1});
  EXPECT_TRUE(chart.series[0].gaps);
  EXPECT_EQ(known_range(chart.series[0].y).max, 5e-6);
  EXPECT_TRUE(std::ranges::is_sorted(chart.series[0].x));
  for (std::size_t k = 0; k < chart.series[0].x.size(); ++k) {
    const double x = chart.series[0].x[k];
    const bool in_the_gap = x > 20100e-6 && x < 39900e-6;
    EXPECT_TRUE(!in_the_gap || std::isnan(chart.series[0].y[k])) << x;
  }
}

TEST(PictureProfile, OutlineIsClosedAndTrue) {
  const NamedProfile item{"", Profile(1e-6, Array<double>(8, 1e-6), 9e-6)};
  const LineChart chart = profile_chart({&item, 1});
  EXPECT_TRUE(chart.equal_axes);
  ASSERT_EQ(chart.series[0].x.size(), 9U);
  EXPECT_NEAR(chart.series[0].x[0], chart.series[0].x[8], 1e-19);
  EXPECT_NEAR(chart.series[0].y[2], 1e-5, 1e-19);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(std::hypot(chart.series[0].x[k], chart.series[0].y[k]), 1e-5, 1e-19);
}

TEST(PictureProfile, RefusesMixturesAndNothing) {
  EXPECT_EQ(error_of([] { profile_chart({}); }),
            "bad_value: a picture of profiles has none; give at least one");
  const std::vector<NamedProfile> both = {{"a", spike(4, 1)},
                                          {"b", Profile(1e-6, Array<double>(4, 0.0), 1e-3)}};
  EXPECT_EQ(
      error_of([&] { profile_chart(both); }),
      "bad_value: a picture has open traces and closed outlines together; draw them in separate pictures");
}

TEST_F(PictureProfileTest, DrawsTracesPointsAndOutlines) {
  draw(spike(100, 50), "trace", folder / "a.svg");
  draw(spike(1, 0), "", folder / "b.png");
  draw(Profile(1e-6, Array<double>(8, 0.0), 1e-3), "grain", folder / "c.png");
  EXPECT_EQ(files_in(folder), 3U);
}

}  // namespace
}  // namespace asperity::picture_profile_test
