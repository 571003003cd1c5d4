// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/text_encoding.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/text.hpp"

namespace asperity {

namespace {

enum class ByteOrder { little, big };

std::optional<ByteOrder> utf16_order(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return ByteOrder::little;
  if (bytes.starts_with("\xFE\xFF")) return ByteOrder::big;
  constexpr std::size_t looked_at = 16;
  if (bytes.size() < looked_at) return {};
  for (const std::size_t zero : {std::size_t{1}, std::size_t{0}}) {
    bool found = true;
    for (std::size_t k = 0; k < looked_at; ++k) {
      const auto byte = static_cast<unsigned char>(bytes[k]);
      const bool letter = (byte >= 0x20 && byte < 0x7F) || byte == '\t' || byte == '\r' || byte == '\n';
      found = found && (k % 2 == zero ? byte == 0 : letter);
    }
    if (found) return zero == 1 ? ByteOrder::little : ByteOrder::big;
  }
  return {};
}

void append_utf8(std::string& text, std::uint32_t c) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  const int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
  constexpr std::uint32_t lead[] = {0, 0xC0, 0xE0, 0xF0};
  put(lead[more] | (c >> (6 * more)));
  for (int k = more; k-- > 0;) put(0x80 | ((c >> (6 * k)) & 0x3F));
}

}  // namespace

bool is_utf16(std::string_view bytes) { return utf16_order(bytes).has_value(); }

std::optional<std::string> utf8_of_utf16(std::string_view bytes) {
  const std::optional<ByteOrder> order = utf16_order(bytes);
  if (!order) return {};
  const auto unit = [&](std::size_t k) -> std::uint32_t {
    const auto first = static_cast<unsigned char>(bytes[2 * k]);
    const auto second = static_cast<unsigned char>(bytes[2 * k + 1]);
    return *order == ByteOrder::little ? first | (second << 8U) : second | (first << 8U);
  };
  const std::size_t units = bytes.size() / 2;
  std::string text;
  text.reserve(units);
  constexpr std::uint32_t mark = 0xFEFF, unknown = 0xFFFD;
  for (std::size_t k = 0; k < units; ++k) {
    std::uint32_t c = unit(k);
    if (k == 0 && c == mark) continue;
    if (c >= 0xD800 && c < 0xDC00 && k + 1 < units && unit(k + 1) >= 0xDC00 && unit(k + 1) < 0xE000) {
      c = 0x10000 + ((c - 0xD800) << 10) + (unit(k + 1) - 0xDC00);
      ++k;
    } else if (c >= 0xD800 && c < 0xE000) {
      c = unknown;
    }
    append_utf8(text, c);
  }
  return text;
}

std::string utf8_or_cp1252(std::string_view text) {
  constexpr std::uint32_t none = 0xFFFD, first = 0x80;
  static constexpr std::array<std::uint32_t, 32> from_first{
      0x20AC, none,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152, none,   0x017D, none,   none,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, none,   0x017E, 0x0178};
  bool utf8 = true;
  for (std::size_t k = 0; utf8 && k < text.size();) {
    const std::size_t length = utf8_bytes(text.substr(k));
    utf8 = length > 0;
    k += length;
  }
  if (utf8) return std::string(text);
  std::string converted;
  for (const char c : text) {
    const std::uint32_t byte = static_cast<unsigned char>(c);
    const bool special = byte >= first && byte < first + from_first.size();
    append_utf8(converted, special ? from_first[byte - first] : byte);
  }
  return converted;
}

}  // namespace asperity
