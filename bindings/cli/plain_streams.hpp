// SPDX-License-Identifier: GPL-3.0-or-later
// Standard streams without control characters. Messages repeat foreign text (file names, titles, script
// errors), whose control characters could change a terminal's title, overwrite lines, or send input as if
// typed. A plain stream replaces each control character, and bytes outside UTF-8, by a question mark
// (plain_text in engine/core/text.hpp). It replaces the C library's streams, and so covers the script's own
// output.
#pragma once

#include <string_view>

namespace asperity::cli {

enum class Keeps {
  text,     // characters, tabs, line ends
  colours,  // also carriage return, colour and weight
};

// Until the program ends. Not with libedit.
void make_errors_plain();
void make_output_plain(Keeps keeps);

// The only sequence written to standard error by the program.
inline constexpr std::string_view erase_line = "\r\033[K";
void erase_shown_line();

}  // namespace asperity::cli
