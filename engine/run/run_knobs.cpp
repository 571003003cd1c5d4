// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_knobs.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr std::size_t longest_name = 60;

bool is_knob_name(std::string_view name) {
  const auto bad = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F || c == '=' || c == '"';
  };
  return !name.empty() && name.size() <= longest_name && name.front() != ' ' && name.back() != ' ' &&
         std::ranges::none_of(name, bad);
}

std::string shown_knob_value(double value, Dimension dimension) {
  return dimension == dimension::number ? format_short(value, 10) : format_quantity(value, dimension, 10);
}

std::string without_quotes(std::string text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

}  // namespace

void require_knob(const RunKnob& knob) {
  const auto shown = [&](double value) { return shown_knob_value(value, knob.dimension); };
  if (!is_knob_name(knob.name))
    refuse("`name` is " + quoted(knob.name.substr(0, longest_name)),
           "give a name of at most 60 characters, without =, quotes and blanks at its ends");
  for (const auto& [key, value] :
       {std::pair("`from`", knob.from), std::pair("`to`", knob.to), std::pair("`value`", knob.value)})
    if (!std::isfinite(value)) refuse(std::string(key) + " is " + shown(value), "give a finite number");
  if (!(knob.from < knob.to))
    refuse("`from` is " + shown(knob.from) + " and `to` is " + shown(knob.to),
           "give the lower bound first, and another one above it");
  if (knob.value < knob.from || knob.value > knob.to)
    refuse("`value` is " + shown(knob.value), "give one from " + bounds_text(knob));
  if (knob.log && !(knob.from > 0))
    refuse("`from` is " + shown(knob.from) + " with log=true", "give `from` above 0, or leave `log` out");
}

std::string bounds_text(const RunKnob& knob) {
  return shown_knob_value(knob.from, knob.dimension) + " to " + shown_knob_value(knob.to, knob.dimension);
}

void give_knob(GivenKnobs& given, const std::string& name, const std::string& text) {
  if (!is_knob_name(name))
    refuse(quoted(name.substr(0, longest_name)) + " is no name of a knob",
           "a name has at most 60 characters, without =, quotes and blanks at its ends");
  const std::string value = without_quotes(text);
  try {
    (void)parse_quantity(value);
  } catch (const Error& error) {
    refuse("the knob " + quoted(name) + ": " + error.sentence(), error.hint());
  }
  if (!given.emplace(name, value).second)
    refuse("the knob " + quoted(name) + " is given twice", "leave one of them out");
}

GivenKnobs given_knobs(const Json& recorded) {
  GivenKnobs given;
  for (const auto& [name, knob] : recorded.members())
    if (const Json* value = knob.find("value")) given.emplace(name, format_exact(value->number()));
  return given;
}

Json given_knobs_json(const GivenKnobs& given) {
  Json json = Json::object();
  for (const auto& [name, text] : given)
    json.set(name, Json::object({{"value", parse_quantity(text).value}}));
  return json;
}

RunKnobs::RunKnobs(const GivenKnobs& given) {
  for (const auto& [name, text] : given) given_.emplace(name, Given{parse_quantity(text), text});
}

double RunKnobs::value_for(const RunKnob& knob, const Given& given) const {
  const std::string what = "the knob " + quoted(knob.name) + " is given as " + quoted(given.text);
  const std::string cure = "give " + bounds_text(knob);
  const Dimension kind = given.quantity.dimension;
  if (kind != knob.dimension && kind != dimension::number)
    refuse(what + ", " + describe(kind) + ", and it is " +
               (knob.dimension == dimension::number ? "a plain number" : describe(knob.dimension)),
           cure);
  const double value = given.quantity.value;
  if (!(value >= knob.from && value <= knob.to)) refuse(what + ", out of its bounds", cure);
  return value;
}

double RunKnobs::make(const RunKnob& knob) {
  met(knob.name);  // also if refused, for check_all_made()
  require_knob(knob);
  const std::lock_guard lock(mutex_);
  for (const Made& made : made_) {
    if (made.knob.name != knob.name) continue;
    if (made.knob == knob) return made.value;
    const auto told = [](const RunKnob& of) {
      return bounds_text(of) + ", " + shown_knob_value(of.value, of.dimension) + (of.log ? ", log" : "");
    };
    refuse("the knob " + quoted(knob.name) + " was made before with other keys: " + told(made.knob) +
               ", and now " + told(knob),
           "make it once and use its value, or give the other one another name");
  }
  const auto given = given_.find(knob.name);
  made_.push_back({knob, given == given_.end() ? knob.value : value_for(knob, given->second)});
  return made_.back().value;
}

void RunKnobs::met(const std::string& name) {
  const std::lock_guard lock(mutex_);
  met_.insert(name);
}

double RunKnobs::value_of(const std::string& name, const std::string& text) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const Made& made : made_) {
    if (made.knob.name == name) return value_for(made.knob, {parse_quantity(text), text});
    names.push_back(made.knob.name);
  }
  refuse_name("there is no knob " + quoted(name) + did_you_mean(name, names),
              names.empty() ? "lab.knob{ name=, from=, to=, value= } makes one"
                            : "the knobs are " + joined(names, " and "));
}

std::vector<RunKnobs::Made> RunKnobs::made() const {
  const std::lock_guard lock(mutex_);
  return made_;
}

void RunKnobs::keep_first(std::size_t count) {
  const std::lock_guard lock(mutex_);
  if (made_.size() > count) made_.resize(count);
}

bool RunKnobs::empty() const {
  const std::lock_guard lock(mutex_);
  return made_.empty() && given_.empty();
}

void RunKnobs::check_all_made() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names, listed;
  for (const Made& made : made_) {
    names.push_back(made.knob.name);
    listed.push_back(made.knob.name + " (" + bounds_text(made.knob) + ")");
  }
  for (const auto& [name, given] : given_) {
    if (met_.contains(name) || std::ranges::find(names, name) != names.end()) continue;
    refuse_name("the knob " + quoted(name) + " was set, and the script makes no such knob" +
                    did_you_mean(name, names),
                names.empty() ? "the script made no knobs" : "its knobs are " + joined(listed, " and "));
  }
}

std::string RunKnobs::given_text() const {
  std::string text;
  for (const auto& [name, given] : given_) text += name + "=" + format_exact(given.quantity.value) + "\n";
  return text;
}

Json RunKnobs::json() const {
  const std::lock_guard lock(mutex_);
  // Cases make knobs in any order.
  std::map<std::string, Json> sorted;
  for (const auto& [name, given] : given_) sorted[name] = Json::object({{"value", given.quantity.value}});
  for (const Made& made : made_) {
    const RunKnob& knob = made.knob;
    sorted[knob.name] = Json::object({{"value", made.value},
                                      {"from", knob.from},
                                      {"to", knob.to},
                                      {"log", knob.log},
                                      {"unit", si_unit(knob.dimension)}});
  }
  Json json = Json::object();
  for (const auto& [name, knob] : sorted) json.set(name, knob);
  return json;
}

}  // namespace asperity
