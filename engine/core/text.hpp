// SPDX-License-Identifier: GPL-3.0-or-later
// Text helpers for errors and reports: numbers, quoted names, "did you mean".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// Shortest text with the same double ("0.1", "1e-06", "inf", "nan").
std::string format_exact(double value);
// At most `digits` significant digits, no trailing zeros ("0.0412", "1.23e+09").
std::string format_short(double value, int digits = 6);
// "12.5 MiB", four digits.
std::string format_bytes(std::int64_t bytes);
// "`name`".
std::string quoted(std::string_view name);
// Otherwise std::quoted is found where <iomanip> is included.
std::string quoted(const std::string& name);
inline std::string quoted(std::string& name) { return quoted(std::string_view(name)); }
inline std::string quoted(const char* name) { return quoted(std::string_view(name)); }
// Keeps letters, digits, `_`, `.` and non-ASCII characters; other runs become one `-`. No leading dot or `-`,
// no trailing `-`, at most 120 bytes, never empty.
std::string safe_file_name(std::string_view text);
// "a", "a or b", "a, b or c".
std::string joined(std::span<const std::string> items, std::string_view last = " or ");

// Bytes of an incomplete UTF-8 character at the end, 0 to 3.
std::size_t unfinished_bytes(std::string_view text);

// Replaces control characters (except tabs and line ends) and invalid UTF-8 by '?'. Linear.
std::string plain_text(std::string text);

std::string without_traceback(const std::string& message);

// By edit distance, ignoring case, a transposition counting 1; empty if none is near.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);
// " (did you mean `x`?)" or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

// None for other text or beyond 64 bits.
std::optional<std::uint64_t> count_in(std::string_view text);

}  // namespace asperity
