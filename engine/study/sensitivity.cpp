// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/sensitivity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_doublings = 3;
constexpr std::size_t few_inputs = 5;
constexpr double exact_below = 1e-3, hopeless_above = 0.9;
constexpr double tie_within = 0.01;  // of the deviation

std::string with_error(double share, double error) {
  return format_short(std::round(1000 * share) / 10, 4) + " ± " +
         format_short(std::round(1000 * error) / 10, 3) + " %";
}

}  // namespace

ChaosOfRuns chaos_of_batches(const ChaosRequest& request, const InputBatch& ask, const RunsToCome& to_come) {
  check_inputs(request.inputs);
  const std::size_t inputs = request.inputs.size(), first = chaos_runs(inputs);
  std::size_t runs = request.runs > 0      ? request.runs
                     : inputs > few_inputs ? std::min(first, std::bit_ceil(2 * (inputs + 1)))
                                           : first;
  ChaosOfRuns found;
  for (std::size_t doubled = 0;;) {
    const auto points = input_points(request.inputs, runs, request.seed);
    if (to_come) to_come(runs - found.answers.size());
    std::vector<std::vector<double>> values;
    for (std::size_t run = found.answers.size(); run < runs; ++run) {
      std::vector<double>& of_run = values.emplace_back();
      for (std::size_t j = 0; j < points[run].size(); ++j)
        of_run.push_back(request.inputs[j].at(points[run][j]));
    }
    const std::vector<double> answers = ask(values);
    found.answers.insert(found.answers.end(), answers.begin(), answers.end());
    found.chaos = polynomial_chaos(request.inputs, points, found.answers, request.highest);
    if (request.runs > 0 || found.chaos.leave_one_out < exact_below) return found;
    if (runs < first) {
      runs = first;
      continue;
    }
    if (found.chaos.trust() == ChaosTrust::good || doubled == most_doublings) return found;
    if (doubled == 2 && found.chaos.leave_one_out > hopeless_above) return found;
    runs *= 2;
    ++doubled;
  }
}

Sensitivity sensitivity_of_batches(const ChaosRequest& request, const InputBatch& ask,
                                   const RunsToCome& to_come) {
  Sensitivity found;
  found.chaos = chaos_of_batches(request, ask, to_come).chaos;
  require_trust(found.chaos);
  found.deviation = std::sqrt(found.chaos.variance);
  const auto& shares = found.chaos.shares;
  found.order.resize(shares.size());
  std::iota(found.order.begin(), found.order.end(), std::size_t{0});
  for (const VarianceShare& share : shares)
    found.deviation_when.push_back(found.deviation * std::sqrt(std::max(0.0, 1 - 0.75 * share.total)));
  const auto& when = found.deviation_when;
  std::ranges::stable_sort(found.order, [&](std::size_t a, std::size_t b) { return when[a] < when[b]; });
  const double least = when[found.order.front()];
  while (found.tied < shares.size() && when[found.order[found.tied]] <= least + tie_within * found.deviation)
    ++found.tied;
  std::sort(found.order.begin(), found.order.begin() + static_cast<std::ptrdiff_t>(found.tied));
  return found;
}

std::string Sensitivity::text() const {
  std::string said =
      "sensitivity: " + format_short(std::abs(chaos.mean) < 1e-12 * deviation ? 0 : chaos.mean, 5) +
      ", standard deviation over the inputs " + format_short(deviation, 3) + "\n";
  std::vector<TextLine> lines = {{"input", "first order", "total", "halved"}};
  for (const std::size_t j : order) {
    const VarianceShare& share = chaos.shares[j];
    lines.push_back({share.name, with_error(share.first, share.first_error),
                     with_error(share.total, share.total_error), format_short(deviation_when[j], 3)});
  }
  said += aligned(lines).substr(1) + "\n";
  if (chaos.variance > 0) {
    const UncertainInput& next = chaos.inputs[order.front()];
    said += "  measure next: " + next.name + "; to u = " + format_short(next.uncertainty / 2, 3) +
            " the standard deviation falls from " + format_short(deviation, 3) + " to " +
            format_short(deviation_when[order.front()], 3);
    for (std::size_t k = 1; k < tied; ++k)
      said += (k == 1 ? "; as much by " : ", ") + chaos.inputs[order[k]].name;
    said += "\n";
  } else {
    said += "  the answer does not depend on these inputs\n";
  }
  said += "  " + chaos.text() + "\n";
  if (chaos.inputs.size() > 1)
    said += "  inputs are taken as independent: shares do not hold for correlated ones\n";
  return said;
}

}  // namespace asperity
