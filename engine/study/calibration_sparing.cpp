// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares for an expensive, noisy model. Derivatives begin as differences; each step corrects them
// (Broyden 1965), and differences are repeated near the minimum. The distance left is offset/s in standard
// errors: offset of the residuals from the predicted minimum, s their scatter. Difference steps move the
// observations by about s: above the noise, within the linear range.
#include <algorithm>
#include <cmath>

#include "engine/study/calibration_problem.hpp"

namespace asperity {

namespace {

constexpr int most_sparing_steps = 60;
constexpr double first_step = 0.02;        // relative, of first differences
constexpr double widest_step = 0.1;        // later differences, relative
constexpr double moves_by = 1;             // move in scatters
constexpr double above_noise = 20;         // least move, in noises
constexpr double little_to_go = 0.003;     // standard errors: converged
constexpr double end_is_near = 0.3;        // standard errors: derivatives stay valid
constexpr double foretold_within = 0.1;    // standard errors: predict the last step
constexpr double foretold_gains = 15;      // in `gain`: smaller reductions need no call
constexpr double full_steps_within = 1;    // standard errors: do not compare sums
constexpr double hidden_within = 3;        // standard errors: noise may hide the minimum
constexpr double comes_nearer_by = 0.5;    // least fall of the offset
constexpr double noise_is_seen = 0.1;      // standard errors: short steps show noise
constexpr double noise_tells = 0.1;        // standard errors: less is not reported
constexpr double sparing_rounding = 1e-9;  // of the residuals, relative to the data

}  // namespace

// For weight 1, at the predicted minimum.
double CalibrationProblem::scatter_at(const CalibrationPlace& at, const CalibrationTangent& tangent) const {
  const std::size_t observations = groups_.size();
  const double least = sparing_rounding * size_of(at);
  if (observations <= tangent.rank) return least;
  const double sum = std::max(0.0, at.sum - tangent.offset * tangent.offset);
  return std::max(least, std::sqrt(sum / static_cast<double>(observations - tangent.rank)));
}

std::vector<double> CalibrationProblem::sparing_steps(const CalibrationPlace& at,
                                                      const TableColumns& rows_jacobian,
                                                      const std::vector<double>& scales,
                                                      double scatter) const {
  std::vector<double> steps;
  for (std::size_t p = 0; p < parameters(); ++p) {
    const double least = parameters_[p].step * scales[p];
    if (rows_jacobian.empty()) {
      steps.push_back(std::max(least, first_step * scales[p]));
      continue;
    }
    const double length = length_of(observed(at, rows_jacobian[p])),
                 wanted = std::max(moves_by * scatter,
                                   above_noise * noise_ * std::sqrt(static_cast<double>(groups_.size())));
    const double widest = std::max(least, widest_step * scales[p]);
    steps.push_back(length > 0 ? std::clamp(wanted / length, least, widest) : widest);
  }
  return steps;
}

double CalibrationProblem::sparing_unseen() const {
  constexpr double least = 1e-3, most = 0.1;
  if (!(differences_ > 0)) return least;
  return std::clamp(2 * noise_ * std::sqrt(static_cast<double>(groups_.size())) / differences_, least, most);
}

// One batch; smaller steps where the model has no value.
TableColumns CalibrationProblem::sparing_jacobian(const CalibrationPlace& at,
                                                  const std::vector<double>& steps,
                                                  const std::vector<bool>& held) {
  TableColumns columns(parameters(), std::vector<double>(rows_.y.size()));
  std::vector<std::vector<double>> sets;
  std::vector<std::size_t> moved;
  for (std::size_t p = 0; p < parameters(); ++p) {
    if (held[p]) continue;
    std::vector<double> q = at.q;
    const double above = inside(at.q[p] + steps[p], p), below = inside(at.q[p] - steps[p], p);
    q[p] = above - at.q[p] >= at.q[p] - below ? above : below;
    sets.push_back(std::move(q));
    moved.push_back(p);
  }
  const auto values = fitted_all(sets);
  for (std::size_t j = 0; j < sets.size(); ++j) {
    const std::size_t p = moved[j];
    const double h = sets[j][p] - at.q[p];
    if (values[j] && h != 0) {
      for (std::size_t k = 0; k < columns[p].size(); ++k)
        columns[p][k] = ((*values[j])[k] - at.fitted[k]) / h;
      continue;
    }
    std::optional<std::vector<double>> column;
    for (double step = steps[p]; !column && step > 1e-4 * steps[p]; step /= 30)
      column = slopes(at, p, step, false);
    if (!column) refuse_place("where its derivatives are taken");
    columns[p] = *std::move(column);
  }
  return columns;
}

std::vector<double> CalibrationProblem::foretold(const CalibrationPlace& at,
                                                 const TableColumns& rows_jacobian,
                                                 const std::vector<double>& from,
                                                 const std::vector<double>& to) const {
  std::vector<double> of_rows(rows_.y.size());
  for (std::size_t p = 0; p < parameters(); ++p)
    for (std::size_t k = 0; k < of_rows.size(); ++k)
      of_rows[k] += at.roots[k] * rows_jacobian[p][k] * (to[p] - from[p]);
  return observed(of_rows);
}

// Broyden (1965).
void CalibrationProblem::correct(TableColumns& rows_jacobian, const CalibrationPlace& from,
                                 const CalibrationPlace& to, const std::vector<double>& scales) const {
  double length = 0;
  for (std::size_t p = 0; p < parameters(); ++p) {
    const double share = (to.q[p] - from.q[p]) / scales[p];
    length += share * share;
  }
  if (!(length > 0)) return;
  for (std::size_t k = 0; k < rows_.y.size(); ++k) {
    double lack = to.fitted[k] - from.fitted[k];
    for (std::size_t p = 0; p < parameters(); ++p) lack -= rows_jacobian[p][k] * (to.q[p] - from.q[p]);
    for (std::size_t p = 0; p < parameters(); ++p)
      rows_jacobian[p][k] += lack * (to.q[p] - from.q[p]) / (scales[p] * scales[p] * length);
  }
}

// For a short step, actual minus predicted change is model noise.
void CalibrationProblem::see_noise(const CalibrationMinimum& from, const CalibrationTangent& tangent,
                                   const CalibrationPlace& to, double scatter) {
  if (!(tangent.offset <= noise_is_seen * scatter)) return;
  CalibrationPlace there = to;
  weigh(there, &from.place.roots);
  const std::vector<double> expected = foretold(from.place, from.rows_jacobian, from.place.q, to.q);
  double lack = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double d = from.place.residual[i] - there.residual[i] - expected[i];
    lack += d * d / static_cast<double>(expected.size());
  }
  noise_ = std::sqrt(lack);
}

// Linear prediction.
CalibrationPlace CalibrationProblem::foretold_place(const CalibrationMinimum& from,
                                                    const std::vector<double>& q) const {
  CalibrationPlace there = from.place;
  there.q = q;
  for (std::size_t p = 0; p < parameters(); ++p)
    for (std::size_t k = 0; k < there.fitted.size(); ++k)
      there.fitted[k] += from.rows_jacobian[p][k] * (q[p] - from.place.q[p]);
  weigh(there, nullptr);
  return there;
}

std::optional<CalibrationPlace> CalibrationProblem::lower(CalibrationMinimum& from, double& damping,
                                                          int& tries) {
  for (tries = 1; tries <= 6; ++tries) {
    const CalibrationTangent at = free_tangent(from.place, from.rows_jacobian);
    const std::vector<double> q = stepped(from.place, at, damping);
    if (q == from.place.q) return {};
    auto there = place(q, &from.place.roots);
    if (there && there->sum < from.place.sum) return there;
    // Short steps show more noise than slope.
    if (there && length_of(foretold(from.place, from.rows_jacobian, from.place.q, q)) >
                     end_is_near * scatter_at(from.place, at))
      correct(from.rows_jacobian, from.place, *there, from.scales);
    damping = std::max(30 * damping, 3e-3);
  }
  return {};
}

void CalibrationProblem::take_derivatives(CalibrationMinimum& found, double scatter) {
  found.rows_jacobian =
      sparing_jacobian(found.place, sparing_steps(found.place, found.rows_jacobian, found.scales, scatter),
                       std::vector<bool>(parameters(), false));
  found.differenced_at = found.place.q;
}
bool CalibrationProblem::take_first_derivatives(CalibrationMinimum& found, const CalibrationMinimum& before) {
  const bool first = before.differenced_at.empty() || before.place.q != found.place.q;
  if (first) {
    take_derivatives(found, 0);
    if (before.scales.empty()) refuse_still(found);
  } else {
    found.rows_jacobian = before.rows_jacobian;
    found.differenced_at = before.differenced_at;
  }
  return first;
}

bool CalibrationProblem::full_step(CalibrationMinimum& found, const CalibrationTangent& at, double scatter) {
  // Here noise hides the lower sum but hardly moves the offset.
  auto last = place(stepped(found.place, at, 0), nullptr);
  if (!last) {
    found.noisy = at.offset > noise_tells * scatter;
    return false;
  }
  const CalibrationTangent there = free_tangent(*last, found.rows_jacobian);
  see_noise(found, at, *last, scatter);
  if (there.offset < at.offset) found.place = *std::move(last);
  if (there.offset <= comes_nearer_by * at.offset) return true;
  found.noisy = std::min(there.offset, at.offset) > noise_tells * scatter;
  return false;
}

void CalibrationProblem::move_to(CalibrationPlace next, CalibrationMinimum& found, double scatter,
                                 bool scaled) {
  if (length_of(foretold(found.place, found.rows_jacobian, found.place.q, next.q)) > end_is_near * scatter)
    correct(found.rows_jacobian, found.place, next, found.scales);
  found.place = std::move(next);
  weigh(found.place, nullptr);
  for (std::size_t p = 0; p < parameters(); ++p)
    if (found.place.q[p] != 0 && !scaled)
      found.scales[p] = std::max(std::abs(found.place.q[p]), 1e-3 * found.scales[p]);
}

CalibrationMinimum CalibrationProblem::sparing_minimum(CalibrationMinimum found,
                                                       const CalibrationMinimum& before) {
  bool first = take_first_derivatives(found, before);
  double damping = 1e-6;
  int steps = 0;  // since the last differences
  for (found.iterations = 0;; ++found.iterations) {
    const CalibrationTangent at = free_tangent(found.place, found.rows_jacobian);
    const double scatter = scatter_at(found.place, at);
    const double moved =
        length_of(foretold(found.place, found.rows_jacobian, found.differenced_at, found.place.q));
    const bool fresh = !first && moved <= end_is_near * scatter;
    const double noise = noise_ * std::sqrt(static_cast<double>(std::max<std::size_t>(at.rank, 1)));
    const auto take_anew = [&] {
      take_derivatives(found, scatter);
      differences_ = moves_by * scatter;
      first = false;
      damping = 1e-6;
      steps = 0;
    };
    if (!fresh && at.offset <= end_is_near * scatter) {
      take_anew();
      continue;
    }
    if (at.offset <= std::max(little_to_go * scatter, std::min(noise, end_is_near * scatter))) {
      found.noisy = noise > noise_tells * scatter;
      return found;
    }
    if (found.iterations >= most_sparing_steps)
      throw Error(ErrorCode::not_converged,
                  "the calibration found no minimum in " + std::to_string(most_sparing_steps) +
                      " steps; it ended at " + parameters_text(found.place.q),
                  "begin nearer to the answer, set `lower` and `upper`, or fit fewer parameters");
    if (fresh && at.offset <= foretold_within * scatter) {
      // Not worth a model call.
      found.place = foretold_place(found, stepped(found.place, at, 0));
      found.noisy = noise > noise_tells * scatter;
      return found;
    }
    if (fresh && at.offset <= full_steps_within * scatter) {
      if (full_step(found, at, scatter)) continue;
      return found;
    }
    int tries = 0;
    auto next = lower(found, damping, tries);
    if (!next) {
      if (!first && found.place.q == found.differenced_at) {
        if (at.offset > hidden_within * scatter) throw_no_lower(found.place.q);
        found.noisy = true;
        return found;
      }
      take_anew();
      continue;
    }
    move_to(*std::move(next), found, scatter, !before.scales.empty());
    damping *= 1e-2;
    // Corrected derivatives lose accuracy.
    if (tries > 2 || ++steps > 5) take_anew();
  }
}

std::optional<CalibrationPlace> CalibrationProblem::sparing_beside(const CalibrationPlace& start,
                                                                   std::size_t p,
                                                                   const CalibrationMinimum& beside,
                                                                   double gain) {
  std::vector<bool> held(parameters(), false);
  held[p] = true;
  CalibrationPlace at = start;
  TableColumns slopes_here = beside.rows_jacobian;
  correct(slopes_here, beside.place, at, beside.scales);
  double damping = 1e-6;
  for (int step = 0; step < 12; ++step) {
    const CalibrationTangent here = tangent(at, slopes_here, pushed(at, slopes_here, held));
    const double left = here.offset * here.offset;
    if (left <= foretold_gains * gain) {
      at.q = stepped(at, here, 0);
      at.sum -= left;
      return at;
    }
    auto next = better(at, here, &beside.place.roots, damping);
    if (!next) return {};
    const bool little = at.sum - next->sum <= 0.1 * gain;
    correct(slopes_here, at, *next, beside.scales);
    at = *std::move(next);
    if (little) return at;
    damping = std::max(damping * 1e-3, 1e-12);
  }
  return {};
}

}  // namespace asperity
