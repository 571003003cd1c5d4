// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/script_types.hpp"

#include <algorithm>
#include <array>

#include "bindings/lua/registry/registry.hpp"

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

constexpr int deepest_brackets = 40;  // deeper values are unknown

// Empty for words that open nothing.
std::string_view closing_of(std::string_view word) {
  static constexpr std::pair<std::string_view, std::string_view> pairs[] = {
      {"(", ")"},    {"[", "]"},    {"{", "}"},         {"function", "end"},
      {"do", "end"}, {"if", "end"}, {"repeat", "until"}};
  for (const auto& [opening, closing] : pairs)
    if (word == opening) return closing;
  return {};
}

bool closes(std::string_view word) {
  return word == ")" || word == "]" || word == "}" || word == "end" || word == "until";
}

bool is_binary(std::string_view sign) {
  static constexpr std::array<std::string_view, 21> signs = {"+",  "-",  "*",  "/",  "//", "%",   "^",
                                                             "..", "==", "~=", "<=", ">=", "<",   ">",
                                                             "&",  "|",  "~",  "<<", ">>", "and", "or"};
  return std::find(signs.begin(), signs.end(), sign) != signs.end();
}

// "State", "ProtocolEvent and State?": one type per turn.
ScriptTypeList types_of_turn(std::string_view text) {
  ScriptTypeList types;
  for (const std::string_view type : parts_of(text, " and ")) types.push_back(script_type(type));
  return types;
}

ScriptTypeList results_of(const Function& function) {
  ScriptTypeList types;
  for (const std::string& type : result_types(function)) types.push_back(script_type(type));
  return types;
}

// For a native value on either side; "" is a sign before a value.
const Operator* operator_of(const ScriptType& left, const ScriptType& right, std::string_view sign) {
  const std::string_view event = sign == "+"   ? "__add"
                                 : sign == "-" ? "__sub"
                                 : sign == "*" ? "__mul"
                                 : sign == "/" ? "__div"
                                 : sign == ""  ? "__unm"
                                               : "";
  for (const ScriptType* side : {&left, &right})
    if (const auto* type = side->as<const Class*>())
      for (const Operator& operation : (*type)->operators)
        if (operation.event == event) return &operation;
  return nullptr;
}

ScriptType live_type(const LiveGlobal& global) {
  if (global.fields.empty()) return script_type(global.type);
  auto fields = std::make_shared<ScriptType::Fields>();
  for (const LiveGlobal& field : global.fields) (*fields)[field.name] = live_type(field);
  return {ScriptType::Table{nullptr, std::move(fields)}};
}

ScriptType member(const ScriptType& of, std::string_view name) {
  const auto named = [&](const auto& list) {
    const auto entry = std::find_if(list.begin(), list.end(), [&](const auto& e) { return e.name == name; });
    return entry == list.end() ? nullptr : &*entry;
  };
  if (const auto* module = of.as<const Module*>()) {
    if (const auto* function = named((*module)->functions)) return {function};
    if (const auto* constant = named((*module)->constants)) return script_type(constant->type);
    return script_type((*module)->path + "." + std::string(name));
  }
  if (const auto* type = of.as<const Class*>()) {
    if (const auto* method = named((*type)->methods)) return {method};
    const auto* field = named((*type)->fields);
    return field != nullptr ? script_type(field->type) : ScriptType{};
  }
  if (const auto* record = of.as<const RecordInfo*>()) {
    const auto* field = named((*record)->fields);
    return field != nullptr ? script_type(field->type) : ScriptType{};
  }
  if (const auto* table = of.as<ScriptType::Table>()) {
    if (table->is_map) return *table->element;
    if (table->fields == nullptr) return {};
    const auto field = table->fields->find(name);
    return field == table->fields->end() ? ScriptType{} : field->second;
  }
  if (const auto* library = of.as<ScriptType::Library>())
    return {ScriptType::Library{library->path + "." + std::string(name)}};
  if (of.as<ScriptType::Text>() != nullptr) return {ScriptType::Library{"string." + std::string(name)}};
  return {};
}

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

ScriptType script_type(std::string_view text) {
  const auto element = [](std::string_view of) {
    return std::make_shared<const ScriptType>(script_type(of));
  };
  if (text.ends_with("?")) return script_type(text.substr(0, text.size() - 1));
  if (const std::size_t at = text.find("[] with "); at != std::string_view::npos) {
    auto fields = std::make_shared<ScriptType::Fields>();
    for (const auto& [name, type] : named_fields(text)) (*fields)[std::string(name)] = script_type(type);
    return {ScriptType::Table{element(text.substr(0, at)), fields}};
  }
  constexpr std::string_view map = "table<string, ";
  if (text.starts_with(map))
    return {ScriptType::Table{element(text.substr(map.size(), text.size() - map.size() - 1)), nullptr, true}};
  if (text.starts_with("iterator<"))
    return {ScriptType::Iterator{
        std::make_shared<const ScriptTypeList>(types_of_turn(text.substr(9, text.size() - 10)))}};
  if (text.starts_with("\"")) return {ScriptType::Text{}};
  if (const std::size_t bar = text.find('|'); bar != std::string_view::npos) {
    const ScriptType first = script_type(text.substr(0, bar));
    return first.known() ? first : script_type(text.substr(bar + 1));
  }
  if (text.ends_with("[]")) return {ScriptType::Table{element(text.substr(0, text.size() - 2))}};
  if (text == "number" || text == "integer") return {ScriptType::Number{}};
  if (text == "string") return {ScriptType::Text{}};
  if (const Class* type = find_class(text)) return {type};
  if (const RecordInfo* type = find_record_type(text)) return {type};
  for (const Module* module : modules())
    if (module->path == text) return {module};
  return {};
}

std::string type_text(const ScriptType& type) {
  if (type.as<ScriptType::Number>() != nullptr) return "a number";
  if (type.as<ScriptType::Text>() != nullptr) return "a string";
  if (type.as<ScriptType::Iterator>() != nullptr) return "an iterator";
  if (const auto* module = type.as<const Module*>()) return (*module)->path;
  if (const auto* value = type.as<const Class*>()) return (*value)->article_name;
  if (const auto* record = type.as<const RecordInfo*>()) return "a " + (*record)->title + " result";
  if (const auto* function = type.as<const Function*>()) return qualified_name(**function);
  const auto* table = type.as<ScriptType::Table>();
  if (table == nullptr) return "";
  if (table->element == nullptr || table->is_map) return table->is_map ? "a result" : "a table";
  const std::string element = type_text(*table->element);
  return "a list" + (element.empty() ? "" : ", each " + element);
}

ScriptTypes::ScriptTypes(std::string_view text, std::vector<Token> tokens,
                         const std::vector<LiveGlobal>& live)
    : text_(text), tokens_(std::move(tokens)), partner_(tokens_.size(), none), around_(tokens_.size(), none) {
  for (const LiveGlobal& global : live) live_names_.push_back(global.name);
  for (std::size_t k = 0; k < live.size(); ++k) names_[live_names_[k]] = live_type(live[k]);
  match_brackets();
  read_assignments();
}

bool ScriptTypes::is(std::size_t k, std::string_view word_or_sign) const {
  if (k >= size()) return false;
  const Token::Kind kind = tokens_[k].kind;
  return (kind == Token::Kind::sign || kind == Token::Kind::keyword) && word(k) == word_or_sign;
}

void ScriptTypes::match_brackets() {
  std::vector<std::pair<std::size_t, std::string_view>> open;  // token, and its closing word
  std::map<std::string_view, std::size_t> awaited;             // open blocks by closing word
  for (std::size_t k = 0; k < size(); ++k) {
    around_[k] = open.empty() ? none : open.back().first;
    const Token::Kind kind = tokens_[k].kind;
    if (kind != Token::Kind::sign && kind != Token::Kind::keyword) continue;
    const std::string_view here = word(k);
    if (const std::string_view closing = closing_of(here); !closing.empty()) {
      open.emplace_back(k, closing);
      ++awaited[closing];
    } else if (closes(here) && awaited[here] > 0) {
      // Brackets left open inside end here too. Unmatched signs are skipped.
      while (open.back().second != here) {
        ++steps_;
        --awaited[open.back().second];
        open.pop_back();
      }
      partner_[open.back().first] = k;
      partner_[k] = open.back().first;
      --awaited[here];
      open.pop_back();
    }
  }
  open_at_end_ = open.empty() ? none : open.back().first;
}

// `a, b = values`, `local a <const>, b = values`, `for a, b in values do`, `for a = values do`, `function
// f(a, b)`.
void ScriptTypes::read_assignments() {
  for (std::size_t k = 0; k < size(); ++k) {
    ++steps_;
    if (is(k, "function")) {
      std::size_t n = k + 1;
      if (is_name(n) && !is(n + 1, ".") && !is(n + 1, ":")) names_[word(n)] = {};
      while (is_name(n) || is(n, ".") || is(n, ":")) ++n;
      if (!is(n, "(")) continue;
      for (++n; is_name(n) || is(n, ",") || is(n, "..."); ++n)
        if (is_name(n)) names_[word(n)] = {};
      steps_ += n - k;
      k = n - 1;
    } else if (is_name(k) && (k == 0 || (!is(k - 1, ".") && !is(k - 1, ":")))) {
      const bool local = k > 0 && is(k - 1, "local");
      const std::vector<std::string_view> names = name_list(k);
      steps_ += names.size();
      if (is(k, "=") || is(k, "in")) {
        const std::size_t bracket = around_[k];
        const bool key = is(bracket, "{") || is(bracket, "(") || is(bracket, "[");
        if (!key) assign(names, k + 1, is(k, "in"));
      } else if (local) {
        for (const std::string_view name : names) names_[name] = {};
      }
      --k;
    }
  }
}

// `a <const>, b`: moves k past the last name.
std::vector<std::string_view> ScriptTypes::name_list(std::size_t& k) const {
  std::vector<std::string_view> names;
  for (;; ++k) {
    names.push_back(word(k++));
    if (is(k, "<")) k += 3;  // <const>, <close>
    if (!is(k, ",") || !is_name(k + 1)) return names;
  }
}

void ScriptTypes::assign(const std::vector<std::string_view>& names, std::size_t values, bool loop) {
  std::size_t k = values;
  ScriptTypeList types;
  for (;;) {
    const std::size_t from = k;
    ScriptTypeList found = value(k, size(), 0);
    // Inside these values the names do not exist yet.
    if (k == from || (k == size() && is(k - 1, "=")) ||
        (k == size() && open_at_end_ != none && open_at_end_ >= values))
      return;
    if (found.empty()) found.emplace_back();
    if (is(k, ",")) found.resize(1);
    types.insert(types.end(), found.begin(), found.end());
    if (!is(k, ",")) break;
    ++k;
  }
  if (loop) {
    const auto* iterator = types.front().as<ScriptType::Iterator>();
    types = iterator != nullptr ? *iterator->turn : ScriptTypeList{};
  }
  types.resize(std::max(types.size(), names.size()));
  for (std::size_t n = 0; n < names.size(); ++n) names_[names[n]] = types[n];
}

// An operator's type comes from the native value on either side; `or` gives the first known type.
ScriptTypeList ScriptTypes::value(std::size_t& k, std::size_t stop, int depth) const {
  if (depth >= deepest_brackets) return {};
  ScriptTypeList types = operand(k, stop, depth);
  while (k < stop && tokens_[k].kind != Token::Kind::text && is_binary(word(k))) {
    const std::string_view sign = word(k);
    const std::size_t next = ++k;
    const ScriptTypeList others = operand(k, stop, depth);
    if (k == next) return {};  // nothing follows the sign
    const ScriptType left = types.empty() ? ScriptType{} : types.front(),
                     right = others.empty() ? ScriptType{} : others.front();
    if (sign == "or" || sign == "and")
      types = {sign == "or" && left.known() ? left : right};
    else if (const Operator* operation = operator_of(left, right, sign))
      types = {script_type(operation->returns)};
    else
      types = {sign == ".." ? ScriptType{ScriptType::Text{}} : ScriptType{ScriptType::Number{}}};
  }
  return types;
}

ScriptTypeList ScriptTypes::operand(std::size_t& k, std::size_t stop, int depth) const {
  const std::size_t begin = k;
  while (k < stop && (is(k, "not") || is(k, "-") || is(k, "#") || is(k, "~"))) ++k;
  steps_ += k - begin + 1;
  if (k >= stop) return {};
  ScriptTypeList types;
  if (tokens_[k].kind == Token::Kind::number) {
    ++k;
    types = {{ScriptType::Number{}}};
  } else if (tokens_[k].kind == Token::Kind::text) {
    ++k;
    types = {{ScriptType::Text{}}};
  } else if (is(k, "function") || is(k, "{")) {
    k = past(k, stop);
    types = {{}};
  } else if (is(k, "(")) {
    std::size_t inner = k + 1;
    types = value(inner, stop, depth + 1);
    types.resize(1);
    k = past(k, stop);
    suffixes(k, stop, depth, types);
  } else if (is_name(k)) {
    types = {name_type(word(k++))};
    suffixes(k, stop, depth, types);
  } else if (is(k, "nil") || is(k, "true") || is(k, "false") || is(k, "...")) {
    ++k;
    types = {{}};
  }
  if (begin == k || !(is(begin, "not") || is(begin, "-") || is(begin, "#") || is(begin, "~"))) return types;
  const Operator* negative =
      is(begin, "-") && !types.empty() ? operator_of(types.front(), types.front(), "") : nullptr;
  return {negative != nullptr ? script_type(negative->returns) : ScriptType{ScriptType::Number{}}};
}

void ScriptTypes::suffixes(std::size_t& k, std::size_t stop, int depth, ScriptTypeList& types) const {
  while (k < stop) {
    ++steps_;
    const ScriptType now = types.empty() ? ScriptType{} : types.front();
    if ((is(k, ".") || is(k, ":")) && k + 1 < stop && is_name(k + 1)) {
      types = {member(now, word(k + 1))};
      k += 2;
    } else if (is(k, "[")) {
      const auto* table = now.as<ScriptType::Table>();
      types = {table != nullptr && table->element != nullptr ? *table->element : ScriptType{}};
      k = past(k, stop);
    } else if (is(k, "(") || is(k, "{")) {
      types = call(now, k, depth);
      k = past(k, stop);
    } else if (tokens_[k].kind == Token::Kind::text) {
      types = call(now, k++, depth);
    } else {
      return;
    }
  }
}

ScriptTypeList ScriptTypes::call(const ScriptType& function, std::size_t arguments, int depth) const {
  ++steps_;
  if (const auto* native = function.as<const Function*>()) return results_of(**native);
  if (const auto* module = function.as<const Module*>())
    return (*module)->call ? results_of(*(*module)->call) : ScriptTypeList{};
  const auto* library = function.as<ScriptType::Library>();
  if (library == nullptr) return {};
  const std::string& path = library->path;
  std::size_t k = is(arguments, "(") ? arguments + 1 : arguments;
  if (path == "require")
    // The token ends with its quote.
    return k < size() && tokens_[k].kind == Token::Kind::text &&
                   text_.substr(tokens_[k].content, tokens_[k].end - tokens_[k].content).substr(0, 8) ==
                       "asperity" &&
                   tokens_[k].end - tokens_[k].content == 9
               ? ScriptTypeList{script_type("lab")}
               : ScriptTypeList{};
  if (path != "ipairs" && path != "pairs") return {};
  ScriptTypeList first = value(k, size(), depth + 1);
  first.resize(1);
  const auto* table = first[0].as<ScriptType::Table>();
  const bool known = table != nullptr && table->element != nullptr && (path == "pairs" || !table->is_map);
  const ScriptType key =
      known && table->is_map ? ScriptType{ScriptType::Text{}} : ScriptType{ScriptType::Number{}};
  const ScriptType of = known ? *table->element : ScriptType{};
  return {{ScriptType::Iterator{std::make_shared<const ScriptTypeList>(ScriptTypeList{key, of})}}};
}

std::size_t ScriptTypes::chain_begin(std::size_t last) const {
  for (std::size_t k = last; k < size();) {
    ++steps_;
    const bool group = is(k, ")") || is(k, "]") || is(k, "}");
    if (group) {
      if (partner_[k] == none) return none;
      k = partner_[k];
    }
    const bool text = tokens_[k].kind == Token::Kind::text;
    if (!group && !text && !is_name(k)) return none;
    if (!group && !text) {
      if (k < 2 || (!is(k - 1, ".") && !is(k - 1, ":"))) return k;
      k -= 2;
      continue;
    }
    // After a name or another group an argument, else the begin of a chain.
    const bool argument = k > 0 && (is_name(k - 1) || is(k - 1, ")") || is(k - 1, "]") || is(k - 1, "}"));
    if (!argument) return k;
    --k;
  }
  return none;
}

ScriptType ScriptTypes::chain_ending_at(std::size_t last) const {
  std::size_t k = chain_begin(last);
  if (k == none) return {};
  const ScriptTypeList types = operand(k, last + 1, 0);
  return types.empty() ? ScriptType{} : types.front();
}

ScriptType ScriptTypes::name_type(std::string_view name) const {
  if (const auto place = names_.find(name); place != names_.end()) return place->second;
  // Also in a script without `require`.
  if (name == "lab") return script_type("lab");
  for (const std::string_view library :
       {"string", "table", "math", "os", "io", "coroutine", "utf8", "require", "ipairs", "pairs"})
    if (name == library) return {ScriptType::Library{std::string(name)}};
  return {};
}

}  // namespace asperity::lua
