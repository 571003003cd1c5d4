// SPDX-License-Identifier: GPL-3.0-or-later
// Small helpers for the sentences of errors and reports: numbers as a person writes them, quoted
// names, and the nearest legal name for "did you mean".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// Shortest text that reads back as the same double ("0.1", "1e-06", "inf", "nan").
std::string format_exact(double value);
// At most `digits` significant digits, no trailing zeros ("0.0412", "1.23e+09").
std::string format_short(double value, int digits = 6);
// "12.5 MiB", four digits.
std::string format_bytes(std::int64_t bytes);
// "`name`".
std::string quoted(std::string_view name);
// The same; without these std::quoted would be found for a std::string wherever <iomanip> is included.
std::string quoted(const std::string& name);
inline std::string quoted(std::string& name) { return quoted(std::string_view(name)); }
inline std::string quoted(const char* name) { return quoted(std::string_view(name)); }
// A file name for any text: letters, digits, `_`, `.` and characters beyond ASCII stay, each run of others
// becomes one `-`; no dot or `-` in front, no `-` at the end, at most 120 bytes, never empty.
std::string safe_file_name(std::string_view text);
// "a", "a or b", "a, b or c".
std::string joined(std::span<const std::string> items, std::string_view last = " or ");

// Bytes at the end that begin a character of UTF-8 and do not finish it, 0 to 3.
std::size_t unfinished_bytes(std::string_view text);

// The text as any terminal shows it: control characters other than tabs and line ends, and bytes that are
// not UTF-8, become question marks. Linear in its length.
std::string plain_text(std::string text);

// The message of a script that failed, without the traceback below it.
std::string without_traceback(const std::string& message);

// The candidate nearest to `name` by edit distance (a transposition counts one, case does not
// count), if it is near enough to be a likely slip; otherwise empty.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);
// " (did you mean `x`?)" or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

// The number that a text of decimal digits alone is; none for every other text and past 64 bits.
std::optional<std::uint64_t> count_in(std::string_view text);

}  // namespace asperity
