// SPDX-License-Identifier: GPL-3.0-or-later
// Joins, unmatched rows; display units; text.
#include "engine/statistics/table_operations.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::table_operations_test {
namespace {

Table measured() {
  return Table({{"N", ""}, {"angle", "rad"}}, {{std::int64_t{1}, 0.1}, {std::int64_t{4}, 0.2}, {2.0, 0.3}});
}
Table computed() { return Table({{"N", ""}, {"mu", ""}}, {{2.0, 0.5}, {1.0, 0.4}, {1.0, 0.45}, {8.0, 0.6}}); }

std::string refusal(const Table& table, const Table& other, const Join& join) {
  return test::error_of([&] { (void)joined(table, other, join); }, "joined");
}

TEST(TableOperations, JoinedRowsStandInTheOrderOfTheFirst) {
  EXPECT_EQ(joined(measured(), computed(), {{"N"}, "", Unmatched::leave_out}).csv(),
            "N,angle [rad],mu\n1,0.1,0.4\n1,0.1,0.45\n2,0.3,0.5\n");
  EXPECT_EQ(joined(measured(), computed(), {{"N"}, "", Unmatched::keep}).csv(),
            "N,angle [rad],mu\n1,0.1,0.4\n1,0.1,0.45\n4,0.2,\n2,0.3,0.5\n");
  EXPECT_EQ(joined(computed(), measured(), {{"N"}, "", Unmatched::leave_out}).csv(),
            "N,mu,angle [rad]\n2,0.5,0.3\n1,0.4,0.1\n1,0.45,0.1\n");
}

TEST(TableOperations, WhatIsJoinedInSilenceIsNot) {
  EXPECT_EQ(
      refusal(measured(), computed(), {{"N"}}),
      "1 row of the notebook without a match in the notebook, the first in row 2: `N` = 4; unmatched=\"leave "
      "out\" takes the other rows, unmatched=\"keep\" leaves their cells empty");
  const Table twice({{"N", ""}, {"x", ""}}, {{1.0, 1.0}, {1.0, 2.0}});
  EXPECT_EQ(refusal(twice, computed(), {{"N"}}),
            "rows with `N` = 1 occur more than once in both tables; join by one more column, or take means "
            "of one table first");
  EXPECT_EQ(refusal(measured(), measured(), {{"N"}}),
            "both tables have `angle` besides the columns of `by`; give the other's names a suffix, as in { "
            "by=\"N\", suffix=\"_predicted\" }");
  EXPECT_EQ(refusal(measured(), computed(), {{"M"}}).substr(0, 45),
            "`by` names `M`, which is no column of the not");
}

TEST(TableOperations, KeysOfDifferentDisplayUnitsMeet) {
  const Table in_kilo({{"load", "kN"}, {"a", ""}}, {{3000.0, 1.0}, {100.0, 2.0}});
  const Table in_newtons({{"load", "N"}, {"b", ""}}, {{100.0, 20.0}, {3000.0, 10.0}});
  EXPECT_EQ(joined(in_kilo, in_newtons, {{"load"}}).csv(), "load [kN],a,b\n3,1,10\n0.1,2,20\n");
  EXPECT_EQ(joined(in_newtons, in_kilo, {{"load"}}).csv(), "load [N],b,a\n100,20,2\n3000,10,1\n");
  const Table of_lengths({{"load", "m"}}, {{3.0}});
  EXPECT_EQ(refusal(in_kilo, of_lengths, {{"load"}}),
            "column `load` is a force in the notebook and a length in the notebook; rows are joined by equal "
            "values: give both columns the unit");
}

TEST(TableOperations, KeysMayBeTextsEmptyOrNumbersThatRoundOtherwise) {
  const Table first({{"tag", ""}, {"x", ""}}, {{"worn", 0.3}, {Cell(), 0.2}, {true, 0.1}, {"new", 0.7}});
  const Table second({{"x", ""}, {"tag", ""}, {"y", ""}},
                     {{0.7, "new", 4.0}, {0.1, true, 3.0}, {0.1 + 0.2, "worn", 1.0}, {0.2, Cell(), 2.0}});
  EXPECT_EQ(joined(first, second, {{"tag", "x"}}).csv(),
            "tag,x,y\nworn,0.3,1\n,0.2,2\ntrue,0.1,3\nnew,0.7,4\n");
}

TEST(TableOperations, DisplayUnitsAreRoundedOnce) {
  const Table table({{"l", "um"}, {"a", "rad"}, {"n", ""}},
                    {{1e-7, 3.141592653589793, 5.0}, {3e-6, Cell(), 6.0}});
  const std::vector<std::string> names = {"a [deg]"};
  const Table shown = in_display_units(table, names);
  EXPECT_EQ(std::get<double>(shown.cell(0, 0)), 0.1);
  EXPECT_EQ(std::get<double>(shown.cell(1, 0)), 3.0);
  EXPECT_EQ(shown.columns()[1].unit, "deg");
  EXPECT_EQ(std::get<double>(shown.cell(0, 1)), 180.0);
  EXPECT_TRUE(is_empty(shown.cell(1, 1)));
  EXPECT_EQ(std::get<double>(shown.cell(1, 2)), 6.0);
}

TEST(TableOperations, ChosenColumnsStandInChosenUnits) {
  const Table table({{"p", "Pa"}, {"N", ""}}, {{1.5e7, std::int64_t{1}}});
  const std::vector<std::string> names = {"N", "p [MPa]"};
  EXPECT_EQ(columns_of(table, names).csv(), "N,p [MPa]\n1,15\n");
  EXPECT_EQ(
      test::error_of([&] { (void)columns_of(table, std::vector<std::string>{"q"}); }, "q").substr(0, 10),
      "`column` n");
}

TEST(TableOperations, DigestIsOfWhatItHoldsAndNotOfItsName) {
  Table named = measured();
  named.rename("another");
  EXPECT_EQ(named.digest(), measured().digest());
  EXPECT_NE(computed().digest(), measured().digest());
  EXPECT_EQ(Table({{"a", "m"}}, {{1.0}}).digest(), Table({{"a", "mm"}}, {{1.0}}).digest());
  EXPECT_NE(Table({{"a", "m"}}, {{1.0}}).digest(), Table({{"a", "Pa"}}, {{1.0}}).digest());
  EXPECT_NE(Table({{"a", ""}}, {{Cell()}}).digest(), Table({{"a", ""}}, {{""}}).digest());
}

TEST(TableOperations, TextIsInReadableUnitsAndEnds) {
  EXPECT_EQ(
      table_text(Table({{"N", ""}, {"load", "N"}}, {{std::int64_t{1}, 2500.0}, {std::int64_t{10}, Cell()}})),
      "the notebook: 2 rows of 2 columns\n   N load [kN]\n   1       2.5\n  10          ");
  EXPECT_EQ(table_text(Table({{"a", ""}, {"b", ""}}, {{std::string("x\ny"), std::string("z")}})),
            "the notebook: 1 row of 2 columns\n    a b\n  x y z");
  EXPECT_EQ(table_text(Table({{"N", ""}}, {{1.0}, {2.0}, {3.0}}), 1),
            "the notebook: 3 rows of 1 column\n  N\n  1\n  and 2 more");
}

TEST(TableOperations, WholeNumbersKeepTheirDigits) {
  const Table table({{"n", ""}}, {{std::int64_t{100000}}, {100000.0}, {-2e6}, {1e15}, {0.5}});
  EXPECT_EQ(table.csv(), "n\n100000\n100000\n-2000000\n1e+15\n0.5\n");
  EXPECT_TRUE(same_cell(std::int64_t{3}, 3.0));
  EXPECT_FALSE(same_cell(std::int64_t{1}, true));
}

}  // namespace
}  // namespace asperity::table_operations_test
