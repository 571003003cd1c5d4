// SPDX-License-Identifier: GPL-3.0-or-later
// Rows selected by `where`.
#include "engine/statistics/table_operations.hpp"

#include "tests/support/run_fixture.hpp"

namespace asperity::table_filter_test {
namespace {

Table cases() {
  Table table;
  for (const double D : {2.0, 2.5, 2.9})
    for (const double seed : {1.0, 2.0}) {
      const std::vector<Entry> row = {{"D", D}, {"seed", seed}, {"preset", D < 2.7 ? "A" : "B"}};
      table.append(row);
    }
  return table;
}

using Rows = std::vector<std::size_t>;

TEST(TableFilter, TakesEveryRowWhenEmpty) {
  EXPECT_EQ(TableFilter().rows(cases()), (Rows{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(TableFilter().text(), "");
}

TEST(TableFilter, TakesRowsThatMatchEveryColumn) {
  const TableFilter filter({{"D", {2.0, 2.9}}, {"seed", {2.0}}});
  EXPECT_EQ(filter.rows(cases()), (Rows{1, 5}));
  EXPECT_EQ(filter.text(), "`D` = 2 or 2.9 and `seed` = 2");
  EXPECT_EQ(TableFilter({{"preset", {std::string("A")}}}).rows(cases()), (Rows{0, 1, 2, 3}));
}

TEST(TableFilter, TakesNoRowForNoAcceptedValue) {
  EXPECT_EQ(TableFilter(std::vector<Condition>{{"D", {}}}).rows(cases()), Rows{});
  EXPECT_EQ(TableFilter({{"D", {3.0}}}).rows(cases()), Rows{});
}

TEST(TableFilter, NumbersAreInSiOrInTheUnitOfTheName) {
  const Table loads(
      {{"load", "kN"}, {"tag", ""}},
      {{3000.0, std::string("3 kN")}, {500.0, std::string("new")}, {std::string("broken"), Cell()}});
  const auto rows = [&](const char* column, std::vector<Cell> accepted) {
    return TableFilter(std::vector<Condition>{{column, std::move(accepted)}}).rows(loads);
  };
  EXPECT_EQ(rows("load", {std::string("3000 N")}), (Rows{0}));
  EXPECT_EQ(rows("load", {std::string("0.5 kN"), 3000.0}), (Rows{0, 1}));
  EXPECT_EQ(rows("load [kN]", {std::string("500 N"), 3.0}), (Rows{0, 1}));
  EXPECT_EQ(rows("load", {3.0}), Rows{});
  EXPECT_EQ(rows("load", {std::string("broken")}), (Rows{2}));
  EXPECT_EQ(rows("tag", {std::string("3 kN")}), (Rows{0}));
  EXPECT_EQ(
      error_of([&] { rows("load", {std::string("3 MPa")}); }),
      "bad_unit: `where.load`: \"3 MPa\": a pressure where a number in kN is wanted; write it such as \"1 "
      "kN\"");
}

TEST(TableFilter, NamesTheNearestColumn) {
  EXPECT_EQ(error_of([] {
              TableFilter({{"sed", {1.0}}}).rows(cases());
            }),
            "unknown_name: `where` names `sed`, which is no column of the notebook (did you mean `seed`?)");
}

}  // namespace
}  // namespace asperity::table_filter_test
