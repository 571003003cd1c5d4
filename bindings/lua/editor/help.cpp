// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/help.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

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
    parts.push_back(optional ? "[" + p.name + "]" : p.name);
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
    parts.push_back((function.options_optional ? "[{ " : "{ ") + keys +
                    (function.options_optional ? " }]" : " }"));
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
};
std::vector<NamedOption> all_options(const BlockInfo& block, const std::string& prefix = "") {
  std::vector<NamedOption> result;
  for (const OptionInfo* option : block.options()) {
    result.push_back({prefix + option->name, option});
    if (option->inner == nullptr) continue;
    for (NamedOption& inner : all_options(*option->inner, prefix + option->name + "."))
      result.push_back(std::move(inner));
  }
  return result;
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : text + std::string(width - text.size(), ' ');
}

std::string fields_help(const std::vector<Getter>& fields, std::size_t width = 0) {
  for (const Getter& field : fields) width = std::max(width, field.name.size());
  std::string text;
  for (const Getter& field : fields)
    text += "  " + padded(field.name, width) + "  " + field.sentence + " (" + describe_field(field) + ")\n";
  return text;
}

std::string record_help(const RecordInfo& type) {
  return type.name + ": " + type.sentence + "\n" + fields_help(type.fields);
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

// Title, then per row its name and the other cells with their headings.
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
  std::size_t width = 0;
  for (const Parameter& p : function.parameters) width = std::max(width, p.name.size());
  if (function.options != nullptr)
    for (const NamedOption& named : all_options(*function.options))
      width = std::max(width, named.name.size());
  if (width > 0) text += "\n";
  for (const Parameter& p : function.parameters)
    text += "  " + padded(p.name, width) + "  " + p.sentence + " (" + p.type + ")\n";
  if (function.options != nullptr)
    for (const auto& [name, option] : all_options(*function.options))
      text += "  " + padded(name, width) + "  " + option->sentence + " (" + describe_option(*option) + ")\n";
  text += records_help(function.returns);
  if (function.listing != nullptr) text += listing_help(function.listing());
  if (!function.example.empty()) text += "\nExample:\n  " + function.example + "\n";
  return text;
}

std::string class_help(const Class& type) {
  std::string text = type.name + ": " + type.sentence + "\n";
  std::size_t width = 0;
  for (const std::string& name : type.names()) width = std::max(width, name.size());
  if (!type.fields.empty()) text += "\nFields:\n" + fields_help(type.fields, width);
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
  std::size_t width = 0;
  for (const Function& f : module.functions) width = std::max(width, f.name.size());
  for (const Constant& c : module.constants) width = std::max(width, c.name.size());
  if (module.call) text += function_help(*module.call) + "\n";
  for (const Function& f : module.functions) text += "  " + padded(f.name, width) + "  " + f.sentence + "\n";
  for (const Constant& c : module.constants) text += "  " + padded(c.name, width) + "  " + c.sentence + "\n";
  for (const Module* child : modules())
    if (child->path != module.path && child->path.starts_with(module.path + ".") &&
        child->path.find('.', module.path.size() + 1) == std::string::npos)
      text +=
          "  " + padded(child->path.substr(module.path.size() + 1), width) + "  " + child->sentence + "\n";
  return text;
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
  bool exact_name = false;  // case-sensitive: "tilt" does not mean `Tilt`
  bool of_record = false;   // field of a result, rarely searched by its bare name
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

std::vector<const Function*> functions_with_options() {
  std::vector<const Function*> all;
  const auto look_at = [&](const Function& f) {
    if (f.options != nullptr) all.push_back(&f);
  };
  for (const Module* module : modules()) {
    if (module->call) look_at(*module->call);
    for (const Function& f : module->functions) look_at(f);
  }
  for (const Class* type : classes())
    for (const Function& f : type->methods) look_at(f);
  return all;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

// Keys of this name and their calls, or "".
std::string keys_help(const std::string& name) {
  std::string text;
  for (const Function* function : functions_with_options())
    for (const auto& [path, option] : all_options(*function->options))
      if (same_word(path, name) || same_word(last_name(path), name))
        text += "Key `" + path + "` of " + qualified_name(*function) + ": " + option->sentence + " (" +
                describe_option(*option) + ")\n";
  return text;
}

// --- search

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Matches beginnings of words.
bool has_word(std::string_view sentence, std::string_view word) {
  for (std::size_t at = sentence.find(word); at != std::string_view::npos; at = sentence.find(word, at + 1))
    if (at == 0 || !is_letter(sentence[at - 1])) return true;
  return false;
}

// Matches in names, then in sentences; "" for none and for a single letter. `beside`: exact names are already
// shown.
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
  for (const Function* function : functions_with_options())
    for (const auto& [path, option] : all_options(*function->options))
      look("key `" + path + "` of " + qualified_name(*function), last_name(path), option->sentence,
           option->type);
  const std::size_t found = by_name.size() + by_sentence.size();
  if (found == 0) return "";
  by_name.insert(by_name.end(), by_sentence.begin(), by_sentence.end());
  constexpr std::size_t most = 40;
  std::string text =
      beside ? quoted(asked) + " is part of\n" : "nothing is called " + quoted(asked) + "; it is part of\n";
  for (std::size_t k = 0; k < std::min(found, most); ++k) text += "  " + by_name[k] + "\n";
  if (found > most) text += "  and " + std::to_string(found - most) + " more\n";
  return text;
}

// --- the reference page

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

void function_reference(std::string& page, const Function& function) {
  page += "### `" + qualified_name(function) + "`\n\n" + function.sentence + "\n\n";
  page += "```lua\n" + signature(function) + (function.returns.empty() ? "" : "  --> " + function.returns) +
          "\n```\n\n";
  if (!function.parameters.empty() || function.options != nullptr) {
    page += "| name | accepts | meaning |\n|---|---|---|\n";
    for (const Parameter& p : function.parameters)
      page += "| `" + p.name + "` | " + cell(p.type) + " | " + cell(p.sentence) + " |\n";
    if (function.options != nullptr)
      for (const auto& [name, option] : all_options(*function.options))
        page +=
            "| `" + name + "` | " + cell(describe_option(*option)) + " | " + cell(option->sentence) + " |\n";
    page += "\n";
  }
  if (function.listing != nullptr) listing_reference(page, function.listing());
  if (!function.example.empty()) page += "```lua\n" + function.example + "\n```\n\n";
}

void fields_reference(std::string& page, const std::vector<Getter>& fields) {
  if (fields.empty()) return;
  page += "| field | type | meaning |\n|---|---|---|\n";
  for (const Getter& field : fields)
    page += "| `" + field.name + "` | " + cell(describe_field(field)) + " | " + cell(field.sentence) + " |\n";
  page += "\n";
}

void operators_reference(std::string& page, const std::vector<Operator>& operators) {
  if (operators.empty()) return;
  page += "| operator | gives | meaning | example |\n|---|---|---|---|\n";
  for (const Operator& operation : operators)
    page += "| `" + operation.form + "` | " + cell(operation.returns) + " | " + cell(operation.sentence) +
            " | `" + operation.example + "` |\n";
  page += "\n";
}

// A record type appears with its first module or class.
void records_reference(std::string& page, const std::vector<const RecordInfo*>& results,
                       std::vector<const RecordInfo*>& told) {
  for (const RecordInfo* type : results) {
    if (std::find(told.begin(), told.end(), type) != told.end()) continue;
    told.push_back(type);
    std::vector<std::string> givers;
    for (const std::string& giver : givers_of(*type)) givers.push_back("`" + giver + "`");
    page += "### " + type->name + "\n\n" + type->sentence + " Given by " + joined(givers, " and ") + ".\n\n";
    fields_reference(page, type->fields);
  }
}

}  // namespace

std::string help_text(const std::string& topic) {
  if (topic.empty()) return topics_help();
  const std::vector<Topic>& topics = all_topics();
  // Case separates `Surface` (value) from `surface` (module).
  for (const std::string& name : {topic, "lab." + topic})
    for (const Topic& t : topics)
      if (t.name == name) return t.text;
  for (const Topic& t : topics)
    if (!t.exact_name && (same_word(t.name, topic) || same_word(t.name, "lab." + topic))) return t.text;
  // A bare name such as `roughness` can have several meanings.
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
  std::vector<std::string> names;
  for (const Function* function : functions_with_options())
    for (const NamedOption& named : all_options(*function->options)) names.push_back(last_name(named.name));
  for (const Topic& t : topics) {
    names.push_back(t.name);
    names.push_back(last_name(t.name));
  }
  throw Error(ErrorCode::unknown_name, "there is no help on " + quoted(topic) + did_you_mean(topic, names),
              "help without a topic lists what there is");
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
      "Excepted are contacts spread over several ranks (`lab.spread`), whose transforms choose by the "
      "processor, and\n"
      "what a script itself computes by `^` and by `math`, which is the C library's; where they differ,\n"
      "`asperity replay` names processor, C library and build. `pairs` and `next` go in one order: numbers,\n"
      "strings by their bytes, booleans.\n"
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
    fields_reference(page, type->fields);
    if (!type->drawing.empty()) page += "```text\n" + type->drawing + "```\n\n";
    operators_reference(page, type->operators);
    for (const Function& f : type->methods) function_reference(page, f);
    records_reference(page, type->results, told);
  }
  while (page.ends_with("\n\n")) page.pop_back();
  return page;
}

}  // namespace asperity::lua
