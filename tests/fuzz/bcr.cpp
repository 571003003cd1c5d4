// SPDX-License-Identifier: GPL-3.0-or-later
// Image Metrology's files: a header in text whose counts and units need not be those of what follows.
#include "tests/fuzz/height_map.hpp"

static void fuzz_bcr(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "bcr"});
}

static const asperity::fuzz::Target bcr_target{"bcr", fuzz_bcr};
