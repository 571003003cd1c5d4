// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/arithmetic/bracketed_secant.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {
constexpr int slow_steps = 1;          // that do not halve the bracket, before it is halved
constexpr double enough_gain = 0.3;    // of what the last step left of the error, that is no slow one
constexpr int few_short = 2;           // steps that all fall short, before they grow
constexpr double furthest = 100;       // times the last place, where nothing lies above
constexpr double off_the_ends = 0.01;  // of the bracket, that a chord through its ends keeps away from them
}  // namespace

void BracketedSecant::take(Point found, bool sure) {
  if (taken_ == 0 || found.at != last_.at) {
    before_ = last_;
    ++taken_;
  }
  last_ = found;
  if (!sure) return;
  short_of_it_ = found.value < wanted_ ? short_of_it_ + 1 : 0;
  if (found.value < wanted_)
    low_ = found.at > low_.at ? found : low_;
  else
    high_ = found.at < high_.at ? found : high_;
}

std::optional<double> BracketedSecant::next() {
  double place = last_.value > 0 ? last_.at * (wanted_ / last_.value) : 4 * last_.at;
  if (taken_ > 1 && last_.value != before_.value)
    place = last_.at + (wanted_ - last_.value) * (last_.at - before_.at) / (last_.value - before_.value);
  const auto inside = [&](double x) { return x > low_.at && x < high_.at; };
  if (!std::isfinite(high_.at)) {
    // A step for each that fell short is one more of those that grow.
    if (short_of_it_ > few_short && place > last_.at)
      place = last_.at + std::ldexp(place - last_.at, short_of_it_ - few_short);
    if (!inside(place)) place = 2 * std::max(low_.at, last_.at);
    place = std::min(place, furthest * last_.at);
    return inside(place) ? std::optional(place) : std::nullopt;
  }
  const double width = high_.at - low_.at;
  const bool gains = std::abs(last_.value - wanted_) < enough_gain * std::abs(before_.value - wanted_);
  slow_ = width > 0.5 * width_ && !gains ? slow_ + 1 : 0;
  width_ = width;
  if (slow_ > slow_steps || !inside(place)) {
    // Through the ends of the bracket, or its middle.
    const double share = high_.value < unknown ? (wanted_ - low_.value) / (high_.value - low_.value) : 0.5;
    place = low_.at + width * (slow_ > slow_steps ? 0.5 : std::clamp(share, off_the_ends, 1 - off_the_ends));
    if (slow_ > slow_steps) slow_ = 0;
  }
  return inside(place) ? std::optional(place) : std::nullopt;
}

}  // namespace asperity
