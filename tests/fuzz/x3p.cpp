// SPDX-License-Identifier: GPL-3.0-or-later
// X3P files as they lie on the disk: a zip archive whose directory, sizes and checksums may lie. Deflate
// makes up to 1032 bytes of one, and two of those a height. See x3p_parts.cpp for what is in the archive.
#include "tests/fuzz/height_map.hpp"

static void fuzz_x3p(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "x3p",
                                    .bytes_per_byte = 1032 * 16,
                                    .beside = std::size_t{48} << 20,
                                    .fill = asperity::HoleFill::with(0)});
}

static const asperity::fuzz::Target x3p_target{"x3p", fuzz_x3p};
