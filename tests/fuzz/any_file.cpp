// SPDX-License-Identifier: GPL-3.0-or-later
// Files of unknown format: each reader is asked whether it recognises the bytes, before one reads them.
#include "engine/surface/io/hdf5_objects.hpp"
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerInitialize(int*, char***) {
  asperity::hdf5_checksums_are_compared = false;
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.name = "input.txt"});
  return 0;
}
