// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivity of a model answer to independent uncertain inputs: variance shares by polynomial chaos, with
// runs doubled until the leave-one-out error is below 5 %.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/polynomial_chaos.hpp"

namespace asperity {

struct ChaosRequest {
  std::vector<UncertainInput> inputs;
  // 0: chaos_runs, doubled up to three times for a poor fit, twice for a hopeless fit. More than five inputs
  // start with two runs per term of degree 1.
  std::size_t runs = 0;
  std::uint64_t seed = 1;
  int highest = 12;  // degree
};

struct ChaosOfRuns {
  PolynomialChaos chaos;
  std::vector<double> answers;
};

// Answers in order; may run in parallel.
using InputBatch = std::function<std::vector<double>(std::span<const std::vector<double>>)>;
// New runs, initially and at each doubling.
using RunsToCome = std::function<void(std::size_t)>;

// Throws errors of polynomial_chaos and of `ask`. Never repeats a run.
ChaosOfRuns chaos_of_batches(const ChaosRequest& request, const InputBatch& ask,
                             const RunsToCome& to_come = {});

struct Sensitivity {
  PolynomialChaos chaos;
  double deviation = 0;                // standard deviation of the answer
  std::vector<std::size_t> order;      // by reduction of deviation
  std::size_t tied = 0;                // leading, of equal reduction
  std::vector<double> deviation_when;  // about, for half the uncertainty

  std::string text() const;
};

// Throws errors of chaos_of_batches, and Error{not_converged} without shares.
Sensitivity sensitivity_of_batches(const ChaosRequest& request, const InputBatch& ask,
                                   const RunsToCome& to_come = {});

}  // namespace asperity
