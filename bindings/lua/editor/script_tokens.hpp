// SPDX-License-Identifier: GPL-3.0-or-later
// The words of a Lua script that need not be finished: names, numbers, strings and signs with their places,
// comments left out. Anything reads as tokens: a string that was not closed ends with its line, or where
// the text does, and is marked open. Linear in the length of the text.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace asperity::lua {

struct Token {
  enum class Kind { name, keyword, number, text, sign };
  Kind kind;
  std::size_t begin, end;   // bytes; of a text with its quotes
  bool open = false;        // a text that was not closed
  std::size_t content = 0;  // of a text: where it begins after its quote
};

struct ScriptTokens {
  std::vector<Token> list;
  bool ends_in_comment = false;
};

ScriptTokens read_tokens(std::string_view script);

bool is_keyword(std::string_view word);
// Lua's keywords in the order of the alphabet.
const std::vector<std::string_view>& keywords();

}  // namespace asperity::lua
