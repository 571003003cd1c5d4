// SPDX-License-Identifier: GPL-3.0-or-later
// Grids, fields and sums.
#include "engine/core/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::grid_test {
namespace {

std::string refusal(double nx, double ny, double sx, double sy) {
  return test::refusal([&] { make_grid(nx, ny, sx, sy); });
}

TEST(Grid, NodesAndCells) {
  const Grid grid = make_grid(4, 5, 2e-6, 10e-6);
  EXPECT_EQ(grid.nx, 4);
  EXPECT_EQ(grid.ny, 5);
  EXPECT_EQ(grid.nodes(), 20u);
  EXPECT_DOUBLE_EQ(grid.hx(), 0.5e-6);
  EXPECT_DOUBLE_EQ(grid.hy(), 2e-6);
  EXPECT_DOUBLE_EQ(grid.cell_area(), 1e-12);
  EXPECT_DOUBLE_EQ(grid.area(), 20e-12);
}

// With zero-width cells the filling of holes would not end.
TEST(Grid, CellsHaveAWidth) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(refusal(3, 2, least, 1),
            "`size` is 4.94066e-324 m, which leaves its 3 cells no width; check its unit");
  EXPECT_EQ(refusal(2, 2, 1, least),
            "`size` is 4.94066e-324 m, which leaves its 2 cells no width; check its unit");
  EXPECT_EQ(make_grid(1, 1, least, least).hx(), least);
  EXPECT_EQ(make_grid(2, 3, 2 * least, 3 * least).hy(), least);
}

TEST(Grid, LimitsOfCells) {
  EXPECT_EQ(make_grid(1, max_cells, 1, 1).ny, max_cells);
  const std::string hint = "; give a whole number from 1 to 65536";
  EXPECT_EQ(refusal(0, 4, 1, 1), "`cells` is 0 a side" + hint);
  EXPECT_EQ(refusal(4, -1, 1, 1), "`cells` is -1 a side" + hint);
  EXPECT_EQ(refusal(4, 2.5, 1, 1), "`cells` is 2.5 a side" + hint);
  EXPECT_EQ(refusal(max_cells + 1, 4, 1, 1), "`cells` is 65537 a side" + hint);
  EXPECT_EQ(refusal(std::nan(""), 4, 1, 1), "`cells` is nan a side" + hint);
}

TEST(Grid, LimitsOfSize) {
  const std::string hint = "; give a finite length above zero";
  EXPECT_EQ(refusal(4, 4, 0, 1), "`size` is 0 m" + hint);
  EXPECT_EQ(refusal(4, 4, 1, -2e-6), "`size` is -2e-06 m" + hint);
  EXPECT_EQ(refusal(4, 4, std::numeric_limits<double>::infinity(), 1), "`size` is inf m" + hint);
  EXPECT_EQ(refusal(4, 4, 1, std::nan("")), "`size` is nan m" + hint);
}

TEST(Field, StoresRowByRow) {
  Field field(3, 2, 7.0);
  EXPECT_EQ(field(2, 1), 7.0);
  field(2, 1) = 5;
  EXPECT_EQ(field[5], 5.0);
  EXPECT_EQ(field.row(1)[2], 5.0);
  EXPECT_EQ(field.row(0).size(), 3u);
  const Field copy = field;
  field(2, 1) = 1;
  EXPECT_EQ(copy(2, 1), 5.0);
  EXPECT_TRUE(Field().empty());
}

TEST(Field, TakesValuesOver) {
  UnsetArray<double> values(6, 3.0);
  const double* const at = values.data();
  const Field field(3, 2, std::move(values));
  EXPECT_EQ(field.data(), at);
  EXPECT_EQ(field(2, 1), 3.0);
  EXPECT_THROW(Field(2, 2, UnsetArray<double>(3)), Error);
}

TEST(BlockSum, OfKnownSeries) {
  for (const int n : {0, 1, 7, 8, 9, 1023, 1024, 1025, 2048, 5000, 100001}) {
    std::vector<double> values(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) values[k] = k + 1;
    EXPECT_EQ(block_sum(values), 0.5 * n * (n + 1.0)) << n;
  }
}

TEST(BlockSum, KeepsItsDigits) {
  const std::vector<double> tenths(10000000, 0.1);
  // At most 128 + 3 + 14 roundings; a running sum errs by 1.6e-4.
  EXPECT_NEAR(block_sum(tenths), 1e6, 145 * 0x1p-53 * 1e6);
  const Stream stream(1, "sum");
  std::vector<double> values(1000000);
  long double exact = 0;
  for (std::size_t k = 0; k < values.size(); ++k) exact += values[k] = stream.uniform(k);
  EXPECT_NEAR(block_sum(values), static_cast<double>(exact), 1e-15 * 500000 * 4);
}

TEST(BlockSum, MeanAndRange) {
  const std::vector<double> values = {3, -1, 4, 2};
  EXPECT_EQ(mean(values), 2.0);
  EXPECT_EQ(range(values).min, -1.0);
  EXPECT_EQ(range(values).max, 4.0);
  EXPECT_EQ(range(values).span(), 5.0);
  EXPECT_EQ(mean({}), 0.0);
  EXPECT_EQ(range({}).span(), 0.0);
}

TEST(BlockSum, RangeIsFoundWhereverItLies) {
  for (const std::size_t n : {1u, 15u, 16u, 17u, 40u, 100u})
    for (std::size_t at = 0; at < n; ++at) {
      std::vector<double> values(n, 1.0);
      values[at] = -2;
      values[(at + n / 2) % n] += 5;
      EXPECT_EQ(range(values).min, n / 2 == 0 ? 3.0 : -2.0) << n << " " << at;
      EXPECT_EQ(range(values).max, n / 2 == 0 ? 3.0 : 6.0) << n << " " << at;
    }
}

}  // namespace
}  // namespace asperity::grid_test
