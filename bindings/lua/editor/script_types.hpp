// SPDX-License-Identifier: GPL-3.0-or-later
// What the names of a script stand for, as far as its text tells: `local c = lab.contact{...}` makes c a
// Contact, `for st in c:sweep{...} do` makes st a State, and a function that returns a surface gives one.
// The script need not be finished or right: brackets and blocks that were not closed are where the reader
// stands, what is not understood is unknown. Nothing is run. Values whose class depends on what happens
// (elements of mixed lists, arguments of functions) stay unknown. Linear in the length of the text.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/lua/editor/script_tokens.hpp"
#include "bindings/lua/registry/record_type.hpp"

namespace asperity::lua {

struct ScriptType;
using ScriptTypeList = std::vector<ScriptType>;

// What is known of one value.
struct ScriptType {
  struct Unknown {};
  struct Number {};
  struct Text {};
  using Fields = std::map<std::string, ScriptType, std::less<>>;
  struct List {
    std::shared_ptr<const ScriptType> element;
    std::shared_ptr<const Fields> fields{};  // that it has besides; may be null
  };
  // A record with a field for each name that there is, all of one type: costs by effect.
  struct Map {
    std::shared_ptr<const ScriptType> element;
  };
  struct Iterator {
    std::shared_ptr<const ScriptTypeList> turn;  // the values of one turn
  };
  // A table of the script's own with named fields.
  struct Table {
    std::shared_ptr<Fields> fields;
  };
  struct Closure {
    std::size_t token;  // its word `function`
  };
  // A part of Lua's own library: "math", or a function of it: "math.floor", "ipairs".
  struct Library {
    std::string path;
  };
  std::variant<Unknown, Number, Text, const Module*, const Class*, const RecordInfo*, const Function*, List,
               Map, Iterator, Table, Closure, Library>
      data{};

  bool known() const { return !std::holds_alternative<Unknown>(data); }
  template <class T>
  const T* as() const {
    return std::get_if<T>(&data);
  }
};

// Of a type as the registry writes it: "Surface", "State?", "Profile[]", "iterator<State>", "lab.surface".
ScriptType script_type(std::string_view text);
// As people read it: "a Surface", "a list of Profile", "function"; "" for the unknown.
std::string type_text(const ScriptType& type);

// A global of a state that a reader has at hand, with its type as script_type() reads it.
struct LiveGlobal {
  std::string name;
  std::string type;
  std::vector<LiveGlobal> fields{};  // of a plain table
};

// Names and types at the end of a script. Keeps a view of the text.
class ScriptTypes {
 public:
  // `tokens` are those before the place that is asked about.
  ScriptTypes(std::string_view text, std::vector<Token> tokens, const std::vector<LiveGlobal>& live);
  ~ScriptTypes();
  ScriptTypes(const ScriptTypes&) = delete;
  ScriptTypes& operator=(const ScriptTypes&) = delete;

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t size() const { return tokens_.size(); }
  const Token& token(std::size_t k) const { return tokens_[k]; }
  std::string_view word(std::size_t k) const {
    return text_.substr(tokens_[k].begin, tokens_[k].end - tokens_[k].begin);
  }
  // Whether token k is this sign or keyword.
  bool is(std::size_t k, std::string_view word_or_sign) const;

  // The bracket or block that is open around token k, which opens one itself, or around the end of the text
  // (k = size()); none outside all.
  std::size_t around(std::size_t k) const { return k >= size() ? open_at_end_ : around_[k]; }
  // The bracket or `end` that closes the one at k, or that it closes; none if nothing does.
  std::size_t partner(std::size_t k) const { return partner_[k]; }

  // The value of the chain of names, calls and indices that ends with token k: `lab.surface.flat{...}`.
  // Unknown if no chain ends there.
  ScriptType chain_ending_at(std::size_t k) const;
  // The token with which that chain begins; none if none ends there.
  std::size_t chain_begin(std::size_t last) const;
  ScriptType name_type(std::string_view name) const;
  // Visible at the end: local variables, then globals that the script or the live state has set.
  std::vector<std::pair<std::string, ScriptType>> locals() const;
  std::vector<std::pair<std::string, ScriptType>> globals() const;

  // How many tokens were looked at, which is what the time goes with.
  std::size_t steps() const { return steps_; }

 private:
  struct Binding {
    std::string_view name;
    ScriptType type;
  };
  struct Open {
    std::size_t token;
    bool bracket;
    std::size_t bindings;  // so many were there before
    std::string_view closes_with;
  };
  // Names that get their types where the values are past.
  struct Pending {
    std::size_t at;
    std::vector<std::string_view> names;
    ScriptTypeList types;
    bool local;
  };

  void match_brackets();
  void scan();
  void scan_local(std::size_t& k);
  void scan_function(std::size_t& k);
  void scan_for(std::size_t k);
  void scan_return(std::size_t k);
  void scan_assignment(std::size_t k);
  void declare_later(std::size_t after_values, std::vector<std::string_view> names, ScriptTypeList types,
                     bool local);
  void bind_pending(std::size_t k);
  void bind(std::string_view name, ScriptType type);
  void assign(std::string_view name, const ScriptType& type);
  void close_to(std::size_t opening);
  void forget_from(std::size_t count);
  bool in_bracket() const { return !open_.empty() && open_.back().bracket; }
  // Whether the values that end before k are whole: nothing is missing after an operator or in a bracket.
  bool ends_value(std::size_t k) const;

  ScriptTypeList values(std::size_t& k, int depth) const;
  ScriptType value(std::size_t& k, int depth) const;
  ScriptTypeList operand(std::size_t& k, int depth, std::size_t stop) const;
  void suffixes(std::size_t& k, ScriptTypeList& types, int depth, std::size_t stop) const;
  ScriptType table(std::size_t open, int depth) const;
  ScriptType member(const ScriptType& of, std::string_view name) const;
  ScriptTypeList call(const ScriptType& function, std::size_t arguments, int depth) const;
  ScriptTypeList turn_of(const ScriptType& iterated) const;
  bool names_at(std::size_t k, Token::Kind kind) const;

  std::string_view text_;
  std::vector<Token> tokens_;
  std::vector<std::size_t> partner_, around_;
  std::vector<std::shared_ptr<ScriptType::Fields>> extended_;  // by an assignment; may hold themselves
  std::size_t open_at_end_ = none;
  std::vector<Open> open_;
  std::vector<Binding> bindings_;
  std::unordered_map<std::string_view, std::vector<std::size_t>> places_;  // of a name in bindings_
  std::vector<Pending> pending_;
  std::unordered_map<std::size_t, Pending> of_loop_;  // by the `do` of the loop
  std::unordered_map<std::string, ScriptType> globals_;
  std::unordered_map<std::size_t, ScriptTypeList> results_;  // of functions, by their token
  mutable std::size_t steps_ = 0;
};

}  // namespace asperity::lua
