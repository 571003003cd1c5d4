// SPDX-License-Identifier: GPL-3.0-or-later
// MI images: several buffers in a header of fixed columns.
#include "tests/fuzz/height_map.hpp"

static void fuzz_mi(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "mi"});
}

static const asperity::fuzz::Target mi_target{"mi", fuzz_mi};
