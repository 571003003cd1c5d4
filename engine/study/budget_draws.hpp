// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/uncertain_input.hpp"

namespace asperity {

// Bailey's method (1994).
inline double student_draw(const Stream& stream, std::uint64_t k, double degrees) {
  const double u = 1 - stream.uniform(2 * k), v = stream.uniform(2 * k + 1);
  return std::sqrt(degrees * elementary::expm1(-2 / degrees * elementary::log(u))) *
         elementary::cos(2 * std::numbers::pi * v);
}

// Marsaglia & Tsang's method (2000); 16 tries always suffice.
inline double chi_squared_draw(const Stream& stream, std::uint64_t k, double degrees) {
  const double shape = degrees / 2, d = (shape < 1 ? shape + 1 : shape) - 1.0 / 3;
  for (std::uint64_t i = 16 * k;; ++i) {
    const double x = stream.normal(2 * i), root = 1 + x / std::sqrt(9 * d), v = root * root * root;
    if (v <= 0) continue;
    const double u = 1 - stream.uniform(4 * i + 2);
    if (elementary::log(u) > x * x / 2 + d - d * v + d * elementary::log(v)) continue;
    return 2 * d * v * (shape < 1 ? elementary::pow(1 - stream.uniform(4 * i + 3), 1 / shape) : 1);
  }
}

// Correlated normal scores select quantiles of the inputs. Inputs with degrees of freedom follow Student's t;
// correlated inputs share one scatter estimate.
class InputDraws {
 public:
  // `inputs` must outlive the draws.
  InputDraws(const std::vector<UncertainInput>& inputs, const std::vector<InputCorrelation>& correlations,
             std::uint64_t seed)
      : inputs_(inputs) {
    const std::size_t n = inputs_.size();
    correlation_.assign(n, std::vector<double>(n));
    for (std::size_t j = 0; j < n; ++j) {
      correlation_[j][j] = 1;
      scores_.emplace_back(seed, "budget input " + std::to_string(j));
      scales_.emplace_back(seed, "budget degrees " + std::to_string(j));
    }
    for (const InputCorrelation& of : correlations) {
      const std::size_t one = place_of(of.one), other = place_of(of.other);
      const std::string both = quoted(of.one) + " and " + quoted(of.other);
      if (correlation_[one][other] != 0 || !(std::abs(of.value) < 1))
        refuse(both + " have " + format_short(of.value), "give each two once, a number between -1 and 1");
      if (inputs_[one].degrees != inputs_[other].degrees)
        refuse(both + " have unlike `degrees`", "give both the same: their scatter is one estimate");
      correlation_[one][other] = correlation_[other][one] = of.value;
    }
    factor_ = correlation_;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k <= j; ++k) {
        for (std::size_t i = 0; i < k; ++i) factor_[j][k] -= factor_[j][i] * factor_[k][i];
        if (k < j)
          factor_[j][k] /= factor_[k][k];
        else if (factor_[j][j] > 1e-12)
          factor_[j][j] = std::sqrt(factor_[j][j]);
        else
          refuse("these correlations contradict each other", "correct those of " + quoted(inputs_[j].name));
      }
  }

  std::vector<double> at(std::uint64_t k) const {
    std::vector<double> scores, found;
    for (std::size_t j = 0; j < inputs_.size(); ++j) {
      scores.push_back(scores_[j].normal(k));
      double z = 0;
      for (std::size_t i = 0; i <= j; ++i)
        if (factor_[j][i] != 0) z += factor_[j][i] * scores[i];
      std::size_t group = 0;
      while (correlation_[j][group] == 0) ++group;
      if (const double degrees = inputs_[j].degrees; std::isfinite(degrees))
        z *= std::sqrt(degrees / chi_squared_draw(scales_[group], k, degrees));
      found.push_back(inputs_[j].coordinate_of_score(z));
    }
    return found;
  }
  double correlation(std::size_t one, std::size_t other) const { return correlation_[one][other]; }

 private:
  [[noreturn]] static void refuse(const std::string& sentence, const std::string& hint) {
    throw Error(ErrorCode::bad_value, "`correlation`: " + sentence, hint);
  }
  std::size_t place_of(const std::string& name) const {
    const auto found = std::ranges::find(inputs_, name, &UncertainInput::name);
    if (found == inputs_.end()) refuse("there is no input " + quoted(name), "name two of `inputs`");
    return static_cast<std::size_t>(found - inputs_.begin());
  }

  const std::vector<UncertainInput>& inputs_;
  std::vector<std::vector<double>> correlation_, factor_;  // and its Cholesky factor
  std::vector<Stream> scores_, scales_;
};

inline double average_of(const std::vector<double>& values) {
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  return mean;
}

inline double deviation_of(const std::vector<double>& values, double degrees) {
  const double mean = average_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return degrees > 0 ? std::sqrt(squares / degrees) : 0;
}

// A random value of `list` plus `scale` times Student's t.
struct BudgetTerm {
  std::string name;
  std::vector<double> list;
  double scale = 0, degrees = 1;
  double uncertainty() const {
    return elementary::hypot(scale, deviation_of(list, static_cast<double>(list.size())));
  }
};

struct BudgetFindings {
  double first = 0;   // replicate on the coarsest grid
  double centre = 0;  // of the replicates, or Cox's
  std::vector<BudgetTerm> terms;
};

}  // namespace asperity
