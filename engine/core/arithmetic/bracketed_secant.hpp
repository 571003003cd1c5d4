// SPDX-License-Identifier: GPL-3.0-or-later
// Where a function that never falls takes a given value, from values that are each dear: the secant through
// the last two, kept within the bracket of those below and above, which is halved where the secant gains
// little; while nothing is known to lie above, steps that keep falling short grow. A value too rough to say
// on which side it lies leaves the bracket as it is. A function that goes as a power of the place is sought
// by its logarithm over that of the place while its values do, near a high end that is known by what it lacks
// of that.
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

  enum class Scale { linear, logarithmic };

  // 0 < wanted. `low`: nothing at nothing, unless more is known; `high` may be infinite.
  explicit BracketedSecant(double wanted, Point low = {0, 0}, Point high = {unknown, unknown},
                           Scale scale = Scale::linear)
      : wanted_(wanted), scale_(scale), low_(low), high_(high), end_(high) {}

  // `instead`: of the last one, which was rougher and at about the same place.
  void take(Point found, bool sure, bool instead = false);
  // Whether the place lies between the two sides.
  bool holds(double place) const { return place > low_.at && place < high_.at; }
  // The next place to try; none where no double is left between the two sides.
  std::optional<double> next();

 private:
  double secant() const;
  // Whether the last value lies nearer to the line through the two before it than to their power.
  bool bends_as_a_line() const;
  double width() const;
  // Between the sides: so much of the way, or through their values.
  double part_of_the_way(double share) const;
  double chord() const;

  double wanted_;
  Scale scale_;
  Point low_, high_;
  Point end_;  // where it was high at first
  Point last_{}, before_{}, earlier_{};
  int taken_ = 0, slow_ = 0, short_of_it_ = 0;
  double width_ = unknown;
};

}  // namespace asperity
