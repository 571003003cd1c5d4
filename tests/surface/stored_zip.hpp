// SPDX-License-Identifier: GPL-3.0-or-later
// Uncompressed zip archives with arbitrary headers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::testing {

inline std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 0xFF);
  return text;
}

inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

// `claimed`: stated size of entry 1.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& entries,
                          std::optional<std::uint64_t> claimed = {}, int method = 0) {
  std::string body, directory;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto& [name, bytes] = entries[k];
    const std::uint64_t size = k == 1 && claimed ? *claimed : bytes.size();
    const int packed = k == 1 ? method : 0;
    const std::string common = little(20, 2) + little(0, 2) + little(static_cast<std::uint64_t>(packed), 2) +
                               little(0, 2) + little(33, 2) + little(crc32(bytes), 4) +
                               little(bytes.size(), 4) + little(size, 4) + little(name.size(), 2) +
                               little(0, 2);
    directory += "PK\x01\x02" + little(20, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(0, 4) + little(body.size(), 4) + name;
    body += "PK\x03\x04" + common + name + bytes;
  }
  return body + directory + "PK\x05\x06" + little(0, 4) + little(entries.size(), 2) +
         little(entries.size(), 2) + little(directory.size(), 4) + little(body.size(), 4) + little(0, 2);
}

}  // namespace asperity::testing
