// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/completion.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/base_library.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/quantity.hpp"
#include "engine/surface/material.hpp"

namespace asperity::lua {

namespace {

constexpr std::size_t none = ScriptTypes::none;

Candidate of_function(const Function& f) { return {f.name, "method", signature(f), f.sentence}; }

// An option, a parameter of a function, or the first argument of a Lua built-in.
struct Role {
  const OptionInfo* option = nullptr;
  const Parameter* parameter = nullptr;
  const Function* function = nullptr;
  std::string library;
};

class Completer {
 public:
  Completer(std::string_view text, std::size_t position, const std::vector<LiveGlobal>& live)
      : text_(text.substr(0, position)), rest_(text.substr(text_.size())), live_(live) {}

  Completion complete() {
    ScriptTokens tokens = read_tokens(text_);
    result_.from = text_.size();
    if (tokens.ends_in_comment) return std::move(result_);
    bool in_text = false;
    if (!tokens.list.empty() && tokens.list.back().end == text_.size()) {
      const Token last = tokens.list.back();
      if (last.kind == Token::Kind::number) return std::move(result_);
      in_text = last.open;
      if (in_text || last.kind == Token::Kind::name || last.kind == Token::Kind::keyword) {
        result_.from = in_text ? last.content : last.begin;
        tokens.list.pop_back();
      }
    }
    types_.emplace(text_, std::move(tokens.list), live_);
    if (in_text)
      inside_text();
    else
      in_code();
    keep_fitting();
    return std::move(result_);
  }

 private:
  const ScriptTypes& types() const { return *types_; }

  void add(Candidate candidate) { result_.candidates.push_back(std::move(candidate)); }

  void in_code() {
    const std::size_t end = types().size();
    const auto after = [&](std::string_view word) { return end > 0 && types().is(end - 1, word); };
    if (after(".") || after(":")) {
      if (end > 1) members(types().chain_ending_at(end - 2), after(":"));
      return;
    }
    if (after("for") || after("goto") || after("::") || after("function")) return;
    if (after("local")) return add({"function", "keyword", "", ""});
    const std::size_t brace = types().around(end);
    if (brace != none && types().is(brace, "{") && begins_item(end))
      if (const BlockInfo* block = block_of(brace))
        if (!block->is_list() || is_item_of_list(brace)) return keys(*block, brace);
    words_of(role_of(end), true);
    names();
  }

  bool begins_item(std::size_t k) const {
    return k > 0 && (types().is(k - 1, "{") || types().is(k - 1, ",") || types().is(k - 1, ";"));
  }

  bool is_item_of_list(std::size_t brace) const {
    const std::size_t outer = types().around(brace);
    return outer != none && types().is(outer, "{") && begins_item(brace);
  }

  // Function called at the end of token k.
  const Function* function_at(std::size_t k) const {
    const ScriptType called = types().chain_ending_at(k);
    if (const auto* function = called.as<const Function*>()) return *function;
    if (const auto* module = called.as<const Module*>()) return (*module)->call ? &*(*module)->call : nullptr;
    return nullptr;
  }

  bool may_be_called(std::size_t k) const {
    return k < types().size() && (types().token(k).kind == Token::Kind::name || types().is(k, ")") ||
                                  types().is(k, "]") || types().is(k, "}"));
  }

  // Skips nested tables and calls.
  int argument_number(std::size_t open, std::size_t k) const {
    int number = 0;
    for (std::size_t n = open + 1; n < k; ++n) {
      if (types().is(n, ",")) ++number;
      const std::size_t partner = types().partner(n);
      if (partner != none && partner > n) n = partner;
    }
    return number;
  }

  // Options of the table at `brace`; null if unknown.
  const BlockInfo* block_of(std::size_t brace) const {
    constexpr int deepest = 100;
    if (nested_ >= deepest) return nullptr;
    if (const auto known = blocks_.find(brace); known != blocks_.end()) return known->second;
    ++nested_;
    const BlockInfo* const block = block_within_depth(brace);
    --nested_;
    return blocks_[brace] = block;
  }

  const BlockInfo* block_within_depth(std::size_t brace) const {
    if (brace > 0 && may_be_called(brace - 1)) {
      const Function* function = function_at(brace - 1);
      return function != nullptr ? function->options : nullptr;
    }
    const Role role = role_of(brace);
    if (role.option != nullptr) return role.option->inner;
    const std::size_t outer = types().around(brace);
    if (role.function != nullptr && role.parameter == nullptr) return role.function->options;
    if (outer != none && types().is(outer, "{") && begins_item(brace))
      if (const BlockInfo* list = block_of(outer); list != nullptr && list->is_list()) return list;
    return nullptr;
  }

  static const OptionInfo* option_of(const BlockInfo& block, std::string_view name) {
    for (const OptionInfo* option : block.options())
      if (option->name == name) return option;
    return nullptr;
  }

  Role role_of(std::size_t k) const {
    if (k == 0) return {};
    const std::size_t around = types().around(k);
    if (around != none && types().is(around, "{")) {
      if (k >= 2 && types().is(k - 1, "=") && types().token(k - 2).kind == Token::Kind::name) {
        const BlockInfo* block = block_of(around);
        return {block == nullptr ? nullptr : option_of(*block, types().word(k - 2)), nullptr, nullptr, {}};
      }
      if (begins_item(k) && around > 0 && types().is(around - 1, "=")) {
        Role role = role_of(around);
        if (role.option != nullptr && role.option->inner == nullptr) return role;
      }
    }
    std::size_t called = none;
    int number = 0;
    if (around != none && types().is(around, "(") && around > 0 &&
        (around == k - 1 || types().is(k - 1, ","))) {
      called = around - 1;
      number = argument_number(around, k);
    } else if (may_be_called(k - 1)) {
      called = k - 1;
    }
    if (called == none || !may_be_called(called)) return {};
    const ScriptType type = types().chain_ending_at(called);
    if (const auto* library = type.as<ScriptType::Library>())
      return number == 0 ? Role{nullptr, nullptr, nullptr, library->path} : Role{};
    if (types().word(called) == "help" && (called == 0 || !types().is(called - 1, ".")) && !type.known())
      return {nullptr, nullptr, nullptr, "help"};
    const Function* function = function_at(called);
    if (function == nullptr) return {};
    const auto n = static_cast<std::size_t>(number);
    if (n < function->parameters.size()) return {nullptr, &function->parameters[n], function, {}};
    return n == function->parameters.size() ? Role{nullptr, nullptr, function, {}} : Role{};
  }

  void members(const ScriptType& of, bool methods_only) {
    if (const auto* held = of.as<const Module*>()) {
      const Module& module = **held;
      if (methods_only) return;
      for (const Function& f : module.functions) add(of_function(f));
      for (const Constant& c : module.constants) add({c.name, "value", c.type, c.sentence});
      for (const Module* child : modules())
        if (const std::string_view name = name_within(module, *child); !name.empty())
          add({std::string(name), "module", child->call ? signature(*child->call) : "", child->sentence});
    } else if (const auto* type = of.as<const Class*>()) {
      if (!methods_only) fields((*type)->fields);
      for (const Function& method : (*type)->methods) add(of_function(method));
    } else if (const auto* record = of.as<const RecordInfo*>()) {
      if (!methods_only) fields((*record)->fields);
    } else if (const auto* table = of.as<ScriptType::Table>()) {
      if (!methods_only && table->fields != nullptr)
        for (const auto& [name, field] : *table->fields)
          add({name, table->element != nullptr ? "value" : kind_of(field), type_text(field), ""});
    } else if (const auto* library = of.as<ScriptType::Library>()) {
      if (!methods_only) of_library(library->path);
    } else if (of.as<ScriptType::Text>() != nullptr && methods_only) {
      of_library("string");
    }
  }

  void fields(const std::vector<Getter>& list) {
    for (const Getter& field : list) add({field.name, "value", describe_field(field), field.sentence});
  }

  static std::string kind_of(const ScriptType& type) {
    if (type.as<const Module*>() != nullptr) return "module";
    return type.as<const Function*>() != nullptr ? "method" : "global";
  }

  void of_library(const std::string& path) {
    for (const LuaName& name : lua_names())
      if (name.library == path)
        add({name.name, name.is_function ? "method" : "value", path + "." + name.name, "of Lua"});
  }

  void keys(const BlockInfo& block, std::size_t brace) {
    std::set<std::string, std::less<>> given;
    for (std::size_t k = brace + 1; k + 1 < types().size(); ++k) {
      if (types().token(k).kind == Token::Kind::name && types().is(k + 1, "=") && begins_item(k))
        given.emplace(types().word(k));
      const std::size_t partner = types().partner(k);
      if (partner != none && partner > k) k = partner;
    }
    keys_after(given);
    for (const OptionInfo* option : block.options())
      if (!given.contains(std::string_view(option->name))) {
        const std::string unit = si_unit(option->dimension);
        add({option->name, "key", describe_option(*option) + (unit.empty() ? "" : "; a number is in " + unit),
             option->sentence});
      }
  }

  void keys_after(std::set<std::string, std::less<>>& given) const {
    constexpr std::size_t far_enough = 4000;  // bytes
    const std::string_view behind = rest_.substr(0, far_enough);
    const std::vector<Token> tokens = read_tokens(behind).list;
    int depth = 0;
    for (std::size_t k = 0; k < tokens.size(); ++k) {
      const std::string_view word = behind.substr(tokens[k].begin, tokens[k].end - tokens[k].begin);
      if (word == "{" || word == "(" || word == "[") ++depth;
      if (word == "}" || word == ")" || word == "]") --depth;
      if (depth < 0) return;
      if (depth == 0 && word == "=" && k > 0)
        given.emplace(behind.substr(tokens[k - 1].begin, tokens[k - 1].end - tokens[k - 1].begin));
    }
  }

  // "\"free\"|\"periodic\""
  static std::vector<std::string> words_in(std::string_view type) {
    std::vector<std::string> words;
    for (std::size_t at = type.find('"'); at != std::string_view::npos; at = type.find('"', at)) {
      const std::size_t end = type.find('"', at + 1);
      if (end == std::string_view::npos) break;
      words.emplace_back(type.substr(at + 1, end - at - 1));
      at = end + 1;
    }
    return words;
  }

  void words_of(const Role& role, bool with_quotes) {
    const auto words = [&](const auto& named) {
      for (const std::string& word : words_in(named.type))
        add({with_quotes ? "\"" + word + "\"" : word, "value", named.name, named.sentence});
    };
    if (role.option != nullptr) words(*role.option);
    if (role.parameter != nullptr) words(*role.parameter);
    if (with_quotes && role.option != nullptr && role.option->type.find("boolean") != std::string::npos)
      for (const char* word : {"true", "false"})
        add({word, "value", role.option->name, role.option->sentence});
    if (!with_quotes && role.function != nullptr && qualified_name(*role.function) == "lab.material")
      for (const Material& known : named_materials())
        add({known.name, "value",
             known.young ? format_quantity(*known.young, dimension::pressure) : std::string(), known.source});
  }

  void inside_text() {
    const Role role = role_of(types().size());
    words_of(role, false);
    if (role.library == "help" || (role.function != nullptr && qualified_name(*role.function) == "lab.help"))
      for (const std::string& topic : help_topics()) add({topic, "value", "", ""});
    if (role.library == "require") {
      add({"asperity", "module", "", "the laboratory"});
      for (const EmbeddedScript& script : embedded_scripts())
        if (script.name == "paper") add({"asperity.paper", "module", "", "what the paper's examples share"});
    }
    if (role.option != nullptr) {
      const bool single = role.option->dimension != dimension::number;
      quantity_words(single ? role.option->dimension : dimension_of(role.option->type),
                     single ? role.option->default_text : std::string());
    }
    if (role.parameter != nullptr) quantity_words(dimension_of(role.parameter->type), "");
  }

  // For example of "a pressure[]".
  static Dimension dimension_of(std::string_view type) {
    type = type.substr(0, std::min({type.find('['), type.find('?'), type.size()}));
    for (const Dimension known : {dimension::length, dimension::area, dimension::mass, dimension::time,
                                  dimension::angle, dimension::force, dimension::pressure})
      if (describe(known) == type) return known;
    return dimension::number;
  }

  // An example, or a unit after a number.
  void quantity_words(Dimension wanted, const std::string& default_text) {
    if (wanted == dimension::number) return;
    const std::string_view content = text_.substr(result_.from);
    if (content.empty()) {
      const bool quantity = default_text.starts_with("\"") && default_text.ends_with("\"");
      add({quantity ? default_text.substr(1, default_text.size() - 2) : example_quantity(wanted), "value",
           quantity ? "the default" : describe(wanted), ""});
      return;
    }
    const std::size_t number = std::min(content.find_first_not_of("0123456789.-+"), content.size());
    if (number == 0) return;
    const std::size_t unit = std::min(content.find_first_not_of(' ', number), content.size());
    result_.from += unit;
    const std::string space = unit == number ? " " : "";
    for (const std::string& name : usual_units(wanted)) add({space + name, "value", describe(wanted), ""});
    leading_space_ = !space.empty();
  }

  void names() {
    const auto& own = types().names();
    for (const auto& [name, type] : own) add({std::string(name), "global", type_text(type), ""});
    for (const LuaName& name : lua_names())
      if (name.library.empty() && !own.contains(name.name))
        add({name.name, "global", name.is_function ? "a function of Lua" : "of Lua", ""});
    for (const std::string_view word : keywords()) add({std::string(word), "keyword", "", ""});
  }

  void keep_fitting() {
    std::string_view typed = text_.substr(result_.from);
    const auto fits = [&](const std::string& candidate, bool any_case) {
      const std::string_view whole = std::string_view(candidate).substr(leading_space_ ? 1 : 0);
      if (typed.size() > whole.size()) return false;
      const auto letter = [&](char c) { return any_case ? std::tolower(static_cast<unsigned char>(c)) : c; };
      return std::equal(typed.begin(), typed.end(), whole.begin(),
                        [&](char a, char b) { return letter(a) == letter(b); });
    };
    std::vector<Candidate>& all = result_.candidates;
    const bool any_case =
        std::none_of(all.begin(), all.end(), [&](const Candidate& c) { return fits(c.text, false); });
    std::erase_if(all, [&](const Candidate& c) { return !fits(c.text, any_case); });
  }

  std::string_view text_, rest_;
  const std::vector<LiveGlobal>& live_;
  std::optional<ScriptTypes> types_;
  Completion result_;
  mutable std::map<std::size_t, const BlockInfo*> blocks_;  // results of block_of()
  mutable int nested_ = 0;                                  // recursion depth of block_of()
  bool leading_space_ = false;                              // of candidates
};

// Refusals of the sandbox have an upvalue `what`.
bool is_refused(lua_State* L, int index) {
  if (!is_sandbox_function(L, index)) return false;
  bool refused = false;
  for (int k = 1; const char* name = lua_getupvalue(L, index, k); ++k) {
    refused = refused || std::string_view(name) == "what";
    lua_pop(L, 1);
  }
  return refused;
}

void list_table(lua_State* L, const Argument& table, const std::string& library,
                std::vector<LuaName>& names) {
  table.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text() || key.text().starts_with("_")) return;
    const bool function = lua_isfunction(L, value.index());
    if (function && is_refused(L, value.index())) return;
    const std::string name(key.text());
    names.push_back({library, name, function});
    if (library.empty() && lua_istable(L, value.index()) && name != "package")
      list_table(L, value, name, names);
  });
}

std::vector<LuaName> read_names() {
  Session session(Monitor::silent());
  const State state = make_state(session, "");
  std::vector<LuaName> names;
  lua_rawgeti(state.get(), LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  list_table(state.get(), Argument(state.get(), lua_gettop(state.get())), "", names);
  std::sort(names.begin(), names.end(), [](const LuaName& a, const LuaName& b) {
    return std::tie(a.library, a.name) < std::tie(b.library, b.name);
  });
  return names;
}

}  // namespace

Completion complete(std::string_view text, std::size_t position, const std::vector<LiveGlobal>& live) {
  return Completer(text, std::min(position, text.size()), live).complete();
}

const std::vector<LuaName>& lua_names() {
  static const std::vector<LuaName> names = read_names();
  return names;
}

}  // namespace asperity::lua
