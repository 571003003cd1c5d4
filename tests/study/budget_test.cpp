// SPDX-License-Identifier: GPL-3.0-or-later
// Budgets of models with known truth: coverage and width, shares, refusals.
#include "engine/study/budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/sanitizers.hpp"
#include "tests/study/one_by_one.hpp"

namespace asperity {
namespace {
namespace budget_test {

// Scatter over seeds, a scattering discretisation error of order 1 to 2, uncertain inputs, slight curvature.
struct Experiment {
  double scatter, of_cells, order, cells_scatter;
  std::vector<double> slopes, curvatures, truth;
  Stream stream;

  double smooth(const std::vector<double>& x) const {
    double y = 10;
    for (std::size_t j = 0; j < x.size(); ++j) y += slopes[j] * x[j] + curvatures[j] * x[j] * x[j];
    return y;
  }
  double answer(const std::vector<double>& x, std::size_t seed, double cells) const {
    const double error = of_cells * elementary::pow(32 / cells, order);
    return smooth(x) + scatter * stream.normal(1000 + 2 * seed) +
           error * (1 + cells_scatter * stream.normal(1001 + 2 * seed));
  }
};

struct Trial {
  Experiment experiment;
  BudgetRequest request;
};

Trial make_trial(std::uint64_t number) {
  const Stream s(number, "blind experiment");
  Trial trial{{s.uniform(0, .1, 1), s.uniform(1, -1.5, 1.5), s.uniform(2, 1, 2), .1, {}, {}, {}, s}, {}};
  Experiment& e = trial.experiment;
  BudgetRequest& r = trial.request;
  r.replicates = 5 + static_cast<std::size_t>(s.below(3, 16));
  if (s.uniform(4) < .7) r.cells = {32, 64};
  const auto inputs = static_cast<std::size_t>(s.below(5, 4));
  for (std::size_t j = 0; j < inputs; ++j) {
    e.slopes.push_back(s.uniform(10 + 10 * j, -3, 3));
    e.curvatures.push_back(s.uniform(11 + 10 * j, -.2, .2));
    e.truth.push_back(s.uniform(12 + 10 * j, -1, 1));
    UncertainInput input{"input " + std::to_string(j), 0, s.uniform(13 + 10 * j, .02, .3),
                         InputShape::normal};
    double off = s.normal(500 + j);
    if (s.uniform(14 + 10 * j) < .3) {
      input.shape = InputShape::uniform;
      off = std::sqrt(3.0) * s.uniform(15 + 10 * j, -1, 1);
    }
    input.value = e.truth[j] + input.uncertainty * off;
    r.inputs.push_back(input);
  }
  if (r.cells.empty()) e.of_cells = 0;
  r.draws = 1000;
  return trial;
}

BudgetAsk ask_of(const Trial& trial) {
  return [&trial](const BudgetSetting& run) {
    const auto& cells = trial.request.cells;
    return BudgetAnswer{
        trial.experiment.answer(run.inputs, run.replicate, cells.empty() ? 32 : cells[run.cells]), .01};
  };
}

// Half width from known error laws.
double known_half_width(const Trial& trial) {
  const Experiment& e = trial.experiment;
  const double n = static_cast<double>(trial.request.replicates);
  double variance = e.scatter * e.scatter / n;
  if (!trial.request.cells.empty()) {
    // Mean and square of 1/(2^p - 1), p from 1 to 2.
    double mean = 0, square = 0;
    for (int k = 0; k < 1000; ++k) {
      const double f = 1 / (elementary::exp2(1 + (k + .5) / 1000) - 1);
      mean += f / 1000;
      square += f * f / 1000;
    }
    const double fine = e.of_cells * elementary::pow(.5, e.order);
    const double change = fine - e.of_cells;
    variance += change * change * (square - mean * mean);
    const double of_seed = (fine + mean * change) * e.cells_scatter;
    variance += of_seed * of_seed / n;
  }
  for (std::size_t j = 0; j < trial.request.inputs.size(); ++j) {
    const double u = trial.request.inputs[j].uncertainty;
    const double slope = e.slopes[j] + 2 * e.curvatures[j] * trial.request.inputs[j].value;
    variance += slope * slope * u * u + 2 * e.curvatures[j] * e.curvatures[j] * u * u * u * u;
  }
  return 1.96 * std::sqrt(variance);
}

TEST(Budget, IntervalHoldsTheTruthOfBlindExperimentsAsOftenAsItSays) {
  const int count = sanitized ? 60 : 1000;
  int held = 0;
  double wider = 0;
  for (int k = 0; k < count; ++k) {
    const Trial trial = make_trial(static_cast<std::uint64_t>(k));
    const Budget budget = budget_of(trial.request, ask_of(trial));
    const double truth = trial.experiment.smooth(trial.experiment.truth);
    held += budget.low <= truth && truth <= budget.high ? 1 : 0;
    wider += budget.half_width() / known_half_width(trial) / count;
  }
  RecordProperty("held", held);
  RecordProperty("wider", std::to_string(wider));
  EXPECT_GE(held, sanitized ? 50 : 930);
  EXPECT_LE(held, sanitized ? 60 : 970);
  EXPECT_LE(wider, 1.3);
  EXPECT_GE(wider, 0.9);
}

// --- shares

BudgetRequest three_parts() {
  BudgetRequest r;
  r.replicates = 6;
  r.cells = {64, 128};
  r.tolerances = {1e-3, 1e-4};
  r.inputs = {{"hardness", 1.1e9, 1e8}, {"mass", .2, .01, InputShape::uniform}};
  return r;
}

// Scatter ±.3; .9 on the coarse grid, .3 on the fine one; .09 and .009 by tolerance.
double known_answer(const BudgetRequest& r, const BudgetSetting& run) {
  const double of_cells = run.cells == 0 ? .9 : .3;
  const double of_solver = 90 * r.tolerances[run.tolerance];
  return 5 + (run.replicate % 2 == 0 ? .3 : -.3) + of_cells + of_solver + 2e-9 * (run.inputs[0] - 1.1e9) +
         20 * (run.inputs[1] - .2);
}

Budget known_budget(const BudgetRequest& r) {
  return budget_of(r, [&r](const BudgetSetting& run) {
    return BudgetAnswer{known_answer(r, run), run.cells == 0 ? .25 : 1.0};
  });
}

double u_of(const Budget& budget, const std::string& name) {
  for (const BudgetPart& part : budget.parts)
    if (part.name == name) return part.uncertainty;
  ADD_FAILURE() << "no part " << name;
  return 0;
}

TEST(Budget, SharesAreThosePutIn) {
  const Budget b = known_budget(three_parts());
  // -.6 times 1/(2^p - 1), whose deviation over p from 1 to 2 is .18616.
  EXPECT_NEAR(u_of(b, "sampling"), .3 * std::sqrt(6.0 / 5) / std::sqrt(6), 1e-12);
  EXPECT_NEAR(u_of(b, "cells"), .6 * .18616, 1e-5);
  EXPECT_NEAR(u_of(b, "solver"), .081 / 9 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(u_of(b, "hardness"), .2, 1e-9);
  EXPECT_NEAR(u_of(b, "mass"), .2, 1e-9);
  EXPECT_NEAR(u_of(b, "inputs together"), 0, 1e-6);
  EXPECT_NEAR(b.value, 5 - .6 * .5850 + .3 + .009, .01);
  double sum = 0;
  for (const BudgetPart& part : b.parts) sum += part.share;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GE(b.parts.front().share, b.parts.back().share);
  EXPECT_EQ(b.runs, budget_runs(three_parts()));
  EXPECT_EQ(b.runs, 6u * 2 + 1 + 32);
  EXPECT_NEAR(b.seconds, 6 * 1.25 + 33 * .25, 1e-12);
  EXPECT_NE(b.text().find("hardness"), std::string::npos);
}

TEST(Budget, HalvingAPartCostsWhatItsRunsTake) {
  const Budget b = known_budget(three_parts());
  for (const BudgetPart& part : b.parts) {
    EXPECT_LE(part.half_width_after, b.half_width());
    if (part.name == "sampling") {
      EXPECT_EQ(part.halving, "18 more replicates");
      EXPECT_NEAR(*part.halving_seconds, 18 * 1.25, 1e-12);
    } else if (part.name == "cells") {
      // Order 1.5: 2^(2/3) as many cells a side; time ~ cells².
      EXPECT_EQ(part.halving, "cells = 204");
      EXPECT_NEAR(*part.halving_seconds, 6 * (204.0 / 128) * (204.0 / 128), 1e-9);
    } else if (part.name == "hardness") {
      EXPECT_FALSE(part.halving_seconds);
    }
  }
}

TEST(Budget, CheapestWayReachesTheAskedIntervalAndNoCheaperOneDoes) {
  BudgetRequest r = three_parts();
  r.inputs.clear();
  r.tolerances.clear();
  const auto ask = [](const BudgetSetting& run) {
    return BudgetAnswer{5 + .5 * (run.replicate % 2 == 0 ? 1 : -1) + (run.cells == 0 ? .02 : .01),
                        run.cells == 0 ? .25 : 1.0};
  };
  r.half_width = .2;
  const Budget b = budget_of(r, ask);
  ASSERT_TRUE(b.plan);
  EXPECT_LE(b.plan->half_width, .2);
  // Scatter dominates: more seeds on coarser cells.
  EXPECT_LT(b.plan->cells, 128);
  EXPECT_GT(b.plan->replicates, 20u);
  EXPECT_LT(b.plan->replicates, 40u);
  EXPECT_NE(b.text().find("instead of 6 replicates on 128²"), std::string::npos) << b.text();
  r = three_parts();
  r.half_width = .1;
  const Budget none = known_budget(r);
  EXPECT_FALSE(none.plan);
  EXPECT_NE(none.text().find("cannot be reached"), std::string::npos);
}

TEST(Budget, OfReplicatesAloneIsStudentsInterval) {
  BudgetRequest r;
  r.replicates = 4;
  const std::vector<double> values = {1, 2, 4, 9};
  const auto ask = [&](const BudgetSetting& run) { return BudgetAnswer{values[run.replicate], 0}; };
  const Budget b = budget_of(r, ask);
  const SampleMean mean = sample_mean(values);
  EXPECT_DOUBLE_EQ(b.value, 4);
  EXPECT_DOUBLE_EQ(b.low, *mean.low);
  EXPECT_DOUBLE_EQ(b.high, *mean.high);
  EXPECT_FALSE(b.warnings.empty());  // only four
  r.interval = MeanInterval::log_normal;
  const Budget log = budget_of(r, ask);
  EXPECT_GT(log.low, 0);
  EXPECT_NE(log.text().find("Cox"), std::string::npos);
}

TEST(Budget, LogIntervalHoldsMoreSkewedMeansThanStudents) {
  const int count = sanitized ? 40 : 400;
  int student = 0, logs = 0, warned = 0;
  for (int k = 0; k < count; ++k) {
    const Stream s(static_cast<std::uint64_t>(k), "skewed");
    BudgetRequest r;
    r.replicates = 8;
    r.draws = 1000;
    r.cells = {32, 64};
    const auto ask = [&](const BudgetSetting& run) {
      return BudgetAnswer{elementary::exp(s.normal(run.replicate) - .5) * (run.cells == 0 ? 1.002 : 1.001),
                          0};
    };
    const Budget one = budget_of(r, ask);
    r.interval = MeanInterval::log_normal;
    const Budget other = budget_of(r, ask);
    student += one.low <= 1 && 1 <= one.high ? 1 : 0;
    logs += other.low <= 1 && 1 <= other.high ? 1 : 0;
    warned += one.warnings.empty() ? 0 : 1;
  }
  EXPECT_GT(logs, student);
  EXPECT_GE(logs, count * 91 / 100);
  EXPECT_GT(warned, count / 2);
}

TEST(Budget, ObservesTheOrderOfThreeGridsAndWarnsOfAnother) {
  BudgetRequest r;
  r.cells = {32, 64, 128};
  double order = 1.5;
  const auto ask = [&](const BudgetSetting& run) {
    return BudgetAnswer{7 + elementary::pow(.5, order * static_cast<double>(run.cells)), 1};
  };
  const Budget b = budget_of(r, ask);
  ASSERT_TRUE(b.order_observed);
  EXPECT_NEAR(*b.order_observed, 1.5, 1e-9);
  EXPECT_TRUE(b.warnings.empty());
  EXPECT_LT(b.low, 7);
  EXPECT_GT(b.high, 7);
  order = 4;
  EXPECT_FALSE(budget_of(r, ask).warnings.empty());
  r.order_low = r.order_high = 4;
  const Budget exact = budget_of(r, ask);
  EXPECT_NEAR(exact.value, 7, 1e-12);
  EXPECT_NEAR(exact.half_width(), 0, 1e-12);
}

TEST(Budget, WithoutAPolynomialTheInputsAreOneRow) {
  BudgetRequest r;
  r.inputs = {{"a", 0, 1, InputShape::uniform}, {"b", 0, 1, InputShape::uniform}};
  const auto jumps = [](const BudgetSetting& run) {
    return BudgetAnswer{elementary::sin(40 * run.inputs[0]) > 0 ? 1.0 : -1.0, 0};
  };
  const Budget b = budget_of(r, jumps);
  ASSERT_EQ(b.parts.size(), 1u);
  EXPECT_EQ(b.parts[0].name, "inputs");
  EXPECT_NEAR(b.uncertainty, 1, .1);
  EXPECT_FALSE(b.warnings.empty());
}

// The tip removes 4 % per radius unit; noise 0.3.
TEST(Budget, TipAndNoiseOfAnInstrumentAreParts) {
  BudgetRequest r;
  r.replicates = 6;
  r.tips = {2, 1};
  r.noises = 40;
  const Stream s(3, "instrument");
  const auto ask = [&](const BudgetSetting& run) {
    double value = 10 + 0.2 * s.normal(run.replicate) - 0.4 * r.tips[run.tip];
    if (run.noise) value += 0.3 * s.normal(100 + *run.noise);
    return BudgetAnswer{value, 1};
  };
  const Budget b = budget_of(r, ask);
  EXPECT_EQ(b.runs, 6u + 1 + 40);
  const auto part = [&](const std::string& name) {
    return *std::ranges::find(b.parts, name, &BudgetPart::name);
  };
  // 1/(2^p - 1): mean 0.58, scatter 0.19.
  EXPECT_NEAR(part("tip").uncertainty, 0.4 * 0.19, 0.01);
  EXPECT_NEAR(part("noise").uncertainty, 0.3, 0.1);
  EXPECT_NEAR(b.value, 10 - 0.4 + 0.58 * 0.4, 0.3);
  EXPECT_LT(b.low, 10);
  EXPECT_GT(b.high, 10);
  EXPECT_FALSE(part("tip").halving_seconds || part("noise").halving_seconds);
  EXPECT_EQ(part("noise").halving, "the mean of four measurements");
  EXPECT_NE(part("tip").halving.find("a tip of"), std::string::npos);
  r.noises = 1;
  EXPECT_THROW(budget_of(r, ask), Error);
  r.noises = 0;
  r.tips = {1, 2};
  EXPECT_THROW(budget_of(r, ask), Error);
}

TEST(Budget, RoughFitIsSaidOnce) {
  BudgetRequest r;
  r.inputs = {{"a", 0, 1, InputShape::uniform}};
  r.runs = 12;
  Budget b;
  for (double wave = 0.1; wave < 0.5 && (!b.chaos || b.chaos->trust() == ChaosTrust::good); wave += 0.02)
    b = budget_of(r, [&](const BudgetSetting& run) {
      return BudgetAnswer{std::abs(run.inputs[0] - 0.2) + wave * elementary::sin(9 * run.inputs[0]), 0};
    });
  ASSERT_EQ(b.chaos->trust(), ChaosTrust::rough) << b.chaos->leave_one_out;
  const std::string text = b.text(), sentence = b.chaos->text();
  const std::size_t first = text.find(sentence);
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find(sentence, first + 1), std::string::npos) << text;
}

// The first batch measures the time.
TEST(Budget, RunsComeInBatches) {
  BudgetRequest r;
  r.replicates = 5;
  r.cells = {32, 64};
  r.inputs = {{"a", 0, 0.1, InputShape::uniform}, {"b", 0, 0.1, InputShape::uniform}};
  std::vector<std::size_t> batches, numbers;
  const BudgetBatch batch = [&](std::span<const BudgetSetting> runs) {
    batches.push_back(runs.size());
    std::vector<BudgetAnswer> answers;
    for (const BudgetSetting& run : runs) {
      numbers.push_back(run.number);
      answers.push_back(
          {1 + run.inputs[0] + 2 * run.inputs[1] + 0.01 * static_cast<double>(run.replicate), 1});
    }
    return answers;
  };
  const Budget b = budget_of_batches(r, batch);
  EXPECT_EQ(batches, (std::vector<std::size_t>{2, 8, 32}));
  std::vector<std::size_t> ascending(42);
  std::iota(ascending.begin(), ascending.end(), std::size_t{1});
  EXPECT_EQ(numbers, ascending);
  r.at_most = 30;
  EXPECT_THROW(budget_of_batches(r, batch), Error);
  r.at_a_time = 2;
  EXPECT_NO_THROW(budget_of_batches(r, batch));
  EXPECT_EQ(b.runs, 42u);
}

// --- one specimen

// As on rough faces: random errors proportional to the cell width, plus a drift.
TEST(Budget, OfOneSpecimenHoldsErrorsOfCellsThatAreChance) {
  const int count = sanitized ? 60 : 500;
  for (const double drift : {0.0, 1.0}) {
    int held = 0;
    for (int k = 0; k < count; ++k) {
      const Stream s(static_cast<std::uint64_t>(k), "one specimen");
      BudgetRequest r;
      r.cells = {32, 64};
      r.draws = 2000;
      const auto ask = [&](const BudgetSetting& run) {
        const double width = 32 / budget_grids(r)[run.cells];
        return BudgetAnswer{width * (s.normal(run.cells) + drift), 0};
      };
      const Budget b = budget_of(r, ask);
      EXPECT_EQ(b.runs, 4u);
      held += b.low <= 0 && 0 <= b.high ? 1 : 0;
    }
    EXPECT_GE(held, count * 91 / 100) << "drift " << drift;
  }
}

TEST(Budget, OfOneSpecimenTakesOffADriftThatAllGridsShow) {
  BudgetRequest r;
  r.cells = {32, 64};
  for (const double order : {1.1, 1.3, 1.7, 1.9}) {
    const Budget b = budget_of(r, [&](const BudgetSetting& run) {
      return BudgetAnswer{5 + elementary::pow(16 / budget_grids(r)[run.cells], order), 0};
    });
    const double error = elementary::pow(.25, order);
    EXPECT_LT(b.low, 5) << order;
    EXPECT_GT(b.high, 5) << order;
    EXPECT_LT(b.half_width(), error) << order;
    EXPECT_LT(std::abs(b.value - 5), error) << order;
  }
}

TEST(Budget, OfOneSpecimenIsWideWhereNoGridBetweenIsTaken) {
  BudgetRequest r;
  r.cells = {32, 64};
  const Budget b = budget_of(r, [](const BudgetSetting& run) {
    if (run.cells > 1) throw Error(ErrorCode::bad_value, "these cells are not in the list");
    return BudgetAnswer{run.cells == 0 ? 1.0 : 1.1, 0};
  });
  EXPECT_NEAR(b.half_width(), 12.7 * .1 / std::sqrt(5.0), .05);
  EXPECT_NE(b.text().find("may be small by chance"), std::string::npos);
  EXPECT_EQ(budget_grids(r), (std::vector<double>{32, 64, 40, 48}));
  r.cells = {16, 32, 64};
  EXPECT_EQ(budget_grids(r), r.cells);
  r.cells = {16, 18};
  EXPECT_EQ(budget_grids(r), r.cells);
}

// --- kinds of inputs

using InputTrial = std::function<std::vector<UncertainInput>(const Stream&)>;

// Counts the intervals that contain 0, the sum of the inputs.
int held_of(const InputTrial& trial, const std::vector<InputCorrelation>& correlations = {}) {
  int held = 0;
  for (std::uint64_t k = 0; k < 400; ++k) {
    BudgetRequest r;
    r.inputs = trial(Stream(k, "kinds"));
    r.correlations = correlations;
    r.draws = 2000;
    const Budget b = budget_of(r, [](const BudgetSetting& run) {
      return BudgetAnswer{std::accumulate(run.inputs.begin(), run.inputs.end(), 0.0), 0};
    });
    held += b.low <= 0 && 0 <= b.high ? 1 : 0;
  }
  return held;
}

TEST(Budget, HoldsTheMeanOfThreeReadingsByTheirDegreesOfFreedom) {
  const auto readings = [](double degrees) {
    return [degrees](const Stream& s) {
      std::vector<double> values = {s.normal(0), s.normal(1), s.normal(2)};
      const SampleMean mean = sample_mean(values);
      return std::vector<UncertainInput>{{"a", mean.mean, *mean.standard_error, InputShape::normal, degrees}};
    };
  };
  EXPECT_LE(held_of(readings(std::numeric_limits<double>::infinity())), 340);
  const int held = held_of(readings(2));
  EXPECT_GE(held, 368);
  EXPECT_LE(held, 392);
}

TEST(Budget, HoldsTheSumOfCorrelatedInputs) {
  for (const double r : {.8, -.8}) {
    const InputTrial trial = [r](const Stream& s) {
      const double a = s.normal(0), b = r * a + std::sqrt(1 - r * r) * s.normal(1);
      return std::vector<UncertainInput>{{"a", a, 1}, {"b", b, 1}};
    };
    const int held = held_of(trial, {{"a", "b", r}});
    EXPECT_GE(held, 368) << r;
    EXPECT_LE(held, 392) << r;
  }
  BudgetRequest request;
  request.inputs = {{"a", 0, 1}, {"b", 0, 1}};
  request.correlations = {{"b", "a", -.8}};
  const Budget b = budget_of(request, [](const BudgetSetting& run) {
    return BudgetAnswer{run.inputs[0] + run.inputs[1], 0};
  });
  EXPECT_NEAR(b.uncertainty, std::sqrt(.4), 1e-9);
  EXPECT_NEAR(b.half_width(), 1.96 * std::sqrt(.4), .03);
  double sum = 0;
  for (const BudgetPart& part : b.parts) sum += part.share;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(b.parts.back().share, -1.6 / .4, 1e-9);
  // With half of u(a) the variance is 1/4 + 1 - 0.8.
  EXPECT_NEAR(b.parts.front().half_width_after / b.half_width(), std::sqrt(.45 / .4), 1e-9);
  const auto refused = [&](std::vector<InputCorrelation> list) {
    request.correlations = std::move(list);
    EXPECT_THROW(budget_of(request, [](const BudgetSetting&) { return BudgetAnswer{}; }), Error);
  };
  refused({{"a", "c", .5}});
  refused({{"a", "a", .5}});
  refused({{"a", "b", 1}});
  refused({{"a", "b", .5}, {"b", "a", .5}});
  request.inputs = {{"a", 0, 1}, {"b", 0, 1}, {"c", 0, 1}};
  refused({{"a", "b", .9}, {"b", "c", .9}, {"a", "c", -.9}});
  request.inputs[0].degrees = 3;
  refused({{"a", "b", .5}});
}

TEST(Budget, ShapesHaveTheirQuantiles) {
  const auto ends = [](UncertainInput input) {
    BudgetRequest r;
    r.inputs = {std::move(input)};
    const Budget b = budget_of(r, [](const BudgetSetting& run) { return BudgetAnswer{run.inputs[0], 0}; });
    EXPECT_NEAR(b.value, r.inputs[0].value, 1e-9);
    EXPECT_NEAR(b.uncertainty, r.inputs[0].uncertainty, 1e-9);
    return std::pair(b.low, b.high);
  };
  const auto [low, high] = ends({"a", 10, 4, InputShape::lognormal});
  const double s = std::sqrt(elementary::log(1.16));
  EXPECT_NEAR(low, 10 * elementary::exp(-s * s / 2 - 1.96 * s), .15);
  EXPECT_NEAR(high, 10 * elementary::exp(-s * s / 2 + 1.96 * s), .4);
  const auto [left, right] = ends({"a", 0, 1, InputShape::triangular});
  EXPECT_NEAR(right, std::sqrt(6.0) * (1 - std::sqrt(.05)), .03);
  EXPECT_NEAR(left, -right, .05);
  UncertainInput own{"a", 0, 0, InputShape::sample};
  for (int k = 0; k < 100; ++k) own.sample.push_back(k * k);
  const SampleMean mean = sample_mean(own.sample);
  own.value = mean.mean;
  own.uncertainty = *mean.deviation;
  const auto [least, most] = ends(own);
  EXPECT_NEAR(least, 4, 3);
  EXPECT_NEAR(most, 97 * 97, 120);
}

TEST(Budget, AStepIsDrawnFromItsAnswers) {
  BudgetRequest r;
  r.inputs = {{"a", 0, 1}};
  const Budget b = budget_of(r, [](const BudgetSetting& run) {
    return BudgetAnswer{run.inputs[0] > .5 ? 1.0 : 0.0, 0};
  });
  EXPECT_NEAR(b.value, .31, .03);
  EXPECT_EQ(b.low, 0);
  EXPECT_EQ(b.high, 1);
  int call = 0;
  const Budget noise = budget_of(r, [&](const BudgetSetting&) {
    return BudgetAnswer{elementary::sin(1e3 * ++call), 0};
  });
  EXPECT_EQ(noise.runs, 1 + 4 * chaos_runs(1));  // stopped before the last doubling
}

TEST(Budget, ASheetListsInputsWithTheirSensitivities) {
  BudgetRequest r;
  r.inputs = {{"hardness", 1.1e9, 1e8}, {"mass", .2, .01, InputShape::uniform}};
  r.inputs[0].dimension = dimension::pressure;
  r.inputs[0].degrees = 4;
  const Budget b = budget_of(r, [](const BudgetSetting& run) {
    return BudgetAnswer{2e-9 * run.inputs[0] * (1 + run.inputs[1]), 0};
  });
  const BudgetPart& first = b.parts.front();
  EXPECT_EQ(first.name, "hardness");
  EXPECT_NEAR(first.sensitivity, 2.4e-9, 1e-18);
  EXPECT_GT(b.degrees(), 4);
  EXPECT_LT(b.degrees(), 4.1);
  for (const char* said : {"1.1 GPa", "100 MPa", "2.4e-09", "uniform", "coverage factor 2."})
    EXPECT_NE(b.text().find(said), std::string::npos) << said << "\n" << b.text();
}

TEST(Budget, HalvingCountsWhatInputsDoTogether) {
  BudgetRequest r;
  r.inputs = {{"a", 0, 1}, {"b", 0, 1}, {"c", 0, 1}};
  const Budget b = budget_of(r, [](const BudgetSetting& run) {
    return BudgetAnswer{run.inputs[0] * run.inputs[1] + .65 * run.inputs[2], 0};
  });
  const auto part = [&](const std::string& name) {
    return *std::ranges::find(b.parts, name, &BudgetPart::name);
  };
  EXPECT_LT(part("a").half_width_after, part("c").half_width_after);
  EXPECT_NEAR(part("a").half_width_after / b.half_width(), std::sqrt(.6725 / 1.4225), 1e-6);
}

TEST(Budget, AnExactLineOfManyInputsTakesFewRuns) {
  BudgetRequest r;
  for (int j = 0; j < 15; ++j) r.inputs.push_back({"x" + std::to_string(j), 1, .1});
  const auto line = [](const BudgetSetting& run) {
    return BudgetAnswer{std::accumulate(run.inputs.begin(), run.inputs.end(), 0.0), 0};
  };
  EXPECT_EQ(budget_of(r, line).runs, 33u);
  const Budget curved = budget_of(r, [](const BudgetSetting& run) {
    return BudgetAnswer{run.inputs[0] * run.inputs[1] * run.inputs[2] + run.inputs[3], 0};
  });
  EXPECT_GE(curved.runs, 1 + chaos_runs(15));
}

TEST(Budget, NoHighDegreeOfFewRuns) {
  BudgetRequest r;
  r.inputs = {{"a", 1, .4}};
  const Budget b = budget_of(r, [](const BudgetSetting& run) {
    return BudgetAnswer{1 / std::abs(run.inputs[0]), 0};
  });
  // The quantiles of 1/|a| are 0.56 and 4.0.
  EXPECT_GT(b.low, 0);
  EXPECT_LT(b.high, 12);
}

// --- replicates

TEST(Budget, SpecimensDecideTheDegreesOfFreedomAndNotTheirRepeats) {
  int held = 0, pooled = 0;
  for (std::uint64_t k = 0; k < 400; ++k) {
    const Stream s(k, "nested");
    BudgetRequest r;
    r.replicates = 16;
    const auto ask = [&](const BudgetSetting& run) {
      return BudgetAnswer{s.normal(run.replicate / 4) + s.normal(100 + run.replicate), 1};
    };
    const Budget all = budget_of(r, ask);
    for (std::size_t n = 0; n < 16; ++n) r.specimens.push_back(n / 4);
    const Budget b = budget_of(r, ask);
    EXPECT_EQ(b.replicates, 4u);
    EXPECT_EQ(b.repeats, 4);
    EXPECT_EQ(b.parts.front().degrees, 3);
    held += b.low <= 0 && 0 <= b.high ? 1 : 0;
    pooled += all.low <= 0 && 0 <= all.high ? 1 : 0;
  }
  EXPECT_GE(held, 366);
  EXPECT_LE(held, 394);
  EXPECT_LT(pooled, 345);
  BudgetRequest r;
  r.replicates = 4;
  r.specimens = {2, 2, 2, 2};
  const auto one = [](const BudgetSetting& run) {
    return BudgetAnswer{static_cast<double>(run.replicate), 1};
  };
  EXPECT_THROW(budget_of(r, one), Error);
}

TEST(Budget, OneLostSeedLosesOnlyItself) {
  BudgetRequest r;
  r.replicates = 24;
  r.cells = {32, 64};
  const auto ask = [](const BudgetSetting& run) {
    return BudgetAnswer{run.replicate == 6 && run.cells == 1 ? NAN : static_cast<double>(run.replicate), 1};
  };
  const Budget b = budget_of(r, ask);
  EXPECT_EQ(b.replicates, 23u);
  EXPECT_NEAR(b.value, (276 - 6) / 23.0, 1e-12);
  EXPECT_NE(b.text().find("of 24 replicates, 7 gave no finite number"), std::string::npos) << b.text();
  r.replicates = 3;
  const auto third = [](const BudgetSetting& run) { return BudgetAnswer{run.replicate == 2 ? NAN : 1.0, 1}; };
  EXPECT_THROW(budget_of(r, third), Error);
}

TEST(Budget, HintOfThreeReplicatesIsThatOfThePlan) {
  BudgetRequest r;
  r.replicates = 3;
  const auto ask = [](const BudgetSetting& run) {
    return BudgetAnswer{100 + static_cast<double>(run.replicate), 1};
  };
  const Budget b = budget_of(r, ask);
  r.half_width = b.parts.front().half_width_after * 1.0001;
  const Budget planned = budget_of(r, ask);
  ASSERT_TRUE(planned.plan);
  EXPECT_EQ(planned.plan->replicates, 12u);
  r.half_width = .05;
  r.of_answer = true;
  const Budget share = budget_of(r, ask);
  EXPECT_NEAR(*share.asked, 5.05, 1e-12);
  EXPECT_EQ(share.plan->replicates, 3u);
}

TEST(Budget, NumbersWithoutMeaningAreNotPrinted) {
  BudgetRequest r;
  r.replicates = 5;
  const Budget b = budget_of(r, [](const BudgetSetting& run) {
    return BudgetAnswer{static_cast<double>(run.replicate) - 2 + 1e-17, 0};
  });
  EXPECT_EQ(b.text().find("e-1"), std::string::npos) << b.text();
}

TEST(Budget, RefusesWhatContradictsItself) {
  const auto one = [](const BudgetSetting&) { return BudgetAnswer{1, 10}; };
  const auto refused = [&](auto change) {
    BudgetRequest r = three_parts();
    change(r);
    EXPECT_THROW(budget_of(r, one), Error);
  };
  refused([](BudgetRequest& r) { r = {}; });
  refused([](BudgetRequest& r) { r.replicates = 1; });
  refused([](BudgetRequest& r) { r.cells = {128, 64}; });
  refused([](BudgetRequest& r) { r.cells = {-64, 64}; });
  refused([](BudgetRequest& r) { r.tolerances = {1e-4, 1e-3}; });
  refused([](BudgetRequest& r) { r.order_low = 3; });
  refused([](BudgetRequest& r) { r.confidence = 1; });
  refused([](BudgetRequest& r) { r.half_width = 0; });
  refused([](BudgetRequest& r) { r.at_most = 60; });
  refused([](BudgetRequest& r) { r.runs = 3; });
  refused([](BudgetRequest& r) { r.inputs[0].uncertainty = 0; });
  EXPECT_THROW(budget_of(three_parts(), [](const BudgetSetting&) { return BudgetAnswer{NAN, 0}; }), Error);
  const Budget same = budget_of(three_parts(), one);
  EXPECT_EQ(same.half_width(), 0);
  EXPECT_FALSE(same.text().empty());
}

}  // namespace budget_test
}  // namespace
}  // namespace asperity
