// SPDX-License-Identifier: GPL-3.0-or-later
// A closed form is worth nothing where a double cannot hold it.
#pragma once

#include <cmath>
#include <initializer_list>

#include "engine/core/error.hpp"

namespace asperity::exact {

// Throws Error{bad_value} for a value that is not finite, or that has gone under the least normal double
// though it is not zero by its formula.
inline void in_range(std::initializer_list<double> values) {
  for (const double value : values)
    if (!std::isnormal(value))
      throw Error(ErrorCode::bad_value, "the exact answer leaves the range of a double",
                  "give lengths, moduli and loads nearer to those of a specimen");
}

}  // namespace asperity::exact
