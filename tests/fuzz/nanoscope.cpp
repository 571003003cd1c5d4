// SPDX-License-Identifier: GPL-3.0-or-later
// Offsets, lengths and sensitivities in a text header.
#include "tests/fuzz/height_map.hpp"

static void fuzz_nanoscope(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "nanoscope"});
}

static const asperity::fuzz::Target nanoscope_target{"nanoscope", fuzz_nanoscope};
