// SPDX-License-Identifier: GPL-3.0-or-later
// What the program's exit status says.
#pragma once

namespace asperity::cli {

inline constexpr int done = 0, failed = 1, bad_usage = 2;

}  // namespace asperity::cli
