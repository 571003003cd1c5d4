// SPDX-License-Identifier: GPL-3.0-or-later
// Files of unknown format: each reader is asked whether it recognises the bytes, before one reads them.
#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"
#include "tests/fuzz/height_map.hpp"

static void fuzz_any_file(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.name = "input.txt"});
}

static const asperity::fuzz::Target any_file_target{"any_file", fuzz_any_file,
                                                    [] { asperity::hdf5_checksums_are_compared = false; }};
