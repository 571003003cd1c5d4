// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/height_map.hpp"

static void fuzz_xyz(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "xyz"});
}

static const asperity::fuzz::Target xyz_target{"xyz", fuzz_xyz};
