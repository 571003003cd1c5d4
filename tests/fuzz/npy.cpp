// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy arrays: a header in text whose shape and type need not be those of the bytes after it.
#include "tests/fuzz/height_map.hpp"

static void fuzz_npy(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "npy"});
}

static const asperity::fuzz::Target npy_target{"npy", fuzz_npy};
