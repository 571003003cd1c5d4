// SPDX-License-Identifier: GPL-3.0-or-later
// Digital Surf's files: a header of 512 bytes whose sizes, zones and units need not be those of what follows.
#include "tests/fuzz/height_map.hpp"

static void fuzz_sur(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "sur"});
}

static const asperity::fuzz::Target sur_target{"sur", fuzz_sur};
