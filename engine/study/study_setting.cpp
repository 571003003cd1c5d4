// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/study_setting.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/require.hpp"

namespace asperity {

namespace {

std::string lua_string(const std::string& text) {
  std::string source = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      source += '\\';
      source += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      const std::string code = std::to_string(byte);
      source += "\\" + std::string(3 - code.size(), '0') + code;
    } else {
      source += c;
    }
  }
  return source + "\"";
}

bool is_name(std::string_view text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  constexpr std::string_view words[] = {
      "and",   "break", "do",  "else", "elseif", "end",   "false", "for",    "goto", "if",    "in",
      "local", "nil",   "not", "or",   "repeat", "while", "then",  "return", "true", "until", "function"};
  if (text.empty() || letters.find(text[0]) == std::string_view::npos) return false;
  if (std::find(std::begin(words), std::end(words), text) != std::end(words)) return false;
  return std::ranges::all_of(
      text, [&](char c) { return letters.find(c) != std::string_view::npos || (c >= '0' && c <= '9'); });
}

}  // namespace

std::optional<double> number_of(const Knobs& knobs, std::string_view name) {
  for (const Knob& knob : knobs) {
    if (knob.name != name) continue;
    if (const auto* real = std::get_if<double>(&knob.value)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&knob.value)) return static_cast<double>(*whole);
  }
  return {};
}

std::string lua_source(const KnobValue& value) {
  struct Writer {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const {
      if (std::isnan(v)) return "(0/0)";
      if (std::isinf(v)) return v > 0 ? "math.huge" : "-math.huge";
      return format_exact(v);
    }
    std::string operator()(const std::string& v) const { return lua_string(v); }
  };
  return std::visit(Writer{}, value);
}

std::string lua_source(const Knobs& knobs) {
  std::string source = "{";
  for (const Knob& knob : knobs)
    source += (source.size() > 1 ? ", " : " ") +
              (is_name(knob.name) ? knob.name : "[" + lua_string(knob.name) + "]") + "=" +
              lua_source(knob.value);
  return source + (knobs.empty() ? "}" : " }");
}

const std::vector<std::string>& row_fields() {
  static const std::vector<std::string> names = {
      "way",     "end",         "value",        "error",         "absolute_error", "held_error",
      "seconds", "seconds_low", "seconds_high", "first_seconds", "runs",           "pareto",
      "steady",  "reason",      "name",         "failed"};
  return names;
}

StudyWay make_way(std::string name, std::vector<KnobSweep> knobs) {
  std::ranges::sort(knobs, [](const auto& a, const auto& b) { return a.name < b.name; });
  const KnobSweep* first = nullptr;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const KnobSweep& knob = knobs[k];
    if (k > 0 && knobs[k - 1].name == knob.name)
      refuse("the way " + quoted(name) + " gives " + quoted(knob.name) + " twice");
    if (knob.name.empty()) refuse("the way " + quoted(name) + " has a knob with an empty name");
    if (std::ranges::find(row_fields(), knob.name) != row_fields().end())
      refuse("the way " + quoted(name) + " has a knob " + quoted(knob.name) +
                 ", and the rows of a study have a column of that name",
             "call the knob something else");
    if (knob.values.empty())
      refuse("the way " + quoted(name) + " gives an empty list for " + quoted(knob.name),
             "list at least one value, from coarse to fine");
    if (!knob.swept) continue;
    if (first == nullptr) {
      first = &knob;
    } else if (first->values.size() != knob.values.size()) {
      refuse("the way " + quoted(name) + " lists " + std::to_string(first->values.size()) + " values of " +
                 quoted(first->name) + " and " + std::to_string(knob.values.size()) + " of " +
                 quoted(knob.name),
             "give lists of equal length, or make two ways");
    }
  }
  StudyWay way{std::move(name), {}};
  const std::size_t count = first == nullptr ? 1 : first->values.size();
  for (std::size_t k = 0; k < count; ++k) {
    Knobs setting;
    for (const KnobSweep& knob : knobs) setting.push_back({knob.name, knob.values[knob.swept ? k : 0]});
    way.settings.push_back(std::move(setting));
  }
  return way;
}

std::vector<std::size_t> coarse_to_fine(const StudyWay& way) {
  std::vector<std::size_t> order(way.settings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (order.empty()) return order;
  const auto change = [&](std::string_view name) {
    const auto first = number_of(way.settings.front(), name), last = number_of(way.settings.back(), name);
    return first && last ? *last - *first : 0.0;
  };
  bool falls = false;
  for (const double finer : {change("cells"), change("cells_factor"), -change("tolerance")})
    if (finer != 0) {
      falls = finer < 0;
      break;
    }
  if (falls) std::ranges::reverse(order);
  return order;
}

}  // namespace asperity
