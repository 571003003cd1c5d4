// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/node_value.hpp"

#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

double node_value(const Field& field, double i, double j) {
  const bool inside =
      i >= 0 && i < field.nx() && i == std::floor(i) && j >= 0 && j < field.ny() && j == std::floor(j);
  if (!inside)
    throw Error(ErrorCode::bad_value,
                "there is no node (" + format_short(i, 17) + ", " + format_short(j, 17) + ")",
                "i runs from 0 to " + std::to_string(field.nx() - 1) + ", j from 0 to " +
                    std::to_string(field.ny() - 1));
  return field(static_cast<int>(i), static_cast<int>(j));
}

}  // namespace asperity
