// SPDX-License-Identifier: GPL-3.0-or-later
// The line of column names and units over a table of points: "x [mm];y [mm];z [um]", "x (mm), z (um)",
// "x/mm y/mm z/um". A comment mark (# or %) may precede it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Metres per unit at the end of a text, such as "Height (nm)"; none if unknown.
std::optional<double> length_unit(std::string_view text);
// The same for a whole text, with its case: "m" (in "x_m") is a unit, "a" (in "x_a") is not.
std::optional<double> exact_unit(std::string_view text);

// Without comment marks (# or %) and blanks around.
std::string_view without_mark(std::string_view line);

struct HeadColumn {
  std::string name;            // lower case
  std::string word;            // unit as written, or empty
  std::optional<double> unit;  // m per number
};

// Separators: semicolon, tab, comma or blank. None unless all cells begin with a letter. O(length of the
// line).
std::optional<std::vector<HeadColumn>> column_head(std::string_view line);

// Columns x, y, z in this order; unseparated names ("xyz") have no unit.
std::optional<std::vector<HeadColumn>> xyz_head(std::string_view line);

// Position and height: at least one with a unit, or "x" and "z" (or "y").
std::optional<std::vector<HeadColumn>> profile_head(std::string_view line);

bool are_points(const std::vector<HeadColumn>& columns);
bool are_of_profile(const std::vector<HeadColumn>& columns);

// Warns of an unknown unit and returns none.
std::optional<double> head_unit(const HeadColumn& column, const SourceFile& file, Monitor& monitor);

}  // namespace asperity
