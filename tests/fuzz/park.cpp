// SPDX-License-Identifier: GPL-3.0-or-later
// Park TIFFs: tags may point anywhere.
#include "tests/fuzz/height_map.hpp"

static void fuzz_park(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "park"});
}

static const asperity::fuzz::Target park_target{"park", fuzz_park};
