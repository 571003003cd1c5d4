// SPDX-License-Identifier: GPL-3.0-or-later
// The types of names in an unfinished script, from its text and the registry: after `local c =
// lab.contact{...}` the name c is a Contact, inside `for st in c:sweep{...} do` the name st is a State. The
// last assignment above the cursor counts, in any block. The script's own tables and functions have no known
// types. Runs no code. Linear in the length of the text.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bindings/lua/registry/record_type.hpp"

namespace asperity::lua {

// Tokens of an unfinished Lua script with positions, without comments. An unclosed string ends with its line
// or the text.
struct Token {
  enum class Kind { name, keyword, number, text, sign };
  Kind kind;
  std::size_t begin, end;   // bytes, with quotes
  bool open = false;        // unclosed string
  std::size_t content = 0;  // of a string: first inner byte
};

struct ScriptTokens {
  std::vector<Token> list;
  bool ends_in_comment = false;
};

ScriptTokens read_tokens(std::string_view script);

bool is_keyword(std::string_view word);
// Sorted.
const std::vector<std::string_view>& keywords();

struct ScriptType;
using ScriptTypeList = std::vector<ScriptType>;

// The known type of one value.
struct ScriptType {
  struct Unknown {};
  struct Number {};
  struct Text {};
  using Fields = std::map<std::string, ScriptType, std::less<>>;
  // A list, a map (costs by effect), or a plain table at a prompt.
  struct Table {
    std::shared_ptr<const ScriptType> element{};  // of a list or map, else null
    std::shared_ptr<const Fields> fields{};       // may be null
    bool is_map = false;                          // each name has the element's type
  };
  struct Iterator {
    std::shared_ptr<const ScriptTypeList> turn;  // the values of one turn
  };
  // "math", "math.floor", "ipairs".
  struct Library {
    std::string path;
  };
  std::variant<Unknown, Number, Text, const Module*, const Class*, const RecordInfo*, const Function*, Table,
               Iterator, Library>
      data{};

  bool known() const { return !std::holds_alternative<Unknown>(data); }
  template <class T>
  const T* as() const {
    return std::get_if<T>(&data);
  }
};

// The type that the registry writes as "Surface", "State?", "Profile[]", "iterator<State>" or "lab.surface".
ScriptType script_type(std::string_view text);
// For people: "a Surface", "a list of Profile", "function"; "" for the unknown.
std::string type_text(const ScriptType& type);

// A global of a running Lua state; `type` for script_type().
struct LiveGlobal {
  std::string name;
  std::string type;
  std::vector<LiveGlobal> fields{};  // of a plain table
};

// Keeps a view of the text.
class ScriptTypes {
 public:
  // `tokens`: up to the cursor.
  ScriptTypes(std::string_view text, std::vector<Token> tokens, const std::vector<LiveGlobal>& live);

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t size() const { return tokens_.size(); }
  const Token& token(std::size_t k) const { return tokens_[k]; }
  std::string_view word(std::size_t k) const {
    return text_.substr(tokens_[k].begin, tokens_[k].end - tokens_[k].begin);
  }
  bool is(std::size_t k, std::string_view word_or_sign) const;

  // The token that opens the innermost bracket or block around token k, or around the end of the text (k =
  // size()).
  std::size_t around(std::size_t k) const { return k >= size() ? open_at_end_ : around_[k]; }
  // The token that closes the bracket or block opened at k, or that opens the one closed at k.
  std::size_t partner(std::size_t k) const { return partner_[k]; }

  // The type of a chain of names, calls and indices such as `lab.surface.flat{...}`.
  ScriptType chain_ending_at(std::size_t k) const;
  // The chain's first token, or none.
  std::size_t chain_begin(std::size_t last) const;
  ScriptType name_type(std::string_view name) const;
  // Set by the script or the live state, in order.
  const std::map<std::string_view, ScriptType>& names() const { return names_; }

  // Tokens read so far: a measure of time.
  std::size_t steps() const { return steps_; }

 private:
  void match_brackets();
  void read_assignments();
  std::vector<std::string_view> name_list(std::size_t& k) const;
  void assign(const std::vector<std::string_view>& names, std::size_t values, bool loop);
  bool is_name(std::size_t k) const { return k < size() && tokens_[k].kind == Token::Kind::name; }

  // Each reads from token k on and moves k past its end; `stop` is the token after the last that may be read.
  ScriptTypeList value(std::size_t& k, std::size_t stop, int depth) const;
  ScriptTypeList operand(std::size_t& k, std::size_t stop, int depth) const;
  void suffixes(std::size_t& k, std::size_t stop, int depth, ScriptTypeList& types) const;
  std::size_t past(std::size_t bracket, std::size_t stop) const {
    return partner_[bracket] == none ? stop : partner_[bracket] + 1;
  }
  ScriptTypeList call(const ScriptType& function, std::size_t arguments, int depth) const;

  std::string_view text_;
  std::vector<Token> tokens_;
  std::vector<std::size_t> partner_, around_;
  std::size_t open_at_end_ = none;
  std::map<std::string_view, ScriptType> names_;
  std::vector<std::string> live_names_;
  mutable std::size_t steps_ = 0;
};

}  // namespace asperity::lua
