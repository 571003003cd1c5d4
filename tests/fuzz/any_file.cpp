// SPDX-License-Identifier: GPL-3.0-or-later
// Files of unknown format: each reader is asked whether it recognises the bytes, before one reads them.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.name = "input.txt"});
  return 0;
}
