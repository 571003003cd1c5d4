// SPDX-License-Identifier: GPL-3.0-or-later
// Solves f(place) = wanted for an expensive, non-decreasing f by secants inside a bracket, halved after slow
// steps. Without an upper value, repeatedly short steps grow. The logarithmic scale uses logarithms while f
// follows a power law, and deficits near a known upper end.
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

  // 0 < wanted. `high` may be infinite.
  explicit BracketedSecant(double wanted, Point low = {0, 0}, Point high = {unknown, unknown},
                           Scale scale = Scale::linear)
      : wanted_(wanted), scale_(scale), low_(low), high_(high), end_(high) {}

  // `sure`: accurate enough to move the bracket.
  void take(Point found, bool sure);
  // None if no double is left inside the bracket.
  std::optional<double> next();

 private:
  bool holds(double place) const { return place > low_.at && place < high_.at; }
  double secant() const;
  // Whether the last value is nearer to the line than to the power law through the previous two.
  bool bends_as_a_line() const;
  double width() const;
  // At a share of the bracket, or at the chord through its values.
  double part_of_the_way(double share) const;
  double chord() const;

  double wanted_;
  Scale scale_;
  Point low_, high_;
  Point end_;  // initial upper end
  Point last_{}, before_{}, earlier_{};
  int taken_ = 0, slow_ = 0, short_of_it_ = 0;
  double width_ = unknown;
};

}  // namespace asperity
