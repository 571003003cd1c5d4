// SPDX-License-Identifier: GPL-3.0-or-later
// Heights that took a generator over a second to make, taken up from the store of the run where the same ones
// were made before. What is quicker is made again: that costs less than a file.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct MadeHeights {
  Field heights;
  double scale = 1;  // a number that the generator found on the way and needs again
};

// `key` holds everything that the heights depend on; it is asked for only where there is a store.
MadeHeights recall_or_make(std::string_view generator, const std::function<std::string()>& key,
                           Monitor& monitor, const std::function<MadeHeights()>& make);

}  // namespace asperity
