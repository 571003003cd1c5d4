// SPDX-License-Identifier: GPL-3.0-or-later
// Unknown formats: every reader examines the bytes before one reads them. Unpacking expands up to 1032
// times.
#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"
#include "tests/fuzz/height_map.hpp"

static void fuzz_any_file(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  const std::string_view bytes = view(data, size);
  if (bytes.starts_with("\x1F\x8B") || bytes.starts_with("DSCOMPRESSED")) {
    read_every_way(bytes, {.name = "input.txt",
                           .bytes_per_byte = 1032 * 64,
                           .beside = std::size_t{64} << 20,
                           .fill = asperity::HoleFill::with(0)});
  } else {
    read_every_way(bytes, {.name = "input.txt"});
  }
}

static const asperity::fuzz::Target any_file_target{"any_file", fuzz_any_file,
                                                    [] { asperity::hdf5_checksums_are_compared = false; }};
