// SPDX-License-Identifier: GPL-3.0-or-later
// Options of effects and elasticity models. A row describes one member of a plain struct: the engine checks
// by it, the bindings derive reading, help and record.
#pragma once

#include <any>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/quantity.hpp"

namespace asperity {

// NaN is never inside; infinity only with `never`.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool never = false;
  // Accepts math.huge as "never".
  constexpr NumberRange or_never() const {
    NumberRange r = *this;
    r.never = true;
    return r;
  }
  bool contains(double value) const;
  // "above 0", "from 2 to 3"; "" if unlimited.
  std::string text(Dimension dimension) const;
  // "a length above 0, e.g. \"250 um\"".
  std::string wanted(Dimension dimension, bool finite = false) const;
};
constexpr NumberRange any() { return {}; }
constexpr NumberRange above(double low) { return {.low = low, .low_open = true}; }
constexpr NumberRange at_least(double low) { return {.low = low}; }
constexpr NumberRange between(double low, double high) { return {.low = low, .high = high}; }
constexpr NumberRange inside(double low, double high) { return {low, high, true, true}; }

struct OptionRow {
  std::string name;
  Dimension dimension{};
  NumberRange range{};
  std::vector<std::string> words{};  // of a choice; its value is an index
  std::string sentence;
  std::string default_text{};  // if the struct's default is not enough
  bool required = false;
  // On the struct inside `any`; none: not given.
  std::function<void(std::any&, double)> set{};
  std::function<std::optional<double>(const std::any&)> get{};

  OptionRow needed() && {
    required = true;
    return std::move(*this);
  }
  OptionRow defaults_to(std::string text) && {
    default_text = std::move(text);
    return std::move(*this);
  }
};

// M: double or std::optional<double>.
template <class O, class M>
OptionRow quantity_row(std::string name, M O::*member, Dimension dimension, NumberRange range,
                       std::string sentence) {
  OptionRow row{
      .name = std::move(name), .dimension = dimension, .range = range, .sentence = std::move(sentence)};
  row.set = [member](std::any& options, double value) { std::any_cast<O&>(options).*member = value; };
  row.get = [member](const std::any& options) -> std::optional<double> {
    return std::any_cast<const O&>(options).*member;
  };
  return row;
}

template <class O, class M>
OptionRow number_row(std::string name, M O::*member, NumberRange range, std::string sentence) {
  return quantity_row(std::move(name), member, dimension::number, range, std::move(sentence));
}

template <class O, class M>
OptionRow choice_row(std::string name, M O::*member, std::vector<std::pair<std::string, M>> words,
                     std::string sentence) {
  OptionRow row{.name = std::move(name), .sentence = std::move(sentence)};
  for (const auto& word : words) row.words.push_back(word.first);
  row.set = [member, words](std::any& options, double place) {
    std::any_cast<O&>(options).*member = words.at(static_cast<std::size_t>(place)).second;
  };
  row.get = [member, words](const std::any& options) -> std::optional<double> {
    for (std::size_t k = 0; k < words.size(); ++k)
      if (words[k].second == std::any_cast<const O&>(options).*member) return static_cast<double>(k);
    return {};
  };
  return row;
}

// Throws Error{bad_value} for the first option out of range.
void check_options(std::span<const OptionRow> rows, const std::any& options, const std::string& of);

}  // namespace asperity
