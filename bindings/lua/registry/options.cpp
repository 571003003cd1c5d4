// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/options.hpp"

#include <algorithm>
#include <numbers>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/registry/variation.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

std::string meant_by(std::string_view name, std::span<const std::string> names) {
  static constexpr std::pair<std::string_view, std::string_view> renamed[] = {
      {"drawn_from", "preload"},
      {"t", "student"},
      {"times", "repeats"},
      {"where", "mask"},
      {"contacts", "nodes_in_contact"},
      {"contacts_low", "nodes_in_contact_low"},
      {"contacts_high", "nodes_in_contact_high"}};
  for (const auto& [old, now] : renamed)
    if (name == old && std::ranges::find(names, now) != names.end())
      return ", which is called " + quoted(now) + " now";
  return did_you_mean(name, names);
}

namespace detail {

void wrong_type(const Argument& value, std::string_view name, std::string_view wanted, Problems& problems) {
  problems.push_back(quoted(name) + " is " + value.describe() + "; give " + std::string(wanted));
}

std::optional<Quantity> read_any_quantity(const Argument& value, const std::string& name,
                                          std::string_view wanted, Problems& problems) {
  if (value.is_unknown()) return {};
  if (value.is_number()) return Quantity{value.number(), dimension::number};
  std::optional<Quantity> quantity;
  if (value.is_text())
    collect(
        problems, [&] { quantity = parse_quantity(value.text()); }, name);
  else
    wrong_type(value, name, wanted, problems);
  return quantity;
}

namespace {
// Numbers without a unit that are implausible in SI.
struct Implausible {
  std::string_view key;
  double above, below;
  std::string_view reason, unit;
  bool whole = false;  // typed, not computed
};
constexpr Implausible implausible[] = {
    {"young", 1, 1000, ", softer than any solid", "GPa"},  // 1 occurs in dimensionless problems
    {"young", 1000, 1e5, ", softer than any solid", "MPa"},
    {"hardness", 1, 1000, ", softer than any solid", "GPa"},
    {"hardness", 1000, 1e5, ", softer than any solid", "MPa"},
    {"pressure", 1, 1e4, "", "MPa", true},
    {"tau0", 1, 1e4, "", "MPa", true},
    {"tip", .01, 1e6, ", no stylus", "um"},
};

void warn_of_bare_number(const Argument& value, const OptionInfo& info, double number) {
  const std::string text = format_short(number), unit = si_unit(info.dimension);
  std::string reason, wanted;
  if (info.dimension == dimension::angle && std::abs(number) > 2 * std::numbers::pi) {
    reason = ", over a whole turn", wanted = "deg";
  } else {
    for (const Implausible& one : implausible)
      if (info.name == one.key && number > one.above && number < one.below &&
          (!one.whole || number == std::floor(number)))
        reason = one.reason, wanted = one.unit;
  }
  const Session* session = Session::find(value.state());
  if (wanted.empty() || session == nullptr) return;
  session->monitor().warn(where(value.state()) + quoted(info.name) + " is " + text + " " + unit + reason +
                          ": a number without a unit is in " + unit + "; write \"" + text + " " + wanted +
                          "\"" + (reason.empty() ? ", or \"" + text + " " + unit + "\"" : ""));
}

// Marks the table's options as seen; returns the other keys.
Problems unknown_keys(const Argument& table, const std::vector<const OptionInfo*>& options,
                      std::vector<bool>& seen) {
  Problems unknown;
  if (!table.is_table()) return unknown;
  const auto names = [&] {
    std::vector<std::string> all;
    for (const OptionInfo* option : options) all.push_back(option->name);
    return all;
  };
  table.each([&](const Argument& key, const Argument&) {
    if (!key.is_text()) {
      unknown.push_back(key.is_number() ? "position " + format_short(key.number()) +
                                              " holds a value without a key; write `key = value`"
                                        : "a key is " + key.describe() + "; keys are names");
      return;
    }
    const auto found = std::ranges::find(options, key.text(), &OptionInfo::name);
    if (found == options.end())
      unknown.push_back("unknown key " + quoted(key.text().substr(0, 40)) + meant_by(key.text(), names()));
    else
      seen[static_cast<std::size_t>(found - options.begin())] = true;
  });
  std::sort(unknown.begin(), unknown.end());
  constexpr std::size_t enough = 12;
  if (unknown.size() > enough) {
    const std::size_t more = unknown.size() - enough;
    unknown.resize(enough);
    unknown.push_back("and " + std::to_string(more) + " more unknown keys");
  }
  if (!unknown.empty()) unknown.push_back("the keys are " + joined(names(), " and "));
  return unknown;
}

[[noreturn]] void throw_problems(const std::string& caller, const Problems& problems, bool unknown) {
  const std::size_t count = problems.size() - (unknown ? 1 : 0);
  if (count == 1)
    throw Error(unknown ? ErrorCode::unknown_name : ErrorCode::bad_value, caller + ": " + problems.front(),
                unknown ? problems.back() : "");
  std::string sentence = caller + ": " + std::to_string(count) + " problems";
  for (const std::string& problem : problems) sentence += "\n  " + problem;
  refuse(sentence);
}

}  // namespace

std::optional<double> read_quantity(const Argument& value, const OptionInfo& info, const NumberRange& range,
                                    Problems& problems) {
  if (value.is_unknown()) return {};
  double number = 0;
  std::string found;
  if (value.is_number()) {
    number = value.number();
    found = format_short(number, 10);
    warn_of_bare_number(value, info, number);
    if (info.dimension != dimension::number) found += " " + si_unit(info.dimension);
  } else if (value.is_text()) {
    try {
      number = parse_quantity_as(value.text(), info.dimension);
    } catch (const Error& error) {
      problems.push_back(quoted(info.name) + ": " + error.what());
      return {};
    }
    found = "\"" + std::string(value.text().substr(0, 40)) + "\"";
  } else {
    wrong_type(value, info, range.wanted(info.dimension), problems);
    return {};
  }
  if (!range.contains(number)) {
    problems.push_back(quoted(info.name) + " is " + found + "; give " +
                       (range.text(info.dimension).empty()
                            ? "a finite number"
                            : range.wanted(info.dimension, std::isinf(number) && std::isinf(range.high))));
    return {};
  }
  return number;
}

std::optional<std::int64_t> read_integer(const Argument& value, const OptionInfo& info,
                                         const NumberRange& range, Problems& problems) {
  if (value.is_unknown()) return {};
  const std::string limits = range.text({});
  const std::string wanted = "a whole number" + (limits.empty() ? "" : " " + limits);
  std::optional<std::int64_t> number;
  std::string found;
  if (value.is_number()) {
    number = value.integer();
    found = format_short(value.number(), 10);
  } else if (value.is_text()) {
    // Text as number: "64" is 64; "64 um" is a refused length.
    std::optional<Quantity> quantity;
    try {
      quantity = parse_quantity(value.text());
    } catch (const Error&) {
      wrong_type(value, info, wanted, problems);
      return {};
    }
    try {
      const double given = quantity->dimension == dimension::number
                               ? quantity->value
                               : parse_quantity_as(value.text(), dimension::number);
      constexpr double exact = 9007199254740992;  // 2^53
      if (given == std::floor(given) && std::abs(given) <= exact) number = static_cast<std::int64_t>(given);
    } catch (const Error& error) {
      problems.push_back(quoted(info.name) + ": " + error.what());
      return {};
    }
    found = "\"" + std::string(value.text().substr(0, 40)) + "\"";
  } else {
    wrong_type(value, info, wanted, problems);
    return {};
  }
  if (!number || !range.contains(static_cast<double>(*number))) {
    problems.push_back(quoted(info.name) + " is " + found + "; give " + wanted);
    return {};
  }
  return number;
}

std::optional<std::size_t> read_word(const Argument& value, const OptionInfo& info,
                                     const std::vector<std::string>& words, Problems& problems) {
  if (!value.is_text()) {
    wrong_type(value, info, "one of " + info.type, problems);
    return {};
  }
  const auto known = std::find(words.begin(), words.end(), value.text());
  if (known != words.end()) return static_cast<std::size_t>(known - words.begin());
  std::vector<std::string> accepted;
  for (const std::string& word : words) accepted.push_back("\"" + word + "\"");
  problems.push_back(quoted(info.name) + " is \"" + std::string(value.text().substr(0, 40)) + "\"" +
                     meant_by(value.text(), words) + "; give " + joined(accepted));
  return {};
}

std::string number_text(double value, Dimension dimension) {
  if (std::isinf(value)) return "math.huge";
  if (dimension == dimension::number || value == 0) return format_exact(value);
  return "\"" + format_quantity(value, dimension, 10) + "\"";
}

std::optional<std::int64_t> read_cells(const Argument& value, const OptionInfo& info,
                                       const NumberRange& range, Problems& problems) {
  const auto given = read_integer(value, info, range, problems);
  Refinement* refinement = given ? refinement_of(value.state()) : nullptr;
  if (refinement == nullptr) return given;
  const std::int64_t made = refinement->cells(*given);
  if (range.contains(static_cast<double>(made))) return made;
  problems.push_back(quoted(info.name) + " is " + std::to_string(*given) + ", and " +
                     format_short(refinement->cells_factor) + " times as many are more than " +
                     range.text({}));
  return {};
}

void read_table(const Argument& table, const std::string& caller,
                const std::vector<const OptionInfo*>& options,
                const std::function<void(std::size_t, const Argument&, Problems&)>& read,
                const std::function<void(Problems&)>& finish) {
  if (!table.is_nil() && !table.is_table())
    refuse(caller + " takes one table of named keys, and was given " + table.describe(),
           "write " + caller + "{ ... }");
  std::vector<bool> seen(options.size(), false);
  // In the block's order: Lua's varies.
  const Problems unknown = unknown_keys(table, options, seen);
  Problems problems;
  Variation* variation = variation_of(table.state());
  for (std::size_t k = 0; k < options.size(); ++k) {
    const Argument::StackGuard guard(table.state());
    const std::string& name = options[k]->name;
    if (variation != nullptr && variation->replaces(table.state(), caller, name, seen[k])) {
      seen[k] = true;
      const std::size_t before = problems.size();
      read(k, Argument(table.state(), lua_gettop(table.state())), problems);
      if (problems.size() > before) variation->note_refused(caller, name, problems.back());
      continue;
    }
    if (!seen[k]) continue;
    // A look-up would allocate the key.
    table.each([&](const Argument& key, const Argument& value) {
      if (key.is_text() && key.text() == name) read(k, value, problems);
    });
  }
  for (std::size_t k = 0; k < options.size(); ++k) {
    if (seen[k] || !options[k]->required) continue;
    std::string example = options[k]->dimension == dimension::number
                              ? ""
                              : ", e.g. \"" + example_quantity(options[k]->dimension) + "\"";
    problems.push_back(quoted(options[k]->name) + " is missing: " + options[k]->sentence + example);
  }
  if (problems.empty() && unknown.empty()) finish(problems);
  problems.insert(problems.end(), unknown.begin(), unknown.end());
  if (!problems.empty()) throw_problems(caller, problems, !unknown.empty());
}

}  // namespace detail

namespace {

std::string type_of(const OptionRow& row) {
  if (row.words.empty()) return row.dimension == dimension::number ? "number" : describe(row.dimension);
  std::string type;
  for (const std::string& word : row.words) type += (type.empty() ? "\"" : "|\"") + word + "\"";
  return type;
}

}  // namespace

OptionInfo row_info(const OptionRow& row, const std::any& defaults) {
  OptionInfo info{row.name,     type_of(row), row.dimension, row.default_text, row.range.text(row.dimension),
                  row.sentence, row.required};
  const std::optional<double> value = row.get(defaults);
  if (!row.required && info.default_text.empty() && value)
    info.default_text = row.words.empty() ? detail::number_text(*value, row.dimension)
                                          : "\"" + row.words[static_cast<std::size_t>(*value)] + "\"";
  return info;
}

void read_row(const OptionRow& row, const OptionInfo& info, const Argument& value, std::any& options,
              Problems& problems) {
  if (row.words.empty()) {
    if (const auto number = detail::read_quantity(value, info, row.range, problems))
      row.set(options, *number);
  } else if (const auto place = detail::read_word(value, info, row.words, problems)) {
    row.set(options, static_cast<double>(*place));
  }
}

RowBlock::RowBlock(std::span<const OptionRow> rows, std::any defaults)
    : rows_(rows), defaults_(std::move(defaults)) {
  for (const OptionRow& row : rows_) infos_.push_back(row_info(row, defaults_));
}

std::any RowBlock::read(const Argument& table, const std::string& caller) const {
  std::any result = defaults_;
  detail::read_table(
      table, caller, options(),
      [&](std::size_t k, const Argument& value, Problems& problems) {
        if (value.is_unknown() && value.as_any_object() == nullptr) return;
        read_row(rows_[k], infos_[k], value, result, problems);
      },
      [](Problems&) {});
  return result;
}

}  // namespace asperity::lua
