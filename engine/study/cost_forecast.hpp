// SPDX-License-Identifier: GPL-3.0-or-later
// What a setting of a study will take, from what others took. `cells` costs n² ln n (the transforms of
// a grid), a factor on all cells its square, `tolerance` the number of digits (an iteration gains a
// constant share of a digit). Any other knob is taken to cost nothing until two measurements that
// differ in it alone show its power law. A forecast, for budgets and times left; no number of a
// result depends on it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/study/study_setting.hpp"

namespace asperity {

class CostForecast {
 public:
  void learn(std::size_t way, const Knobs& knobs, double seconds);

  // From the measurements of the same way, if there are any; otherwise from that which shares most knobs.
  // No way: the truth. Nothing if nothing was learnt. Linear in the measurements.
  std::optional<double> seconds(std::optional<std::size_t> way, const Knobs& knobs) const;

  // Of the modelled knobs alone, in no unit: orders the settings of a way before anything is known.
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
