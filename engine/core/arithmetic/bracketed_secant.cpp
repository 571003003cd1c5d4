// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/arithmetic/bracketed_secant.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {
constexpr int slow_steps = 1;          // slow steps before the bracket is halved
constexpr double enough_gain = 0.8;    // error ratio of a step that is not slow
constexpr int few_short = 2;           // short steps before steps grow
constexpr double furthest = 100;       // largest ratio to the last place, or to a missing lower end
constexpr double off_the_ends = 0.01;  // of the bracket, between step and ends
constexpr double near_the_end = 0.3;   // fraction of the initial upper end
constexpr double usual_power = 1.5, least_power = 1e-9;
}  // namespace

void BracketedSecant::take(Point found, bool sure) {
  if (taken_ == 0 || found.at != last_.at) {
    earlier_ = before_;
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

double BracketedSecant::secant() const {
  const bool first = taken_ < 2 || last_.value == before_.value;
  const auto ratio = [](double x, double y) { return elementary::log(x / y); };
  if (scale_ == Scale::logarithmic && end_.value < unknown && last_.at > near_the_end * end_.at &&
      last_.at < end_.at && last_.value < end_.value) {
    // f may approach the end as any power of the deficit.
    const double lacks = end_.at - last_.at, power = [&] {
      if (first || !(before_.at < end_.at && before_.value < end_.value)) return usual_power;
      return ratio(end_.value - last_.value, end_.value - before_.value) / ratio(lacks, end_.at - before_.at);
    }();
    const double factor =
        elementary::exp(ratio(end_.value - wanted_, end_.value - last_.value) / std::max(power, least_power));
    return end_.at - lacks * factor;
  }
  if (first && !(last_.value > 0)) return 4 * last_.at;
  if (first && scale_ == Scale::linear) return last_.at * (wanted_ / last_.value);
  if (first) {
    const double by_power = elementary::pow(wanted_ / last_.value, usual_power);
    double factor = by_power;
    if (end_.value < unknown && last_.value < wanted_ && last_.at < end_.at) {
      // Between power and chord to the end, for an f that flattens near its end.
      const double chord = ratio(end_.value, last_.value) / ratio(end_.at, last_.at);
      const double by_chord = elementary::exp(ratio(wanted_, last_.value) / chord);
      factor = std::sqrt(by_power * std::max(by_power, by_chord));
    }
    return last_.at * std::clamp(factor, 1 / furthest, furthest);
  }
  if (scale_ == Scale::logarithmic && last_.value > 0 && before_.value > 0 && before_.at > 0 &&
      !bends_as_a_line()) {
    const double power = ratio(last_.value, before_.value) / ratio(last_.at, before_.at);
    const double factor = elementary::exp(ratio(wanted_, last_.value) / std::max(power, least_power));
    return last_.at * std::clamp(factor, 1 / furthest, furthest);
  }
  return last_.at + (wanted_ - last_.value) * (last_.at - before_.at) / (last_.value - before_.value);
}

bool BracketedSecant::bends_as_a_line() const {
  if (taken_ < 3 || !(earlier_.value > 0 && earlier_.at > 0) || earlier_.at == before_.at) return false;
  const auto ratio = [](double x, double y) { return elementary::log(x / y); };
  const double line = before_.value + (before_.value - earlier_.value) *
                                          ((last_.at - before_.at) / (before_.at - earlier_.at));
  const double power = ratio(before_.value, earlier_.value) / ratio(before_.at, earlier_.at);
  const double curve = before_.value * elementary::exp(power * ratio(last_.at, before_.at));
  return std::abs(line - last_.value) < std::abs(curve - last_.value);
}

double BracketedSecant::width() const {
  return scale_ == Scale::logarithmic && low_.at > 0 ? elementary::log(high_.at / low_.at)
                                                     : high_.at - low_.at;
}

double BracketedSecant::part_of_the_way(double share) const {
  if (scale_ == Scale::linear) return low_.at + share * (high_.at - low_.at);
  const double from = low_.at > 0 ? low_.at : high_.at / furthest;
  return from * elementary::exp(share * elementary::log(high_.at / from));
}

double BracketedSecant::chord() const {
  double share = 0.5;
  if (high_.value < unknown && scale_ == Scale::linear)
    share = (wanted_ - low_.value) / (high_.value - low_.value);
  else if (high_.value < unknown && low_.value > 0)
    share = elementary::log(wanted_ / low_.value) / elementary::log(high_.value / low_.value);
  return part_of_the_way(std::clamp(share, off_the_ends, 1 - off_the_ends));
}

std::optional<double> BracketedSecant::next() {
  double place = secant();
  if (!std::isfinite(high_.at)) {
    if (short_of_it_ > few_short && place > last_.at)
      place = last_.at + std::ldexp(place - last_.at, short_of_it_ - few_short);
    if (!holds(place)) place = 2 * std::max(low_.at, last_.at);
    place = std::min(place, furthest * last_.at);
    return holds(place) ? std::optional(place) : std::nullopt;
  }
  const double width = this->width();
  const bool gains = std::abs(last_.value - wanted_) < enough_gain * std::abs(before_.value - wanted_);
  slow_ = width > 0.5 * width_ && !gains ? slow_ + 1 : 0;
  width_ = width;
  if (slow_ > slow_steps)
    place = part_of_the_way(0.5);
  else if (!holds(place))
    place = chord();
  if (slow_ > slow_steps) slow_ = 0;
  return holds(place) ? std::optional(place) : std::nullopt;
}

}  // namespace asperity
