// SPDX-License-Identifier: GPL-3.0-or-later
// The content of an X3P archive, packed with right checksums. Input: main.xml, a zero byte, the number of
// valid-point bytes (two bytes, little-endian), these bytes, the points.
#include "tests/fuzz/height_map.hpp"
#include "tests/surface/stored_zip.hpp"

static void fuzz_x3p_parts(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  const std::string_view input = view(data, size);
  const std::size_t end = std::min(input.find('\0'), size);
  std::string_view rest = input.substr(std::min(end + 1, size));
  std::size_t valid = 0;
  if (rest.size() >= 2) {
    valid = static_cast<unsigned char>(rest[0]) |
            static_cast<std::size_t>(static_cast<unsigned char>(rest[1])) << 8;
    rest.remove_prefix(2);
  }
  const std::string archive =
      asperity::testing::zip_of({{"main.xml", std::string(input.substr(0, end))},
                                 {"points", std::string(rest.substr(std::min(valid, rest.size())))},
                                 {"valid", std::string(rest.substr(0, valid))}});
  read_every_way(archive, {.format = "x3p"});
}

static const asperity::fuzz::Target x3p_parts_target{"x3p_parts", fuzz_x3p_parts};
