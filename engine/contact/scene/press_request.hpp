// SPDX-License-Identifier: GPL-3.0-or-later
// One press: prescribed quantity, value and dwell.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace asperity {

enum class PressBy {
  pressure,     // Pa, load over nominal area
  load,         // N on the tile
  approach,     // m, from first touch
  indentation,  // approach over peak-to-valley of the combined heights as placed
  flatten,      // relative fall of this peak-to-valley under load, 0 … 1
};

struct PressRequest {
  PressBy by = PressBy::pressure;
  double value = 0;               // zero: first touch, no contact
  std::optional<double> dwell{};  // s; used by creep only
  // Attracting bodies: earlier reversals of the prescribed quantity, in order. Empty: from apart.
  std::vector<double> preload{};

  bool by_load() const { return by == PressBy::pressure || by == PressBy::load; }
};

std::string_view name(PressBy by);

// Throws Error{bad_value} naming the key for non-finite values, `flatten` outside 0 … 1, negative `dwell`.
void check_numbers(const PressRequest& request);
// Throws as check_numbers, and for a negative value or `preload` without attraction, `flatten` with
// attraction, a single `preload` below the value.
void check(const PressRequest& request, bool attracts = false);
// Throws Error{bad_value} for `indentation` and `flatten` of equal heights.
void check_fraction(const PressRequest& request, double peak_to_valley);

// Preload for `value` after presses to `visited`: greatest value, least after it, greatest after the least, …
// A press past an earlier reversal erases it (return-point memory; Sethna et al. 1993). O(n²).
std::vector<double> turns_before(std::span<const double> visited, double value);

}  // namespace asperity
