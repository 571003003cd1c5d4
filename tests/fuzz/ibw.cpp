// SPDX-License-Identifier: GPL-3.0-or-later
// Igor binary waves: inconsistent lengths and dimensions under a corrected header checksum.
#include "tests/fuzz/height_map.hpp"

static void fuzz_ibw(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  std::string bytes(view(data, size));
  constexpr std::size_t headers = 384;
  if (bytes.size() >= headers) {
    unsigned sum = 0;
    bytes[2] = bytes[3] = 0;
    for (std::size_t k = 0; k < headers; k += 2)
      sum += static_cast<unsigned char>(bytes[k]) + 256U * static_cast<unsigned char>(bytes[k + 1]);
    sum = 0U - sum;
    bytes[2] = static_cast<char>(sum & 0xFFU);
    bytes[3] = static_cast<char>(sum >> 8 & 0xFFU);
  }
  read_every_way(bytes, {.format = "ibw"});
}

static const asperity::fuzz::Target ibw_target{"ibw", fuzz_ibw};
