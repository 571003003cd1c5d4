// SPDX-License-Identifier: GPL-3.0-or-later
// Charts: a line per method, rings around the front, rim marks for rows without an error.
#include "engine/study/study_result.hpp"

#include <gtest/gtest.h>

#include "tests/study/study_fixture.hpp"

namespace asperity::study_chart_test {
namespace {

const ChartSeries* series_of(const LineChart& chart, const std::string& name) {
  for (const ChartSeries& series : chart.series)
    if (series.name == name) return &series;
  return nullptr;
}

class Drawn : public testing::Test {
 protected:
  LineChart chart_of(const StudyRequest& request) {
    NotingMonitor monitor;
    WorkPrecision study(request, work, monitor, work.clock());
    study.run();
    return study_chart(study.result(), "title");
  }
  WrittenWork work;
};

TEST_F(Drawn, HasALineAWayAndRingsAboutTheFront) {
  const LineChart chart =
      chart_of({{way_of_cells("one", {64, 128}), way_of_cells("two", {96, 256})}, 1.0, 3, {}});
  ASSERT_NE(series_of(chart, "one"), nullptr);
  EXPECT_EQ(series_of(chart, "one")->y, (std::vector<double>{1.0 / 64, 1.0 / 128}));
  ASSERT_NE(series_of(chart, "nothing beats these"), nullptr);
  EXPECT_EQ(series_of(chart, "nothing beats these")->x.size(), 4U);
  EXPECT_EQ(series_of(chart, "failed"), nullptr);
  EXPECT_TRUE(chart.x.logarithmic);
  EXPECT_TRUE(chart.y.logarithmic);
}

TEST_F(Drawn, FailedAndLeftOutStandAtTheRimAndExactAtTheFoot) {
  work.answer = [](const Knobs& knobs, int) {
    const double n = *number_of(knobs, "cells");
    if (n == 128) return StudyAnswer{{}, "no"};
    return StudyAnswer{n == 256 ? 1.0 : 1.25, ""};
  };
  const LineChart chart = chart_of({{way_of_cells("grid", {64, 128, 256, 4096})}, 1.0, 1, 2.0});
  const ChartSeries *failed = series_of(chart, "failed"), *left_out = series_of(chart, "left out: budget"),
                    *exact = series_of(chart, "no error at all");
  ASSERT_NE(failed, nullptr);
  ASSERT_NE(left_out, nullptr);
  ASSERT_NE(exact, nullptr);
  EXPECT_NEAR(failed->x[0], 128 * 128 * 1e-6, 1e-12);
  EXPECT_GT(failed->y[0], 0.25);
  EXPECT_LT(exact->y[0], 0.25);
  EXPECT_NEAR(left_out->x[0], 4 * 256 * 256 * 1e-6, 1e-12);  // 16 s would be far outside
  for (const ChartSeries& series : chart.series)
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      EXPECT_GE(series.x[k], chart.x.range->min);
      EXPECT_LE(series.x[k], chart.x.range->max);
      EXPECT_GE(series.y[k], chart.y.range->min);
      EXPECT_LE(series.y[k], chart.y.range->max);
    }
}

TEST_F(Drawn, WithNothingMeasuredIsRefused) {
  work.answer = [](const Knobs&, int) { return StudyAnswer{{}, "no"}; };
  EXPECT_THROW(chart_of({{way_of_cells("grid", {64})}, 1.0, 1, {}}), Error);
}

}  // namespace
}  // namespace asperity::study_chart_test
