// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong directories, sizes and checksums of the zip archive (content: x3p_parts.cpp). Deflate expands up to
// 1032 times; two bytes make a height.
#include "tests/fuzz/height_map.hpp"

static void fuzz_x3p(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "x3p",
                                    .bytes_per_byte = 1032 * 16,
                                    .beside = std::size_t{48} << 20,
                                    .fill = asperity::HoleFill::with(0)});
}

static const asperity::fuzz::Target x3p_target{"x3p", fuzz_x3p};
