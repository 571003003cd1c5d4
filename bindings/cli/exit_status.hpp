// SPDX-License-Identifier: GPL-3.0-or-later
// The program's exit statuses.
#pragma once

namespace asperity::cli {

inline constexpr int done = 0, failed = 1, bad_usage = 2;
inline constexpr int cases_missing = 3;  // in a shared store

}  // namespace asperity::cli
