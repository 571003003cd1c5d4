// SPDX-License-Identifier: GPL-3.0-or-later
// The line over a table of points that names its columns and says their units of length: "x [mm];y [mm];z
// [um]", "x (mm), z (um)", "x/mm y/mm z/um". A mark of comments (# or %) may stand before it. What the
// columns mean is for the readers of x y z files and of profiles in two columns.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct HeadColumn {
  std::string name;            // lower case, without its unit
  std::string word;            // its unit as written; empty: none
  std::optional<double> unit;  // m per number, where the word is a unit of length
};

// The columns of such a line, parted by semicolons, tabs, commas or blanks; nothing for a line whose cells do
// not all begin with a letter. O(length of the line).
std::optional<std::vector<HeadColumn>> column_head(std::string_view line);

// The same of a line that names x, y and z in this order; names without any separator ("xyz") have no unit.
std::optional<std::vector<HeadColumn>> xyz_head(std::string_view line);

// The same of a line that names a position and a height: two columns of which one has a unit at least, or "x"
// and "z" (or "y").
std::optional<std::vector<HeadColumn>> profile_head(std::string_view line);

// Whether columns are those of points, or of a profile, as xyz_head and profile_head have them.
bool are_points(const std::vector<HeadColumn>& columns);
bool are_of_profile(const std::vector<HeadColumn>& columns);

// The unit of a column; a word that is no unit of length is warned of, and then the call has to say.
std::optional<double> head_unit(const HeadColumn& column, const SourceFile& file, Monitor& monitor);

}  // namespace asperity
