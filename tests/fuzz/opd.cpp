// SPDX-License-Identifier: GPL-3.0-or-later
// Wyko: a directory of blocks with wrong lengths and kinds.
#include "tests/fuzz/height_map.hpp"

static void fuzz_opd(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "opd"});
}

static const asperity::fuzz::Target opd_target{"opd", fuzz_opd};
