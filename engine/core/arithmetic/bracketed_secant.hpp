// SPDX-License-Identifier: GPL-3.0-or-later
// Where a function that never falls takes a given value, from values that are each dear: the secant through
// the last two, kept within the bracket of those below and above, which is halved where the secant gains
// little; while nothing is known to lie above, steps that keep falling short grow. A value too rough to say
// on which side it lies leaves the bracket as it is.
#pragma once

#include <limits>
#include <optional>

namespace asperity {

class BracketedSecant {
 public:
  struct Point {
    double at, value;
  };
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  // 0 < wanted. `low`: nothing at nothing, unless more is known; `high` may be infinite.
  explicit BracketedSecant(double wanted, Point low = {0, 0}, Point high = {unknown, unknown})
      : wanted_(wanted), low_(low), high_(high) {}

  void take(Point found, bool sure);
  // The next place to try; none where no double is left between the two sides.
  std::optional<double> next();

 private:
  double wanted_;
  Point low_, high_;
  Point last_{}, before_{};
  int taken_ = 0, slow_ = 0, short_of_it_ = 0;
  double width_ = unknown;
};

}  // namespace asperity
