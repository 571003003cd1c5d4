// SPDX-License-Identifier: GPL-3.0-or-later
// Line editing by libedit, in a part that is loaded at the first read from a terminal (core/loaded_part.hpp).
// The program supplies key bytes and completions; the part edits, shows and remembers lines. C names for
// symbol lookup; one editor at a time.
#pragma once

#include <cstddef>

extern "C" {

// The change of the word before the cursor after Tab. Texts are valid until the next call.
struct AsperityEditAnswer {
  std::size_t take_away;  // characters before the cursor to delete
  const char* insert;
  const char* list;  // lines to print; may be empty
};

struct AsperityEditHooks {
  void* context;
  // The next byte of the terminal: 1; 0 at the end; -1 after Ctrl-C, -2 after suspension, -3 after a window
  // resize.
  int (*next_byte)(void* context, unsigned char* byte);
  // `before`: bytes of the line before the cursor.
  AsperityEditAnswer (*complete)(void* context, const char* line, std::size_t length, std::size_t before);
};

// Null if the terminal cannot be used.
void* asperity_edit_open(const AsperityEditHooks* hooks);
// 1: a line without its end, valid until the next call; 0: end of input; -1: Ctrl-C.
int asperity_edit_read(void* editor, const char* prompt, const char** line);
// Adds a line to the history.
void asperity_edit_remember(void* editor, const char* line);
void asperity_edit_close(void* editor);

}  // extern "C"
