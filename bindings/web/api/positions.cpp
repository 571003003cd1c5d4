// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/positions.hpp"

#include <algorithm>

namespace asperity::web {

namespace {

// Units of UTF-16 that the character which this byte begins takes; none for a byte inside one.
std::size_t units_of(char byte) {
  const auto bits = static_cast<unsigned char>(byte);
  return (bits & 0xC0) == 0x80 ? 0 : bits >= 0xF0 ? 2 : 1;
}

}  // namespace

std::size_t byte_of_unit(std::string_view text, std::size_t unit) {
  std::size_t before = 0, begin = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::size_t units = units_of(text[k]);
    if (units == 0) continue;
    begin = k;
    if (before + units > unit) return begin;
    before += units;
  }
  return text.size();
}

std::size_t unit_of_byte(std::string_view text, std::size_t byte) {
  std::size_t units = 0;
  for (std::size_t k = 0; k < std::min(byte, text.size()); ++k) units += units_of(text[k]);
  return units;
}

}  // namespace asperity::web
