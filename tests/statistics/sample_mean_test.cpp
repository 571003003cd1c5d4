// SPDX-License-Identifier: GPL-3.0-or-later
// Means with intervals: known answers, coverage against a table (4000 samples each), groups, refusals.
#include "engine/statistics/sample_mean.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"

namespace asperity::sample_mean_test {
namespace {

TEST(SampleMean, OfFiveValues) {
  const std::vector<double> values = {1, 2, 3, 4, 10};
  const SampleMean of = sample_mean(values);
  EXPECT_EQ(of.count, 5U);
  EXPECT_DOUBLE_EQ(of.mean, 4);
  EXPECT_DOUBLE_EQ(*of.deviation, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(*of.skewness, 36 / std::pow(10.0, 1.5));  // m3 = 180/5, m2 = 50/5
  EXPECT_NEAR(*of.high, 4 + 2.7764451051977943578 * std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(*of.low, 4 - 2.7764451051977943578 * std::sqrt(2.5), 1e-12);
  EXPECT_EQ(of.method, "Student's t, 4 degrees of freedom");
  ASSERT_EQ(of.warnings.size(), 1U);
  EXPECT_NE(of.warnings[0].find("skewed"), std::string::npos);
}

TEST(SampleMean, LogIntervalOfCox) {
  // exp(m + s²/2 ± t sqrt(s²/n + s⁴/(2(n-1)))): m = 1, s² = 1, t(2) = 4.3026527297494637.
  const std::vector<double> values = {1, std::exp(1.0), std::exp(2.0)};
  const SampleMean of = sample_mean(values, MeanInterval::log_normal);
  const double reach = 4.3026527297494637 * std::sqrt(1.0 / 3 + 1.0 / 4);
  EXPECT_NEAR(*of.low / std::exp(1.5 - reach), 1, 1e-12);
  EXPECT_NEAR(*of.high / std::exp(1.5 + reach), 1, 1e-12);
  EXPECT_NE(of.method.find("assumes that the logarithms are normal"), std::string::npos);
}

TEST(SampleMean, KeepsItsDigitsFarFromZeroAndNearOverflow) {
  const SampleMean far = sample_mean(std::vector<double>{1e9 + 1, 1e9 + 2, 1e9 + 3});
  EXPECT_EQ(far.mean, 1e9 + 2);
  EXPECT_NEAR(*far.deviation, 1, 1e-6);
  EXPECT_EQ(*sample_mean(std::vector<double>{1e300, 3e300}).deviation, std::sqrt(2.0) * 1e300);
  const SampleMean equal = sample_mean(std::vector<double>(7, 0.1));
  EXPECT_NEAR(*equal.deviation, 0, 1e-16);
  EXPECT_FALSE(equal.skewness);
}

TEST(SampleMean, FewValuesAreSaid) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const SampleMean one = sample_mean(std::vector<double>{3, none, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(one.count, 1U);
  EXPECT_EQ(one.left_out, 2U);
  EXPECT_FALSE(one.low);
  EXPECT_FALSE(one.deviation);
  EXPECT_EQ(one.warnings.at(0), "the mean of 1 value has no interval");
  EXPECT_EQ(sample_mean(std::vector<double>{3, 4, 5, 6}).warnings.size(), 1U);
  EXPECT_TRUE(sample_mean(std::vector<double>{3, 4, 5, 6, 7}).warnings.empty());
  EXPECT_THROW(sample_mean(std::vector<double>{none}), Error);
  EXPECT_THROW(sample_mean(std::vector<double>{1, 2}, MeanInterval::student, 1), Error);
  EXPECT_THROW(sample_mean(std::vector<double>{0, 2}, MeanInterval::log_normal), Error);
}

// Coverage of the distribution's mean, 1.
template <class Draw>
double coverage(int sets, int n, MeanInterval interval, const char* stream, Draw draw) {
  const Stream random(1, stream);
  int held = 0;
  std::vector<double> values(static_cast<std::size_t>(n));
  for (int set = 0; set < sets; ++set) {
    for (int k = 0; k < n; ++k)
      values[static_cast<std::size_t>(k)] = draw(random, static_cast<std::uint64_t>(set * n + k));
    const SampleMean of = sample_mean(values, interval);
    held += *of.low <= 1 && 1 <= *of.high ? 1 : 0;
  }
  return static_cast<double>(held) / sets;
}

// Four standard errors (2000 samples: 0.5 % at 95 %, 0.8 % at 83 %) plus the table's.
TEST(SampleMean, IntervalsHoldTheirLevelAsTheyShould) {
  constexpr int sets = 2000;
  const auto normal = [](const Stream& random, std::uint64_t k) { return 1 + 0.3 * random.normal(k); };
  const auto from_normal = [](const Stream& random, std::uint64_t k) {
    return std::exp(random.normal(k) - 0.5);
  };
  const auto exponential = [](const Stream& random, std::uint64_t k) {
    return -std::log1p(-random.uniform(k));
  };
  constexpr MeanInterval student = MeanInterval::student;
  EXPECT_NEAR(coverage(sets, 5, student, "normal", normal), 0.955, 0.025);
  EXPECT_NEAR(coverage(sets, 5, student, "lognormal", from_normal), 0.824, 0.04);
  EXPECT_NEAR(coverage(sets, 5, MeanInterval::log_normal, "lognormal", from_normal), 0.938, 0.025);
  EXPECT_NEAR(coverage(sets, 8, student, "exponential", exponential), 0.900, 0.03);
  EXPECT_NEAR(coverage(sets, 8, MeanInterval::log_normal, "exponential", exponential), 0.984, 0.015);
}

Table trials() {
  Table table;
  const auto write = [&](double N, Cell mu) {
    table.append(std::vector<Entry>{{"N", N}, {"mu", std::move(mu)}});
  };
  for (const double mu : {0.4, 0.5, 0.6}) write(8, mu);
  for (const double mu : {0.1, 0.3}) write(1, mu);
  write(1, std::numeric_limits<double>::quiet_NaN());
  write(1, Cell());
  write(20, Cell());
  return table;
}

TEST(MeansOf, GroupsInAscendingOrder) {
  const auto groups = means_of(trials(), "mu", {"N"});
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].by, (std::vector<Cell>{1.0}));
  EXPECT_DOUBLE_EQ(groups[0].of.mean, 0.2);
  EXPECT_EQ(groups[0].of.left_out, 2U);
  EXPECT_DOUBLE_EQ(groups[1].of.mean, 0.5);
  EXPECT_EQ(groups[2].of.count, 0U);
  EXPECT_TRUE(std::isnan(groups[2].of.mean));
  const auto all = means_of(trials(), "mu", {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].of.count, 5U);
  EXPECT_EQ(all[0].of.left_out, 3U);
}

TEST(MeansOf, RefusesTextAndUnknownColumns) {
  Table table = trials();
  EXPECT_THROW(means_of(table, "mv", {}), Error);
  EXPECT_THROW(means_of(table, "mu", {"M"}), Error);
  table.append(std::vector<Entry>{{"N", 1.0}, {"mu", std::string("slipped")}});
  try {
    means_of(table, "mu", {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "column `mu` holds the text \"slipped\" in row 9, and numbers are wanted; leave such rows out "
        "with `where`, or write the numbers in a column of their own");
  }
}

}  // namespace
}  // namespace asperity::sample_mean_test
