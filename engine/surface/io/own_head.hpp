// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of numbers under a head of words, as instruments and their programs export them:
//   Stylus profiler / Operator Li / Speed 0.5 mm/s / x [mm],z [um] / 0,1 / 0.1,2 / …
// Of the head only what is certain is taken: counts of columns and rows, lengths that have a unit, the unit
// of the heights, and a last line that names as many columns as there are. All else in it is passed over. A
// table under such a head may be positions and heights, points, a log or a matrix that is wrapped: where
// nothing says which, it is not taken for a map (refuse_uncertain_lattice).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/io/column_head.hpp"

namespace asperity {

struct OwnHead {
  std::size_t lines = 0;    // before the first row of the table
  std::size_t first = 0;    // number of the first of them with words, which are
  std::string words;        // these, as errors show them
  std::size_t columns = 0;  // of the first row
  // The last line before the table, where it names as many columns.
  std::optional<std::vector<HeadColumn>> names;
  std::optional<double> stated_columns, stated_rows;
  std::optional<double> size_x, size_y;        // m, nodes times spacing
  std::optional<double> spacing_x, spacing_y;  // m
  std::optional<double> size;                  // m, of a square
  std::optional<double> unit;                  // m per height
  std::vector<std::string> twice;              // what is stated in two ways, and then not used
};

// The head of a text whose first line, comments apart, is of words, over two rows of numbers or more. Nothing
// for any other text, for a line that names columns alone (column_head.hpp) and for formats that are known.
// O(length of the head).
std::optional<OwnHead> own_head(const SourceFile& file);

// Throws Error{bad_file} where the table under such a head may be no map: columns of another kind are named,
// positions may stand in the first row or column, or the matrix may be wrapped. Says what would tell.
void refuse_uncertain_lattice(const SourceFile& file, const OwnHead& head);

}  // namespace asperity
