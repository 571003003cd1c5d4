// SPDX-License-Identifier: GPL-3.0-or-later
// Tokens of an unfinished Lua script with positions, without comments. An unclosed string ends with its line
// or the text. Linear in the length of the text.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace asperity::lua {

struct Token {
  enum class Kind { name, keyword, number, text, sign };
  Kind kind;
  std::size_t begin, end;   // bytes, with quotes
  bool open = false;        // unclosed string
  std::size_t content = 0;  // of a string: first byte inside
};

struct ScriptTokens {
  std::vector<Token> list;
  bool ends_in_comment = false;
};

ScriptTokens read_tokens(std::string_view script);

bool is_keyword(std::string_view word);
// Sorted.
const std::vector<std::string_view>& keywords();

}  // namespace asperity::lua
