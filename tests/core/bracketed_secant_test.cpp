// SPDX-License-Identifier: GPL-3.0-or-later
// The bracketed secant on smooth and difficult functions.
#include "engine/core/arithmetic/bracketed_secant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace asperity::bracketed_secant_test {
namespace {

int evaluations(const std::function<double(double)>& f, double wanted, double begin, BracketedSecant root) {
  double at = begin;
  for (int n = 1; n < 200; ++n) {
    const double value = f(at);
    if (std::abs(value - wanted) <= 1e-10 * wanted) return n;
    root.take({at, value}, true);
    const auto next = root.next();
    if (!next) return n;
    at = *next;
  }
  return 200;
}
int evaluations(const std::function<double(double)>& f, double wanted, double begin) {
  return evaluations(f, wanted, begin, BracketedSecant(wanted));
}

TEST(BracketedSecant, FindsRootsOfMonotoneFunctions) {
  EXPECT_LE(evaluations([](double x) { return x; }, 3, 1), 3);
  EXPECT_LE(evaluations([](double x) { return x * std::sqrt(x); }, 3, 1e-3), 12);
  EXPECT_LE(evaluations([](double x) { return 1 - std::exp(-x); }, .999, 1e-2), 20);
  // Terraces with steep edges.
  EXPECT_LE(evaluations([](double x) { return std::floor(x) + std::pow(x - std::floor(x), 20); }, 5.5, 1),
            60);
  // No double is near enough: every second step halves, down to the last of 52 digits.
  EXPECT_LE(evaluations([](double x) { return x < 2 ? 1e-9 * x : 2e-9 + 1e9 * (x - 2); }, 1, 1), 110);
}

TEST(BracketedSecant, TakesPowersAndFullContactByTheirLogarithms) {
  using Scale = BracketedSecant::Scale;
  const auto by_logarithms = [](const std::function<double(double)>& f, double wanted, double begin,
                                BracketedSecant::Point end) {
    return evaluations(f, wanted, begin, BracketedSecant(wanted, {0, 0}, end, Scale::logarithmic));
  };
  const BracketedSecant::Point nothing_known{BracketedSecant::unknown, BracketedSecant::unknown};
  const auto power = [](double x) { return std::pow(x, .2); };
  EXPECT_LE(by_logarithms(power, 1, 1e-3, nothing_known), 6);
  EXPECT_GT(evaluations(power, 1, 1e-3), 8);
  EXPECT_LE(by_logarithms([](double x) { return std::log1p(1e6 * x); }, 10, 1e-5, nothing_known), 10);
  // Near full contact the slope vanishes: a secant creeps.
  const auto near_full = [](double x) { return x < 1 ? 1 - std::pow(1 - x, 2.5) : 1; };
  EXPECT_LE(by_logarithms(near_full, 1 - 1e-6, .4, {1, 1}), 6);
  EXPECT_GT(evaluations(near_full, 1 - 1e-6, .4, BracketedSecant(1 - 1e-6, {0, 0}, {1, 1})), 12);
  // Peaks sink fully before the ground is reached: distant loads, almost equal values.
  const auto flat = [](double x) { return 1 + 1e-5 * std::log(x); };
  EXPECT_LE(by_logarithms(flat, flat(2), 1, nothing_known), 5);
  const auto sunk = [](double x) { return x < 1 ? 1 - .07 * std::pow(1 - x, 7) : 1; };
  EXPECT_LE(by_logarithms(sunk, sunk(.5), .015, {1, 1}), 5);
  // A power under light loads, then a line.
  const auto punch = [](double x) { return 1 + .1 * x / (1 + x) + .01 * x; };
  EXPECT_LE(by_logarithms(punch, punch(1000), 50, nothing_known), 5);
  // Beyond full contact the quantity is constant.
  const auto saturated = [](double x) { return x < 1e-3 ? x : BracketedSecant::unknown; };
  EXPECT_LE(by_logarithms(saturated, 9e-4, 1, nothing_known), 60);
}

TEST(BracketedSecant, ADoubtfulValueLeavesTheBracket) {
  BracketedSecant root(1);
  root.take({1, .5}, true);
  root.take({4, 2}, true);
  root.take({2, 3}, false);
  for (int k = 0; k < 20; ++k) {
    const auto next = root.next();
    ASSERT_TRUE(next);
    EXPECT_GT(*next, 1);
    EXPECT_LT(*next, 4);
    root.take({*next, 3}, false);
  }
}

}  // namespace
}  // namespace asperity::bracketed_secant_test
