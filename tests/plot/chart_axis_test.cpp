// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/chart_axis.hpp"

#include <cmath>
#include <limits>
#include <set>

#include "tests/support/run_fixture.hpp"

namespace asperity::chart_axis_test {
namespace {

std::vector<std::string> labels(const AxisLayout& layout) {
  std::vector<std::string> texts;
  for (const Tic& tic : layout.tics)
    if (!tic.label.empty()) texts.push_back(tic.label);
  return texts;
}

AxisLayout lay(ChartAxis axis, std::vector<double> values) { return lay_out(axis, values); }

ChartAxis axis(std::string label, std::string unit, bool logarithmic = false) {
  ChartAxis a;
  a.label = std::move(label);
  a.unit = std::move(unit);
  a.logarithmic = logarithmic;
  return a;
}

TEST(ChartAxis, TakesTheUnitThatReadsBest) {
  const AxisLayout layout = lay(axis("Ra", "m"), {0, 3e-6});
  EXPECT_EQ(layout.label, "Ra (µm)");
  EXPECT_DOUBLE_EQ(layout.factor, 1e-6);
  EXPECT_NEAR(layout.low, -0.12, 1e-12);
  EXPECT_NEAR(layout.high, 3.12, 1e-12);
  EXPECT_EQ(labels(layout), (std::vector<std::string>{"0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"}));
}

TEST(ChartAxis, TakesThePrefixOfTheMiddleOverDecades) {
  const AxisLayout layout = lay(axis("pressure", "Pa", true), {1e6, 1e9});
  EXPECT_EQ(layout.label, "pressure (MPa)");
  EXPECT_EQ(labels(layout), (std::vector<std::string>{"1", "10", "100", "1000"}));
}

TEST(ChartAxis, ConvertsUnitsThatAreNotSi) {
  const AxisLayout layout = lay(axis("z", "um"), {0, 2500});
  EXPECT_EQ(layout.label, "z (mm)");
  EXPECT_DOUBLE_EQ(layout.factor, 1000);
}

TEST(ChartAxis, SharesKeepTheirPerCent) {
  const AxisLayout layout = lay(axis("share", "%"), {10, 30});
  EXPECT_EQ(layout.label, "share (%)");
  EXPECT_EQ(layout.factor, 1);
  EXPECT_NEAR(layout.low, 9.2, 1e-12);
  EXPECT_NEAR(layout.high, 30.8, 1e-12);
  EXPECT_EQ(lay(axis("n", "1"), {10, 30}).label, "n");
  EXPECT_EQ(printed_quantity(10, "%", 4), "10 %");
}

TEST(ChartAxis, PrintsUnknownUnitsAsTheyAre) {
  const AxisLayout layout = lay(axis("n", "trials"), {1, 5});
  EXPECT_EQ(layout.label, "n (trials)");
  EXPECT_EQ(layout.factor, 1);
}

TEST(ChartAxis, TakesPowersOfTenOutOfPlainNumbers) {
  EXPECT_EQ(lay(axis("x", ""), {0, 5e-5}).label, "x (10⁻⁶)");
  EXPECT_EQ(lay(axis("x", ""), {0, 2e5}).label, "x (10³)");
  EXPECT_EQ(lay(axis("x", ""), {0, 0.4}).label, "x");
  EXPECT_EQ(lay(axis("x", "", true), {1e-9, 5e-5}).label, "x");
}

TEST(ChartAxis, LabelsDecades) {
  EXPECT_EQ(labels(lay(axis("x", "", true), {1e-5, 1e-1})),
            (std::vector<std::string>{"10⁻⁵", "10⁻⁴", "0.001", "0.01", "0.1"}));
  EXPECT_EQ(labels(lay(axis("x", "", true), {1, 30})), (std::vector<std::string>{"1", "2", "5", "10", "20"}));
  EXPECT_GE(labels(lay(axis("x", "", true), {1, 1.5})).size(), 3U);
}

TEST(ChartAxis, CountsInWholeNumbers) {
  EXPECT_EQ(labels(lay(axis("N", ""), {1, 2, 3, 4, 5})), (std::vector<std::string>{"1", "2", "3", "4", "5"}));
  EXPECT_EQ(labels(lay(axis("x", ""), {-1, 1.5}))[0], "−1.0");
}

TEST(ChartAxis, GivesRoomToOneValue) {
  for (const double value : {0.0, 3.0, -1e-9, 1e250}) {
    const AxisLayout layout = lay(axis("x", ""), {value});
    EXPECT_LT(layout.low, value / layout.factor);
    EXPECT_GT(layout.high, value / layout.factor);
  }
  const AxisLayout layout = lay(axis("x", "", true), {5});
  EXPECT_LT(layout.low, 5);
  EXPECT_GT(layout.high, 5);
  EXPECT_GE(labels(layout).size(), 2U);
}

TEST(ChartAxis, LeavesOutWhatCannotStandOnIt) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const AxisLayout plain = lay(axis("x", ""), {nan, 1, infinity, 2});
  EXPECT_NEAR(plain.high, 2.04, 1e-12);
  const AxisLayout log = lay(axis("x", "", true), {-1, 0, 1, 100});
  EXPECT_GT(log.low, 0.5);
  const AxisLayout nothing = lay(axis("x", ""), {});
  EXPECT_LT(nothing.low, nothing.high);
}

TEST(ChartAxis, TicsAreDistinctAndInside) {
  using Values = std::vector<double>;
  for (const bool logarithmic : {false, true})
    for (const Values& values :
         {Values{1, 1.0000001}, Values{1e-300, 1e300}, Values{1e-308, 1e-307}, Values{0.28, 0.5},
          Values{123456, 123457}, Values{1e10, 1e10 + 1}, Values{7, 7}, Values{2, 2.9}}) {
      const AxisLayout layout = lay(axis("x", "", logarithmic), values);
      const std::vector<std::string> texts = labels(layout);
      EXPECT_GE(texts.size(), 2U) << values[0];
      EXPECT_LE(texts.size(), 13U) << values[0];
      EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), texts.size()) << values[0];
      for (const Tic& tic : layout.tics) {
        EXPECT_GE(tic.at, layout.low - 1e-6 * (layout.high - layout.low));
        EXPECT_LE(tic.at, layout.high + 1e-6 * (layout.high - layout.low));
      }
    }
}

TEST(ChartAxis, KeepsToARangeGiven) {
  ChartAxis a = axis("x", "m");
  a.range = Range{0, 1e-3};
  const AxisLayout layout = lay(a, {5, 6});
  EXPECT_EQ(layout.low, 0);
  EXPECT_DOUBLE_EQ(layout.high * layout.factor, 1e-3);
}

TEST(PrintedUnit, ReadsAsInPrint) {
  EXPECT_EQ(printed_unit("um"), "µm");
  EXPECT_EQ(printed_unit("um^2"), "µm²");
  EXPECT_EQ(printed_unit("MPa/um"), "MPa/µm");
  EXPECT_EQ(printed_unit("N*m"), "N·m");
  EXPECT_EQ(printed_unit("kg m^-3"), "kg m⁻³");
  EXPECT_EQ(printed_unit("deg"), "°");
  EXPECT_EQ(printed_unit("lux"), "lux");
  EXPECT_EQ(printed_unit("u"), "u");
  EXPECT_EQ(printed_unit("a^b"), "a^b");
}

TEST(PrintedQuantity, HasValueAndUnit) {
  EXPECT_EQ(printed_quantity(2e-5, "m"), "20 µm");
  EXPECT_EQ(printed_quantity(2.5, ""), "2.5");
}

TEST(RoundBelow, IsOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_below(1), 1);
  EXPECT_DOUBLE_EQ(round_below(1.99), 1);
  EXPECT_DOUBLE_EQ(round_below(2), 2);
  EXPECT_DOUBLE_EQ(round_below(4.99e-6), 2e-6);
  EXPECT_DOUBLE_EQ(round_below(9.99e7), 5e7);
  EXPECT_DOUBLE_EQ(round_below(1e-3), 1e-3);
}

TEST(ChartAxis, NamesStandAtWholeNumbersAndSlantWhereTheyAreLong) {
  ChartAxis axis;
  axis.label = "grit";
  axis.names = {"P80", "P120"};
  const AxisLayout layout = lay_out(axis, {});
  EXPECT_EQ(layout.low, -0.5);
  EXPECT_EQ(layout.high, 1.5);
  ASSERT_EQ(layout.tics.size(), 2U);
  EXPECT_EQ(layout.tics[1].at, 1);
  EXPECT_EQ(layout.tics[1].label, "P120");
  EXPECT_FALSE(layout.slanted);
  axis.names = std::vector<std::string>(8, "a body of bead-blasted steel, worn");
  EXPECT_TRUE(lay_out(axis, {}).slanted);
  EXPECT_EQ(lay_out(axis, {}).tics[0].label, "a body of bead-blasted s…");
  axis.names = {"µµµµµµµµµµµµµµµµµµµµµµµµ", "µµµµµµµµµµµµµµµµµµµµµµµµµ"};
  EXPECT_EQ(lay_out(axis, {}).tics[0].label, axis.names[0]);
  EXPECT_EQ(lay_out(axis, {}).tics[1].label, axis.names[0] + "…");
}

}  // namespace
}  // namespace asperity::chart_axis_test
