// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a column taken apart into its name and its unit: "load [N]", "load (N)", "load / N", "load, N",
// and "load kN" where the last word can be nothing but a unit. What may be a part of the name stays one: the
// s of "time_s" and the N of "Run N".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/quantity.hpp"

namespace asperity {

struct TableHead {
  std::string name;
  std::string unit;  // as it stands, "" where there is none; in square brackets it need not be one
};
TableHead table_head(std::string_view title);

// A unit alone, in brackets or not: "[s]", "kN", "-". Nothing for any other text, and for an empty one.
std::optional<Quantity> unit_in_cell(std::string_view cell);
// The same without its brackets.
std::string bare_unit(std::string_view cell);

// A number with a unit after it, "10 MPa" or "0,5 kN", in SI; nothing for any other text.
std::optional<Quantity> quantity_in_cell(std::string_view cell);

}  // namespace asperity
