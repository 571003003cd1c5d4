// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/accuracy/chosen_accuracy.hpp"

#include <cmath>

#include "engine/core/text.hpp"

namespace asperity {

std::string cells_text(int nx, int ny) { return std::to_string(nx) + " x " + std::to_string(ny) + " cells"; }

std::string percent_text(double share) {
  return std::isfinite(share) ? format_short(100 * share, 2) + " %" : std::string("no limit");
}

const TriedGrid* ChosenAccuracy::before(int cells) const {
  const TriedGrid* last = nullptr;
  for (const TriedGrid& grid : tried)
    if (grid.nx < cells) last = &grid;
  return last;
}

std::string ChosenAccuracy::reason() const {
  std::string result =
      percent_text(asked.error) + " of " + joined(asked.of, " and ") + " was asked for; on " +
      cells_text(nx, ny) +
      (outline_between_nodes ? ", with the outline between the nodes, it comes to " : " it comes to ") +
      percent_text(error);
  if (asked.of.size() > 1) result += " of " + of;
  if (const TriedGrid* const last = before())
    result += ", on " + cells_text(last->nx, last->ny) +
              (last->note.empty() ? " to " + percent_text(last->error) : " " + last->note);
  if (!met()) result += "; finer cells were not to be had";
  return result;
}

std::string ChosenAccuracy::text() const {
  return cells_text(nx, ny) + (source.empty() ? "" : " (" + source + ")") + ", tolerance " +
         format_short(tolerance) + ", " + (precision == Accuracy::Precision::single ? "single" : "double") +
         " precision" + (why_precision.empty() ? "" : " (" + why_precision + ")") + ": " + reason();
}

}  // namespace asperity
