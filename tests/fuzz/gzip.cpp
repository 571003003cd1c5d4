// SPDX-License-Identifier: GPL-3.0-or-later
// Files packed with gzip: streams that are cut, that lie, and that unpack to much more than they are. What
// comes out is bounded by 16 MiB or 128 bytes a byte, and each of its readers by a multiple of that.
#include "tests/fuzz/height_map.hpp"

static void fuzz_gzip(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.name = "input.txt.gz",
                                    .bytes_per_byte = 1032 * 64,
                                    .beside = std::size_t{64} << 20,
                                    .fill = asperity::HoleFill::with(0)});
}

static const asperity::fuzz::Target gzip_target{"gzip", fuzz_gzip};
