// SPDX-License-Identifier: GPL-3.0-or-later
// Standard streams without control characters. Messages repeat foreign text (file names, titles, script
// errors), whose control characters could change a terminal's title, overwrite lines, or send input as if
// typed. A plain stream prints a question mark for each control character and each byte outside UTF-8
// (engine/core/text.hpp). It replaces the C library's streams, also for the script's own output.
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

// The program's only sequence on standard error.
inline constexpr std::string_view erase_line = "\r\033[K";
void erase_shown_line();

// Discards standard output: a repeated script has already printed.
class Muted {
 public:
  Muted();
  ~Muted();
  Muted(const Muted&) = delete;
  Muted& operator=(const Muted&) = delete;

 private:
  int kept_ = -1;
};

}  // namespace asperity::cli
