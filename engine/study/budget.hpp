// SPDX-License-Identifier: GPL-3.0-or-later
// Uncertainty budget of a computed number: the model runs with other seeds, coarser grids, looser tolerances
// and varied inputs. Joint draws give the interval (GUM, Supplement 1). Parts are independent; scatter and
// inputs are examined on one grid.
//
// sampling  scatter of replicates or specimen means: Student's t, or the log interval
// cells     y(h) = y + C h^p, p from order_low to order_high. With replicates, the mean change to the
//           finest grid corrects the value (Richardson 1911). For one specimen, differences from the
//           finest grid, also of intermediate grids, scale a Student's t, and only a drift far above the
//           scatter corrects the value
// solver    proportional to the tolerance, bounded by the change between the two tightest
// tip       y(r) = y + C r^p, p from 1 to 2, for the stylus radius r
// noise     scatter of instrument noise, Student's t
// inputs    polynomial chaos on the coarsest grid with the first replicate: first-order shares and
//           joint effects; correlated inputs: sensitivity times uncertainty, and correlation
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/polynomial_chaos.hpp"
#include "engine/statistics/sample_mean.hpp"

namespace asperity {

struct BudgetRequest {
  std::vector<UncertainInput> inputs;
  std::vector<InputCorrelation> correlations;
  std::size_t replicates = 0;          // 0: no sampling; else at least 2
  std::vector<std::size_t> specimens;  // by replicate; none: all differ
  std::vector<double> cells;           // per side, ascending
  double order_low = 1, order_high = 2;
  std::vector<double> tolerances;  // descending
  std::vector<double> tips;        // radii in m, descending
  std::size_t noises = 0;          // draws; 0 or at least 2
  std::size_t runs = 0;            // 0: chaos_runs, doubled up to three times
  double confidence = 0.95;
  MeanInterval interval = MeanInterval::student;
  std::optional<double> half_width;  // requested
  bool of_answer = false;            // `half_width` is relative
  std::optional<double> at_most;     // s, refused on a worse forecast
  int at_a_time = 1;                 // parallel runs, for `at_most`
  std::uint64_t seed = 1;
  std::size_t draws = 20000;
};

// The requested grids; for one specimen on two grids, then up to two intermediate grids.
std::vector<double> budget_grids(const BudgetRequest& request);

// Indices into the request, for cells into budget_grids; 0 for empty lists.
struct BudgetSetting {
  std::vector<double> inputs;
  std::size_t replicate = 0, cells = 0, tolerance = 0, tip = 0;
  std::optional<std::size_t> noise;
  std::string part;
  std::size_t number = 0, of = 0;  // from 1; number of runs
  double done_before = 0, done_after = 0;
};
struct BudgetAnswer {
  double value = 0;
  double seconds = 0;  // computing time
};
// Answers in order; may run in parallel.
using BudgetBatch = std::function<std::vector<BudgetAnswer>(std::span<const BudgetSetting>)>;

struct BudgetPart {
  // "sampling", "cells", "solver", "tip", "noise", an input, "inputs together", "correlation".
  std::string name;
  double uncertainty = 0;                                    // standard, of the answer
  double degrees = std::numeric_limits<double>::infinity();  // of freedom
  double share = 0;                                          // of variance; correlations: also negative
  double share_error = 0;                                    // standard, of an input
  std::string halving{};
  std::optional<double> halving_seconds{};  // none for a measurement
  double half_width_after = 0;              // of the whole interval
  std::optional<UncertainInput> input{};
  double sensitivity = 0,
         total = 0;  // of an input: derivative; variance with joint effects
  double sign = 1;   // -1: negative variance

  double variance() const { return sign * uncertainty * uncertainty; }
};

struct BudgetPlan {
  std::size_t replicates = 0;
  double cells = 0;  // 0 without cells
  double seconds = 0;
  double half_width = 0;
};

struct Budget {
  double value = 0, low = 0, high = 0, confidence = 0.95;
  double uncertainty = 0;         // standard
  std::vector<BudgetPart> parts;  // largest share first
  std::optional<SampleMean> sample;
  std::optional<PolynomialChaos> chaos;
  std::optional<double> order_observed;
  std::size_t replicates = 0;  // or repeated specimens
  double repeats = 1;          // runs per replicate
  std::vector<double> cells, tolerances, tips;
  std::vector<double> seconds_of_cells;  // median, by grid
  std::size_t runs = 0;
  double seconds = 0;
  std::optional<double> asked;
  std::optional<BudgetPlan> plan;  // cheapest; none reaches `asked`
  std::vector<std::string> notes, warnings;

  double half_width() const { return (high - low) / 2; }
  // Effective degrees of freedom (Welch–Satterthwaite).
  double degrees() const;
  std::string text() const;
};

void check_request(const BudgetRequest& request);
// Without later doubling.
std::size_t budget_runs(const BudgetRequest& request);
// Runs each setting once. The first batch holds the first replicate on each grid, to check `at_most`. Omits
// up to a quarter of the replicates if not finite, and intermediate grids refused by `ask`. Throws
// Error{bad_value} for a contradictory request or any other answer that is not finite, Error{infeasible} for
// a short `at_most`, and errors of `ask`.
Budget budget_of_batches(const BudgetRequest& request, const BudgetBatch& ask);

}  // namespace asperity
