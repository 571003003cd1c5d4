// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <exception>

namespace asperity::cli {

inline constexpr int done = 0, failed = 1, bad_usage = 2;
inline constexpr int cases_missing = 3;    // cases of other processes are missing in the store
inline constexpr int another_version = 3;  // recorded the replayed run

// Prints the error.
inline int refused(const std::exception& error) {
  std::fprintf(stderr, "asperity: %s\n", error.what());
  return bad_usage;
}

}  // namespace asperity::cli
