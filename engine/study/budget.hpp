// SPDX-License-Identifier: GPL-3.0-or-later
// The whole error of a number. A model is run again with other seeds, on coarser grids, to looser tolerances
// and over the range of uncertain inputs. Draws from all parts together give the interval (GUM, Supplement
// 1).
//
//   sampling  scatter over replicates, or over the means of specimens: Student's t, or the log interval
//   cells     y(h) = y + C h^p with p from order_low to order_high. Over replicates, the mean change to the
//             finest grid gives C (Richardson 1911) with its standard error; the value is corrected. A single
//             specimen has errors of either sign, and two grids may agree by chance: `ask` gets grids between
//             as well, and the differences from the finest give the scale of Student's t about it. The value
//             is corrected only for a drift far above the scatter
//   solver    an error in proportion to the tolerance: the change between the two tightest gives a bound
//   tip       y(r) = y + C r^p with p from 1 to 2, for the radius of a stylus
//   noise     scatter over draws of an instrument's noise, with Student's t; a measurement has one draw
//   inputs    polynomial chaos, on the coarsest grid with the first replicate: first-order shares, and a row
//             for joint effects. Correlated inputs have sensitivity times uncertainty, and their correlation
//             has a row
//
// The parts are independent. Scatter and inputs are examined on one grid only.
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

struct InputCorrelation {
  std::string one, other;
  double value = 0;  // above -1 and below 1
};

struct BudgetRequest {
  std::vector<UncertainInput> inputs;  // none: no share of inputs
  std::vector<InputCorrelation> correlations;
  std::size_t replicates = 0;          // 0: there is nothing to sample; else at least 2
  std::vector<std::size_t> specimens;  // of each replicate, counted from 0; none: each is its own
  std::vector<double> cells;           // a side, ascending; the share of cells takes two or more
  double order_low = 1, order_high = 2;
  std::vector<double> tolerances;  // descending; the share of the solver takes two or more
  std::vector<double> tips;        // radii in m, blunt to sharp; the share of the tip takes two
  std::size_t noises = 0;          // draws of the noise; 0: none, else at least 2
  std::size_t runs = 0;  // of the inputs; 0: chaos_runs, doubled up to three times while they are too few
  double confidence = 0.95;
  MeanInterval interval = MeanInterval::student;
  std::optional<double> half_width;  // the requested interval
  bool of_answer = false;            // `half_width` is a share of the answer
  std::optional<double> at_most;     // s: refused if the first runs predict more
  int at_a_time = 1;                 // runs computed side by side, for `at_most`
  std::uint64_t seed = 1;            // of the points of the inputs and the draws
  std::size_t draws = 20000;
};

// The cells of the request. For one specimen on two grids, up to two numbers of cells between follow.
std::vector<double> budget_grids(const BudgetRequest& request);

// One run of the model. Indices are into the lists of the request, for the cells into budget_grids; 0
// where a list is empty.
struct BudgetSetting {
  std::vector<double> inputs;  // the values, in their order
  std::size_t replicate = 0, cells = 0, tolerance = 0, tip = 0;
  std::optional<std::size_t> noise;        // none: without it
  std::string part;                        // what the run is for
  std::size_t number = 0, of = 0;          // 1, 2, … in all runs
  double done_before = 0, done_after = 0;  // share of the whole, by the cells
};
struct BudgetAnswer {
  double value = 0;
  double seconds = 0;  // of computing
};
// Many runs, in their order, which may be computed side by side.
using BudgetBatch = std::function<std::vector<BudgetAnswer>(std::span<const BudgetSetting>)>;

struct BudgetPart {
  // "sampling", "cells", "solver", "tip", "noise", an input, "inputs together", "correlation".
  std::string name;
  double uncertainty = 0;                                    // standard, in the unit of the answer
  double degrees = std::numeric_limits<double>::infinity();  // of freedom
  double share = 0;                       // of the variance; all sum to 1; a correlation's may be below 0
  double share_error = 0;                 // standard error of an input's share; 0 of others
  std::string halving;                    // what halves it
  std::optional<double> halving_seconds;  // of computing; none where it takes a measurement
  double half_width_after = 0;            // of the whole interval, with this part halved
  std::optional<UncertainInput> input{};  // of an input
  double sensitivity = 0,
         total = 0;  // of an input: derivative of the answer; variance with its joint effects
  double sign = 1;   // -1 if the variance is below 0

  double variance() const { return sign * uncertainty * uncertainty; }
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
  std::size_t replicates = 0;            // or specimens with repeats
  double repeats = 1;                    // runs for each
  std::vector<double> cells, tolerances, tips;
  std::vector<double> seconds_of_cells;  // median time of a run on each grid
  std::size_t runs = 0;
  double seconds = 0;
  std::optional<double> asked;     // the requested half-width
  std::optional<BudgetPlan> plan;  // the cheapest way to it; none where computing cannot reach it
  std::vector<std::string> notes, warnings;

  double half_width() const { return (high - low) / 2; }
  // Effective degrees of freedom, by Welch and Satterthwaite.
  double degrees() const;
  // A table of the shares, with what was assumed and what was not estimated.
  std::string text() const;
};

// Throws Error{bad_value} for a contradictory request.
void check_request(const BudgetRequest& request);
// How many runs a request takes, at first.
std::size_t budget_runs(const BudgetRequest& request);
// Asks for every run once. The first batch is the first replicate on each grid, for `at_most`; the answers
// decide nothing of what is asked but for how often the runs over the inputs are doubled. Replicates without
// a finite answer are left out, up to a quarter. Throws Error{bad_value} for contradictory requests and
// other answers without a finite number, Error{infeasible} where `at_most` is too short, and
// whatever `ask` throws. Grids between are left out if `ask` refuses one.
Budget budget_of_batches(const BudgetRequest& request, const BudgetBatch& ask);

}  // namespace asperity
