// SPDX-License-Identifier: GPL-3.0-or-later
// Shape and type of the text header may contradict the data.
#include "tests/fuzz/height_map.hpp"

static void fuzz_npy(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "npy"});
}

static const asperity::fuzz::Target npy_target{"npy", fuzz_npy};
