// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/height_map.hpp"

static void fuzz_text_matrix(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "text"});
}

static const asperity::fuzz::Target text_matrix_target{"text_matrix", fuzz_text_matrix};
