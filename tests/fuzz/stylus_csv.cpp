// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/height_map.hpp"

static void fuzz_stylus_csv(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  read_every_way(view(data, size), {.format = "stylus-csv"});
}

static const asperity::fuzz::Target stylus_csv_target{"stylus_csv", fuzz_stylus_csv};
