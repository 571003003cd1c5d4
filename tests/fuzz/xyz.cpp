// SPDX-License-Identifier: GPL-3.0-or-later
// x y z triples, whose coordinates have to make a lattice.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "xyz"});
  return 0;
}
