// SPDX-License-Identifier: GPL-3.0-or-later
// Editing of one line in a terminal, by libedit, in a part of the program that is loaded when a terminal is
// first read (core/loaded_part.hpp). The program gives the keys that were pressed and knows what may come
// next; the part moves the cursor, keeps what was typed before, and shows it. Names of C, so that they can
// be looked up; one editor at a time.
#pragma once

#include <cstddef>

extern "C" {

// What becomes of the word before the cursor when Tab is pressed. Texts live until the next call.
struct AsperityEditAnswer {
  std::size_t take_away;  // characters before the cursor
  const char* insert;
  const char* list;  // lines to show below; may be empty
};

struct AsperityEditHooks {
  void* context;
  // The next byte of the terminal: 1; 0 at its end; -1 where the line was given up (Ctrl-C), -2 where the
  // program was stopped and goes on, -3 where the window has another size.
  int (*next_byte)(void* context, unsigned char* byte);
  // The line as it stands, and how many bytes of it are before the cursor.
  AsperityEditAnswer (*complete)(void* context, const char* line, std::size_t length, std::size_t before);
};

// Null if the terminal cannot be used.
void* asperity_edit_open(const AsperityEditHooks* hooks);
// 1: a line without its end, which lives until the next call; 0: the end of the input; -1: given up.
int asperity_edit_read(void* editor, const char* prompt, const char** line);
// A line to come back to with the arrow keys.
void asperity_edit_remember(void* editor, const char* line);
void asperity_edit_close(void* editor);

}  // extern "C"
