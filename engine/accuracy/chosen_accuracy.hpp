// SPDX-License-Identifier: GPL-3.0-or-later
// Record of the cells and tolerance chosen for a requested error (accuracy/accuracy_choice.hpp).
#pragma once

#include <string>
#include <vector>

#include "engine/contact/scene/scene.hpp"
#include "engine/core/cost.hpp"

namespace asperity {

struct TriedGrid {
  int nx = 0, ny = 0;
  double tolerance = 0;
  // Largest relative error of the requested quantities, with margin and algebraic bound (none within an
  // outline); infinite if the value grows from grid to grid, or is zero with an error.
  double error = 0;
  std::string of;    // its quantity
  std::string note;  // why the grid does not count
  Cost cost;         // in transforms of this grid
};

struct ChosenAccuracy {
  AskedError asked;
  int nx = 0, ny = 0;
  double tolerance = 0;
  Accuracy::Precision precision = Accuracy::Precision::double_;
  std::string why_precision;
  double error = 0;  // as in TriedGrid
  std::string of;
  std::string source;                  // of the bodies on these cells
  std::string limit;                   // "4096 x 4096 cells are the most within 4 GiB of memory"
  bool outline_between_nodes = false;  // of the corrected area (contact/outline_area.hpp)
  std::vector<TriedGrid> tried;
  // Requested. Below 1e-9 of the first press they count as zero (no new yield under less load), with errors
  // relative to the first value.
  std::vector<double> values;

  bool met() const { return error <= asked.error && tried.back().note.empty(); }
  // Null if none.
  const TriedGrid* before() const;
  // Along x, by the order of the error.
  int cells_needed() const;
  std::string reason() const;
  std::string values_text() const;  // "requested: corrected_area_fraction 0.0421, within 0.9 %"
  std::string text() const;         // cells, tolerance, precision, reason
};

// "64 x 64 cells"; "1.2 %".
std::string cells_text(int nx, int ny);
std::string percent_text(double share);
// The accuracy of a companion grid: `tolerance` or looser. A missed tolerance is no error.
Accuracy companion_accuracy(const Accuracy& given, double tolerance);

}  // namespace asperity
