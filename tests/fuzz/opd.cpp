// SPDX-License-Identifier: GPL-3.0-or-later
// Wyko's files: a directory of blocks whose lengths may overlap the end, and blocks of the wrong kind.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "opd"});
  return 0;
}
