// SPDX-License-Identifier: GPL-3.0-or-later
// Reuses heights from the run's store if they took over a second.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct MadeHeights {
  Field heights;
  double scale = 1;  // a number from the generator
};

// `key`: all inputs; called only with a store.
MadeHeights recall_or_make(std::string_view generator, const std::function<std::string()>& key,
                           Monitor& monitor, const std::function<MadeHeights()>& make);

}  // namespace asperity
