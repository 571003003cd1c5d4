// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/script_tokens.hpp"

#include <algorithm>
#include <string>

namespace asperity::lua {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name(char c) { return begins_name(c) || is_digit(c); }
bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  ScriptTokens read() {
    if (text_.starts_with("#")) at_ = line_end(0);
    while (at_ < text_.size()) step();
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  std::size_t line_end(std::size_t from) const { return std::min(text_.find('\n', from), text_.size()); }

  // Number of `=` in the long bracket at `from`, or -1.
  int long_bracket(std::size_t from) const {
    if (from >= text_.size() || text_[from] != '[') return -1;
    std::size_t k = from + 1;
    while (k < text_.size() && text_[k] == '=') ++k;
    return k < text_.size() && text_[k] == '[' ? static_cast<int>(k - from - 1) : -1;
  }

  // End of the closing bracket, or npos.
  std::size_t past_long(std::size_t from, int level) const {
    const std::string closing = "]" + std::string(static_cast<std::size_t>(level), '=') + "]";
    const std::size_t end = text_.find(closing, from);
    return end == std::string_view::npos ? end : end + closing.size();
  }

  void add(Token::Kind kind, std::size_t end) {
    tokens_.list.push_back({kind, at_, end});
    at_ = end;
  }

  void step() {
    const char c = peek();
    if (is_space(c)) {
      ++at_;
    } else if (c == '-' && peek(1) == '-') {
      comment();
    } else if (begins_name(c)) {
      std::size_t end = at_;
      while (end < text_.size() && is_name(text_[end])) ++end;
      const bool keyword = is_keyword(text_.substr(at_, end - at_));
      add(keyword ? Token::Kind::keyword : Token::Kind::name, end);
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      std::size_t end = at_;
      while (end < text_.size() && (is_name(text_[end]) || text_[end] == '.')) {
        const char last = text_[end++];
        const bool exponent = last == 'e' || last == 'E' || last == 'p' || last == 'P';
        if (exponent && end < text_.size() && (text_[end] == '-' || text_[end] == '+')) ++end;
      }
      add(Token::Kind::number, end);
    } else if (c == '"' || c == '\'') {
      quoted_text(c);
    } else if (const int level = long_bracket(at_); level >= 0) {
      const std::size_t content = at_ + static_cast<std::size_t>(level) + 2;
      const std::size_t end = past_long(content, level);
      add(Token::Kind::text, std::min(end, text_.size()));
      tokens_.list.back().content = content;
      tokens_.list.back().open = end == std::string_view::npos;
    } else {
      add(Token::Kind::sign, at_ + sign_length());
    }
  }

  void comment() {
    if (const int level = long_bracket(at_ + 2); level >= 0) {
      const std::size_t end = past_long(at_ + 4 + static_cast<std::size_t>(level), level);
      tokens_.ends_in_comment = end == std::string_view::npos;
      at_ = std::min(end, text_.size());
    } else {
      at_ = line_end(at_);
      tokens_.ends_in_comment = at_ == text_.size();
    }
  }

  void quoted_text(char quote) {
    std::size_t end = at_ + 1;
    bool closed = false;
    while (end < text_.size() && text_[end] != '\n') {
      const char c = text_[end++];
      if (c == quote) {
        closed = true;
        break;
      }
      if (c == '\\' && end < text_.size()) ++end;
    }
    const std::size_t begin = at_;
    add(Token::Kind::text, std::min(end, text_.size()));
    tokens_.list.back().content = begin + 1;
    tokens_.list.back().open = !closed && at_ == text_.size();
  }

  std::size_t sign_length() const {
    if (text_.substr(at_, 3) == "...") return 3;
    for (const std::string_view two : {"..", "==", "~=", "<=", ">=", "//", "::", "<<", ">>"})
      if (text_.substr(at_, 2) == two) return 2;
    return 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  ScriptTokens tokens_;
};

}  // namespace

const std::vector<std::string_view>& keywords() {
  static const std::vector<std::string_view> words = {
      "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
      "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};
  return words;
}

bool is_keyword(std::string_view word) {
  return std::binary_search(keywords().begin(), keywords().end(), word);
}

ScriptTokens read_tokens(std::string_view script) { return Lexer(script).read(); }

}  // namespace asperity::lua
