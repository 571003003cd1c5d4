// SPDX-License-Identifier: GPL-3.0-or-later
// Budgets and sensitivities of a model with one run at a time.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/study/budget.hpp"
#include "engine/study/sensitivity.hpp"

namespace asperity {

using BudgetAsk = std::function<BudgetAnswer(const BudgetSetting&)>;
inline Budget budget_of(const BudgetRequest& request, const BudgetAsk& ask) {
  return budget_of_batches(request, [&ask](std::span<const BudgetSetting> settings) {
    std::vector<BudgetAnswer> answers;
    for (const BudgetSetting& setting : settings) answers.push_back(ask(setting));
    return answers;
  });
}

using InputAsk = std::function<double(const std::vector<double>&)>;
inline Sensitivity sensitivity_of(const ChaosRequest& request, const InputAsk& ask,
                                  const RunsToCome& to_come = {}) {
  const InputBatch batch = [&ask](std::span<const std::vector<double>> points) {
    std::vector<double> answers;
    for (const std::vector<double>& values : points) answers.push_back(ask(values));
    return answers;
  };
  return sensitivity_of_batches(request, batch, to_come);
}

}  // namespace asperity
