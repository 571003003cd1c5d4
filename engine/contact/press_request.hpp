// SPDX-License-Identifier: GPL-3.0-or-later
// One press of a contact: which quantity is prescribed, its value, and how long the load dwells.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace asperity {

enum class PressBy {
  pressure,     // Pa, load over nominal area
  load,         // N, on the whole tile
  approach,     // m, from first touch
  indentation,  // approach over the peak-to-valley of the combined heights as placed
  flatten,      // fraction by which peak-to-valley under load has fallen, 0 … 1
};

struct PressRequest {
  PressBy by = PressBy::pressure;
  double value = 0;               // zero leaves the bodies just touching, with no contact
  std::optional<double> dwell{};  // s; read by creep alone, so without that effect it changes nothing
  // Bodies that attract each other have a history: the values of the same quantity at which the direction of
  // the press was reversed before this one, in their order. Empty for bodies that come together from apart.
  std::vector<double> preload{};
};

// The script key: "pressure", "load", …
std::string_view name(PressBy by);

// Throws Error{bad_value} naming the key for numbers that no contact could take: a value that is not finite,
// `flatten` outside 0 … 1, a negative `dwell`.
void check_numbers(const PressRequest& request);
// Throws as check_numbers; also for a negative value and for `preload` where nothing attracts the bodies, for
// `flatten` where something does, and for a single `preload` below the value.
void check(const PressRequest& request, bool attracts = false);
// Throws Error{bad_value} for `indentation` and `flatten` of heights that are all equal.
void check_fraction(const PressRequest& request, double peak_to_valley);

// The preload of a press to `value` after presses to `visited`, in their order: the greatest value, the least
// after it, the greatest after that, … A press past an earlier reversal wipes it out, because the branches of
// a contact are monotone (return-point memory; Sethna et al. 1993). O(n²) at most.
std::vector<double> turns_before(std::span<const double> visited, double value);

}  // namespace asperity
