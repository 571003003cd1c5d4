// SPDX-License-Identifier: GPL-3.0-or-later
// The walk through the statements of a script: which names there are, and where. What a value is worth is
// found in script_values.cpp.
#include "bindings/lua/editor/script_types.hpp"

#include <algorithm>
#include <map>

namespace asperity::lua {

namespace {
// What closes a bracket or block; empty for words that open none.
std::string_view closing_of(std::string_view word) {
  static constexpr std::pair<std::string_view, std::string_view> pairs[] = {
      {"(", ")"},    {"[", "]"},    {"{", "}"},         {"function", "end"},
      {"do", "end"}, {"if", "end"}, {"repeat", "until"}};
  for (const auto& [opening, closing] : pairs)
    if (word == opening) return closing;
  return {};
}

bool is_bracket(std::string_view word) { return word == "(" || word == "[" || word == "{"; }

bool closes(std::string_view word) {
  return word == ")" || word == "]" || word == "}" || word == "end" || word == "until";
}
}  // namespace

ScriptTypes::ScriptTypes(std::string_view text, std::vector<Token> tokens,
                         const std::vector<LiveGlobal>& live)
    : text_(text), tokens_(std::move(tokens)), partner_(tokens_.size(), none), around_(tokens_.size(), none) {
  const auto type_of = [](const LiveGlobal& global, const auto& self) -> ScriptType {
    if (global.fields.empty()) return script_type(global.type);
    auto fields = std::make_shared<ScriptType::Fields>();
    for (const LiveGlobal& field : global.fields) (*fields)[field.name] = self(field, self);
    return {ScriptType::Table{std::move(fields)}};
  };
  for (const LiveGlobal& global : live) globals_[global.name] = type_of(global, type_of);
  match_brackets();
  scan();
}

// A table that holds itself, as after `t.self = t`, would hold itself for ever.
ScriptTypes::~ScriptTypes() {
  for (const auto& fields : extended_) fields->clear();
}

bool ScriptTypes::is(std::size_t k, std::string_view word_or_sign) const {
  if (k >= size()) return false;
  const Token::Kind kind = tokens_[k].kind;
  return (kind == Token::Kind::sign || kind == Token::Kind::keyword) && word(k) == word_or_sign;
}

void ScriptTypes::match_brackets() {
  std::vector<std::pair<std::size_t, std::string_view>> open;  // and what closes it
  std::map<std::string_view, std::size_t> awaited;             // how many of them each would close
  for (std::size_t k = 0; k < size(); ++k) {
    around_[k] = open.empty() ? none : open.back().first;
    const Token::Kind kind = tokens_[k].kind;
    if (kind != Token::Kind::sign && kind != Token::Kind::keyword) continue;
    const std::string_view here = word(k);
    if (const std::string_view closing = closing_of(here); !closing.empty()) {
      open.emplace_back(k, closing);
      ++awaited[closing];
    } else if (closes(here) && awaited[here] > 0) {
      // What was left open inside ends here too; a sign that closes nothing is passed over.
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

void ScriptTypes::scan() {
  for (std::size_t k = 0; k < size();) {
    ++steps_;
    bind_pending(k);
    const Token::Kind kind = tokens_[k].kind;
    const std::string_view here = word(k);
    if (kind == Token::Kind::keyword && here == "local") {
      scan_local(k);
      continue;
    }
    if (kind == Token::Kind::keyword && here == "function") {
      scan_function(k);
      continue;
    }
    if (kind == Token::Kind::keyword || kind == Token::Kind::sign) {
      if (const std::string_view closing = closing_of(here); !closing.empty()) {
        open_.push_back({k, is_bracket(here), bindings_.size(), closing});
        if (here == "do")
          if (const auto loop = of_loop_.find(k); loop != of_loop_.end())
            for (std::size_t n = 0; n < loop->second.names.size(); ++n)
              bind(loop->second.names[n],
                   n < loop->second.types.size() ? loop->second.types[n] : ScriptType{});
      } else if (closes(here)) {
        if (partner_[k] != none) close_to(partner_[k]);
      } else if ((here == "else" || here == "elseif") && !open_.empty() && is(open_.back().token, "if")) {
        forget_from(open_.back().bindings);
      } else if (here == "for") {
        scan_for(k);
      } else if (here == "return") {
        scan_return(k);
      } else if (here == "=" && !in_bracket()) {
        scan_assignment(k);
      }
    }
    ++k;
  }
  bind_pending(size());
}

bool ScriptTypes::names_at(std::size_t k, Token::Kind kind) const {
  return k < size() && tokens_[k].kind == kind;
}

void ScriptTypes::scan_local(std::size_t& k) {
  ++k;
  if (is(k, "function") && names_at(k + 1, Token::Kind::name)) {
    bind(word(k + 1), {ScriptType::Closure{k}});
    return;  // the function itself comes next
  }
  std::vector<std::string_view> names;
  while (names_at(k, Token::Kind::name)) {
    names.push_back(word(k++));
    if (is(k, "<")) k = std::min(k + 3, size());  // <const>, <close>
    if (!is(k, ",")) break;
    ++k;
  }
  if (!is(k, "=")) {
    for (const std::string_view name : names) bind(name, {});
    return;
  }
  std::size_t end = ++k;
  ScriptTypeList types = values(end, 0);
  declare_later(end, std::move(names), std::move(types), true);
}

void ScriptTypes::scan_function(std::size_t& k) {
  const std::size_t opening = k++;
  ScriptType self;
  if (names_at(k, Token::Kind::name)) {
    // `function f`, `function a.b.f`, `function a:f`
    std::size_t end = k;
    ScriptType owner = name_type(word(k));
    while ((is(end + 1, ".") || is(end + 1, ":")) && names_at(end + 2, Token::Kind::name)) {
      if (end > k) owner = member(owner, word(end));
      if (is(end + 1, ":")) self = owner;
      end += 2;
    }
    const bool is_local = opening > 0 && is(opening - 1, "local");
    if (end == k && !is_local) assign(word(k), {ScriptType::Closure{opening}});
    if (end > k)
      if (const auto* fields = owner.as<ScriptType::Table>())
        (*fields->fields)[std::string(word(end))] = {ScriptType::Closure{opening}};
    k = end + 1;
  }
  open_.push_back({opening, false, bindings_.size(), "end"});
  if (self.known()) bind("self", self);
  if (!is(k, "(")) return;
  for (++k; names_at(k, Token::Kind::name) || is(k, ",") || is(k, "..."); ++k)
    if (names_at(k, Token::Kind::name)) bind(word(k), {});
  if (is(k, ")")) ++k;
}

void ScriptTypes::scan_for(std::size_t k) {
  std::vector<std::string_view> names;
  ++k;
  while (names_at(k, Token::Kind::name)) {
    names.push_back(word(k++));
    if (!is(k, ",")) break;
    ++k;
  }
  ScriptTypeList types;
  std::size_t end = k + 1;
  if (is(k, "=")) {
    values(end, 0);
    types.push_back({ScriptType::Number{}});
  } else if (is(k, "in")) {
    const ScriptTypeList iterated = values(end, 0);
    if (!iterated.empty()) types = turn_of(iterated.front());
  }
  if (is(end, "do")) of_loop_[end] = {end, std::move(names), std::move(types), true};
}

void ScriptTypes::scan_return(std::size_t k) {
  const auto function = std::find_if(open_.rbegin(), open_.rend(),
                                     [this](const Open& open) { return is(open.token, "function"); });
  if (function == open_.rend() || results_.contains(function->token)) return;
  ScriptTypeList types = values(++k, 0);
  if (!types.empty() && types.front().known()) results_[function->token] = std::move(types);
}

void ScriptTypes::scan_assignment(std::size_t k) {
  if (k == 0 || !names_at(k - 1, Token::Kind::name)) return;
  std::size_t end = k + 1;
  // `a.b = value` gives a table of the script's own one more field.
  if (k >= 3 && is(k - 2, ".") && names_at(k - 3, Token::Kind::name) &&
      (k == 3 || (!is(k - 4, ".") && !is(k - 4, ":")))) {
    const ScriptType owner = name_type(word(k - 3));
    const auto* fields = owner.as<ScriptType::Table>();
    if (fields == nullptr) return;
    const ScriptType given = value(end, 0);
    if (!ends_value(end)) return;
    extended_.push_back(fields->fields);
    (*fields->fields)[std::string(word(k - 1))] = given;
    return;
  }
  std::size_t first = k - 1;
  while (first >= 2 && is(first - 1, ",") && names_at(first - 2, Token::Kind::name)) first -= 2;
  if (first > 0 && (is(first - 1, ".") || is(first - 1, ":") || is(first - 1, ","))) return;
  std::vector<std::string_view> names;
  for (std::size_t n = first; n < k; n += 2) names.push_back(word(n));
  ScriptTypeList types = values(end, 0);
  declare_later(end, std::move(names), std::move(types), false);
}

void ScriptTypes::declare_later(std::size_t after_values, std::vector<std::string_view> names,
                                ScriptTypeList types, bool local) {
  if (!ends_value(after_values)) return;  // the reader stands inside these values
  pending_.push_back({after_values, std::move(names), std::move(types), local});
}

void ScriptTypes::bind_pending(std::size_t k) {
  while (!pending_.empty() && pending_.back().at <= k) {
    const Pending now = std::move(pending_.back());
    pending_.pop_back();
    for (std::size_t n = 0; n < now.names.size(); ++n) {
      const ScriptType type = n < now.types.size() ? now.types[n] : ScriptType{};
      now.local ? bind(now.names[n], type) : assign(now.names[n], type);
    }
  }
}

void ScriptTypes::bind(std::string_view name, ScriptType type) {
  places_[name].push_back(bindings_.size());
  bindings_.push_back({name, std::move(type)});
}

void ScriptTypes::assign(std::string_view name, const ScriptType& type) {
  const auto place = places_.find(name);
  ScriptType& kept = place != places_.end() && !place->second.empty() ? bindings_[place->second.back()].type
                                                                      : globals_[std::string(name)];
  if (type.known()) kept = type;
}

void ScriptTypes::close_to(std::size_t opening) {
  while (!open_.empty()) {
    const Open last = open_.back();
    open_.pop_back();
    forget_from(last.bindings);
    if (last.token <= opening) return;
  }
}

void ScriptTypes::forget_from(std::size_t count) {
  while (bindings_.size() > count) {
    places_[bindings_.back().name].pop_back();
    bindings_.pop_back();
  }
}

bool ScriptTypes::ends_value(std::size_t k) const {
  if (k < size()) return true;
  if (open_at_end_ != none && (open_.empty() || open_at_end_ != open_.back().token)) return false;
  if (size() == 0) return false;
  const Token& last = tokens_.back();
  if (last.kind == Token::Kind::text) return !last.open;
  if (last.kind != Token::Kind::sign && last.kind != Token::Kind::keyword) return true;
  const std::string_view end = word(size() - 1);
  for (const std::string_view whole : {")", "]", "}", "end", "nil", "true", "false", "..."})
    if (end == whole) return true;
  return false;
}

ScriptType ScriptTypes::name_type(std::string_view name) const {
  if (const auto place = places_.find(name); place != places_.end() && !place->second.empty())
    return bindings_[place->second.back()].type;
  if (const auto global = globals_.find(std::string(name)); global != globals_.end()) return global->second;
  // A script that has not yet required it means the laboratory all the same.
  if (name == "lab") return script_type("lab");
  for (const std::string_view library :
       {"string", "table", "math", "os", "io", "coroutine", "utf8", "require", "ipairs", "pairs", "assert",
        "setmetatable", "tostring", "type"})
    if (name == library) return {ScriptType::Library{std::string(name)}};
  return {};
}

std::vector<std::pair<std::string, ScriptType>> ScriptTypes::locals() const {
  std::map<std::string_view, const ScriptType*> visible;
  for (const Binding& binding : bindings_) visible[binding.name] = &binding.type;
  std::vector<std::pair<std::string, ScriptType>> result;
  for (const auto& [name, type] : visible) result.emplace_back(name, *type);
  return result;
}

std::vector<std::pair<std::string, ScriptType>> ScriptTypes::globals() const {
  std::vector<std::pair<std::string, ScriptType>> result(globals_.begin(), globals_.end());
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return result;
}

}  // namespace asperity::lua
