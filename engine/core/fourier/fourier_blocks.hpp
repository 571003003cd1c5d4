// SPDX-License-Identifier: GPL-3.0-or-later
// Loops of 2-D transforms. Private to this folder.
#pragma once

#include <cstdint>

namespace asperity {

constexpr std::int64_t block_count(int items, int block) {
  return (static_cast<std::int64_t>(items) + block - 1) / block;
}

// For fewer nodes, waking a helper does not pay.
inline constexpr std::int64_t nodes_worth_sharing = 64 * 64;

}  // namespace asperity
