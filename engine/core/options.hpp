// SPDX-License-Identifier: GPL-3.0-or-later
// The options of an effect or of a model of elasticity, each told once: name, dimension, range, default and
// sentence of a member of a plain struct. The engine checks values by these rows; the language reads them,
// and its help, its reference and its record are made of them. The ranges serve every other option too.
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

// The numbers an option accepts, in the words of its error and of the reference page.
// NaN never passes; an infinity only where `never` allows it.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool never = false;
  // math.huge is accepted and means "never".
  constexpr NumberRange or_never() const {
    NumberRange r = *this;
    r.never = true;
    return r;
  }
  bool contains(double value) const;
  // "above 0", "from 2 to 3"; "" for any.
  std::string text(Dimension dimension) const;
  // "a length above 0, e.g. \"250 um\""; `finite`: says so, of a value whose one fault that is.
  std::string wanted(Dimension dimension, bool finite = false) const;
};
constexpr NumberRange any() { return {}; }
constexpr NumberRange above(double low) {
  return {low, std::numeric_limits<double>::infinity(), true, false, false};
}
constexpr NumberRange at_least(double low) {
  return {low, std::numeric_limits<double>::infinity(), false, false, false};
}
constexpr NumberRange between(double low, double high) { return {low, high, false, false, false}; }
constexpr NumberRange inside(double low, double high) { return {low, high, true, true, false}; }

struct OptionRow {
  std::string name;
  Dimension dimension{};
  NumberRange range{};
  std::vector<std::string> words{};  // of a choice, whose number is the place of a word here
  std::string sentence;
  std::string default_text{};  // where the struct's own default does not say it
  bool required = false;
  // Of the struct that the any holds; none: not given.
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

// One of a closed set of words.
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

// Throws Error{bad_value} that names the first option out of its range, `of` what, and what would be in it.
void check_options(std::span<const OptionRow> rows, const std::any& options, const std::string& of);

}  // namespace asperity
