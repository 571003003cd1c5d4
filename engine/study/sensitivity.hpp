// SPDX-License-Identifier: GPL-3.0-or-later
// Which uncertain input the answer of a model hangs on: shares of the variance by polynomial chaos, of runs
// that are doubled until the leave-one-out error is below 5 %, and which input to measure better next: the
// one whose first-order share is greatest, since that is the part of the variance that goes, in the mean,
// when the input becomes known (Saltelli et al. 2008). Inputs are taken for independent.
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
  std::size_t runs = 0;  // fixed; 0: chaos_runs, doubled up to three times while the fit is not good
  std::uint64_t seed = 1;
};

struct ChaosOfRuns {
  PolynomialChaos chaos;
  std::vector<double> answers;
};

// The answer at these values of the inputs.
using InputAsk = std::function<double(const std::vector<double>&)>;
// The answers at many such values, in their order, which may be computed side by side.
using InputBatch = std::function<std::vector<double>(std::span<const std::vector<double>>)>;
// Told how many runs will follow, before the first and at each doubling.
using RunsToCome = std::function<void(std::size_t)>;

// Throws as polynomial_chaos does, and whatever `ask` throws. No run is made twice.
ChaosOfRuns chaos_of_runs(const ChaosRequest& request, const InputAsk& ask, const RunsToCome& to_come = {});
ChaosOfRuns chaos_of_batches(const ChaosRequest& request, const InputBatch& ask,
                             const RunsToCome& to_come = {});

struct Sensitivity {
  PolynomialChaos chaos;
  double deviation = 0;            // standard, of the answer over the inputs
  std::vector<std::size_t> order;  // of the inputs, greatest first-order share first
  std::vector<double>
      deviation_when;  // of each input: that of the answer with its uncertainty halved, nearly

  std::string text() const;
};

// Throws as chaos_of_runs does, and Error{not_converged} where no shares can be had.
Sensitivity sensitivity_of(const ChaosRequest& request, const InputAsk& ask, const RunsToCome& to_come = {});
Sensitivity sensitivity_of_batches(const ChaosRequest& request, const InputBatch& ask,
                                   const RunsToCome& to_come = {});

}  // namespace asperity
