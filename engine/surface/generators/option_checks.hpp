// SPDX-License-Identifier: GPL-3.0-or-later
// What generators say of options they cannot take. Included only by sources of this folder.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

inline std::string metres(double value) { return format_quantity(value, dimension::length); }

[[noreturn]] inline void refuse(std::string sentence, std::string hint) {
  throw Error(ErrorCode::bad_value, std::move(sentence), std::move(hint));
}

inline void check_positive(const char* key, double value) {
  if (!(std::isfinite(value) && value > 0))
    refuse(quoted(key) + " is " + format_short(value), "give a finite value above zero");
}

}  // namespace asperity
