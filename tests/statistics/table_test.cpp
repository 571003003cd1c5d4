// SPDX-License-Identifier: GPL-3.0-or-later
// The table: column order, units, CSV as in RFC 4180.
#include "engine/statistics/table.hpp"
#include "engine/core/constants.hpp"

#include <cmath>
#include <limits>

#include "tests/support/run_fixture.hpp"

namespace asperity::table_test {
namespace {

bool add(Table& table, std::vector<Entry> row) { return table.append(row); }

TEST(TableColumns, EveryFormOfAUnitNamesOneColumn) {
  for (const char* head : {"p [MPa]", "p[MPa]", "p (MPa)", "p / MPa"}) {
    const TableColumn column = split_column_unit(head);
    EXPECT_EQ(column.name, "p") << head;
    EXPECT_EQ(column.unit, "MPa") << head;
  }
  for (const char* head : {"p", "mu (first)", "area / load", "Run N"}) {
    EXPECT_EQ(split_column_unit(head).name, head);
    EXPECT_EQ(split_column_unit(head).unit, "");
  }
  EXPECT_EQ(split_column_unit("slope [-]").name, "slope");
  EXPECT_EQ(split_column_unit("slope [-]").unit, "");
}

TEST(Table, ColumnsStandInOrderOfAppearance) {
  Table table;
  EXPECT_TRUE(add(table, {{"N", 1.0}, {"Ra", 1e-6, "m"}}));
  EXPECT_TRUE(add(table, {{"mu", 0.1}, {"N", 2.0}}));
  EXPECT_FALSE(add(table, {{"N", 3.0}}));
  EXPECT_EQ(table.csv(), "N,Ra [m],mu\n1,1e-06,\n2,,0.1\n3,,\n");
  EXPECT_TRUE(is_empty(table.cell(0, 2)));
  EXPECT_EQ(std::get<double>(table.cell(1, 2)), 0.1);
}

TEST(Table, QuotesAsRfc4180) {
  Table table;
  add(table, {{"a,b", "x"},
              {"c", std::string("say \"hi\"\nthere")},
              {"e", std::string()},
              {"t", true},
              {"f", false}});
  EXPECT_EQ(table.csv(), "\"a,b\",c,e,t,f\nx,\"say \"\"hi\"\"\nthere\",\"\",true,false\n");
}

TEST(Table, FormulasAreTexts) {
  Table table;
  add(table,
      {{"=1+1", "=cmd|' /C calc'!A0"}, {"a", "+1+cmd"}, {"b", "-2+3"}, {"c", "@SUM(A1)"}, {"d", "\tx"}});
  EXPECT_EQ(table.csv(),
            "\"'=1+1\",a,b,c,d\n\"'=cmd|' /C calc'!A0\",\"'+1+cmd\",\"'-2+3\",\"'@SUM(A1)\",\"'\tx\"\n");
}

TEST(Table, NumbersAndOtherTextsStayAsTheyAre) {
  Table table;
  add(table, {{"a", -5.0}, {"b", "-5"}, {"c", "+1e-6"}, {"d", "a=b"}, {"e", "1-2"}, {"f", "-inf"}});
  EXPECT_EQ(table.csv_row(0), "-5,-5,+1e-6,a=b,1-2,-inf\n");
}

TEST(Table, NumbersAreExact) {
  Table table;
  const double value = std::nextafter(0.1, 1.0);
  add(table, {{"v", value}, {"inf", -std::numeric_limits<double>::infinity()}, {"nan", std::nan("")}});
  EXPECT_EQ(table.csv_row(0), "0.10000000000000002,-inf,nan\n");
  EXPECT_EQ(std::stod(table.csv_row(0)), value);
}

TEST(Table, TakesAUnitFromTheName) {
  Table table;
  add(table, {{"load [N]", 3.0}});
  EXPECT_EQ(table.columns()[0].name, "load");
  EXPECT_EQ(table.columns()[0].unit, "N");
  for (const char* name : {"load", "load [N]", "load [Pa]"}) EXPECT_EQ(table.find_column(name), 0U);
  EXPECT_EQ(error_of([&] { table.column("load [Pa]", "y"); }),
            "bad_unit: column `load` is a force, and `Pa` is a unit of a pressure; write `load [N]`");
  EXPECT_EQ(table.csv_header(), "load [N]\n");
}

TEST(Table, StoresSiAndShowsTheFirstUnit) {
  Table table;
  EXPECT_TRUE(table.declare_unit("Ra", "um"));
  EXPECT_FALSE(table.declare_unit("Ra", "um"));
  add(table, {{"Ra", 2.8e-6}});
  EXPECT_FALSE(add(table, {{"Ra [nm]", 2900.0}}));
  EXPECT_EQ(std::get<double>(table.cell(1, 0)), 2.9e-6);
  EXPECT_EQ(table.csv(), "Ra [um]\n2.8\n2.9\n");
  EXPECT_TRUE(table.declare_unit("Ra", "nm"));
  EXPECT_EQ(table.csv(), "Ra [nm]\n2800\n2900\n");
  EXPECT_EQ(std::get<double>(table.cell(0, 0)), 2.8e-6);
  EXPECT_EQ(error_of([&] { table.declare_unit("Ra", "Pa"); }),
            "bad_unit: column `Ra` is a length, and `Pa` is a unit of a pressure; write `Ra [nm]`");
  EXPECT_EQ(table.rows(), 2U);
}

TEST(Table, UnknownUnitsStayInTheName) {
  Table table;
  add(table, {{"signal [counts]", 3.0}});
  EXPECT_EQ(table.columns()[0].name, "signal [counts]");
  EXPECT_EQ(table.columns()[0].unit, "");
}

TEST(Table, UnitsMayBeginWithOne) {
  Table table;
  add(table, {{"area per load [1/MPa]", 2.0}});
  EXPECT_EQ(table.columns()[0].unit, "1/MPa");
  EXPECT_EQ(std::get<double>(table.cell(0, 0)), 2e-6);
}

TEST(Table, SharesAreNumbers) {
  Table table;
  add(table, {{"area [%]", 12.0}});
  EXPECT_EQ(std::get<double>(table.cell(0, 0)), 0.12);
  EXPECT_EQ(table.csv(), "area [%]\n12\n");
}

TEST(Table, RefusesRowsThatSayNothingOrTwoThings) {
  Table table;
  EXPECT_EQ(error_of([&] { add(table, {}); }),
            "bad_value: a notebook row has no columns; give at least one, as in {mu = 0.4}");
  EXPECT_EQ(error_of([&] {
              add(table, {{"", 1.0}});
            }),
            "bad_value: a notebook column has an empty name; give every column a name");
  EXPECT_EQ(error_of([&] {
              add(table, {{"a", 1.0}, {"b", 1.0}, {"a [m]", 2.0}});
            }),
            "bad_value: a notebook row has column `a` twice; give each column one value");
  EXPECT_EQ(table.rows(), 0U);
  EXPECT_TRUE(table.columns().empty());
}

TEST(Table, NamesTheNearestColumn) {
  Table table;
  EXPECT_EQ(error_of([&] { table.column("mu", "y"); }),
            "unknown_name: `y` names `mu`, which is no column of the notebook; nothing is written in the "
            "notebook yet");
  add(table, {{"stiffness", 1.0}, {"D", 2.0}});
  EXPECT_EQ(
      error_of([&] { table.column("stifness", "y"); }),
      "unknown_name: `y` names `stifness`, which is no column of the notebook (did you mean `stiffness`?)");
  EXPECT_EQ(error_of([&] { table.column("pressure", "x"); }),
            "unknown_name: `x` names `pressure`, which is no column of the notebook; its columns are "
            "stiffness and D");
}

TEST(Cell, NumbersAreTheSameWithinARounding) {
  EXPECT_TRUE(same_cell(0.1 + 0.2, 0.3));
  EXPECT_TRUE(same_cell(1e-9 * (1 + 0.9e-12), 1e-9));
  EXPECT_FALSE(same_cell(1e-9 * (1 + 1.1e-12), 1e-9));
  EXPECT_FALSE(same_cell(0.0, 1e-300));
  EXPECT_TRUE(same_cell(0.0, -0.0));
  EXPECT_TRUE(same_cell(std::nan(""), std::nan("")));
  EXPECT_FALSE(same_cell(1.0, true));
  EXPECT_FALSE(same_cell(std::string("1"), 1.0));
  EXPECT_TRUE(same_cell(infinity, infinity));
  EXPECT_FALSE(same_cell(infinity, 1.0));
  EXPECT_FALSE(same_cell(infinity, -infinity));
}

}  // namespace
}  // namespace asperity::table_test
