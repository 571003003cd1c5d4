// SPDX-License-Identifier: GPL-3.0-or-later
// What the engine says of a number, list or combination that a call does not take. Most of what a script
// gives is checked by the ranges of its keys before it comes here; these checks are those of the engine's own
// callers, and of what only several numbers together can tell.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

// A length as sentences tell it.
inline std::string metres(double length) { return format_quantity(length, dimension::length); }

[[noreturn]] inline void refuse(std::string sentence, std::string hint) {
  throw Error(ErrorCode::bad_value, std::move(sentence), std::move(hint));
}

[[noreturn]] inline void refuse_infeasible(std::string sentence, std::string hint) {
  throw Error(ErrorCode::infeasible, std::move(sentence), std::move(hint));
}

// Throws Error{bad_value} "`key` is VALUE UNIT", with what would do as the hint, unless `holds`.
template <class Number>
void require(bool holds, std::string_view key, Number value, const char* unit, const char* hint) {
  if (holds) return;
  std::string sentence = quoted(key) + " is ";
  if constexpr (std::is_integral_v<Number>)
    sentence += std::to_string(value);
  else
    sentence += format_short(value);
  refuse(*unit == '\0' ? sentence : sentence + " " + unit, hint);
}

// The same of a number that is to be finite and above zero where it is given.
inline void require_positive(std::string_view key, std::optional<double> value, const char* unit = "",
                             const char* hint = "give a finite value above zero") {
  if (value) require(std::isfinite(*value) && *value > 0, key, *value, unit, hint);
}

}  // namespace asperity
