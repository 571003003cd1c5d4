// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/changed_laws.hpp"

#include <array>
#include <charconv>

namespace asperity {

namespace {

constexpr std::array<ChangedLaw, law_count> table_of_laws{{
    {Law::last_digits, "0.2.0", "last digits",
     "sine, cosine, exponential, logarithm and powers were the C library's, which rounds by the processor, "
     "and transforms chose by the processor",
     "elementary functions are correctly rounded and transforms go one way, the same on every processor",
     "the last digits of every surface and of what is computed from it, and so all digests"},
    {Law::overlap, "0.2.0", "bodies that do not cover each other",
     "on a free boundary an invisible flat carried load where a turned or placed upper body does not lie",
     "nothing is there: no pressure, the gap is missing, and means of the gap go over the overlap",
     "all that is pressed on a free boundary after a turn or a placement that leaves ground uncovered"},
    {Law::plastic_shares, "0.2.0", "shares of unlike bodies",
     "body i took H_j/(H_i + H_j) of what yields, however hard it is",
     "it takes 1/(1 + exp(1.5 (r^2 - 1/r^2)) E_i/E_j), r = H_i/H_j with the hardness each node has by then",
     "plastic events of two bodies of unlike hardness or modulus, or that harden, and all that follows them"},
    {Law::tilt_weight, "0.2.0", "heavy weights and lone spots on the tilt stage",
     "on a half-space friction at the probe pressures was taken for that at the weight, also where the "
     "weight presses harder than they do, or on one spot whose area is not in proportion to the load",
     "such a weight is solved for itself, and as the stage is raised what is left of it",
     "angles, mu and area per load of such trials"},
    {Law::approach_control, "0.2.0", "control by approach",
     "`approach`, `indentation` and `flatten` were reached by seeking the load",
     "the contact is solved at the given approach", "such presses of half-spaces, within their tolerance"},
    {Law::long_cells, "0.2.0", "long cells",
     "the solver took cells much longer than wide, or wider than long, as it takes square ones",
     "it is carried along their lines",
     "half-spaces on such cells, within their tolerance, and how many transforms they take"},
    {Law::flat_stiffness, "0.2.0", "secant stiffness of a flat",
     "a flat under load on all of a periodic tile had a secant stiffness of 0",
     "it is infinite: the load brings no approach", "`secant_stiffness` of states without approach"},
    {Law::column_units, "0.2.0", "units of columns",
     "in a column with a unit a quantity was kept as text, and a bound given as one was counted in SI units",
     "both are counted in the unit of the column, and one of another kind is an error",
     "cells of such columns that were written as quantities, and verdicts on them"},
    {Law::point_units, "0.2.0", "units in the heads of points",
     "units in the line that names the columns of x y z and x z files were passed over",
     "they are the units of the numbers below", "surfaces read from such files, and all that follows them"},
    {Law::alike_readings, "0.2.0", "readings that are alike", "the noise of a recording was taken for white",
     "neighbouring readings that a filter made alike count for fewer",
     "events found in such recordings, their loads, dwells and standard errors"},
    {Law::whole_numbers, "0.2.0", "whole numbers in notebooks",
     "rows() gave every number with a point, 1.0, and tables had 1e+05",
     "an integer of the script stays one, and tables have 100000",
     "files of such columns, and what a script prints of them"},
    {Law::asked_error, "0.2.0", "errors that are asked for",
     "`error` of `accuracy` was judged by two grids that agree, from 64 cells on, and a corrected area was "
     "that of the nodes less the same for every edge",
     "grids are tried from 16 cells on, each with twice the cells of the one before, a corrected area of "
     "half-spaces and boxes lies within an outline between the nodes, and functions are evaluated again",
     "cells, tolerance and costs of such presses, their corrected areas, and all that follows them"},
    {Law::line_order, "0.2.0", "files that store the top line first",
     "the first line of every file was j = 0, so images were upside down",
     "the top line of an image has the largest y, as Gwyddion shows it",
     "surfaces read from such files, their lay and skew along y, and all that follows them"},
    {Law::stray_readings, "0.2.0", "stray readings",
     "a stray reading on a ramp, or several in a row, became a press or a release",
     "up to three in a row that leave the lines through their neighbours are left out",
     "events found in such recordings, their loads and dwells, and all that follows them"},
    {Law::separation, "0.2.0", "the separation of a press that yields",
     "`separation` was that of the bodies before the press yielded",
     "what yields under the press is taken off first, so that pressing once more changes nothing",
     "separations of such presses, and all that follows them"},
}};

constexpr bool each_in_its_place() {
  for (std::size_t k = 0; k < table_of_laws.size(); ++k)
    if (static_cast<std::size_t>(table_of_laws[k].law) != k) return false;
  return true;
}
static_assert(each_in_its_place());

std::optional<std::array<int, 3>> version_numbers(std::string_view text) {
  std::array<int, 3> numbers{};
  const char *at = text.data(), *const end = text.data() + text.size();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0 && (at == end || *at++ != '.')) return {};
    if (at == end || *at < '0' || *at > '9') return {};
    const auto [after, problem] = std::from_chars(at, end, numbers[k]);
    if (problem != std::errc()) return {};
    at = after;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

}  // namespace

std::span<const ChangedLaw> changed_laws() { return table_of_laws; }

const ChangedLaw& told(Law law) { return table_of_laws[static_cast<std::size_t>(law)]; }

std::optional<bool> is_earlier(std::string_view version, std::string_view than) {
  const auto one = version_numbers(version), other = version_numbers(than);
  if (!one || !other) return {};
  return *one < *other;
}

std::vector<const ChangedLaw*> laws_changed_between(std::string_view then, std::string_view now) {
  std::vector<const ChangedLaw*> changed;
  for (const ChangedLaw& law : table_of_laws)
    if (is_earlier(then, law.since).value_or(false) && !is_earlier(now, law.since).value_or(true))
      changed.push_back(&law);
  return changed;
}

}  // namespace asperity
