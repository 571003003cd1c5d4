// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/text_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/core/error.hpp"

namespace asperity::text_picture_test {
namespace {

Field rising(int nx, int ny) {
  Field field(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) field(i, j) = j;
  return field;
}

std::string map_of(const Grid& grid, const Field& field, const TextCanvas& canvas) {
  return text_map(grid, field, {}, dimension::length, canvas);
}

TEST(TextPicture, AMapHasYUpwardsAndIsTrueToScale) {
  const std::string text =
      map_of(Grid{40, 40, 1e-3, 1e-3}, rising(40, 40), {42, 40, TextColours::none, true});
  const std::string first = text.substr(0, text.find('\n'));
  EXPECT_EQ(first, std::string(40, '@'));                         // the highest rows on top
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 20 + 1);  // characters are twice as high as wide
  EXPECT_NE(text.find(std::string(40, ' ') + "\n"), std::string::npos);
  EXPECT_NE(text.find("height from 500 mm (blank) to 38.5 m; 1 mm x 1 mm; a mark is the mean of 1 x 2 cells"),
            std::string::npos)
      << text;
}

TEST(TextPicture, AMapFitsItsCanvasAndAnyGrid) {
  for (const auto& [nx, ny] : {std::pair{1, 1}, {3, 500}, {500, 3}, {7, 7}, {1000, 1000}})
    for (const TextColours colours : {TextColours::none, TextColours::indexed, TextColours::full}) {
      const std::string text =
          map_of(Grid{nx, ny, nx * 1e-6, ny * 1e-6}, rising(nx, ny), {60, 20, colours, true});
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 20) << nx << " x " << ny;
      EXPECT_NE(text.find("height from"), std::string::npos);
      EXPECT_EQ(text.find("\033[") != std::string::npos, colours != TextColours::none);
    }
}

TEST(TextPicture, AMapLeavesHolesBlankAndRefusesNothingAtAll) {
  Field field = rising(4, 4);
  field(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(map_of(Grid{4, 4, 1, 1}, field, {}).find("height from 0 m"), std::string::npos);
  Field none(2, 2);
  for (int k = 0; k < 4; ++k) none(k % 2, k / 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map_of(Grid{2, 2, 1, 1}, none, {}), Error);
}

TEST(TextPicture, AChartNamesItsAxesWithTheirUnits) {
  LineChart chart;
  chart.x.label = "load";
  chart.x.unit = "N";
  chart.y.label = "Ra";
  chart.y.unit = "m";
  chart.series.push_back(
      {.name = "", .x = {1, 2, 3}, .y = {1e-6, 2e-6, 3e-6}, .y_error = {}, .cloud_x = {}, .cloud_y = {}});
  std::vector<std::string> warnings;
  const std::string text = text_chart(chart, {70, 20, TextColours::none, true}, warnings);
  EXPECT_NE(text.find("load (N)"), std::string::npos) << text;
  EXPECT_NE(text.find("Ra (µm)"), std::string::npos) << text;
  EXPECT_EQ(text.find("\033["), std::string::npos);
  EXPECT_EQ(text.find(" \n"), std::string::npos);
  EXPECT_TRUE(warnings.empty());

  chart.series[0].y[1] = std::numeric_limits<double>::infinity();
  text_chart(chart, {}, warnings);
  ASSERT_EQ(warnings.size(), 1U);
  chart.series[0].y = {-1, -1, -1};
  chart.y.logarithmic = true;
  EXPECT_THROW(text_chart(chart, {}, warnings), Error);
}

}  // namespace
}  // namespace asperity::text_picture_test
