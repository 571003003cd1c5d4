// SPDX-License-Identifier: GPL-3.0-or-later
// Image Metrology: counts and units of the text header may contradict the data.
#include "tests/fuzz/height_map.hpp"

static void fuzz_bcr(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "bcr"});
}

static const asperity::fuzz::Target bcr_target{"bcr", fuzz_bcr};
