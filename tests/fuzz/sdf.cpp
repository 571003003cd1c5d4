// SPDX-License-Identifier: GPL-3.0-or-later
// ISO 25178-71, text and binary: counts and types may contradict the data.
#include "tests/fuzz/height_map.hpp"

static void fuzz_sdf(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "sdf"});
}

static const asperity::fuzz::Target sdf_target{"sdf", fuzz_sdf};
