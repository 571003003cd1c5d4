// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_doublings = 3;

std::string in_column(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string with_error(double share, double error) {
  return format_short(std::round(1000 * share) / 10, 4) + " ± " +
         format_short(std::round(1000 * error) / 10, 3) + " %";
}

InputBatch one_by_one(const InputAsk& ask) {
  return [&ask](std::span<const std::vector<double>> points) {
    std::vector<double> answers;
    for (const std::vector<double>& values : points) answers.push_back(ask(values));
    return answers;
  };
}

}  // namespace

ChaosOfRuns chaos_of_runs(const ChaosRequest& request, const InputAsk& ask, const RunsToCome& to_come) {
  return chaos_of_batches(request, one_by_one(ask), to_come);
}

ChaosOfRuns chaos_of_batches(const ChaosRequest& request, const InputBatch& ask, const RunsToCome& to_come) {
  check_inputs(request.inputs);
  std::size_t runs = request.runs > 0 ? request.runs : chaos_runs(request.inputs.size());
  ChaosOfRuns found;
  for (std::size_t doubled = 0;; ++doubled) {
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
    found.chaos = polynomial_chaos(request.inputs, points, found.answers);
    if (found.chaos.trust() == ChaosTrust::good || request.runs > 0 || doubled == most_doublings)
      return found;
    runs *= 2;
  }
}

Sensitivity sensitivity_of(const ChaosRequest& request, const InputAsk& ask, const RunsToCome& to_come) {
  return sensitivity_of_batches(request, one_by_one(ask), to_come);
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
  std::ranges::stable_sort(found.order,
                           [&](std::size_t a, std::size_t b) { return shares[a].first > shares[b].first; });
  for (const VarianceShare& share : shares)
    found.deviation_when.push_back(found.deviation * std::sqrt(std::max(0.0, 1 - 0.75 * share.first)));
  return found;
}

std::string Sensitivity::text() const {
  std::string said = "sensitivity: " + format_short(chaos.mean, 5) + ", standard deviation over the inputs " +
                     format_short(deviation, 3) + "\n";
  std::size_t width = 5;
  for (const VarianceShare& share : chaos.shares) width = std::max(width, share.name.size());
  said += "  input" + std::string(width - 5, ' ') + in_column("first order", 18) + in_column("total", 18) +
          "   halved\n";
  for (const std::size_t j : order) {
    const VarianceShare& share = chaos.shares[j];
    // The sign ± is two bytes of one column.
    said += "  " + share.name + std::string(width - share.name.size(), ' ') +
            in_column(with_error(share.first, share.first_error), 19) +
            in_column(with_error(share.total, share.total_error), 19) + "   " +
            format_short(deviation_when[j], 3) + "\n";
  }
  if (chaos.variance > 0) {
    const UncertainInput& next = chaos.inputs[order.front()];
    said += "  measure next: " + next.name + "; to u = " + format_short(next.uncertainty / 2, 3) +
            " the standard deviation falls from " + format_short(deviation, 3) + " to " +
            format_short(deviation_when[order.front()], 3) + "\n";
  } else {
    said += "  the answer does not hang on these inputs\n";
  }
  said += "  " + chaos.text() + "\n";
  if (chaos.inputs.size() > 1)
    said += "  inputs are taken as independent: shares do not hold for correlated ones\n";
  return said;
}

}  // namespace asperity
