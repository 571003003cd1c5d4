// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// A name or sentence of the language, valid until the process ends. A literal is constant data without
// constructor code. A composed text is stored once.
struct StaticText : std::string_view {
  constexpr StaticText(const char* literal = "") : std::string_view(literal) {}
  StaticText(const std::string& composed);
  const char* c_str() const { return data(); }
  operator std::string() const { return std::string(begin(), end()); }
};
template <class Left, class Right>
requires(std::same_as<Left, StaticText> || std::same_as<Right, StaticText>) std::string operator+(
    const Left& left, const Right& right) {
  return std::string(left).append(right);
}

// Shortest text with the same double ("1e-06", "inf", "nan").
std::string format_exact(double value);
// At most `digits` significant digits, no trailing zeros.
std::string format_short(double value, int digits = 6);
// "12.5 MiB", four digits.
std::string format_bytes(std::int64_t bytes);
std::string lower_case(std::string_view text);
std::string hexadecimal(std::span<const unsigned char> bytes);
// "`name`".
std::string quoted(std::string_view name);
// Otherwise <iomanip> makes std::quoted the match.
inline std::string quoted(const std::string& name) { return quoted(std::string_view(name)); }
inline std::string quoted(std::string& name) { return quoted(std::string_view(name)); }
inline std::string quoted(const char* name) { return quoted(std::string_view(name)); }
// Keeps letters, digits, `_`, `.` and non-ASCII characters; other runs become one `-`. At most 120 bytes,
// never empty.
std::string safe_file_name(std::string_view text);
// "1 row", "3 rows".
std::string counted(std::size_t count, const std::string& one);
// "a", "a or b", "a, b or c".
std::string joined(std::span<const std::string> items, std::string_view last = " or ");

// Bytes of the first UTF-8 character; 0: invalid.
std::size_t utf8_bytes(std::string_view text);
std::size_t characters_of(std::string_view text);
// Columns, two blanks apart; `right` aligns all but the first column to the right. Every line begins with a
// line end.
using TextLine = std::vector<std::string>;
std::string aligned(const std::vector<TextLine>& lines, bool right = false);
// Bytes of an incomplete UTF-8 character at the end, 0 to 3.
std::size_t unfinished_bytes(std::string_view text);

// Replaces control characters (except tabs and line ends) and invalid UTF-8 by '?'. Linear.
std::string plain_text(std::string text);
// In quotes: at most `longest` bytes, '?' for unprintable characters.
std::string shown(std::string_view text, std::size_t longest = 24);

std::string without_traceback(const std::string& message);

// By edit distance, ignoring case; empty if none is near.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);
// " (did you mean `x`?)" or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

// None for other text or beyond 64 bits.
std::optional<std::uint64_t> count_in(std::string_view text);

}  // namespace asperity
