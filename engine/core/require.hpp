// SPDX-License-Identifier: GPL-3.0-or-later
// Errors for numbers of C++ callers and for conditions on several numbers; keys check most script values.
// Includes what their sentences need: errors, quantities and texts.
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

inline std::string metres(double length) { return format_quantity(length, dimension::length); }

[[noreturn]] inline void refuse(std::string sentence, std::string hint = {}) {
  throw Error(ErrorCode::bad_value, std::move(sentence), std::move(hint));
}

[[noreturn]] inline void refuse_infeasible(std::string sentence, std::string hint) {
  throw Error(ErrorCode::infeasible, std::move(sentence), std::move(hint));
}
// Throws Error{bad_value} "`key` is VALUE UNIT" with the hint.
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

inline void require_positive(std::string_view key, std::optional<double> value, const char* unit = "",
                             const char* hint = "give a finite value above zero") {
  if (value) require(std::isfinite(*value) && *value > 0, key, *value, unit, hint);
}

}  // namespace asperity
