// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/help.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "bindings/lua/registry/record_type.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

std::string signature(const Function& function) {
  std::string text = qualified_name(function);
  std::vector<std::string> parts;
  for (const Parameter& p : function.parameters) {
    const bool optional = p.type.ends_with("?");
    parts.push_back(optional ? "[" + p.name + "]" : std::string(p.name));
  }
  if (function.options != nullptr && function.options->is_list()) {
    std::string keys;
    for (const OptionInfo* option : function.options->options())
      keys += (keys.empty() ? "{" : " | {") + option->name + "=}";
    return text + "{ " + keys + ", ... }";
  }
  if (function.options != nullptr) {
    std::string keys;
    for (const OptionInfo* option : function.options->options())
      keys += (keys.empty() ? "" : ", ") + option->name + "=" + option->default_text;
    if (parts.empty()) return text + "{ " + keys + " }";
    parts.push_back((function.options.optional ? "[{ " : "{ ") + keys +
                    (function.options.optional ? " }]" : " }"));
  }
  return text + "(" + joined(parts, ", ") + ")";
}

std::string describe_option(const OptionInfo& option) {
  std::string text = option.type;
  if (!option.range_text.empty()) text += " " + option.range_text;
  if (option.required)
    text += ", required";
  else if (!option.default_text.empty())
    text += ", default " + option.default_text;
  return text;
}

std::string describe_field(const Getter& field) {
  const std::string unit = si_unit(field.dimension);
  return field.type + (unit.empty() ? "" : ", " + unit);
}

namespace {

// Nested options follow their table, as `accuracy.tolerance`.
struct NamedOption {
  std::string name;
  const OptionInfo* option;
  std::string call;
};

void add_options(const BlockInfo& block, const std::string& prefix, const std::string& call,
                 std::vector<NamedOption>& found) {
  for (const OptionInfo* option : block.options()) {
    found.push_back({prefix + option->name, option, call});
    if (option->inner != nullptr) add_options(*option->inner, prefix + option->name + ".", call, found);
  }
}

std::vector<NamedOption> options_of(const Function& function) {
  std::vector<NamedOption> found;
  if (function.options != nullptr) add_options(*function.options, "", qualified_name(function), found);
  return found;
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : text + std::string(width - text.size(), ' ');
}

struct Row {
  std::string name, accepts, meaning;
};

std::vector<Row> rows_of(const std::vector<Getter>& fields) {
  std::vector<Row> rows;
  for (const Getter& field : fields) rows.push_back({field.name, describe_field(field), field.sentence});
  return rows;
}

std::vector<Row> rows_of(const Function& function) {
  std::vector<Row> rows;
  for (const Parameter& p : function.parameters) rows.push_back({p.name, p.type, p.sentence});
  for (const auto& [name, option, call] : options_of(function))
    rows.push_back({name, describe_option(*option), option->sentence});
  return rows;
}

std::string rows_help(const std::vector<Row>& rows, std::size_t width = 0) {
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string text;
  for (const Row& row : rows)
    text += "  " + padded(row.name, width) + "  " + row.meaning +
            (row.accepts.empty() ? "" : " (" + row.accepts + ")") + "\n";
  return text;
}

std::string record_help(const RecordInfo& type) {
  return type.name + ": " + type.sentence + "\n" + rows_help(rows_of(type.fields));
}

// Includes records of fields.
void add_records_of(const std::string& of, std::vector<const RecordInfo*>& found) {
  for (const RecordInfo* type : record_types_in(of)) {
    if (std::find(found.begin(), found.end(), type) != found.end()) continue;
    found.push_back(type);
    for (const Getter& field : type->fields) add_records_of(field.type, found);
  }
}

std::string records_help(const std::string& of) {
  std::vector<const RecordInfo*> found;
  add_records_of(of, found);
  std::string text;
  for (const RecordInfo* type : found) text += "\n" + record_help(*type);
  return text;
}

// Functions and fields with this type.
std::vector<std::string> givers_of(const RecordInfo& type) {
  std::vector<std::string> givers;
  const auto look_at = [&](const std::string& giver, const std::string& of) {
    const std::vector<const RecordInfo*> named = record_types_in(of);
    if (std::find(named.begin(), named.end(), &type) != named.end()) givers.push_back(giver);
  };
  for (const Module* module : modules())
    for (const Function& f : module->functions) look_at(qualified_name(f), f.returns);
  for (const Class* value : classes()) {
    for (const Function& f : value->methods) look_at(qualified_name(f), f.returns);
    for (const Getter& field : value->fields) look_at(value->name + "." + field.name, field.type);
  }
  for (const RecordInfo* other : record_types())
    for (const Getter& field : other->fields) look_at(other->name + "." + field.name, field.type);
  return givers;
}

// Title; per row its name and the other cells with headings.
std::string listing_help(const Listing& listing) {
  std::string text = "\n" + listing.title + ":\n";
  for (const std::vector<std::string>& row : listing.rows) {
    text += "  " + row.front() + "\n";
    for (std::size_t k = 1; k < row.size(); ++k)
      if (!row[k].empty()) text += "    " + listing.columns[k] + ": " + row[k] + "\n";
  }
  return text;
}

std::string function_help(const Function& function) {
  std::string text = signature(function);
  if (!function.returns.empty()) text += "  ->  " + function.returns;
  text += "\n\n" + function.sentence + "\n";
  if (const std::vector<Row> rows = rows_of(function); !rows.empty()) text += "\n" + rows_help(rows);
  text += records_help(function.returns);
  if (function.listing != nullptr) text += listing_help(function.listing());
  if (!function.example.empty()) text += "\nExample:\n  " + function.example + "\n";
  return text;
}

std::string class_help(const Class& type) {
  std::string text = type.name + ": " + type.sentence + "\n";
  std::size_t width = 0;
  for (const std::string& name : type.names()) width = std::max(width, name.size());
  if (!type.fields.empty()) text += "\nFields:\n" + rows_help(rows_of(type.fields), width);
  if (!type.methods.empty()) text += "\nMethods:\n";
  for (const Function& method : type.methods)
    text += "  " + padded(method.name, width) + "  " + method.sentence + "\n";
  if (!type.operators.empty()) text += "\nOperators:\n";
  for (const Operator& operation : type.operators)
    text += "  " + padded(operation.form, width) + "  " + operation.sentence + " E.g. " + operation.example +
            "\n";
  return text;
}

std::string module_help(const Module& module) {
  std::string text = module.path + ": " + module.sentence + "\n\n";
  if (module.call) text += function_help(*module.call) + "\n";
  std::vector<Row> rows;
  for (const Function& f : module.functions) rows.push_back({f.name, "", f.sentence});
  for (const Constant& c : module.constants) rows.push_back({c.name, "", c.sentence});
  for (const Module* child : modules())
    if (const std::string_view name = name_within(module, *child); !name.empty())
      rows.push_back({std::string(name), "", child->sentence});
  return text + rows_help(rows);
}

std::string topics_help() {
  std::string text = "Modules:\n";
  for (const Module* module : modules())
    text += "  " + padded(module->path, 16) + "  " + module->sentence + "\n";
  text += "\nValues:\n";
  for (const Class* type : classes()) text += "  " + padded(type->name, 16) + "  " + type->sentence + "\n";
  return text +
         "\nAsk for any of these, or for a function or method by name: help \"surface.sine\", help "
         "\"press\".\n";
}

// "sine" for "lab.surface.sine", "scaled" for "surface:scaled".
std::string last_name(const std::string& path) {
  const std::size_t at = path.find_last_of(".:");
  return at == std::string::npos ? path : path.substr(at + 1);
}

struct Topic {
  std::string name;
  std::string text;
  std::string sentence;     // of the text
  bool exact_name = false;  // "tilt" does not mean `Tilt`
  bool of_record = false;   // rarely searched by its bare name
};

std::vector<Topic> collect_topics() {
  std::vector<Topic> topics;
  for (const Module* module : modules()) {
    topics.push_back({module->path, module_help(*module), module->sentence});
    for (const Function& f : module->functions)
      topics.push_back({qualified_name(f), function_help(f), f.sentence});
    for (const Constant& c : module->constants)
      topics.push_back(
          {module->path + "." + c.name, module->path + "." + c.name + ": " + c.sentence + "\n", c.sentence});
  }
  for (const Class* type : classes()) {
    topics.push_back({type->name, class_help(*type), type->sentence});
    for (const Function& f : type->methods)
      topics.push_back({qualified_name(f), function_help(f), f.sentence});
    for (const Getter& field : type->fields)
      topics.push_back({type->name + "." + field.name,
                        type->name + "." + field.name + ": " + field.sentence + " (" + describe_field(field) +
                            ")\n" + records_help(field.type),
                        field.sentence});
  }
  for (const RecordInfo* type : record_types()) {
    const std::string givers = joined(givers_of(*type), " and ");
    topics.push_back({type->name, record_help(*type) + "\nGiven by " + givers + ".\n",
                      type->sentence + " Given by " + givers + ".", true});
    for (const Getter& field : type->fields) {
      const std::string name = type->name + "." + field.name;
      topics.push_back(
          {name, name + ", of " + givers + ": " + field.sentence + " (" + describe_field(field) + ")\n",
           field.sentence, false, true});
    }
  }
  return topics;
}

const std::vector<Topic>& all_topics() {
  static const std::vector<Topic> topics = collect_topics();
  return topics;
}

const std::vector<NamedOption>& all_options() {
  static const std::vector<NamedOption> all = [] {
    std::vector<NamedOption> found;
    for (const Module* module : modules()) {
      if (module->call) append(found, options_of(*module->call));
      for (const Function& f : module->functions) append(found, options_of(f));
    }
    for (const Class* type : classes())
      for (const Function& f : type->methods) append(found, options_of(f));
    return found;
  }();
  return all;
}

bool same_word(std::string_view a, std::string_view b) { return lower_case(a) == lower_case(b); }

std::string keys_help(const std::string& name) {
  std::string text;
  for (const auto& [path, option, call] : all_options())
    if (same_word(path, name) || same_word(last_name(path), name))
      text +=
          "Key `" + path + "` of " + call + ": " + option->sentence + " (" + describe_option(*option) + ")\n";
  return text;
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Matches beginnings of words.
bool has_word(std::string_view sentence, std::string_view word) {
  for (std::size_t at = sentence.find(word); at != std::string_view::npos; at = sentence.find(word, at + 1))
    if (at == 0 || !is_letter(sentence[at - 1])) return true;
  return false;
}

// Matches in names, then in sentences; "" for none and for a single letter. `beside`: exact names are shown
// already.
std::string hits_help(const std::string& asked, const std::vector<Topic>& topics, bool beside) {
  const std::string word = lower_case(asked);
  if (word.size() < 2 || word.find_first_not_of(' ') == std::string::npos) return "";
  std::vector<std::string> by_name, by_sentence;
  const auto look = [&](const std::string& name, std::string_view own, const std::string& sentence,
                        const std::string& type) {
    if (beside && lower_case(own) == word) return;
    if (has_word(lower_case(own), word))
      by_name.push_back(name + ": " + sentence);
    else if (has_word(lower_case(sentence + " " + type), word))
      by_sentence.push_back(name + ": " + sentence);
  };
  for (const Topic& topic : topics) look(topic.name, last_name(topic.name), topic.sentence, "");
  for (const auto& [path, option, call] : all_options())
    look("key `" + path + "` of " + call, last_name(path), option->sentence, option->type);
  const std::size_t found = by_name.size() + by_sentence.size();
  if (found == 0) return "";
  by_name.insert(by_name.end(), by_sentence.begin(), by_sentence.end());
  constexpr std::size_t most = 40;
  std::string text = quoted(asked) + " is part of\n";
  for (std::size_t k = 0; k < std::min(found, most); ++k) text += "  " + by_name[k] + "\n";
  if (found > most) text += "  and " + std::to_string(found - most) + " more\n";
  return text;
}

// Words without empty ones, as stems: "turning" is "turn".
std::vector<std::string> stems_of(const std::string& question) {
  static const std::set<std::string> empty_words = {
      "a",   "an",  "and", "are", "at",   "can",  "do",    "does",  "for",  "from", "get", "have",
      "how", "i",   "in",  "is",  "it",   "me",   "my",    "of",    "on",   "or",   "the", "this",
      "to",  "use", "up",  "we",  "what", "when", "where", "which", "with", "you"};
  std::vector<std::string> stems;
  std::istringstream stream(lower_case(question));
  for (std::string word; stream >> word;) {
    std::erase_if(word, [](char c) { return !is_letter(c); });
    if (word.empty() || empty_words.contains(word)) continue;
    for (const std::string_view ending : {"ing", "ed", "es", "s"})
      if (word.size() > ending.size() + 2 && word.ends_with(ending)) {
        word.resize(word.size() - ending.size());
        break;
      }
    stems.push_back(word);
  }
  return stems;
}

// Topics with the rarest words; "" for a single word. Words of the last name and of the sentence's beginning
// count twice. Values, results and their fields (in capitals) count half.
std::string question_help(const std::string& asked, const std::vector<Topic>& topics) {
  if (asked.find(' ') == std::string::npos) return "";
  static const std::vector<std::pair<std::string_view, std::string>> synonyms = {
      {"load", "read"},   {"open", "read"},     {"save", "write"},
      {"map", "surface"}, {"trace", "profile"}, {"line", "curve"}};
  struct Score {
    double score;
    std::size_t length, topic;
    auto operator<=>(const Score&) const = default;
  };
  std::vector<Score> scores;
  for (const Topic& topic : topics) scores.push_back({0, topic.name.size(), scores.size()});
  for (const std::string& stem : stems_of(asked)) {
    const auto same = std::ranges::find_if(
        synonyms, [&](const auto& pair) { return stem.size() > 2 && pair.first.starts_with(stem); });
    const auto has = [&](const std::string& text) {
      const std::string lower = lower_case(text);
      return has_word(lower, stem) || (same != synonyms.end() && has_word(lower, same->second));
    };
    std::vector<std::pair<std::size_t, double>> hits;
    for (std::size_t k = 0; k < topics.size(); ++k)
      if (const auto& [name, text, sentence, exact, field] = topics[k]; has(name + " " + sentence))
        hits.emplace_back(k, (has(last_name(name) + " " + sentence.substr(0, 24)) ? -2 : -1) *
                                 (std::isupper(static_cast<unsigned char>(name[0])) != 0 ? 0.5 : 1));
    for (const auto& [k, weight] : hits)
      scores[k].score += weight / std::sqrt(static_cast<double>(hits.size()));
  }
  std::ranges::sort(scores);
  std::string found;
  for (std::size_t k = 0; k < std::min<std::size_t>(8, scores.size()) && scores[k].score < 0; ++k)
    found += "  " + topics[scores[k].topic].name + ": " + topics[scores[k].topic].sentence + "\n";
  return found.empty() ? "" : "nearest to " + quoted(asked) + " are\n" + found;
}

std::string cell(std::string text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string table_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& text : cells) line += " " + cell(text) + " |";
  return line + "\n";
}

void listing_reference(std::string& page, const Listing& listing) {
  page += listing.title + ":\n\n" + table_row(listing.columns) + "|";
  for (std::size_t k = 0; k < listing.columns.size(); ++k) page += "---|";
  page += "\n";
  for (const std::vector<std::string>& row : listing.rows) page += table_row(row);
  page += "\n";
}

void rows_reference(std::string& page, const char* heading, const std::vector<Row>& rows) {
  if (rows.empty()) return;
  page += std::string(heading) + "|---|---|---|\n";
  for (const Row& row : rows) page += table_row({"`" + row.name + "`", row.accepts, row.meaning});
  page += "\n";
}

void function_reference(std::string& page, const Function& function) {
  page += "### `" + qualified_name(function) + "`\n\n" + function.sentence + "\n\n";
  page += "```lua\n" + signature(function) + (function.returns.empty() ? "" : "  --> " + function.returns) +
          "\n```\n\n";
  rows_reference(page, "| name | accepts | meaning |\n", rows_of(function));
  if (function.listing != nullptr) listing_reference(page, function.listing());
  if (!function.example.empty()) page += "```lua\n" + function.example + "\n```\n\n";
}

void operators_reference(std::string& page, const std::vector<Operator>& operators) {
  if (operators.empty()) return;
  page += "| operator | gives | meaning | example |\n|---|---|---|---|\n";
  for (const Operator& operation : operators)
    page += table_row(
        {"`" + operation.form + "`", operation.returns, operation.sentence, "`" + operation.example + "`"});
  page += "\n";
}

// With its first module or class.
void records_reference(std::string& page, const std::vector<const RecordInfo*>& results,
                       std::vector<const RecordInfo*>& told) {
  for (const RecordInfo* type : results) {
    if (std::find(told.begin(), told.end(), type) != told.end()) continue;
    told.push_back(type);
    std::vector<std::string> givers;
    for (const std::string& giver : givers_of(*type)) givers.push_back("`" + giver + "`");
    page += "### " + type->name + "\n\n" + type->sentence + " Given by " + joined(givers, " and ") + ".\n\n";
    rows_reference(page, "| field | type | meaning |\n", rows_of(type->fields));
  }
}

}  // namespace

std::string help_text(const std::string& topic) {
  if (topic.empty()) return topics_help();
  const std::vector<Topic>& topics = all_topics();
  // `Surface` is a value, `surface` a module.
  for (const std::string& name : {topic, "lab." + topic})
    for (const Topic& t : topics)
      if (t.name == name) return t.text;
  for (const Topic& t : topics)
    if (!t.exact_name && (same_word(t.name, topic) || same_word(t.name, "lab." + topic))) return t.text;
  std::string found;
  bool fields_alone = true;
  for (const Topic& t : topics)
    if (!t.exact_name && same_word(last_name(t.name), topic)) {
      found += (found.empty() ? "" : "\n") + t.text;
      fields_alone = fields_alone && t.of_record;
    }
  if (const std::string keys = keys_help(topic); !keys.empty()) {
    found += (found.empty() ? "" : "\n") + keys;
    fields_alone = false;
  }
  if (!found.empty() && !fields_alone) return found;
  if (const std::string hits = hits_help(topic, topics, !found.empty()); !hits.empty())
    return found + (found.empty() ? "" : "\n") + hits;
  if (!found.empty()) return found;
  if (const std::string nearest = question_help(topic, topics); !nearest.empty()) return nearest;
  std::vector<std::string> names;
  for (const NamedOption& key : all_options()) names.push_back(last_name(key.name));
  for (const Topic& t : topics) {
    names.push_back(t.name);
    names.push_back(last_name(t.name));
  }
  refuse_name("there is no help on " + quoted(topic) + did_you_mean(topic, names),
              "help without a topic lists all topics");
}

std::vector<std::string> help_topics() {
  std::vector<std::string> names;
  for (const Topic& topic : all_topics()) names.push_back(topic.name);
  return names;
}

const std::string& example_preamble() {
  static const std::string text = R"(local lab = require "asperity"
local al = lab.material "Al-2011"
local function face(seed)
  return lab.surface.self_affine{ cells=64, size="640 um", hurst=0.8, ra="1 um", short_wave="40 um", seed=seed,
                                  material=al }
end
local s, fine = face(1), face(2):scaled{ ra="0.1 um" }
local p = s:profile{ row=0 }
local grain = lab.surface.grain_profile{ radius="100 um", D=1.3, points=512 }
local stylus = lab.stylus{ tip="2 um", spacing="1 um", length="0.5 mm" }
local c = lab.contact{ lower=s, upper=lab.material "quartz", boundary="periodic", accuracy={ estimate=true },
                       effects={ elasticity="half_space", tangential={} } }
local st = c:press{ pressure="10 MPa" }
local q = c:shear{ ratio=0.5, friction=0.3 }
local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
local stage = lab.tilt_stage{ contact=c, friction=law, mass="4.3 g" }
local protocol = lab.protocol{ { press={ pressure="10 MPa" } }, { release=true }, { rotate="90 deg" } }
local book = lab.notebook "examples"
for N = 1, 3 do book:write{ N=N, D=2.5, r=0.1, mu=0.4 + 0.01 * N } end
local t = book:table()
local study = lab.work_precision{
  ask=function(knobs) return lab.exact.hertz{ radius=1, modulus=1, load=1 }.approach + 1e-2 / knobs.cells ^ 2 end,
  truth={ cells=1024 }, try={ { name="finer grid", cells={ 16, 32, 64 } } }, repeats=1,
}
local tile = lab.spread.sine{ cells=64, size="1 mm", amplitude="1 um", material=al }
local spread = lab.spread.contact{ lower=tile, upper=lab.rigid, boundary="periodic",
                                   effects={ elasticity="half_space" } }
local under = spread:press{ pressure="10 MPa" }
s:write "specimen.txt" p:write "scan.csv" protocol:write "press_log.csv"
lab.table.from{ { ["force"]=3, mu=0.42 } }:write "mu.csv"
)";
  return text;
}

std::string reference_page() {
  std::string page =
      "# Reference\n\n<!-- Generated by `asperity help --reference`; do not edit. -->\n\n"
      "Every function, value and key of the language, from the same entries that drive the program.\n"
      "The same inputs give the same bits on every x86-64 processor, in every build and for any number of "
      "threads.\n"
      "Two kinds of results are excepted: of contacts spread over several ranks (`lab.spread`), whose\n"
      "transforms depend on the processor, and of `^` and `math` in a script, which come from the C "
      "library.\n"
      "If results differ, `asperity replay` names processor, C library and build. `pairs` and `next` follow\n"
      "one order: numbers, strings by their bytes, booleans.\n"
      "A quantity is a plain SI number or a string with a unit, `\"250 um\"`. Every entry has an example "
      "that runs\n"
      "after these lines:\n\n```lua\n" +
      example_preamble() + "```\n\n";
  std::vector<const RecordInfo*> told;
  for (const Module* module : modules()) {
    page += "## `" + module->path + "`\n\n" + module->sentence + "\n\n";
    if (!module->constants.empty()) {
      page += "| constant | meaning |\n|---|---|\n";
      for (const Constant& c : module->constants)
        page += "| `" + module->path + "." + c.name + "` | " + cell(c.sentence) + " |\n";
      page += "\n";
    }
    if (module->call) function_reference(page, *module->call);
    for (const Function& f : module->functions) function_reference(page, f);
    records_reference(page, module->results, told);
  }
  for (const Class* type : classes()) {
    page += "## " + type->name + "\n\n" + type->sentence + "\n\n";
    rows_reference(page, "| field | type | meaning |\n", rows_of(type->fields));
    if (!type->drawing.empty()) page += "```text\n" + type->drawing + "```\n\n";
    operators_reference(page, type->operators);
    // Notebooks share most methods with tables.
    const Class& table = *find_class("Table");
    const auto shared = [&](const Function& f) {
      return type != &table &&
             std::ranges::find(table.methods, f.body, &Function::body) != table.methods.end();
    };
    for (const Function& f : type->methods)
      if (!shared(f)) function_reference(page, f);
    if (std::ranges::any_of(type->methods, shared)) page += "All methods of [Table](#table).\n\n";
    records_reference(page, type->results, told);
  }
  while (page.ends_with("\n\n")) page.pop_back();
  return page;
}

}  // namespace asperity::lua
