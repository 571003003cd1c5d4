// SPDX-License-Identifier: GPL-3.0-or-later
// Tables under a head of words, as instruments export them:
//   Stylus profiler / Operator Li / Speed 0.5 mm/s / x [mm],z [um] / 0,1 / 0.1,2 / …
// Only unambiguous entries are used: counts, lengths with a unit, the unit of heights, and a last line that
// names every column. Undecided tables are refused.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/column_head.hpp"

namespace asperity {

struct OwnHead {
  std::size_t lines = 0;  // before the table
  std::size_t first = 0;  // first line of words
  std::string words;      // this line, for errors
  std::size_t columns = 0;
  std::optional<std::vector<HeadColumn>> names;
  std::optional<double> stated_columns, stated_rows;
  std::optional<double> size_x, size_y;        // m, nodes times spacing
  std::optional<double> spacing_x, spacing_y;  // m
  std::optional<double> size;                  // m, of a square
  std::optional<double> unit;                  // m per height
  std::vector<std::string> twice;              // contradictory entries
};

// The head, if the first line (without comments) has words and two rows of numbers follow. None for column
// names alone and for known formats.
std::optional<OwnHead> own_head(const SourceFile& file);

// Throws Error{bad_file} for other named columns, possible positions in the first row or column, and a
// possibly wrapped matrix.
void refuse_uncertain_lattice(const SourceFile& file, const OwnHead& head);

}  // namespace asperity
