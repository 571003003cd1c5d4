// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy arrays: a header in text whose shape and type need not be those of the bytes after it.
#include "tests/fuzz/height_map.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "npy"});
  return 0;
}
