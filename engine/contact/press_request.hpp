// SPDX-License-Identifier: GPL-3.0-or-later
// One press of a contact: which quantity is prescribed, its value, and how long the load dwells.
#pragma once

#include <optional>
#include <string_view>

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
  // Of bodies that attract each other: pressed to this first, in the same quantity, and drawn back from
  // there.
  std::optional<double> drawn_from{};
};

// The script key: "pressure", "load", …
std::string_view name(PressBy by);

// Throws Error{bad_value} naming the key when the value is not finite, or negative where bodies do not
// attract each other; when `flatten` is above 1, or `dwell` is negative; and for `drawn_from` where nothing
// attracts or below the value.
void check(const PressRequest& request, bool attracts = false);

}  // namespace asperity
