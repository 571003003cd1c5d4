// SPDX-License-Identifier: GPL-3.0-or-later
// Runs double until the fit is good, without repeats; the next input to measure narrows the answer most.
#include "engine/study/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "tests/study/one_by_one.hpp"

namespace asperity {
namespace {
namespace sensitivity_test {

ChaosRequest ishigami_request() {
  ChaosRequest request;
  for (const char* name : {"x1", "x2", "x3"})
    request.inputs.push_back({name, 0, std::numbers::pi / std::sqrt(3.0), InputShape::uniform});
  return request;
}
double ishigami_of(const std::vector<double>& x) {
  const double s1 = elementary::sin(x[0]), s2 = elementary::sin(x[1]);
  return s1 + 7 * s2 * s2 + 0.1 * x[2] * x[2] * x[2] * x[2] * s1;
}

TEST(Sensitivity, DoublesTheRunsUntilTheFitIsGoodAndAsksNoneTwice) {
  std::set<std::vector<double>> asked;
  std::vector<std::size_t> to_come;
  const Sensitivity found = sensitivity_of(
      ishigami_request(),
      [&](const std::vector<double>& x) {
        EXPECT_TRUE(asked.insert(x).second);
        return ishigami_of(x);
      },
      [&](std::size_t more) { to_come.push_back(more); });
  EXPECT_EQ(to_come.front(), 32u);
  EXPECT_GT(to_come.size(), 2u);
  EXPECT_LE(found.chaos.runs, 256u);
  EXPECT_EQ(asked.size(), found.chaos.runs);
  EXPECT_NEAR(found.chaos.shares[1].first, 0.442411, 0.05);
  EXPECT_NEAR(found.chaos.shares[2].total, 0.243684, 0.05);
  EXPECT_EQ(found.order, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_NE(found.text().find("measure next: x1"), std::string::npos) << found.text();
}

TEST(Sensitivity, SaysHowMuchHalvingAnInputNarrowsALinearAnswer) {
  ChaosRequest request;
  request.inputs = {{"a", 1, .3}, {"b", 2, .4}};
  const Sensitivity found = sensitivity_of(request, [](const std::vector<double>& x) { return x[0] + x[1]; });
  EXPECT_NEAR(found.deviation, .5, 1e-12);
  EXPECT_NEAR(found.deviation_when[1], std::sqrt(.09 + .04), 1e-12);
  EXPECT_EQ(found.order.front(), 1u);
}

TEST(Sensitivity, CountsWhatInputsDoTogetherAndTellsTies) {
  ChaosRequest request;
  request.inputs = {{"a", 0, 1}, {"b", 0, 1}, {"c", 0, 1}};
  for (const std::uint64_t seed : {1, 2, 3}) {
    request.seed = seed;
    const Sensitivity found =
        sensitivity_of(request, [](const std::vector<double>& x) { return x[0] * x[1] + .65 * x[2]; });
    EXPECT_EQ(found.order, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(found.tied, 2u);
    EXPECT_NEAR(found.deviation_when[0], std::sqrt(.25 + .4225), 1e-9);
    EXPECT_NE(found.text().find("as much by b"), std::string::npos) << found.text();
  }
}

TEST(Sensitivity, IsRefusedOfAJumpAndOfTooFewRuns) {
  ChaosRequest request = ishigami_request();
  EXPECT_THROW(
      sensitivity_of(request, [](const auto& x) { return elementary::sin(50 * x[0]) > 0 ? 1. : 0.; }), Error);
  request.runs = 32;
  EXPECT_THROW(sensitivity_of(request, ishigami_of), Error);
  EXPECT_THROW(sensitivity_of({}, ishigami_of), Error);
}

TEST(Sensitivity, OfAConstantSaysSo) {
  const Sensitivity found = sensitivity_of(ishigami_request(), [](const auto&) { return 3.0; });
  EXPECT_NE(found.text().find("does not depend"), std::string::npos);
}

}  // namespace sensitivity_test
}  // namespace
}  // namespace asperity
