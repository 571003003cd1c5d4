// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/accuracy/chosen_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "engine/contact/quantities.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/text.hpp"

namespace asperity {

Accuracy companion_accuracy(const Accuracy& given, double tolerance) {
  return {.tolerance = std::max(given.tolerance, tolerance),
          .precision = given.precision,
          .on_failure = Accuracy::OnFailure::best};
}

std::string cells_text(int nx, int ny) { return std::to_string(nx) + " x " + std::to_string(ny) + " cells"; }

std::string percent_text(double share) {
  return std::isfinite(share) ? format_short(100 * share, 2) + " %" : std::string("no limit");
}

const TriedGrid* ChosenAccuracy::before() const {
  const TriedGrid* last = nullptr;
  for (const TriedGrid& grid : tried)
    if (grid.nx < nx) last = &grid;
  return last;
}

int ChosenAccuracy::cells_needed() const {
  const double times =
      elementary::pow(std::max(1.0, error / asked.error), 1 / find_quantity(of)->cells->order);
  return static_cast<int>(std::min(times * nx, static_cast<double>(std::numeric_limits<int>::max())));
}

std::string ChosenAccuracy::reason() const {
  std::string result =
      percent_text(asked.error) + " of " + joined(asked.of, " and ") + " was requested; on " +
      cells_text(nx, ny) +
      (outline_between_nodes ? ", with the outline between the nodes, it comes to " : " it comes to ") +
      percent_text(error);
  if (asked.of.size() > 1) result += " of " + of;
  if (const TriedGrid* const last = before())
    result += ", on " + cells_text(last->nx, last->ny) + " to " + percent_text(last->error) +
              (last->note.empty() ? "" : " (" + last->note + ")");
  if (!met())
    result += "; " + (tried.back().note.empty() ? "" : tried.back().note + "; ") + "no finer grid " + limit;
  return result;
}

std::string ChosenAccuracy::values_text() const {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < asked.of.size(); ++k)
    texts.push_back(asked.of[k] + " " + format_quantity(values[k], find_quantity(asked.of[k])->dimension));
  return "requested: " + joined(texts, ", ") + ", within " + percent_text(error) +
         (met() ? "" : ", more than the " + percent_text(asked.error) + " requested");
}

std::string ChosenAccuracy::text() const {
  return cells_text(nx, ny) + (source.empty() ? "" : " (" + source + ")") + ", tolerance " +
         format_short(tolerance) + ", " + (precision == Accuracy::Precision::single ? "single" : "double") +
         " precision" + (why_precision.empty() ? "" : " (" + why_precision + ")") + ": " + reason();
}

}  // namespace asperity
