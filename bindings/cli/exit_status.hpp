// SPDX-License-Identifier: GPL-3.0-or-later
// What the program's exit status says.
#pragma once

namespace asperity::cli {

inline constexpr int done = 0, failed = 1, bad_usage = 2;
inline constexpr int cases_missing = 3;    // in the store that other processes fill
inline constexpr int another_version = 3;  // recorded the replayed run

}  // namespace asperity::cli
