// SPDX-License-Identifier: GPL-3.0-or-later
// Known shares: the Ishigami function; contact with junctions over five inputs (Gauss-Legendre rule of 16^5
// points).
#include "engine/statistics/polynomial_chaos.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity {
namespace {
namespace polynomial_chaos_test {

constexpr double pi = std::numbers::pi;
using Model = std::function<double(const std::vector<double>&)>;

UncertainInput between(const std::string& name, double low, double high) {
  return {name, (low + high) / 2, (high - low) / std::sqrt(12.0), InputShape::uniform};
}

std::vector<UncertainInput> ishigami_inputs() {
  return {between("x1", -pi, pi), between("x2", -pi, pi), between("x3", -pi, pi)};
}
double ishigami(const std::vector<double>& x) {
  const double s1 = elementary::sin(x[0]), s2 = elementary::sin(x[1]);
  return s1 + 7 * s2 * s2 + 0.1 * x[2] * x[2] * x[2] * x[2] * s1;
}

std::vector<UncertainInput> contact_inputs() {
  return {between("p", .01, .05), between("E", .8, 1.2), between("slope", .05, .2),
          between("tau0", .005, .02), between("alpha", .1, .3)};
}
double contact(const std::vector<double>& x) {
  const double area = elementary::erf(std::sqrt(pi) / 2 * std::sqrt(2 * pi) * x[0] / (x[1] * x[2]));
  return x[4] + x[3] * area / x[0];
}

PolynomialChaos chaos_of(const std::vector<UncertainInput>& inputs, const Model& model, std::size_t runs,
                         std::uint64_t seed = 1, int highest = 12) {
  const auto points = input_points(inputs, runs, seed);
  std::vector<double> answers;
  for (const auto& point : points) {
    std::vector<double> x;
    for (std::size_t j = 0; j < inputs.size(); ++j) x.push_back(inputs[j].at(point[j]));
    answers.push_back(model(x));
  }
  return polynomial_chaos(inputs, points, answers, highest);
}

void expect_shares(const PolynomialChaos& chaos, const std::vector<double>& first,
                   const std::vector<double>& total, double within) {
  for (std::size_t j = 0; j < first.size(); ++j) {
    EXPECT_NEAR(chaos.shares[j].first, first[j], within) << chaos.shares[j].name << " " << chaos.text();
    EXPECT_NEAR(chaos.shares[j].total, total[j], within) << chaos.shares[j].name << " " << chaos.text();
    EXPECT_LT(std::abs(chaos.shares[j].first - first[j]), 3.5 * chaos.shares[j].first_error + 1e-12);
    EXPECT_LT(std::abs(chaos.shares[j].total - total[j]), 3.5 * chaos.shares[j].total_error + 1e-12);
  }
}

const std::vector<double> contact_first = {0.038805, 0.023445, 0.276040, 0.394795, 0.182936};
const std::vector<double> contact_total = {0.086534, 0.030724, 0.349903, 0.440038, 0.182936};

TEST(PolynomialChaos, SharesOfFiveInputsAreWithinAFiveHundredthsFromSixtyFourRuns) {
  EXPECT_EQ(chaos_runs(5), 64u);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PolynomialChaos chaos = chaos_of(contact_inputs(), contact, chaos_runs(5), seed);
    EXPECT_NE(chaos.trust(), ChaosTrust::refused);
    expect_shares(chaos, contact_first, contact_total, 0.05);
  }
}

TEST(PolynomialChaos, IshigamiIsRaisedToDegreeSixOrMoreWithTwoHundredAndFiftySixRuns) {
  const PolynomialChaos chaos = chaos_of(ishigami_inputs(), ishigami, 256);
  EXPECT_GE(chaos.degree, 6);
  EXPECT_NE(chaos.trust(), ChaosTrust::refused) << chaos.text();
  expect_shares(chaos, {0.313905, 0.442411, 0}, {0.557589, 0.442411, 0.243684}, 0.05);
}

TEST(PolynomialChaos, IshigamiIsRefusedWithTooFewRuns) {
  const PolynomialChaos chaos = chaos_of(ishigami_inputs(), ishigami, 32);
  EXPECT_EQ(chaos.trust(), ChaosTrust::refused) << chaos.text();
  EXPECT_THROW(require_trust(chaos), Error);
}

TEST(PolynomialChaos, OfAPolynomialIsThePolynomial) {
  // y = 3 + 2 x + x z, x normal about 1 (u 0.5), z about 0 (u 2): Var = 4·.25 + (1 + .25)·4.
  const std::vector<UncertainInput> inputs = {{"x", 1, .5}, {"z", 0, 2}};
  const auto model = [](const std::vector<double>& x) { return 3 + 2 * x[0] + x[0] * x[1]; };
  const PolynomialChaos chaos = chaos_of(inputs, model, 24);
  EXPECT_NEAR(chaos.leave_one_out, 0, 1e-20);
  EXPECT_NEAR(chaos.mean, 5, 1e-12);
  EXPECT_NEAR(chaos.variance, 1 + 5, 1e-11);
  EXPECT_NEAR(chaos.shares[0].first, 1.0 / 6, 1e-12);
  EXPECT_NEAR(chaos.shares[0].total, 2.0 / 6, 1e-12);
  EXPECT_NEAR(chaos.shares[1].first, 4.0 / 6, 1e-12);
  EXPECT_NEAR(chaos.shares[1].total, 5.0 / 6, 1e-12);
  const std::vector<double> point = {.3, -1.2};
  EXPECT_NEAR(chaos.at(point), model({inputs[0].at(.3), inputs[1].at(-1.2)}), 1e-12);
}

TEST(PolynomialChaos, NoiseWithoutInputsIsRefused) {
  int call = 0;
  const auto noise = [&](const std::vector<double>&) { return elementary::sin(1e3 * ++call); };
  EXPECT_EQ(chaos_of(contact_inputs(), noise, 64).trust(), ChaosTrust::refused);
}

TEST(PolynomialChaos, SharesErrMoreWithNoiseAndSayIt) {
  int call = 0;
  const auto noisy = [&](const std::vector<double>& x) {
    return contact(x) + .02 * elementary::sin(1e3 * ++call);
  };
  const PolynomialChaos with = chaos_of(contact_inputs(), noisy, 64),
                        without = chaos_of(contact_inputs(), contact, 64);
  EXPECT_GT(with.leave_one_out, without.leave_one_out);
  EXPECT_GT(with.shares[3].first_error, without.shares[3].first_error);
}

TEST(PolynomialChaos, AnswersAllAlikeHaveNoShares) {
  const PolynomialChaos chaos = chaos_of(
      contact_inputs(), [](const auto&) { return 7.25; }, 64);
  EXPECT_DOUBLE_EQ(chaos.mean, 7.25);
  EXPECT_EQ(chaos.variance, 0);
  EXPECT_EQ(chaos.leave_one_out, 0);
  for (const VarianceShare& share : chaos.shares) EXPECT_EQ(share.total, 0);
}

TEST(PolynomialChaos, AnswersOfAnySizeHaveTheSameShares) {
  const PolynomialChaos one = chaos_of(contact_inputs(), contact, 64);
  for (const double size : {1e-150, 1e150}) {
    const PolynomialChaos other = chaos_of(
        contact_inputs(), [&](const auto& x) { return size * contact(x); }, 64);
    EXPECT_NEAR(other.shares[2].total, one.shares[2].total, 1e-9);
    EXPECT_NEAR(other.mean / size, one.mean, 1e-9);
  }
}

TEST(PolynomialChaos, IsTheSameToTheBitForTheSameSeed) {
  const PolynomialChaos a = chaos_of(contact_inputs(), contact, 64, 5),
                        b = chaos_of(contact_inputs(), contact, 64, 5);
  EXPECT_EQ(a.coefficients, b.coefficients);
  EXPECT_NE(a.coefficients, chaos_of(contact_inputs(), contact, 64, 6).coefficients);
}

TEST(PolynomialChaos, RefusesWhatItCannotFit) {
  const auto nothing = [](const auto&) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_THROW(chaos_of(contact_inputs(), nothing, 64), Error);
  EXPECT_THROW(chaos_of(contact_inputs(), contact, 8), Error);
  EXPECT_NO_THROW(chaos_of(contact_inputs(), contact, 9));
  EXPECT_THROW(chaos_of(contact_inputs(), contact, 64, 1, 13), Error);
  EXPECT_THROW(chaos_of(
                   {}, [](const auto&) { return 1.0; }, 64),
               Error);
  EXPECT_THROW(chaos_of(
                   {{"x", 1, 0}}, [](const auto& x) { return x[0]; }, 64),
               Error);
  EXPECT_THROW(chaos_of(
                   {{"x", 1, 1}, {"x", 1, 1}}, [](const auto& x) { return x[0]; }, 64),
               Error);
  const std::vector<UncertainInput> two = {{"x", 0, 1}, {"z", 0, 1}};
  const std::vector<std::vector<double>> along(9, {0, 1});
  EXPECT_THROW(polynomial_chaos(two, along, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}), Error);
  EXPECT_THROW(polynomial_chaos(two, along, std::vector<double>{1, 2}), Error);
}

TEST(InputPoints, TakeEachSliceOfEachInputOnce) {
  const auto inputs = contact_inputs();
  const auto points = input_points(inputs, 64, 3);
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    std::vector<int> met(64);
    for (const auto& point : points) ++met.at(static_cast<std::size_t>((point[j] + 1) / 2 * 64));
    EXPECT_EQ(met, std::vector<int>(64, 1));
  }
  EXPECT_NE(points, input_points(inputs, 64, 4));
}

TEST(InputPoints, FollowOnEachOther) {
  const auto inputs = contact_inputs();
  const auto all = input_points(inputs, 48, 3), later = input_points(inputs, 16, 3, 32);
  for (std::size_t i = 0; i < later.size(); ++i) EXPECT_EQ(later[i], all[32 + i]);
}

TEST(InputPoints, FillAllCoordinatesOfTwentyOne) {
  const std::vector<UncertainInput> inputs = [] {
    std::vector<UncertainInput> list;
    for (int j = 0; j < 21; ++j) list.push_back(between("x" + std::to_string(j), 0, 1));
    return list;
  }();
  const auto points = input_points(inputs, 1024, 1);
  for (std::size_t j = 0; j < inputs.size(); ++j)
    for (std::size_t k = 0; k <= j; ++k) {
      double product = 0;
      for (const auto& point : points) product += 3 * point[j] * point[k] / 1024;
      EXPECT_NEAR(product, j == k ? 1 : 0, .06) << j << " " << k;
    }
}

TEST(InputPoints, OfNormalInputsStayFinite) {
  const std::vector<UncertainInput> one = {{"x", 0, 1}};
  for (const auto& point : input_points(one, 1024, 9)) EXPECT_LT(std::abs(point[0]), 6.5);
}

}  // namespace polynomial_chaos_test
}  // namespace
}  // namespace asperity
