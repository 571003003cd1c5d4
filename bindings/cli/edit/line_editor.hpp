// SPDX-License-Identifier: GPL-3.0-or-later
// Line editing by libedit, in a part loaded at the first read from a terminal (core/loaded_part.hpp). The
// program supplies key bytes and completions. C names for symbol lookup; one editor at a time.
#pragma once

#include <cstddef>

extern "C" {

// Replaces the word before the cursor. Valid until the next call.
struct AsperityEditAnswer {
  std::size_t take_away;  // characters to delete
  const char* insert;
  const char* list;  // lines to print
};

struct AsperityEditHooks {
  void* context;
  // 1: byte; 0: end; -1: Ctrl-C; -2: continued after suspension; -3: window resized.
  int (*next_byte)(void* context, unsigned char* byte);
  AsperityEditAnswer (*complete)(void* context, const char* line, std::size_t length, std::size_t before);
};

// Null if the terminal cannot be used.
void* asperity_edit_open(const AsperityEditHooks* hooks);
// 1: line, valid until the next call; 0: end; -1: Ctrl-C.
int asperity_edit_read(void* editor, const char* prompt, const char** line);
// For the history.
void asperity_edit_remember(void* editor, const char* line);
void asperity_edit_close(void* editor);

}  // extern "C"
