// SPDX-License-Identifier: GPL-3.0-or-later
// Standard streams without control characters. Messages repeat foreign text: file names, titles, errors of
// scripts. A terminal would obey control characters in such text: change its title, overwrite lines, or send
// input as if typed. A plain stream replaces each control character, and bytes outside UTF-8, by a question
// mark (plain_text in engine/core/text.hpp). The streams of the C library are replaced, so that the script's
// own output is covered, too.
#pragma once

#include <string_view>

namespace asperity::cli {

enum class Keeps {
  text,     // characters, tabs, line ends
  colours,  // also carriage return, and sequences that only set colour or weight
};

// Until the end of the program. Not for programs that pass the streams to libedit.
void make_errors_plain();
void make_output_plain(Keeps keeps);

// The only sequence that the program writes to standard error.
inline constexpr std::string_view erase_line = "\r\033[K";
void erase_shown_line();

}  // namespace asperity::cli
