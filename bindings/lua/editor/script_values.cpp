// SPDX-License-Identifier: GPL-3.0-or-later
// What the values of a script are, as far as its text and the registry tell: names, fields, calls and their
// results, by a reading from left to right that steps over the bodies of functions and, where nothing
// depends on them, over arguments.
#include <algorithm>
#include <array>

#include "bindings/lua/editor/script_types.hpp"
#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

namespace {

constexpr int deepest_brackets = 40;  // brackets in brackets; beyond, values are unknown

// "State", "ProtocolEvent and State?": one type a turn.
ScriptTypeList types_of_turn(std::string_view text) {
  constexpr std::string_view separator = " and ";
  ScriptTypeList types;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    types.push_back(script_type(text.substr(0, end)));
    text.remove_prefix(std::min(end + separator.size(), text.size()));
  }
  return types;
}

bool is_binary(std::string_view sign) {
  static constexpr std::array<std::string_view, 21> signs = {"+",  "-",  "*",  "/",  "//", "%",   "^",
                                                             "..", "==", "~=", "<=", ">=", "<",   ">",
                                                             "&",  "|",  "~",  "<<", ">>", "and", "or"};
  return !sign.empty() && std::find(signs.begin(), signs.end(), sign) != signs.end();
}

}  // namespace

ScriptType script_type(std::string_view text) {
  if (text.ends_with("?")) return script_type(text.substr(0, text.size() - 1));
  if (const std::size_t at = text.find("[] with "); at != std::string_view::npos) {
    auto fields = std::make_shared<ScriptType::Fields>();
    for (const auto& [name, type] : named_fields(text)) (*fields)[std::string(name)] = script_type(type);
    return {ScriptType::List{std::make_shared<const ScriptType>(script_type(text.substr(0, at))), fields}};
  }
  constexpr std::string_view map = "table<string, ";
  if (text.starts_with(map))
    return {ScriptType::Map{std::make_shared<const ScriptType>(
        script_type(text.substr(map.size(), text.size() - map.size() - 1)))}};
  if (text.starts_with("iterator<"))
    return {ScriptType::Iterator{
        std::make_shared<const ScriptTypeList>(types_of_turn(text.substr(9, text.size() - 10)))}};
  if (text.starts_with("\"")) return {ScriptType::Text{}};
  if (const std::size_t bar = text.find('|'); bar != std::string_view::npos) {
    const ScriptType first = script_type(text.substr(0, bar));
    return first.known() ? first : script_type(text.substr(bar + 1));
  }
  if (text.ends_with("[]"))
    return {
        ScriptType::List{std::make_shared<const ScriptType>(script_type(text.substr(0, text.size() - 2)))}};
  if (text == "number" || text == "integer") return {ScriptType::Number{}};
  if (text == "string") return {ScriptType::Text{}};
  if (const Class* type = find_class(text)) return {type};
  if (const RecordInfo* type = find_record_type(text)) return {type};
  for (const Module* module : modules())
    if (module->path == text) return {module};
  return {};
}

std::string type_text(const ScriptType& type) {
  struct Shower {
    std::string operator()(ScriptType::Unknown) const { return ""; }
    std::string operator()(ScriptType::Number) const { return "a number"; }
    std::string operator()(ScriptType::Text) const { return "a string"; }
    std::string operator()(const Module* module) const { return module->path; }
    std::string operator()(const Class* type) const { return type->article_name; }
    std::string operator()(const RecordInfo* type) const { return "a " + type->title + " result"; }
    std::string operator()(const Function* function) const { return qualified_name(*function); }
    std::string operator()(const ScriptType::List& list) const {
      const std::string element = type_text(*list.element);
      return "a list" + (element.empty() ? "" : ", each " + element);
    }
    std::string operator()(const ScriptType::Map&) const { return "a result"; }
    std::string operator()(const ScriptType::Iterator&) const { return "an iterator"; }
    std::string operator()(const ScriptType::Table&) const { return "a table"; }
    std::string operator()(ScriptType::Closure) const { return "a function"; }
    std::string operator()(const ScriptType::Library&) const { return ""; }
  };
  return std::visit(Shower{}, type.data);
}

namespace {

// The operator of a native value on either side, if its class has one for this sign; "" is the sign before a
// value.
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

}  // namespace

ScriptTypeList ScriptTypes::values(std::size_t& k, int depth) const {
  ScriptTypeList all;
  for (;;) {
    std::size_t from = k;
    ScriptTypeList types;
    if (depth < deepest_brackets) types = operand(k, depth, size());
    // Only the last of a list gives more than its first value, and only where nothing is done with it.
    if (k < size() && is_binary(word(k))) {
      const std::size_t reached = k;
      k = from;
      types = {value(k, depth)};
      steps_ += reached - from;
    }
    const bool more = is(k, ",");
    if (types.empty()) types.emplace_back();
    if (more) types.resize(1);
    all.insert(all.end(), types.begin(), types.end());
    if (!more || k == from) return all;
    ++k;
  }
}

ScriptType ScriptTypes::value(std::size_t& k, int depth) const {
  if (depth >= deepest_brackets) return {};
  ScriptTypeList types = operand(k, depth, size());
  ScriptType result = types.empty() ? ScriptType{} : types.front();
  while (k < size() && tokens_[k].kind != Token::Kind::text && is_binary(word(k))) {
    const std::string_view sign = word(k);
    std::size_t next = k + 1;
    types = operand(next, depth, size());
    if (next == k + 1) {  // nothing after the sign
      k = next;
      return {};
    }
    k = next;
    const ScriptType right = types.empty() ? ScriptType{} : types.front();
    if (sign == "and")
      result = right;
    else if (sign == "or")
      result = result.known() ? result : right;
    else if (sign == "..")
      result = {ScriptType::Text{}};
    else if (const Operator* of_class = operator_of(result, right, sign))
      result = script_type(of_class->returns);
    else
      result = {ScriptType::Number{}};
  }
  return result;
}

ScriptTypeList ScriptTypes::operand(std::size_t& k, int depth, std::size_t stop) const {
  bool changed = false, negated = true;  // by nothing else than "-"
  while (k < stop && (is(k, "not") || is(k, "-") || is(k, "#") || is(k, "~"))) {
    negated = negated && is(k, "-");
    ++k;
    changed = true;
  }
  if (k >= stop) return {};
  ++steps_;
  const Token& token = tokens_[k];
  ScriptTypeList types;
  if (token.kind == Token::Kind::number) {
    ++k;
    types = {{ScriptType::Number{}}};
  } else if (token.kind == Token::Kind::text) {
    ++k;
    types = {{ScriptType::Text{}}};
  } else if (is(k, "function")) {
    types = {{ScriptType::Closure{k}}};
    k = partner_[k] == none ? stop : partner_[k] + 1;
  } else if (is(k, "{")) {
    types = {table(k, depth + 1)};
    k = partner_[k] == none ? stop : partner_[k] + 1;
  } else if (is(k, "(")) {
    std::size_t inner = k + 1;
    types = {value(inner, depth + 1)};
    k = partner_[k] == none ? stop : partner_[k] + 1;
    suffixes(k, types, depth, stop);
  } else if (token.kind == Token::Kind::name) {
    types = {name_type(word(k++))};
    suffixes(k, types, depth, stop);
  } else if (is(k, "nil") || is(k, "true") || is(k, "false") || is(k, "...")) {
    ++k;
    types = {{}};
  }
  if (!changed) return types;
  const Operator* negative =
      negated && !types.empty() ? operator_of(types.front(), types.front(), "") : nullptr;
  return {negative != nullptr ? script_type(negative->returns) : ScriptType{ScriptType::Number{}}};
}

void ScriptTypes::suffixes(std::size_t& k, ScriptTypeList& types, int depth, std::size_t stop) const {
  while (k < stop) {
    ++steps_;
    const ScriptType now = types.empty() ? ScriptType{} : types.front();
    if ((is(k, ".") || is(k, ":")) && k + 1 < stop && names_at(k + 1, Token::Kind::name)) {
      types = {member(now, word(k + 1))};
      k += 2;
    } else if (is(k, "[")) {
      const auto* list = now.as<ScriptType::List>();
      const auto* map = now.as<ScriptType::Map>();
      types = {list != nullptr ? *list->element : map != nullptr ? *map->element : ScriptType{}};
      k = partner_[k] == none ? stop : partner_[k] + 1;
    } else if (is(k, "(") || is(k, "{")) {
      types = call(now, k, depth);
      k = partner_[k] == none ? stop : partner_[k] + 1;
    } else if (tokens_[k].kind == Token::Kind::text) {
      types = call(now, k, depth);
      ++k;
    } else {
      return;
    }
  }
}

ScriptType ScriptTypes::table(std::size_t open, int depth) const {
  auto fields = std::make_shared<ScriptType::Fields>();
  const std::size_t close = partner_[open];
  ScriptType element;
  // Of a table that is not closed nothing is asked: the reader stands inside. A statement in a table is a
  // bracket that was forgotten.
  for (std::size_t k = open + 1; close != none && k < close;) {
    ++steps_;
    if (names_at(k, Token::Kind::keyword) && !is(k, "function") && !is(k, "not") && !is(k, "nil") &&
        !is(k, "true") && !is(k, "false"))
      break;
    if (names_at(k, Token::Kind::name) && is(k + 1, "=")) {
      const std::string name(word(k));
      k += 2;
      (*fields)[name] = value(k, depth);
    } else if (is(k, "[") && partner_[k] != none && is(partner_[k] + 1, "=")) {
      k = partner_[k] + 2;
      const ScriptType given = value(k, depth);
      if (!element.known()) element = given;
    } else {
      const std::size_t from = k;
      const ScriptType given = value(k, depth);
      if (!element.known()) element = given;
      if (k == from) ++k;  // something that is no value
    }
    if (is(k, ",") || is(k, ";")) ++k;
  }
  if (fields->empty() && element.known())
    return {ScriptType::List{std::make_shared<const ScriptType>(std::move(element))}};
  return {ScriptType::Table{std::move(fields)}};
}

ScriptType ScriptTypes::member(const ScriptType& of, std::string_view name) const {
  const auto named = [&](const auto& list) {
    return std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
  };
  if (const auto* held = of.as<const Module*>()) {
    const Module& module = **held;
    if (const auto f = named(module.functions); f != module.functions.end()) return {&*f};
    if (const auto c = named(module.constants); c != module.constants.end()) return script_type(c->type);
    return script_type(module.path + "." + std::string(name));
  }
  if (const auto* held = of.as<const Class*>()) {
    const Class& type = **held;
    if (const auto f = named(type.methods); f != type.methods.end()) return {&*f};
    if (const auto g = named(type.fields); g != type.fields.end()) return script_type(g->type);
    return {};
  }
  if (const auto* held = of.as<const RecordInfo*>()) {
    const auto field = named((*held)->fields);
    return field == (*held)->fields.end() ? ScriptType{} : script_type(field->type);
  }
  if (const auto* held = of.as<ScriptType::Map>()) return *held->element;
  if (const auto* held = of.as<ScriptType::List>(); held != nullptr && held->fields != nullptr) {
    const auto field = held->fields->find(name);
    return field == held->fields->end() ? ScriptType{} : field->second;
  }
  if (const auto* held = of.as<ScriptType::Table>()) {
    const auto field = held->fields->find(name);
    return field == held->fields->end() ? ScriptType{} : field->second;
  }
  if (const auto* held = of.as<ScriptType::Library>())
    return {ScriptType::Library{held->path + "." + std::string(name)}};
  if (of.as<ScriptType::Text>() != nullptr) return {ScriptType::Library{"string." + std::string(name)}};
  return {};
}

ScriptTypeList ScriptTypes::call(const ScriptType& function, std::size_t arguments, int depth) const {
  ++steps_;
  const auto results_of = [](const Function& f) {
    ScriptTypeList types;
    for (const std::string& type : result_types(f)) types.push_back(script_type(type));
    return types;
  };
  if (const auto* held = function.as<const Function*>()) return results_of(**held);
  if (const auto* held = function.as<const Module*>())
    return (*held)->call ? results_of(*(*held)->call) : ScriptTypeList{};
  if (const auto* closure = function.as<ScriptType::Closure>()) {
    const auto results = results_.find(closure->token);
    return results == results_.end() ? ScriptTypeList{} : results->second;
  }
  const auto* library = function.as<ScriptType::Library>();
  if (library == nullptr) return {};
  const auto first_argument = [&]() -> ScriptType {
    std::size_t k = is(arguments, "(") ? arguments + 1 : arguments;
    return value(k, depth + 1);
  };
  const std::string& path = library->path;
  if (path == "require") {
    const std::size_t k = is(arguments, "(") ? arguments + 1 : arguments;
    if (!names_at(k, Token::Kind::text)) return {};
    const std::string_view name = text_.substr(tokens_[k].content, tokens_[k].end - tokens_[k].content);
    return name.starts_with("asperity") && name.size() == 9 ? ScriptTypeList{script_type("lab")}
                                                            : ScriptTypeList{};
  }
  if (path == "ipairs" || path == "pairs") {
    const ScriptType of = first_argument();
    const auto* list = of.as<ScriptType::List>();
    const auto* map = of.as<ScriptType::Map>();
    auto turn = std::make_shared<const ScriptTypeList>(
        ScriptTypeList{path == "ipairs" || list != nullptr ? ScriptType{ScriptType::Number{}} : ScriptType{},
                       list != nullptr                     ? *list->element
                       : map != nullptr && path == "pairs" ? *map->element
                                                           : ScriptType{}});
    return {{ScriptType::Iterator{std::move(turn)}}};
  }
  if (path == "assert" || path == "setmetatable") return {first_argument()};
  if (path.starts_with("math.")) return {{ScriptType::Number{}}};
  for (const std::string_view text : {"tostring", "type", "string.format", "string.rep", "string.sub",
                                      "string.upper", "string.lower", "string.gsub", "table.concat"})
    if (path == text) return {{ScriptType::Text{}}};
  return {};
}

ScriptTypeList ScriptTypes::turn_of(const ScriptType& iterated) const {
  const auto* iterator = iterated.as<ScriptType::Iterator>();
  return iterator == nullptr ? ScriptTypeList{} : *iterator->turn;
}

std::size_t ScriptTypes::chain_begin(std::size_t last) const {
  // Back to where the chain begins, over calls and indices as wholes.
  for (std::size_t k = last; k < size();) {
    ++steps_;
    const bool group = is(k, ")") || is(k, "]") || is(k, "}");
    if (group) {
      if (partner_[k] == none) return none;
      k = partner_[k];
    }
    const bool text = tokens_[k].kind == Token::Kind::text;
    if (!group && !text && tokens_[k].kind != Token::Kind::name) return none;
    if (!group && !text) {
      if (k < 2 || (!is(k - 1, ".") && !is(k - 1, ":"))) return k;
      k -= 2;
      continue;
    }
    // A group or text after a name, another group or a text is an argument; otherwise the chain begins here.
    const bool argument = k > 0 && (tokens_[k - 1].kind == Token::Kind::name || is(k - 1, ")") ||
                                    is(k - 1, "]") || is(k - 1, "}"));
    if (!argument) return k;
    --k;
  }
  return none;
}

ScriptType ScriptTypes::chain_ending_at(std::size_t last) const {
  std::size_t k = chain_begin(last);
  if (k == none) return {};
  const ScriptTypeList types = operand(k, 0, last + 1);
  return types.empty() ? ScriptType{} : types.front();
}

}  // namespace asperity::lua
