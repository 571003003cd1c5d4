// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/expectation.hpp"

#include <cmath>
#include <limits>

#include "tests/support/run_fixture.hpp"

namespace asperity::expectation_test {
namespace {

// Mean mu rises with D by 0.1 a step; single seeds may fall.
Table study() {
  Table table;
  for (int k = 0; k < 3; ++k)
    for (const double shift : {-0.2, 0.2}) {
      const std::vector<Entry> row = {{"D", 2.0 + 0.5 * k}, {"mu", 0.4 + 0.1 * k + shift}, {"kind", "rough"}};
      table.append(row);
    }
  return table;
}

Table values(std::vector<Cell> column) {
  Table table;
  for (const Cell& cell : column) {
    const std::vector<Entry> row = {{"row", 1.0}, {"v", cell}};
    table.append(row);
  }
  return table;
}

Verdict judge(const Expectation& expectation, const Table& table) {
  return evaluate(expectation, table, "book");
}

Expectation about(std::string column) {
  Expectation expectation;
  expectation.column = std::move(column);
  return expectation;
}

TEST(Expectation, NearHoldsUpToItsWidth) {
  Expectation e = about("v");
  e.near = 0.4;
  e.within = 0.05;
  EXPECT_TRUE(judge(e, values({0.35, 0.45, 0.4})).passed);
  EXPECT_EQ(judge(e, values({0.35, 0.45, 0.4})).sentence,
            "`v` is near 0.4 within 0.05 (3 rows, 0.35 to 0.45)");
  const Verdict verdict = judge(e, values({0.4, 0.45 + 1e-12, 0.3}));
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.sentence,
            "`v` should be near 0.4 within 0.05, but row 2 has 0.45, row 3 has 0.3 (2 of 3 rows)");
}

TEST(Expectation, NearTakesARelativeWidth) {
  Expectation e = about("v");
  e.near = -2e9;
  e.relative = 0.1;
  EXPECT_TRUE(judge(e, values({-2.2e9, -1.8e9})).passed);
  EXPECT_FALSE(judge(e, values({-2.2001e9})).passed);
  EXPECT_EQ(judge(e, values({-1.9e9})).sentence, "`v` is near -2e+09 within 10 % (1 row, -1.9e+09)");
}

TEST(Expectation, BoundsAreInclusiveToTheLastBit) {
  Expectation e = about("v");
  e.at_least = 0.1;
  EXPECT_TRUE(judge(e, values({0.1})).passed);
  const Verdict below = judge(e, values({std::nextafter(0.1, 0.0)}));
  EXPECT_FALSE(below.passed);
  EXPECT_EQ(below.sentence, "`v` should be at least 0.1, but row 1 has 0.09999999999999999 (1 of 1 row)");
  e.at_least.reset();
  e.at_most = 0.1;
  EXPECT_TRUE(judge(e, values({0.1})).passed);
  EXPECT_FALSE(judge(e, values({std::nextafter(0.1, 1.0)})).passed);
}

TEST(Expectation, BooleansCountAsOneAndZero) {
  Expectation e = about("v");
  e.at_least = 1;
  EXPECT_TRUE(judge(e, values({true, true})).passed);
  EXPECT_FALSE(judge(e, values({true, false})).passed);
}

TEST(Expectation, TellsTheFirstThreeOffendingRows) {
  Expectation e = about("v");
  e.at_most = 0;
  EXPECT_EQ(judge(e, values({1., 2., 3., 4., 5., -1.})).sentence,
            "`v` should be at most 0, but row 1 has 1, row 2 has 2, row 3 has 3 and 2 more (5 of 6 rows)");
}

TEST(Expectation, TrendIsAskedOfMeans) {
  Expectation e = about("mu");
  e.increasing_in = "D";
  EXPECT_TRUE(judge(e, study()).passed);
  EXPECT_EQ(judge(e, study()).sentence, "`mu` is increasing in `D` (6 rows, 0.2 to 0.8)");
  e.increasing_in.reset();
  e.decreasing_in = "D";
  const Verdict verdict = judge(e, study());
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.sentence,
            "`mu` should be decreasing in `D`, but it rises from 0.4 to 0.5 between `D` = 2 and 2.5 and "
            "turns 1 more "
            "times");
}

TEST(Expectation, TrendIsStrict) {
  Table table;
  for (const double x : {3.0, 1.0, 2.0}) {
    const std::vector<Entry> row = {{"x", x}, {"y", x == 3.0 ? 2.0 : x}};
    table.append(row);
  }
  Expectation e = about("y");
  e.increasing_in = "x";
  EXPECT_EQ(judge(e, table).sentence, "`y` should be increasing in `x`, but it stays at 2 from `x` = 2 to 3");
}

TEST(Expectation, ATrendNeedsTwoLevels) {
  Expectation e = about("mu");
  e.increasing_in = "D";
  e.where = TableFilter({{"D", {2.5}}});
  const Verdict verdict = judge(e, study());
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.sentence,
            "`mu` where `D` = 2.5 cannot be judged increasing in `D`: a trend in `D` needs two of its values "
            "at least");
  e.where = {};
  e.increasing_in = "kind";
  EXPECT_FALSE(judge(e, study()).judged);
  e.increasing_in = "pressure";
  EXPECT_EQ(judge(e, study()).sentence,
            "`mu` cannot be judged increasing in `pressure`: the notebook has no column `pressure`");
}

TEST(Expectation, AllConditionsMustHold) {
  Expectation e = about("mu");
  e.where = TableFilter({{"D", {2.0, 3.0}}});
  e.at_least = 0.1;
  e.at_most = 0.7;
  e.increasing_in = "D";
  EXPECT_EQ(judge(e, study()).sentence,
            "`mu` where `D` = 2 or 3 should be at least 0.1, at most 0.7 and increasing in `D`, but row 6 "
            "has 0.8 "
            "(1 of 4 rows)");
}

TEST(Expectation, NegativeControlPassesWhenViolated) {
  Expectation e = about("mu");
  e.decreasing_in = "D";
  e.should_fail = true;
  const Verdict control = judge(e, study());
  EXPECT_TRUE(control.passed);
  EXPECT_TRUE(
      control.sentence.starts_with("fails, as it should: `mu` is not decreasing in `D`: it rises from"));
  e.decreasing_in.reset();
  e.increasing_in = "D";
  const Verdict broken = judge(e, study());
  EXPECT_FALSE(broken.passed);
  EXPECT_EQ(broken.sentence, "holds, and should fail: `mu` is increasing in `D` (6 rows, 0.2 to 0.8)");
}

TEST(Expectation, WhatCannotBeJudgedNeverPasses) {
  Expectation e = about("mu");
  e.at_least = 0;
  const auto sentence = [&](const Table& table) {
    for (const bool control : {false, true}) {
      e.should_fail = control;
      EXPECT_FALSE(judge(e, table).passed);
      EXPECT_FALSE(judge(e, table).judged);
    }
    return judge(e, table).sentence;
  };
  EXPECT_EQ(sentence(Table()), "`mu` cannot be judged at least 0: the notebook has no column `mu`");
  e.where = TableFilter({{"D", {7.0}}});
  EXPECT_EQ(sentence(study()), "`mu` where `D` = 7 cannot be judged at least 0: no row matches");
  e.where = TableFilter({{"knd", {1.0}}});
  EXPECT_EQ(sentence(study()),
            "`mu` where `knd` = 1 cannot be judged at least 0: `where` names `knd`, which is no column of "
            "the notebook "
            "(did you mean `kind`?)");
  e.where = {};
  e.column = "m";
  EXPECT_NE(sentence(study()).find("the notebook has no column `m`"), std::string::npos);
  e.column = "kind";
  EXPECT_EQ(sentence(study()), "`kind` cannot be judged at least 0: row 1 has the text \"rough\"");
  e.column = "v";
  EXPECT_EQ(sentence(values({1.0, std::nan("")})), "`v` cannot be judged at least 0: row 2 has nan");
  EXPECT_EQ(sentence(values({Cell()})),
            "`v` cannot be judged at least 0: none of the rows has a value in that column");
}

TEST(Expectation, LeavesOutRowsWithoutAValueAndSaysSo) {
  Expectation e = about("v");
  e.at_least = 0;
  EXPECT_EQ(judge(e, values({1.0, Cell(), 3.0})).sentence, "`v` is at least 0 (2 rows of 3, 1 to 3)");
}

TEST(Expectation, RefusesToSayNothing) {
  EXPECT_EQ(
      error_of([] { check(about("mu")); }),
      "bad_value: the expectation of `mu` has no condition; give `near` with `within` or `rel`, `at_least`, "
      "`at_most`, `increasing_in` or `decreasing_in`");
  Expectation e = about("mu");
  e.near = 1;
  EXPECT_EQ(error_of([&] { check(e); }),
            "bad_value: `near` needs a width; give `within` (absolute) or `rel` (a fraction of `near`)");
  e.within = e.relative = 0.1;
  EXPECT_EQ(
      error_of([&] { check(e); }),
      "bad_value: `near` is given both `within` and `rel`; give `within` (absolute) or `rel` (a fraction of "
      "`near`)");
  e.within.reset();
  e.relative = -0.1;
  EXPECT_EQ(error_of([&] { check(e); }), "bad_value: `rel` is -0.1; give a finite number, zero or above");
  e.near = 0;
  e.relative = 0.1;
  EXPECT_EQ(error_of([&] { check(e); }), "bad_value: `near` is 0, so `rel` gives no width; give `within`");
  e = about("mu");
  e.within = 1;
  e.at_least = 0;
  EXPECT_EQ(error_of([&] { check(e); }), "bad_value: `within` needs `near`; give `near` as well");
  e = about("mu");
  e.at_least = 2;
  e.at_most = 1;
  EXPECT_EQ(error_of([&] { check(e); }),
            "bad_value: `at_least` is 2 and `at_most` is 1; no value is both; exchange them");
  e.at_least = std::nan("");
  EXPECT_EQ(error_of([&] { check(e); }), "bad_value: `at_least` is nan; give a number to compare with");
  e = about("mu");
  e.increasing_in = e.decreasing_in = "D";
  EXPECT_EQ(error_of([&] { check(e); }),
            "bad_value: `increasing_in` and `decreasing_in` both name `D`; keep one of them");
}

// A bound is converted to the column's unit.
struct UnitCase {
  const char* column;    // its unit
  const char* quantity;  // of the bound
  double cell;           // in the column's unit
};
constexpr UnitCase same_kind[] = {{"MPa", "10 MPa", 10},       {"MPa", "0.01 GPa", 10},
                                  {"kPa", "10 MPa", 10000},    {"Pa", "10 MPa", 1e7},
                                  {"um", "0.1 um", 0.1},       {"nm", "0.1 um", 100},
                                  {"m", "250 um", 250e-6},     {"h", "90 min", 1.5},
                                  {"min", "2 h", 120},         {"deg", "30 deg", 30},
                                  {"turn", "180 deg", 0.5},    {"%", "10 %", 10},
                                  {"%", "0.1 1", 10},          {"", "0.1", 0.1},
                                  {"", "10 %", 0.1},           {"N", "3 kN", 3000},
                                  {"MPa/um", "80 MPa/um", 80}, {"kg m^-3", "2 g/cm^3", 2000}};

std::string named(const std::string& column, const std::string& unit) {
  return unit.empty() ? column : column + " [" + unit + "]";
}

TEST(Expectation, NumbersAreInSiOrInTheUnitOfTheName) {
  Table table;
  const std::vector<Entry> row = {{"Ra [um]", 2.8}};
  table.append(row);
  Expectation e = about("Ra");
  e.near = 2.8e-6;
  e.within = 0.1e-6;
  EXPECT_TRUE(judge(e, table).passed);
  EXPECT_EQ(judge(e, table).sentence, "`Ra` is near 2.8 um within 0.1 um (1 row, 2.8 um)");
  e.column = "Ra [nm]";
  EXPECT_FALSE(judge(e, table).passed);
  e.near = 2800;
  e.within = 100;
  EXPECT_EQ(judge(e, table).sentence, "`Ra` is near 2800 nm within 100 nm (1 row, 2800 nm)");
}

TEST(Expectation, QuantitiesAreCountedInTheUnitOfTheColumn) {
  for (const UnitCase& one : same_kind) {
    SCOPED_TRACE(std::string(one.quantity) + " in " + one.column);
    for (const double factor : {1.0, 1.001}) {
      Table table;
      const std::vector<Entry> row = {{named("v", one.column), one.cell * factor}};
      table.append(row);
      const bool holds = factor == 1;
      Expectation near = about("v");
      near.near = ExpectedValue(std::string_view(one.quantity));
      near.relative = 0;
      EXPECT_EQ(judge(near, table).passed, holds) << judge(near, table).sentence;
      Expectation most = about("v");
      most.at_most = ExpectedValue(std::string_view(one.quantity));
      EXPECT_EQ(judge(most, table).passed, holds) << judge(most, table).sentence;
    }
  }
}

TEST(Expectation, AnotherKindIsAnError) {
  const auto refused = [](std::string unit, const char* quantity) {
    Table table;
    const std::vector<Entry> row = {{named("v", unit), 10.0}};
    table.append(row);
    Expectation e = about("v");
    e.at_least = ExpectedValue(std::string_view(quantity));
    try {
      return "judged: " + judge(e, table).sentence;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_unit);
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refused("MPa", "10 N"),
            "`at_least` is \"10 N\", which is a force, and column `v` is in MPa; give a pressure, or a plain "
            "number in SI");
  EXPECT_EQ(refused("MPa", "10"),
            "`at_least` is \"10\", which has no unit, and column `v` is in MPa; give a pressure, or a plain "
            "number in SI");
  EXPECT_EQ(
      refused("", "10 um"),
      "`at_least` is \"10 um\", which is a length, and column `v` has no unit; give a plain number, or the "
      "column its unit: book:units{ v=\"m\" } before the first row");
  EXPECT_NE(refused("deg", "0.1").find("has no unit"), std::string::npos);
  EXPECT_NE(refused("%", "10").find("has no unit"), std::string::npos);
}

TEST(Expectation, SaysWhatWasWantedInTheUnitOfTheColumn) {
  Table table;
  const std::vector<Entry> row = {{"p [MPa]", 12.0}};
  table.append(row);
  Expectation e = about("p");
  e.near = ExpectedValue(std::string_view("10000 kPa"));
  e.within = 1.5e6;
  EXPECT_EQ(judge(e, table).sentence,
            "`p` should be near 10 MPa within 1.5 MPa, but row 1 has 12 (1 of 1 row)");
  e.within = ExpectedValue(std::string_view("0.002 GPa"));
  EXPECT_EQ(judge(e, table).sentence, "`p` is near 10 MPa within 2 MPa (1 row, 12 MPa)");
  Expectation between = about("p");
  between.at_least = ExpectedValue(std::string_view("5 MPa"));
  between.at_most = 20e6;
  EXPECT_TRUE(judge(between, table).passed);
  between.at_most = 4e6;
  EXPECT_THROW(judge(between, table), Error);
}

}  // namespace
}  // namespace asperity::expectation_test
