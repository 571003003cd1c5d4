// SPDX-License-Identifier: GPL-3.0-or-later
// Text that is not UTF-8: UTF-16, as spreadsheets save "Unicode text", and one byte a character, as older
// loggers write a degree sign or an umlaut.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// Whether bytes begin as UTF-16: with a byte-order mark, or without one where every other byte is zero, as in
// a text of a European language.
bool is_utf16(std::string_view bytes);
// Such bytes as UTF-8; nothing for any other bytes. Halves of a pair that stand alone become U+FFFD.
std::optional<std::string> utf8_of_utf16(std::string_view bytes);

// A short text as UTF-8: unchanged where it is UTF-8, else each byte is a character of Windows-1252, which is
// Latin-1 with dashes, quotes and the euro sign in place of control characters.
std::string utf8_or_cp1252(std::string_view text);

}  // namespace asperity
