// SPDX-License-Identifier: GPL-3.0-or-later
// The direction that a set descent moves pressures along and the one before it, and the steps along them that
// pressures and gaps have yet to take: taken where these are read next, a step costs no pass over memory of
// its own. Any rounding of a direction is as good, since pressures and gaps go by what has been rounded:
// Stored is float or double.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/lane_terms.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/smooth_extension.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// A row of a direction yet without its balance of the load: what is stored of M r, what is kept of the
// direction before, and a smooth field.
template <class Stored>
struct Along {
  const Stored *values, *before;
  double kept;
  SmoothRow<double> smooth;

  // At node k of the grid, or at as many as a vector has lanes.
  template <class Value>
  void read(std::size_t k, Value& to) const {
    Value old, low, high;
    lane_terms::read(values + k, to);
    lane_terms::read(before + k, old);
    lane_terms::read(smooth.low + k, low);
    lane_terms::read(smooth.high + k, high);
    to += kept * old + (smooth.low_share * low + smooth.high_share * high);
  }
};

template <class Stored>
class DescentDirections {
 public:
  // Room for a direction, that of the one before the last; a step along that is taken first.
  Stored* next(std::span<double> pressure);
  Stored* last() { return now_.data(); }
  // Row j, of nx nodes, of what is stored and `kept` of the direction before, with a row of a smooth field.
  Along<Stored> row(int j, int nx, double kept, SmoothRow<double> smooth) const {
    const auto begin = static_cast<std::ptrdiff_t>(j) * nx;
    smooth.low -= begin;
    smooth.high -= begin;
    return {now_.data(), kept != 0 ? before_.data() : now_.data(), kept, smooth};
  }

  // A step along the last direction, whose image is kept until the gaps have taken it.
  void go(double length, const double* image) {
    step_.along[0].length = step_.gap_length = length;
    step_.image = image;
  }
  // No step along the last direction, which may be anything, as may its image: `finite` is read in its place.
  void drop_last(std::span<const double> finite) {
    step_.along[0] = {0, step_.along[1].direction};
    step_.image = finite.data();
  }

  // Steps not yet taken, for whoever takes them; none are left.
  PressureStep<Stored> hand_over() { return std::exchange(step_, {}); }
  // That of the gaps alone.
  ContactPreconditioner::Step hand_over_gaps(std::span<double> gap) {
    const double length = std::exchange(step_.gap_length, 0);
    return length != 0 ? ContactPreconditioner::Step{gap.data(), length, step_.image}
                       : ContactPreconditioner::Step{};
  }
  void take(std::span<double> pressure, std::span<double> gap);

 private:
  UnsetArray<Stored> now_, before_;
  PressureStep<Stored> step_{};
};

template <class Stored>
Stored* DescentDirections<Stored>::next(std::span<double> pressure) {
  using Step = typename PressureStep<Stored>::Along;
  Step &latest = step_.along[0], &oldest = step_.along[1];
  if (oldest.length != 0)
    for_lanes(pressure.size(), [oldest, p = pressure.data()]<class Value>(std::size_t k) {
      Value value, change;
      lane_terms::read(p + k, value);
      lane_terms::read(oldest.direction + k, change);
      value += oldest.length * change;
      lane_terms::put(value, p + k);
    });
  before_.resize(pressure.size());
  std::swap(now_, before_);
  oldest = latest.length != 0 ? latest : Step{0, now_.data()};
  latest = {0, now_.data()};
  return now_.data();
}

template <class Stored>
void DescentDirections<Stored>::take(std::span<double> pressure, std::span<double> gap) {
  const PressureStep<Stored> step = hand_over();
  if (step.none()) return;
  for_lanes(pressure.size(), [step, p = pressure.data(), g = gap.data()]<class Value>(std::size_t k) {
    Value at, apart;
    step.take(k, p, g, at, apart);
  });
}

}  // namespace asperity
