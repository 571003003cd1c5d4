// SPDX-License-Identifier: GPL-3.0-or-later
// Truncated, wrong or greatly expanding streams. Output limit: 16 MiB or 128 bytes per byte; memory: a
// multiple.
#include "tests/fuzz/height_map.hpp"

static void fuzz_gzip(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.name = "input.txt.gz",
                                    .bytes_per_byte = 1032 * 64,
                                    .beside = std::size_t{64} << 20,
                                    .fill = asperity::HoleFill::with(0)});
}

static const asperity::fuzz::Target gzip_target{"gzip", fuzz_gzip};
