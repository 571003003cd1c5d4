// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/height_map.hpp"

static void fuzz_nid(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "nid"});
}

static const asperity::fuzz::Target nid_target{"nid", fuzz_nid};
