// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_reader/hdf5_bytes.hpp"

#include <array>
#include <bit>

namespace asperity {

std::string_view Hdf5Bytes::piece(std::uint64_t at, std::uint64_t length, const char* what) const {
  if (at > bytes.size() || length > bytes.size() - at)
    refuse("has " + std::string(what) + " past its end: " + std::to_string(length) + " bytes at " +
               std::to_string(at) + " of " + std::to_string(bytes.size()),
           "the file is cut short or damaged");
  return bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(length));
}

void Hdf5Bytes::refuse(const std::string& finding, const std::string& hint) const {
  refuse_file(file, finding, hint);
}

std::uint64_t Hdf5Cursor::number(int width) {
  const std::string_view raw = take(static_cast<std::uint64_t>(width));
  std::uint64_t value = 0;
  for (std::size_t k = raw.size(); k-- > 0;) value = value << 8 | static_cast<unsigned char>(raw[k]);
  return value;
}

std::string_view Hdf5Cursor::take(std::uint64_t count) {
  if (count > left()) refuse("ends too soon");
  const std::string_view taken = piece_.substr(at_, static_cast<std::size_t>(count));
  at_ += taken.size();
  return taken;
}

bool Hdf5Cursor::starts_with(std::string_view mark) {
  if (piece_.substr(at_, mark.size()) != mark) return false;
  at_ += mark.size();
  return true;
}

void Hdf5Cursor::refuse(const std::string& finding) const {
  file_.refuse("is damaged: " + std::string(what_) + " " + finding, "the file was cut short or altered");
}

bool is_nowhere(const Hdf5Bytes& file, std::uint64_t address) {
  return address == (~std::uint64_t{0} >> (64 - 8 * file.address_width));
}

std::uint32_t lookup3(std::string_view bytes) {
  std::uint32_t a = 0xdeadbeefU + static_cast<std::uint32_t>(bytes.size());
  std::uint32_t b = a, c = a;
  if (bytes.empty()) return c;
  const auto add = [](std::uint32_t& word, std::string_view part) {
    for (std::size_t k = 0; k < part.size() && k < 4; ++k)
      word += static_cast<std::uint32_t>(static_cast<unsigned char>(part[k])) << (8 * k);
  };
  const auto add_twelve = [&](std::string_view part) {
    add(a, part);
    if (part.size() > 4) add(b, part.substr(4));
    if (part.size() > 8) add(c, part.substr(8));
  };
  const auto turn = [](std::uint32_t& x, std::uint32_t& y, std::uint32_t& z, int bits) {
    x = (x - z) ^ std::rotl(z, bits);
    z += y;
  };
  while (bytes.size() > 12) {
    add_twelve(bytes);
    turn(a, b, c, 4);
    turn(b, c, a, 6);
    turn(c, a, b, 8);
    turn(a, b, c, 16);
    turn(b, c, a, 19);
    turn(c, a, b, 4);
    bytes.remove_prefix(12);
  }
  add_twelve(bytes);
  const auto close = [](std::uint32_t& x, std::uint32_t y, int bits) { x = (x ^ y) - std::rotl(y, bits); };
  close(c, b, 14);
  close(a, c, 11);
  close(b, a, 25);
  close(c, b, 16);
  close(a, c, 4);
  close(b, a, 14);
  close(c, b, 24);
  return c;
}

}  // namespace asperity
