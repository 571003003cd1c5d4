// SPDX-License-Identifier: GPL-3.0-or-later
// Run-time forecast of a setting. `cells` costs n² ln n (grid transforms), a factor on all cells its square,
// `tolerance` the number of digits (linear convergence). Other knobs are free until two measurements that
// differ only in one knob determine a power law. No result depends on forecasts.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/study/study_setting.hpp"

namespace asperity {

class CostForecast {
 public:
  void learn(std::size_t way, const Knobs& knobs, double seconds);

  // From a measurement of the same way, otherwise with the most common knobs. No way: the truth.
  // O(measurements).
  std::optional<double> seconds(std::optional<std::size_t> way, const Knobs& knobs) const;

  // From the modelled knobs alone, dimensionless.
  static double relative(const Knobs& knobs);

 private:
  struct Measured {
    std::size_t way;
    Knobs knobs;
    double seconds;
  };
  double ratio(const Knobs& knobs, const Measured& reference) const;

  std::vector<Measured> measured_;
};

}  // namespace asperity
