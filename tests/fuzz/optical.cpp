// SPDX-License-Identifier: GPL-3.0-or-later
// MetroPro, PLU, AL3D, NMS and FRT, selected by the first byte.
#include <array>

#include "tests/fuzz/height_map.hpp"

static void fuzz_optical(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  constexpr std::array formats{"metropro", "plu", "al3d", "nms", "frt"};
  if (size < 2) return;
  const std::string_view format = formats[data[0] % formats.size()];
  read_every_way(view(data + 1, size - 1), {.format = std::string(format)});
}

static const asperity::fuzz::Target optical_target{"optical", fuzz_optical};
