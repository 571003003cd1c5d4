// SPDX-License-Identifier: GPL-3.0-or-later
// Digital Surf: sizes, zones and units may be wrong; compressed heights expand up to 1032 times.
#include "tests/fuzz/height_map.hpp"

static void fuzz_sur(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  const std::string_view bytes = view(data, size);
  if (bytes.starts_with("DSCOMPRESSED")) {
    read_every_way(bytes, {.format = "sur",
                           .bytes_per_byte = 1032 * 16,
                           .beside = std::size_t{1} << 20,
                           .fill = asperity::HoleFill::with(0)});
  } else {
    read_every_way(bytes, {.format = "sur"});
  }
}

static const asperity::fuzz::Target sur_target{"sur", fuzz_sur};
