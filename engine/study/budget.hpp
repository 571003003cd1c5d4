// SPDX-License-Identifier: GPL-3.0-or-later
// The whole error of a number: what is asked of a model is asked again with other seeds, on coarser grids, to
// looser tolerances and over the range of uncertain inputs, and the parts are put together by drawing from
// all of them (GUM, Supplement 1).
//
//   sampling   scatter over replicates (seeds, placements): Student's t of the mean, or the log interval
//   cells      y(h) = y + C h^p with p anywhere from order_low to order_high: the change from the last but
//              one grid to the finest gives C (Richardson 1911), the value is corrected by the mean of that,
//              replicate by replicate, and what p leaves open is the uncertainty
//   solver     an error in proportion to the tolerance: the change between the two tightest gives a bound
//   tip        the same as cells of the radius of a stylus, y(r) = y + C r^p with p from 1 to 2: the change
//   from
//              a blunter tip to the sharpest, with the first replicate on the coarsest grid
//   noise      scatter over draws of the noise of an instrument, with Student's t; a measurement has one draw
//   inputs     polynomial chaos, on the coarsest grid with the first replicate; first-order shares, and one
//              row for what inputs do together and for what the polynomial leaves open
//
// The parts are taken for independent of each other, and so are the inputs: correlated inputs break both
// shares and interval. How the scatter and the effect of inputs hang on the grid is not looked into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/polynomial_chaos.hpp"
#include "engine/statistics/sample_mean.hpp"

namespace asperity {

struct BudgetRequest {
  std::vector<UncertainInput> inputs;  // none: no share of inputs
  std::size_t replicates = 0;          // 0: there is nothing to sample; else at least 2
  std::vector<double> cells;           // a side, ascending; the share of cells takes two or more
  double order_low = 1, order_high = 2;
  std::vector<double> tolerances;  // descending; the share of the solver takes two or more
  std::vector<double> tips;        // radii in m, blunt to sharp; the share of the tip takes two
  std::size_t noises = 0;          // draws of the noise; 0: none, else at least 2
  std::size_t runs = 0;  // of the inputs; 0: chaos_runs, doubled up to three times while they are too few
  double confidence = 0.95;
  MeanInterval interval = MeanInterval::student;
  std::optional<double> half_width;  // the interval that is asked for
  std::optional<double> at_most;     // s: refused where the first runs say that all take longer
  int at_a_time = 1;                 // runs that are computed side by side, for `at_most`
  std::uint64_t seed = 1;            // of the points of the inputs and the draws
  std::size_t draws = 20000;
};

// One run of the model. Indices are into the lists of the request; 0 where a list is empty.
struct BudgetSetting {
  std::vector<double> inputs;  // the values, in their order
  std::size_t replicate = 0, cells = 0, tolerance = 0, tip = 0;
  std::optional<std::size_t> noise;        // none: without it
  std::string part;                        // what the run is for
  std::size_t number = 0, of = 0;          // 1, 2, … of all runs
  double done_before = 0, done_after = 0;  // share of the whole, by the cells
};
struct BudgetAnswer {
  double value = 0;
  double seconds = 0;  // that it took
};
using BudgetAsk = std::function<BudgetAnswer(const BudgetSetting&)>;
// Many runs, in their order, which may be computed side by side.
using BudgetBatch = std::function<std::vector<BudgetAnswer>(std::span<const BudgetSetting>)>;

struct BudgetPart {
  std::string name;        // "sampling", "cells", "solver", "tip", "noise", an input, "inputs together"
  double uncertainty = 0;  // standard, in the unit of the answer
  double share = 0;        // of the variance; all sum to 1
  double share_error = 0;  // standard error of an input's share; 0 of others
  std::string halving;     // what halves it
  std::optional<double> halving_seconds;  // of computing; none where it takes a measurement
  double half_width_after = 0;            // of the whole interval, with this part halved
};

struct BudgetPlan {
  std::size_t replicates = 0;
  double cells = 0;  // 0 where there is no list of cells
  double seconds = 0;
  double half_width = 0;
};

struct Budget {
  double value = 0, low = 0, high = 0, confidence = 0.95;
  double uncertainty = 0;         // standard
  std::vector<BudgetPart> parts;  // largest share first
  std::optional<SampleMean> sample;
  std::optional<PolynomialChaos> chaos;
  std::optional<double> order_observed;  // of three grids or more
  std::size_t replicates = 0;
  std::vector<double> cells, tolerances, tips;
  std::vector<double> seconds_of_cells;  // median time of a run on each grid
  std::size_t runs = 0;
  double seconds = 0;
  std::optional<double> asked;     // the half-width that is asked for
  std::optional<BudgetPlan> plan;  // the cheapest way to it; none where computing cannot reach it
  std::vector<std::string> notes, warnings;

  double half_width() const { return (high - low) / 2; }
  // A table of the shares, with what was assumed and what was not estimated.
  std::string text() const;
};

// Throws Error{bad_value} for a request that contradicts itself.
void check_request(const BudgetRequest& request);
// How many runs a request takes, at first.
std::size_t budget_runs(const BudgetRequest& request);
// Asks for every run once, the first replicate on each grid first. Throws Error{bad_value} for requests that
// contradict themselves and answers that are not finite, Error{infeasible} where `at_most` is too short, and
// whatever `ask` throws.
Budget budget_of(const BudgetRequest& request, const BudgetAsk& ask);
// The first batch is the first replicate on each grid, for `at_most`; the answers decide nothing of what is
// asked but for how often the runs over the inputs are doubled.
Budget budget_of_batches(const BudgetRequest& request, const BudgetBatch& ask);

}  // namespace asperity
