// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers an option accepts, in the words of its error and of the reference page.
#pragma once

#include <limits>
#include <string>

#include "engine/core/quantity.hpp"

namespace asperity {

// NaN never passes; an infinity only where `never` allows it.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool never = false;
  // math.huge is accepted and means "never".
  constexpr NumberRange or_never() const {
    NumberRange r = *this;
    r.never = true;
    return r;
  }
  bool contains(double value) const;
  // "above 0", "from 2 to 3"; "" for any.
  std::string text(Dimension dimension) const;
  // "a length above 0, e.g. \"250 um\""; `finite`: says so, of a value whose one fault that is.
  std::string wanted(Dimension dimension, bool finite = false) const;
};
constexpr NumberRange any() { return {}; }
constexpr NumberRange above(double low) {
  return {low, std::numeric_limits<double>::infinity(), true, false, false};
}
constexpr NumberRange at_least(double low) {
  return {low, std::numeric_limits<double>::infinity(), false, false, false};
}
constexpr NumberRange between(double low, double high) { return {low, high, false, false, false}; }
constexpr NumberRange inside(double low, double high) { return {low, high, true, true, false}; }

}  // namespace asperity
