// SPDX-License-Identifier: GPL-3.0-or-later
// Bins by rule, number and edges; special values.
#include "engine/statistics/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/error.hpp"

namespace asperity::histogram_test {
namespace {

std::vector<double> counting(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

TEST(Histogram, FreedmanDiaconisByDefault) {
  // Quartiles 25 and 75: width 100/101^(1/3) = 21.47, five bins of 20.
  const ValueHistogram found = value_histogram(counting(101));
  EXPECT_EQ(found.rule, "Freedman-Diaconis");
  EXPECT_EQ(found.edges, (std::vector<double>{0, 20, 40, 60, 80, 100}));
  EXPECT_EQ(found.counts, (std::vector<std::size_t>{20, 20, 20, 20, 21}));
  double whole = 0;
  for (std::size_t k = 0; k < 5; ++k) whole += found.density[k] * 20;
  EXPECT_NEAR(whole, 1, 1e-15);
}

TEST(Histogram, EdgesBelongToTheBinAboveAndTheLastToBoth) {
  const HistogramBins bins{{}, {0, 1, 2}};
  const ValueHistogram found = value_histogram(
      std::vector<double>{-0.1, 0, std::nextafter(1.0, 0.0), 1, 2, std::nextafter(2.0, 3.0), 9}, bins);
  EXPECT_EQ(found.counts, (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(found.below, 1U);
  EXPECT_EQ(found.above, 2U);
  EXPECT_EQ(found.values, 4U);
  EXPECT_EQ(found.rule, "edges as given");
}

TEST(Histogram, NumberOfBinsAndMissingValues) {
  std::vector<double> values = counting(10);
  values.push_back(std::nan(""));
  values.push_back(std::numeric_limits<double>::infinity());
  const ValueHistogram found = value_histogram(values, {3, {}});
  EXPECT_EQ(found.counts, (std::vector<std::size_t>{3, 3, 4}));
  EXPECT_EQ(found.left_out, 2U);
  EXPECT_EQ(found.rule, "3 bins as given");
}

TEST(Histogram, TwoLevelsHaveNoQuartileWidth) {
  std::vector<double> values(10, 1.0);
  values.push_back(2);
  const ValueHistogram found = value_histogram(values);
  EXPECT_TRUE(found.rule.starts_with("Sturges"));
  EXPECT_EQ(found.counts.front(), 10U);
  EXPECT_EQ(found.counts.back(), 1U);
}

TEST(Histogram, Refuses) {
  EXPECT_THROW(value_histogram(std::vector<double>{}), Error);
  EXPECT_THROW(value_histogram(std::vector<double>{std::nan("")}), Error);
  EXPECT_THROW(value_histogram(std::vector<double>{3, 3, 3}), Error);
  EXPECT_EQ(value_histogram(std::vector<double>{3, 3, 3}, {{}, {0, 5}}).counts.at(0), 3U);
  EXPECT_THROW(value_histogram(counting(5), {0, {}}), Error);
  EXPECT_THROW(value_histogram(counting(5), {20'000, {}}), Error);
  EXPECT_THROW(value_histogram(counting(5), {{}, {1}}), Error);
  EXPECT_THROW(value_histogram(counting(5), {{}, {1, 1}}), Error);
  EXPECT_THROW(value_histogram(counting(5), {{}, {1, std::nan("")}}), Error);
}

}  // namespace
}  // namespace asperity::histogram_test
