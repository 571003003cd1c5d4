// SPDX-License-Identifier: GPL-3.0-or-later
// Reliability of difference derivatives. Narrow differences of models with steps (counted nodes, iterations)
// are 0 or far too large. The disagreement between two widths bounds the effect of noise and curvature on
// singular values (Weyl). Only directions above this bound are determined.
#include <algorithm>
#include <cmath>

#include "engine/core/text.hpp"
#include "engine/study/calibration_problem.hpp"

namespace asperity {

namespace {

constexpr double wider = 4;                   // than the previous differences
constexpr double widest_share = 0.25;         // of a parameter
constexpr double first_sparing_share = 0.02;  // the same, sparing
constexpr double beyond_errors = 2;           // singular values, in disagreements
constexpr double beyond_noise = 1.2;          // the same, if wider agrees better
constexpr double falls_by = 0.5;              // due to noise

bool ends_there(const Error& error) {
  return error.code() == ErrorCode::bad_value || error.code() == ErrorCode::infeasible ||
         error.code() == ErrorCode::not_converged;
}

}  // namespace

void CalibrationProblem::refuse_still(const CalibrationMinimum& at) {
  std::size_t still = 0;
  const auto moves = [](const std::vector<double>& column) {
    return std::ranges::any_of(column, [](double value) { return value != 0; });
  };
  for (std::size_t p = 0; p < parameters(); ++p) {
    if (moves(at.rows_jacobian[p])) continue;
    ++still;
    bool wide = false;
    for (double share = 1; !wide && share > parameters_[p].step; share /= wider) try {
        const auto column = slopes(at.place, p, share * at.scales[p], true);
        wide = column && moves(*column);
      } catch (const Error& error) {
        if (!ends_there(error)) throw;
      }
    if (wide || still == parameters())
      throw Error(
          ErrorCode::not_converged,
          "no row changes with a " + std::string(wide ? "small " : "") + "step of " +
              quoted(parameters_[p].name) + " from its start " + format_short(at.place.q[p]),
          "write a model without steps, begin elsewhere, or give lab.calibrate a larger `step`, such as 0.2");
  }
}

std::optional<FirmSlopes> CalibrationProblem::firm_slopes(const CalibrationMinimum& at) {
  const std::vector<bool> none(parameters(), false);
  const auto disagreement = [&](const TableColumns& narrow, const TableColumns& wide) {
    double sum = 0;
    for (std::size_t p = 0; p < parameters(); ++p) {
      std::vector<double> apart = observed(at.place, wide[p]);
      const double length = length_of(apart);
      std::ranges::transform(apart, observed(at.place, narrow[p]), apart.begin(), std::minus());
      const double error = length_of(apart);
      if (error > 0) sum += length > 0 ? error * error / (length * length) : 1;
    }
    return std::sqrt(sum);
  };
  // One share for all: columns of equivalent parameters are then identical.
  double share = widest_share;
  for (const CalibrationParameter& of : parameters_)
    share = std::min(share, sparing_ ? std::max(of.step, first_sparing_share) : of.step);
  std::optional<FirmSlopes> best;
  std::size_t least_silent = parameters() + 1;
  TableColumns narrow;
  double before = 0;
  for (;;) {
    TableColumns wide;
    try {
      for (std::size_t p = 0; p < parameters(); ++p) {
        auto column = slopes(at.place, p, share * at.scales[p], true);
        if (!column) return best;
        wide.push_back(*std::move(column));
      }
    } catch (const Error& error) {
      if (!ends_there(error)) throw;
      return best;
    }
    if (!narrow.empty()) {
      const double apart = disagreement(narrow, wide);
      const double hidden = (apart < falls_by * before ? beyond_noise : beyond_errors) * apart;
      before = apart;
      const CalibrationTangent there = tangent(at.place, wide, none, hidden);
      const auto silent = static_cast<std::size_t>(
          std::ranges::count_if(there.lengths, [](double length) { return !(length > 0); }));
      if (silent < least_silent || (silent == least_silent && hidden < best->hidden)) {
        best = FirmSlopes{wide, hidden};
        least_silent = silent;
      }
      if (silent == 0 && there.rank == parameters()) return FirmSlopes{std::move(wide), hidden};
    }
    narrow = std::move(wide);
    if (share >= widest_share) return best;
    share = std::min(wider * share, widest_share);
  }
}

}  // namespace asperity
