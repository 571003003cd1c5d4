// SPDX-License-Identifier: GPL-3.0-or-later
// Large tiles, whose loops have several blocks.
#include "engine/core/parallel.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

Verdict check(const Trial& trial, std::uint64_t) {
  const auto on = [&](int threads) {
    set_thread_count(threads);
    return pressed(trial);
  };
  const State one = on(1);
  for (const int threads : {2, 3, 8}) {
    const State many = on(threads);
    const bool same = many.digest() == one.digest() && many.energy() == one.energy() &&
                      many.residual() == one.residual() && many.stiffness() == one.stiffness();
    if (!same) {
      set_thread_count(1);
      return Broken{"threads change no bit", std::to_string(threads) + " threads"};
    }
  }
  set_thread_count(1);
  return {};
}

}  // namespace

const Family threads{"threads", {.most_cells = 160}, check, 100};

}  // namespace asperity::stability
