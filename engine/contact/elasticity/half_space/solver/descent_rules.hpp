// SPDX-License-Identifier: GPL-3.0-or-later
// When a descent that settles which nodes are free gives a direction up: the same alone and over ranks.
#pragma once

namespace asperity::descent_rules {

inline constexpr double richardson_step = 0.65;  // of the preconditioner, where a pass settles
inline constexpr int passes_without_gain = 4;
inline constexpr double slow = 0.7;  // a pass that leaves more than this of the best residual is slow
inline constexpr int slow_passes = 2;
inline constexpr double jump = 10;  // a pass whose residual is so many times the one before has gone back
inline constexpr int jumps_in_a_cycle = 2;
inline constexpr int most_renewals = 50;

}  // namespace asperity::descent_rules
