// SPDX-License-Identifier: GPL-3.0-or-later
// Nested containers, lengths of one, two and four bytes.
#include "tests/fuzz/height_map.hpp"

static void fuzz_opdx(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "opdx"});
}

static const asperity::fuzz::Target opdx_target{"opdx", fuzz_opdx};
