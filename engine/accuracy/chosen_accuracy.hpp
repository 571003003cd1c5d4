// SPDX-License-Identifier: GPL-3.0-or-later
// What was chosen for an error that a script asked for, and why: the grids that were tried, what each
// reached, and the one that was kept. A record for the reader; how it is found is in
// accuracy/accuracy_choice.hpp.
#pragma once

#include <string>
#include <vector>

#include "engine/contact/scene.hpp"
#include "engine/core/cost.hpp"

namespace asperity {

struct TriedGrid {
  int nx = 0, ny = 0;
  double tolerance = 0;
  // Greatest relative error among the quantities asked for, with the margin of the estimate and, but for the
  // area within an outline between the nodes, the algebraic bound in it; infinite where the value grows from
  // grid to grid, or its quantity is zero and its error is not.
  double error = 0;
  std::string of;    // the quantity that has it
  std::string note;  // why this grid does not count, or empty
  Cost cost;         // transforms in those of this grid
};

struct ChosenAccuracy {
  AskedError asked;
  int nx = 0, ny = 0;
  double tolerance = 0;
  Accuracy::Precision precision = Accuracy::Precision::double_;
  std::string why_precision;  // in a few words
  double error = 0;           // of this state, as in TriedGrid
  std::string of;
  std::string source;                  // how the bodies were put on these cells
  std::string limit;                   // "4096 x 4096 cells are the most within 4 GiB of memory"
  bool outline_between_nodes = false;  // the corrected area is that within contact/outline_area.hpp
  std::vector<TriedGrid> tried;
  // The quantities requested, in this state. A later value below 1e-9 of the first press's counts as zero (a
  // body that has yielded yields no more under less load), and its error is relative to the first value.
  std::vector<double> values;

  bool met() const { return error <= asked.error && tried.back().note.empty(); }
  // The grid tried before the one chosen; null where none was.
  const TriedGrid* before() const;
  // Cells along x that would meet the request, by the order of the error; the most of an int at most.
  int cells_needed() const;
  std::string reason() const;       // one sentence
  std::string values_text() const;  // "requested: corrected_area_fraction 0.0421, within 0.9 %"
  std::string text() const;         // one line: cells, tolerance, precision and the reason
};

// "64 x 64 cells"; "1.2 %".
std::string cells_text(int nx, int ny);
std::string percent_text(double share);

}  // namespace asperity
