// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a column head into name and unit: "load [N]", "load (N)", "load / N", "load, N", and "load kN" for
// an unmistakable unit. The s of "time_s" and the N of "Run N" belong to the name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/quantity.hpp"

namespace asperity {

struct TableHead {
  std::string name;
  std::string unit;  // as written; any text in square brackets
};
TableHead table_head(std::string_view title);

struct HeadedColumn {
  std::string title, name, unit;  // whole; without unit; as written
};
// Columns with this whole head, else with this name: first place, and number.
struct HeadMatch {
  std::size_t first = 0, count = 0;
};
HeadMatch find_head(const std::vector<HeadedColumn>& columns, std::string_view head, bool any_case);
// Heads, and names that differ from them.
std::vector<std::string> head_names(const std::vector<HeadedColumn>& columns);
// "no column is headed \"laod\", which `columns` calls `F` (did you mean `load`?)".
std::string head_complaint(const std::vector<HeadedColumn>& columns, const HeadMatch& match,
                           std::string_view head, const std::string& called);

std::optional<Quantity> known_unit(std::string_view text);
// "[s]", "kN" or "-"; nothing for other or empty text.
std::optional<Quantity> unit_in_cell(std::string_view cell);
// Without brackets.
std::string bare_unit(std::string_view cell);

// "10 MPa" or "0,5 kN", in SI.
std::optional<Quantity> quantity_in_cell(std::string_view cell);

}  // namespace asperity
