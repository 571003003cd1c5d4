// SPDX-License-Identifier: GPL-3.0-or-later
// Shared constants.
#pragma once

#include <limits>
#include <numbers>

namespace asperity {

inline constexpr double pi = std::numbers::pi, two_pi = 2 * pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace asperity
