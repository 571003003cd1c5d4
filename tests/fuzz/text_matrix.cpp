// SPDX-License-Identifier: GPL-3.0-or-later
// Text matrices with their headers, decimal commas, comments and missing cells.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "text"});
  return 0;
}
