// SPDX-License-Identifier: GPL-3.0-or-later
// Traces of stylus profilers: a header of keys, then positions and heights.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "stylus-csv"});
  return 0;
}
