// SPDX-License-Identifier: GPL-3.0-or-later
// Which uncertain input the answer of a model hangs on: shares of the variance by polynomial chaos, of runs
// that are doubled until the leave-one-out error is below 5 %, and which input to measure better next: the
// one with the greatest total share: halved, it narrows also what it does together with others. Inputs are
// taken for independent.
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
  // Fixed; 0: chaos_runs, doubled up to three times while the fit is not good and twice where it is hopeless;
  // of more than five inputs two for each term of degree 1 at first, where degree 1 is all but exact.
  std::size_t runs = 0;
  std::uint64_t seed = 1;
  int highest = 12;  // degree
};

struct ChaosOfRuns {
  PolynomialChaos chaos;
  std::vector<double> answers;
};

// The answers at many values of the inputs, in their order, which may be computed side by side.
using InputBatch = std::function<std::vector<double>(std::span<const std::vector<double>>)>;
// Told how many runs will follow, before the first and at each doubling.
using RunsToCome = std::function<void(std::size_t)>;

// Throws as polynomial_chaos does, and whatever `ask` throws. No run is made twice.
ChaosOfRuns chaos_of_batches(const ChaosRequest& request, const InputBatch& ask,
                             const RunsToCome& to_come = {});

struct Sensitivity {
  PolynomialChaos chaos;
  double deviation = 0;            // standard, of the answer over the inputs
  std::vector<std::size_t> order;  // of the inputs: those first that narrow the answer most
  std::size_t tied = 0;            // the first of these, in the order of the inputs, narrow it alike
  std::vector<double>
      deviation_when;  // of each input: that of the answer with its uncertainty halved, nearly

  std::string text() const;
};

// Throws as chaos_of_batches does, and Error{not_converged} where no shares can be had.
Sensitivity sensitivity_of_batches(const ChaosRequest& request, const InputBatch& ask,
                                   const RunsToCome& to_come = {});

}  // namespace asperity
