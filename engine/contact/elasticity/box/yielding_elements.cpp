// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/yielding_elements.hpp"

#include <bit>
#include <tuple>

#include "engine/core/monitor.hpp"

namespace asperity {

namespace {

constexpr std::size_t elements_a_block = 256;

// count · depth − Σ drops, without loss of digits.
Accumulator depth_below(double depth, std::size_t count, const Accumulator& drops) {
  Accumulator sum;
  sum.add_product(static_cast<double>(count), depth);
  sum.subtract(drops);
  return sum;
}

}  // namespace

void YieldingElements::FirstSums::build(std::span<const double> values) {
  every_block_.resize(values.size() / elements_a_block + 1);
  Accumulator sum;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k % elements_a_block == 0) every_block_[k / elements_a_block] = sum;
    sum.add(values[k]);
  }
  if (values.size() % elements_a_block == 0) every_block_[values.size() / elements_a_block] = sum;
}

Accumulator YieldingElements::FirstSums::of(std::span<const double> values, std::size_t count) const {
  Accumulator sum = every_block_[count / elements_a_block];
  for (std::size_t k = count / elements_a_block * elements_a_block; k < count; ++k) sum.add(values[k]);
  return sum;
}

YieldingElements::YieldingElements(const ElementLaw& law, std::span<const double> sorted, double yield)
    : law_(law), one_yield_(yield), drops_(sorted) {
  drop_sums_.build(drops_);
  last_to_yield_ = drops_.back() + law_.depth_at_yield(yield);
}

YieldingElements::YieldingElements(const YieldingElements& others, double yield)
    : law_(others.law_),
      one_yield_(yield),
      last_to_yield_(others.drops_.back() + law_.depth_at_yield(yield)),
      drops_(others.drops_),
      drop_sums_(others.drop_sums_) {}

YieldingElements::YieldingElements(const ElementLaw& law, std::span<const double> drops,
                                   std::span<const double> yields)
    : law_(law) {
  std::vector<std::pair<double, double>> elements(drops.size());
  for (std::size_t k = 0; k < drops.size(); ++k) elements[k] = {drops[k], yields[k]};
  stop_flag().check();
  const auto begins = [&](const std::pair<double, double>& e) {
    return e.first + law_.depth_at_yield(e.second);
  };
  // By depth of first yield; ties by drop and yield pressure: node order has no effect.
  std::sort(elements.begin(), elements.end(), [&](const auto& a, const auto& b) {
    const double first = begins(a), second = begins(b);
    return first != second ? first < second : a < b;
  });
  stop_flag().check();
  own_drops_.resize(elements.size());
  own_yields_.resize(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) std::tie(own_drops_[k], own_yields_[k]) = elements[k];
  drops_ = own_drops_;
  yields_ = own_yields_;
  last_to_yield_ = drops_.back() + law_.depth_at_yield(yields_.back());
  by_drop_ = own_drops_;
  sort_ascending(by_drop_);
  drop_sums_.build(drops_);
  yield_sums_.build(yields_);
  by_drop_sums_.build(by_drop_);
}

Accumulator YieldingElements::yields_of_first(std::size_t count) const {
  if (!yields_.empty()) return yield_sums_.of(yields_, count);
  Accumulator sum;
  sum.add_product(static_cast<double>(count), one_yield_);
  return sum;
}

double YieldingElements::mean_pressure(double depth) const {
  // Yielding elements come first in this order.
  std::size_t first = 0;
  for (std::size_t step = std::bit_floor(size()); step > 0; step /= 2)
    if (const std::size_t k = first + step; k <= size() && law_.yields(depth - drop(k - 1), yield(k - 1)))
      first = k;
  const Accumulator yielding = depth_below(depth, first, drop_sums_.of(drops_, first));

  double pressure = 0;
  if (first > 0) {
    const Accumulator yields = yields_of_first(first);
    Accumulator past = yielding;
    past.add(-law_.depth_at_yield(1) * yields.value());
    pressure = yields.value() + law_.slope_past_yield() * std::max(0.0, past.value());
  }
  if (!law_.rigid()) {
    const std::span<const double> by_drop = yields_.empty() ? drops_ : std::span<const double>(by_drop_);
    const FirstSums& sums = yields_.empty() ? drop_sums_ : by_drop_sums_;
    const auto touched =
        static_cast<std::size_t>(std::lower_bound(by_drop.begin(), by_drop.end(), depth) - by_drop.begin());
    Accumulator elastic = depth_below(depth, touched, sums.of(by_drop, touched));
    elastic.subtract(yielding);
    pressure += law_.stiffness * std::max(0.0, elastic.value());
  }
  return pressure / static_cast<double>(size());
}

double YieldingElements::greatest_mean_pressure() const {
  if (law_.hardening != 0) return std::numeric_limits<double>::infinity();
  return yields_of_first(size()).value() / static_cast<double>(size());
}

RestingPlane YieldingElements::plane_under(double mean_pressure) const {
  const auto between = [&](double low, double high) -> RestingPlane {
    const double below = this->mean_pressure(low), above = this->mean_pressure(high);
    return {low, high, above > below ? std::clamp((mean_pressure - below) / (above - below), 0.0, 1.0) : 1.0};
  };
  // At depth 0 the highest rigid element touches already.
  constexpr double nothing = -std::numeric_limits<double>::denorm_min();
  if (this->mean_pressure(0) >= mean_pressure) return between(nothing, 0);

  // Bisects between 0 and a depth at which all elements yield and carry enough. Bisects values, not bits: a
  // power of two in the lengths changes no digit.
  double low = 0, high = last_to_yield_;
  if (const double slope = law_.slope_past_yield(); slope > 0) high += mean_pressure / slope;
  high = std::max(high, std::numeric_limits<double>::min());
  while (this->mean_pressure(high) < mean_pressure && std::isfinite(high)) high *= 2;
  for (double middle = low + (high - low) / 2; low < middle && middle < high; middle = low + (high - low) / 2)
    (this->mean_pressure(middle) < mean_pressure ? low : high) = middle;
  return between(low, high);
}

std::int64_t YieldingElements::bytes(std::size_t elements) {
  return static_cast<std::int64_t>((elements / elements_a_block + 1) * sizeof(Accumulator));
}

}  // namespace asperity
