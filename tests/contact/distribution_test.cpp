// SPDX-License-Identifier: GPL-3.0-or-later
// Histograms: known counts, normalisation, bin edges.
#include "engine/contact/distribution.hpp"

#include <cmath>
#include <numeric>

#include "tests/contact/contacts.hpp"

namespace asperity::distribution_test {
namespace {

TEST(Histogram, LinearBinsRunFromZeroToTheGreatest) {
  const std::vector<double> values = {0.5, 1, 1.5, 2, 4};
  const Histogram h = make_histogram(values, {.bins = 4});
  EXPECT_EQ(h.edges, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(h.counts, (std::vector<std::int64_t>{1, 2, 1, 1}));
  EXPECT_EQ(h.values, 5);
  EXPECT_DOUBLE_EQ(h.mean, 1.8);
  EXPECT_DOUBLE_EQ(h.density[1], 0.4);
}

TEST(Histogram, DensityIntegratesToOne) {
  const Stream stream(1, "histogram");
  std::vector<double> values;
  for (std::uint64_t k = 0; k < 10000; ++k) values.push_back(std::exp(stream.normal(k)));
  for (const bool log : {false, true}) {
    const Histogram h = make_histogram(values, {.bins = 37, .log = log});
    double integral = 0;
    for (std::size_t k = 0; k < 37; ++k) integral += h.density[k] * (h.edges[k + 1] - h.edges[k]);
    EXPECT_NEAR(integral, 1, 1e-14);
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::int64_t{0}), 10000);
  }
}

TEST(Histogram, LogBinsHaveEqualRatio) {
  const Histogram h = make_histogram(std::vector<double>{1, 10, 99, 1000, 10000}, {.bins = 4, .log = true});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(h.edges[k + 1] / h.edges[k], 10, 1e-12);
  EXPECT_EQ(h.edges.front(), 1);
  EXPECT_EQ(h.edges.back(), 10000);
}

TEST(Histogram, OneValueHasABinOfSomeWidth) {
  for (const bool log : {false, true}) {
    const Histogram h = make_histogram(std::vector<double>{3, 3}, {.bins = 5, .log = log});
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::int64_t{0}), 2);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_TRUE(std::isfinite(h.density[k]) && h.edges[k] < h.edges[k + 1]);
  }
}

}  // namespace
}  // namespace asperity::distribution_test
