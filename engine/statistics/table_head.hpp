// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a column head into name and unit: "load [N]", "load (N)", "load / N", "load, N", and "load kN" for
// an unmistakable unit. The s of "time_s" and the N of "Run N" belong to the name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/quantity.hpp"

namespace asperity {

struct TableHead {
  std::string name;
  std::string unit;  // as written; square brackets may hold other text
};
TableHead table_head(std::string_view title);

// "[s]", "kN" or "-"; nothing for other or empty text.
std::optional<Quantity> unit_in_cell(std::string_view cell);
// Without brackets.
std::string bare_unit(std::string_view cell);

// "10 MPa" or "0,5 kN", in SI; nothing for other text.
std::optional<Quantity> quantity_in_cell(std::string_view cell);

}  // namespace asperity
