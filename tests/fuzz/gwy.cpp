// SPDX-License-Identifier: GPL-3.0-or-later
// Gwyddion: nested objects with wrong lengths and counts.
#include "tests/fuzz/height_map.hpp"

static void fuzz_gwy(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "gwy"});
}

static const asperity::fuzz::Target gwy_target{"gwy", fuzz_gwy};
