// SPDX-License-Identifier: GPL-3.0-or-later
// How the loops of two-dimensional transforms are shared out. Included only by sources of this folder.
#pragma once

#include <cstdint>

namespace asperity {

// Blocks that hold all items.
constexpr std::int64_t block_count(int items, int block) {
  return (static_cast<std::int64_t>(items) + block - 1) / block;
}

// On fewer nodes, waking a helper costs more than it saves.
inline constexpr std::int64_t nodes_worth_sharing = 64 * 64;

}  // namespace asperity
