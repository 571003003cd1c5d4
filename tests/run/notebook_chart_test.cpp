// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/notebook_chart.hpp"

#include <cmath>

#include "tests/support/run_fixture.hpp"

namespace asperity::notebook_chart_test {
namespace {

Table study() {
  Table table;
  for (const double D : {2.5, 2.0})
    for (const double seed : {1.0, 2.0, 3.0})
      for (const double p : {2e6, 1e6}) {
        const std::vector<Entry> row = {{"D", D},
                                        {"seed", seed},
                                        {"pressure", p, "Pa"},
                                        {"mu", D * p / 1e7 + 0.01 * (seed - 2)},
                                        {"size", 1e-6 * D, "m"}};
        table.append(row);
      }
  return table;
}

NotebookChart chart(std::string x, std::vector<std::string> y) {
  NotebookChart options;
  options.x = std::move(x);
  options.y = std::move(y);
  return options;
}

LineChart drawn(const Table& table, const NotebookChart& options) {
  std::vector<std::string> warnings;
  return chart_of(table, options, warnings);
}

TEST(NotebookChart, AveragesRowsThatShareX) {
  NotebookChart options = chart("pressure", {"mu"});
  options.one_line_per = "D";
  const LineChart plain = drawn(study(), options);
  ASSERT_EQ(plain.series.size(), 2U);
  EXPECT_EQ(plain.series[0].name, "2");
  EXPECT_EQ(plain.series[1].name, "2.5");
  EXPECT_EQ(plain.key_title, "D");
  EXPECT_EQ(plain.series[0].x, (std::vector<double>{1e6, 2e6}));
  EXPECT_NEAR(plain.series[0].y[1], 0.4, 1e-15);
  EXPECT_TRUE(plain.series[0].y_error.empty());
  EXPECT_EQ(plain.series[0].cloud_x.size(), 6U);
}

TEST(NotebookChart, SpreadIsTheStandardDeviation) {
  NotebookChart options = chart("pressure", {"mu"});
  options.one_line_per = "D";
  options.spread = true;
  const LineChart spread = drawn(study(), options);
  ASSERT_EQ(spread.series[0].y_error.size(), 2U);
  EXPECT_NEAR(spread.series[0].y_error[0], 0.01, 1e-15);
  EXPECT_TRUE(spread.series[0].cloud_x.empty());
}

TEST(NotebookChart, SpreadOfOneRowIsNothing) {
  NotebookChart options = chart("pressure", {"mu"});
  options.where = TableFilter({{"D", {2.0}}, {"seed", {1.0}}});
  options.spread = true;
  EXPECT_EQ(drawn(study(), options).series[0].y_error, (std::vector<double>{0, 0}));
}

TEST(NotebookChart, SpreadMayBeAColumn) {
  NotebookChart options = chart("pressure", {"mu"});
  options.spread_column = "D";
  const LineChart spread = drawn(study(), options);
  EXPECT_NEAR(spread.series[0].y_error[0], 2.25, 1e-15);
}

TEST(NotebookChart, InOrderKeepsLoops) {
  Table table;
  for (const double p : {1.0, 2.0, 3.0, 2.0, 1.0}) {
    const std::vector<Entry> row = {{"p", p}, {"a", p * p}};
    table.append(row);
  }
  NotebookChart options = chart("p", {"a"});
  options.in_order = true;
  EXPECT_EQ(drawn(table, options).series[0].x, (std::vector<double>{1, 2, 3, 2, 1}));
}

TEST(NotebookChart, LabelsCarryUnits) {
  const LineChart lines = drawn(study(), chart("pressure", {"size"}));
  EXPECT_EQ(lines.x.unit, "Pa");
  EXPECT_EQ(lines.y.unit, "m");
  NotebookChart options = chart("pressure", {"mu"});
  options.one_line_per = "size";
  options.y_label = "coefficient of friction";
  const LineChart named = drawn(study(), options);
  EXPECT_EQ(named.series[1].name, "2.5 µm");
  EXPECT_EQ(named.y.label, "coefficient of friction");
}

TEST(NotebookChart, SeveralColumnsShareAnAxis) {
  Table table;
  const std::vector<Entry> row = {{"x", 1.0}, {"a", 1.0}, {"b", 2.0}, {"c", 1.0, "m"}};
  table.append(row);
  const LineChart both = drawn(table, chart("x", {"a", "b"}));
  EXPECT_EQ(both.y.label, "a, b");
  EXPECT_EQ(both.series[1].name, "b");
  EXPECT_EQ(error_of([&] {
              drawn(table, chart("x", {"a", "c"}));
            }),
            "bad_unit: `y` has columns of different units: `a` is a plain number, `c` is in m; draw one "
            "chart for each "
            "unit");
}

TEST(NotebookChart, NamesTheNearestColumn) {
  EXPECT_EQ(
      error_of([] { drawn(study(), chart("presure", {"mu"})); }),
      "unknown_name: `x` names `presure`, which is no column of the notebook (did you mean `pressure`?)");
  NotebookChart options = chart("pressure", {"mu"});
  options.one_line_per = "sed";
  EXPECT_EQ(
      error_of([&] { drawn(study(), options); }),
      "unknown_name: `one_line_per` names `sed`, which is no column of the notebook (did you mean `seed`?)");
  EXPECT_EQ(error_of([] { drawn(study(), chart("pressure", {})); }),
            "bad_value: a chart has no `y`; name a column");
}

TEST(NotebookChart, RefusesToDrawNothing) {
  NotebookChart options = chart("pressure", {"mu"});
  options.where = TableFilter({{"D", {9.0}}});
  EXPECT_EQ(
      error_of([&] { drawn(study(), options); }),
      "bad_value: the chart of `mu` against `pressure` has nothing to draw; no row matches `where` `D` = 9");
  Table table;
  const std::vector<Entry> first = {{"x", 1.0}}, second = {{"y", 1.0}};
  table.append(first);
  table.append(second);
  EXPECT_EQ(
      error_of([&] { drawn(table, chart("x", {"y"})); }),
      "bad_value: the chart of `y` against `x` has nothing to draw; none of the 2 rows has a number in both");
}

TEST(NotebookChart, SaysWhichRowsAreText) {
  Table table;
  const std::vector<Entry> first = {{"x", 1.0}, {"y", 1.0}}, second = {{"x", 2.0}, {"y", "none"}};
  table.append(first);
  table.append(second);
  std::vector<std::string> warnings;
  chart_of(table, chart("x", {"y"}), warnings);
  EXPECT_EQ(warnings, (std::vector<std::string>{"1 row is not drawn: text where a number should be"}));
}

TEST(NotebookChart, FileNameIsSafe) {
  EXPECT_EQ(default_chart_file("fig 9", chart("D", {"Ra", "Rq"})), "fig-9-Ra-Rq-D.svg");
  EXPECT_EQ(default_chart_file("../x", chart("a'b`rm`", {"/"})), "x-a-b-rm.svg");
}

Table grits() {
  Table table;
  double N = 0;
  for (const char* grit : {"P80", "P120", "P80"}) {
    const std::vector<Entry> row = {{"grit", grit}, {"Ra [um]", N + 1}, {"N", N}};
    table.append(row);
    ++N;
  }
  return table;
}

TEST(NotebookChart, TextsAlongXAreNamesInTheOrderOfTheirRows) {
  const LineChart named = drawn(grits(), chart("grit", {"Ra"}));
  EXPECT_EQ(named.x.names, (std::vector<std::string>{"P80", "P120"}));
  EXPECT_EQ(named.series[0].x, (std::vector<double>{0, 1}));
  EXPECT_EQ(named.series[0].y, (std::vector<double>{2, 2}));  // P80 twice: 1 and 3
  EXPECT_FALSE(named.series[0].line);
  NotebookChart options = chart("grit", {"Ra"});
  options.log_x = true;
  EXPECT_EQ(
      error_of([&] { drawn(grits(), options); }),
      "bad_value: `grit` holds names, such as \"P80\"; `log_x`, `fit` and `functions` need numbers along");
  EXPECT_EQ(error_of([&] { drawn(grits(), chart("N", {"grit"})); }),
            "bad_value: the chart of `grit` against `N` has nothing to draw; `grit` holds names, such as "
            "\"P80\"; names can only be along x: add a column of numbers");
}

TEST(NotebookChart, LinesAcrossAreCountedInTheColumnsUnit) {
  NotebookChart options = chart("N", {"Ra"});
  options.references = {{{}, ExpectedValue("2500 nm"), "limit"}, {ExpectedValue(1), {}, ""}};
  const LineChart lines = drawn(grits(), options);
  EXPECT_EQ(*lines.references[0].y, 2.5);
  EXPECT_EQ(*lines.references[1].x, 1);
  options.references = {{{}, ExpectedValue(2.5e-6), ""}};
  EXPECT_EQ(*drawn(grits(), options).references[0].y, 2.5);
  options.y = {"Ra [nm]"};
  options.references = {{{}, ExpectedValue(2500), ""}};
  EXPECT_EQ(*drawn(grits(), options).references[0].y, 2500);
  EXPECT_EQ(drawn(grits(), options).series[0].y, (std::vector<double>{1000, 2000, 3000}));
  options.references = {{{}, ExpectedValue("2 N"), ""}};
  EXPECT_TRUE(error_of([&] { drawn(grits(), options); }).starts_with("bad_unit: a line across `Ra`: "));
}

TEST(NotebookChart, FitsAndFunctionsAreLinesOverTheRangeOfX) {
  NotebookChart options = chart("N", {"Ra"});
  options.fits = {{"", "N", "Ra", 0.9, {{0, 1e-6, 0.5e-6, 1.5e-6}, {2, 3e-6, 2.5e-6, 3.5e-6}}}};
  options.functions = {{"double", [](double x) { return 2e-6 * x; }}};
  const LineChart lines = drawn(grits(), options);
  ASSERT_EQ(lines.series.size(), 3U);
  EXPECT_FALSE(lines.series[0].line);
  EXPECT_EQ(lines.series[1].name, "fit, 90 % band");
  EXPECT_TRUE(lines.series[1].band);
  EXPECT_EQ(lines.series[1].y_high, (std::vector<double>{1.5, 3.5}));
  EXPECT_EQ(lines.series[2].name, "double");
  EXPECT_EQ(lines.series[2].x.front(), 0);
  EXPECT_EQ(lines.series[2].x.back(), 2);
  EXPECT_EQ(lines.series[2].y.back(), 4);
  options.lines = true;
  EXPECT_TRUE(drawn(grits(), options).series[0].line);
  options.fits[0].y = "mu";
  EXPECT_EQ(
      error_of([&] { drawn(grits(), options); }),
      "bad_value: `fit` is of `mu` against `N`, and the chart shows `Ra` against `N`; draw the columns that "
      "were fitted");
}

TEST(NotebookChart, IntervalsFromColumns) {
  Table table;
  for (const double x : {1.0, 2.0}) {
    const std::vector<Entry> row = {{"x", x}, {"y", 2 * x}, {"low", x}, {"high", 5 * x}};
    table.append(row);
  }
  NotebookChart options = chart("x", {"y"});
  options.low = "low";
  options.high = "high";
  EXPECT_EQ(drawn(table, options).series[0].y_low, (std::vector<double>{1, 2}));
  EXPECT_EQ(drawn(table, options).series[0].y_high, (std::vector<double>{5, 10}));
  options.high = "hihg";
  EXPECT_NE(error_of([&] { drawn(table, options); }).find("`interval` names `hihg`"), std::string::npos);
}

TEST(NotebookChart, LinesStandInTheOrderOfTheirNumbersWholeOrNot) {
  Table table;
  for (const Cell& D : {Cell(std::int64_t{3}), Cell(2.5), Cell(std::int64_t{2})}) {
    const std::vector<Entry> row = {{"D", D}, {"x", 1.0}, {"y", 1.0}};
    table.append(row);
  }
  NotebookChart options = chart("x", {"y"});
  options.one_line_per = "D";
  const LineChart lines = drawn(table, options);
  EXPECT_EQ(lines.series[0].name, "2");
  EXPECT_EQ(lines.series[1].name, "2.5");
  EXPECT_EQ(lines.series[2].name, "3");
}

using NotebookChartRun = InFolder;

TEST_F(NotebookChartRun, DrawsUnderTheRunAndJournals) {
  RunSetup setup;
  setup.script_name = "a.lua";
  setup.out = folder / "run";
  RunDirectory run(setup);
  const auto book = run.notebook("book");
  for (const double x : {0.0, 1.0, 2.0}) {
    const std::vector<Entry> row = {{"x", x}, {"a'b`touch mark`", x}};
    book->write(row);
  }
  NotebookChart options = chart("x", {"a'b`touch mark`"});
  options.log_x = true;
  const DrawnChart result = draw_chart(run, *book, options);
  EXPECT_EQ(result.file, folder / "run" / "book-a-b-touch-mark-x.svg");
  EXPECT_TRUE(std::filesystem::exists(result.file));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(content_of(folder / "run" / "journal.jsonl")
                .find("\"event\":\"chart\",\"notebook\":\"book\",\"file\":"),
            std::string::npos);
  options.file = "../out.svg";
  EXPECT_NE(error_of([&] { draw_chart(run, *book, options); }), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.svg"));
}

TEST_F(NotebookChartRun, DryRunChecksOnly) {
  RunDirectory run(RunDirectory::Without::dry);
  const auto book = run.notebook("book");
  const std::vector<Entry> row = {{"x", 1.0}, {"y", 1.0}};
  book->write(row);
  EXPECT_FALSE(std::filesystem::exists(draw_chart(run, *book, chart("x", {"y"})).file));
  EXPECT_NE(error_of([&] { draw_chart(run, *book, chart("x", {"z"})); }), "");
}

}  // namespace
}  // namespace asperity::notebook_chart_test
