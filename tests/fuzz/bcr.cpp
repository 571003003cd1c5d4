// SPDX-License-Identifier: GPL-3.0-or-later
// Image Metrology's files: a header in text whose counts and units need not be those of what follows.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "bcr"});
  return 0;
}
