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

// A short text as UTF-8: as it is where it is that, else each byte taken for a character of Latin-1.
std::string utf8_or_latin1(std::string_view text);

}  // namespace asperity
