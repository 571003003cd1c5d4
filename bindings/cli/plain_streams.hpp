// SPDX-License-Identifier: GPL-3.0-or-later
// Standard streams whose text is shown and never obeyed. Messages repeat what others wrote: names of files,
// titles, errors raised by scripts. A terminal would take their control characters for orders: to retitle its
// window, to write over lines, to answer as if somebody had typed. On a plain stream each becomes a question
// mark, as do bytes that are not UTF-8 (plain_text in engine/core/text.hpp). Every writer of stdout and
// stderr is covered, the script's own included, for it is the streams of the C library that are exchanged.
#pragma once

#include <string_view>

namespace asperity::cli {

enum class Keeps {
  text,     // characters, tabs and ends of lines
  colours,  // besides, the return to the begin of a line, and sequences that only set colour or weight
};

// From here on, to the end of the program. Not for a program that gives the streams to libedit.
void make_errors_plain();
void make_output_plain(Keeps keeps);

// The one sequence that the program itself writes to standard error: back to the begin of the line, and erase
// it.
inline constexpr std::string_view erase_line = "\r\033[K";
void erase_shown_line();

}  // namespace asperity::cli
