// SPDX-License-Identifier: GPL-3.0-or-later
// UTF-8 from UTF-16 (spreadsheets' "Unicode text") and one-byte encodings (older loggers).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// By a byte-order mark, or zeros in every other byte.
bool is_utf16(std::string_view bytes);
// Nothing for other bytes. Unpaired surrogates become U+FFFD.
std::optional<std::string> utf8_of_utf16(std::string_view bytes);

// Valid UTF-8 is unchanged; other bytes are Windows-1252.
std::string utf8_or_cp1252(std::string_view text);

}  // namespace asperity
