// SPDX-License-Identifier: GPL-3.0-or-later
// Surface data files (ISO 25178-71) in text and in bytes: a header whose counts and types need not be those
// of what follows.
#include "tests/fuzz/height_map.hpp"

static void fuzz_sdf(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "sdf"});
}

static const asperity::fuzz::Target sdf_target{"sdf", fuzz_sdf};
