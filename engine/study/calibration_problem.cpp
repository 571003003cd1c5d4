// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/calibration_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr int most_calibration_steps = 200;
constexpr double calibration_orthogonal = 1e-6;   // residuals to the tangent plane, relative
constexpr double near_enough_for_central = 1e-4;  // the same, for central differences
constexpr double noise_of_model = 0.03;           // the same, noisy models
constexpr double calibration_rounding = 1e-13;    // relative to the data
constexpr double unseen = 1e-5;                   // relative to the largest
constexpr double smallest_share = 1e-3;           // of the largest fit

std::vector<double> products(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all(a.size());
  std::ranges::transform(a, b, all.begin(), std::multiplies());
  return all;
}

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

CalibrationProblem::CalibrationProblem(const CalibrationRows& rows, const CalibrationBatch& model,
                                       std::span<const CalibrationParameter> parameters,
                                       const CalibrationOptions& options, Monitor& monitor)
    : rows_(rows),
      model_(model),
      parameters_(parameters),
      scatter_(options.scatter),
      sparing_(options.sparing),
      monitor_(monitor),
      begun_(std::chrono::steady_clock::now()),
      reported_(begun_) {
  for (std::size_t k = 0; k < rows.y.size(); ++k) {
    own_.push_back(rows.u.empty() ? 1 : 1 / rows.u[k]);
    groups_.push_back({{k}, 1});
  }
  size_ = length_of(products(own_, rows.y));
}

// Counts at least the work after the present part, against stalled progress.
void CalibrationProblem::report(std::int64_t calls) {
  const auto now = std::chrono::steady_clock::now();
  if (seconds_between(reported_, now) < 0.1) return;
  reported_ = now;
  const auto set = static_cast<std::int64_t>(rows_.y.size());
  const std::int64_t left = std::max({expected_ - calls, afterwards_, set});
  share_ = std::max(share_, static_cast<double>(calls) / static_cast<double>(calls + left));
  monitor_.progress_of_parts("calibration", share_,
                             part_ + ", call " + std::to_string(calls) + " of the model",
                             seconds_between(begun_, now));
}

// In order, up to a row without a value.
std::vector<double> CalibrationProblem::asked(const std::vector<std::vector<double>>& sets) {
  std::vector<CalibrationQuery> queries;
  for (const std::vector<double>& q : sets)
    for (std::size_t k = 0; k < rows_.y.size(); ++k)
      for (std::size_t r = 0; r < rows_.replicates; ++r) queries.push_back({q, k, r});
  stop_flag().check();
  const std::int64_t before = calls_;
  report(before);
  std::vector<double> values =
      model_(queries, [&](std::size_t done) { report(before + static_cast<std::int64_t>(done)); });
  calls_ = before + static_cast<std::int64_t>(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k])) continue;
    without_value_ = queries[k].row;
    without_value_at_ = sets[k / (rows_.y.size() * rows_.replicates)];
    break;
  }
  return values;
}

std::vector<std::vector<double>> CalibrationProblem::replicate_deviations(const CalibrationPlace& at) {
  std::vector<std::vector<double>> found(rows_.replicates, std::vector<double>(rows_.y.size()));
  const std::vector<double> values = asked({at.q});
  if (values.size() < rows_.replicates * rows_.y.size()) refuse_place("at the least sum");
  for (std::size_t row = 0; row < rows_.y.size(); ++row) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * rows_.replicates);
    const double mean = std::accumulate(first, first + static_cast<std::ptrdiff_t>(rows_.replicates), 0.0) /
                        static_cast<double>(rows_.replicates);
    for (std::size_t r = 0; r < rows_.replicates; ++r)
      found[r][row] = first[static_cast<std::ptrdiff_t>(r)] - mean;
  }
  return found;
}

std::optional<std::vector<double>> CalibrationProblem::fitted(const std::vector<double>& q) {
  return fitted_all({q}).front();
}

std::vector<std::optional<std::vector<double>>> CalibrationProblem::fitted_all(
    const std::vector<std::vector<double>>& sets) {
  std::vector<std::optional<std::vector<double>>> found(sets.size());
  std::vector<std::vector<double>> unknown;
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < sets.size(); ++j) {
    const auto known =
        std::ranges::find(known_, sets[j], &std::pair<std::vector<double>, std::vector<double>>::first);
    if (known != known_.end()) {
      found[j] = known->second;
    } else {
      unknown.push_back(sets[j]);
      places.push_back(j);
    }
  }
  if (unknown.empty()) return found;
  const std::size_t rows = rows_.y.size(), all = rows * rows_.replicates;
  const std::vector<double> values = asked(unknown);
  for (std::size_t j = 0; j < unknown.size() && (j + 1) * all <= values.size(); ++j) {
    std::vector<double> of_rows(rows);
    for (std::size_t k = 0; k < all; ++k)
      of_rows[k / rows_.replicates] += values[j * all + k] / static_cast<double>(rows_.replicates);
    if (!std::ranges::all_of(of_rows, [](double value) { return std::isfinite(value); })) continue;
    if (sparing_) known_.emplace_back(unknown[j], of_rows);
    found[places[j]] = std::move(of_rows);
  }
  return found;
}

double CalibrationProblem::observed_mean(const std::vector<double>& of_rows, std::size_t observation) const {
  double sum = 0;
  for (const std::size_t row : groups_[observation].rows) sum += of_rows[row];
  return sum / static_cast<double>(groups_[observation].rows.size());
}

std::vector<double> CalibrationProblem::observed(const std::vector<double>& of_rows) const {
  std::vector<double> values;
  values.reserve(groups_.size());
  for (std::size_t i = 0; i < groups_.size(); ++i)
    values.push_back(groups_[i].weight * observed_mean(of_rows, i));
  return values;
}

std::vector<double> CalibrationProblem::observed(const CalibrationPlace& at,
                                                 const std::vector<double>& of_rows) const {
  return observed(products(at.roots, of_rows));
}

std::vector<double> CalibrationProblem::weighted_residuals(const CalibrationPlace& at) const {
  std::vector<double> residuals(rows_.y.size());
  std::ranges::transform(rows_.y, at.fitted, residuals.begin(), std::minus());
  return products(at.roots, residuals);
}

void CalibrationProblem::weigh(CalibrationPlace& at, const std::vector<double>* roots) const {
  if (roots != nullptr) {
    at.roots = *roots;
  } else {
    at.roots = own_;
    if (scatter_ == CalibrationScatter::relative) {
      double largest = 0;
      for (const double value : at.fitted) largest = std::max(largest, std::abs(value));
      if (!(largest > 0)) largest = 1;
      for (std::size_t k = 0; k < at.roots.size(); ++k)
        at.roots[k] /= std::max(std::abs(at.fitted[k]), smallest_share * largest);
    }
  }
  at.residual = observed(weighted_residuals(at));
  at.sum = scalar_product(at.residual, at.residual);
}

std::optional<CalibrationPlace> CalibrationProblem::place(const std::vector<double>& q,
                                                          const std::vector<double>* roots) {
  auto values = fitted(q);
  if (!values) return {};
  CalibrationPlace at;
  at.q = q;
  at.fitted = *std::move(values);
  weigh(at, roots);
  if (!std::isfinite(at.sum)) return {};
  return at;
}

void CalibrationProblem::refuse_place(const std::string& where) const {
  const std::size_t number = rows_.numbers.empty() ? without_value_ + 1 : rows_.numbers[without_value_];
  refuse("the model has no finite value for row " + std::to_string(number) + " " + where + ", with " +
             parameters_text(without_value_at_),
         "begin from other values, set `lower` and `upper`, or write the model so that it has a value there");
}

void CalibrationProblem::throw_no_lower(const std::vector<double>& q) const {
  throw Error(ErrorCode::not_converged,
              "the calibration stops at " + parameters_text(q) +
                  ", which is no minimum: the derivatives of the model are wrong there",
              "give a larger `step` of a parameter if the model has noise, or begin elsewhere");
}

std::string CalibrationProblem::parameters_text(const std::vector<double>& q) const {
  std::string text;
  for (std::size_t p = 0; p < q.size(); ++p)
    text += (p > 0 ? ", " : "") + parameters_[p].name + " = " + format_short(q[p]) +
            (parameters_[p].unit.empty() ? "" : " " + parameters_[p].unit);
  return text;
}

bool CalibrationProblem::at_lower(double value, std::size_t p) const {
  return parameters_[p].lower && value <= *parameters_[p].lower;
}

bool CalibrationProblem::at_upper(double value, std::size_t p) const {
  return parameters_[p].upper && value >= *parameters_[p].upper;
}

double CalibrationProblem::inside(double value, std::size_t p) const {
  if (parameters_[p].lower) value = std::max(value, *parameters_[p].lower);
  if (parameters_[p].upper) value = std::min(value, *parameters_[p].upper);
  return value;
}

// By rows; nothing if the model has no value nearby.
std::optional<std::vector<double>> CalibrationProblem::slopes(const CalibrationPlace& at, std::size_t p,
                                                              double step, bool central) {
  const double room_above = parameters_[p].upper ? *parameters_[p].upper - at.q[p] : step * 4,
               room_below = parameters_[p].lower ? at.q[p] - *parameters_[p].lower : step * 4;
  std::vector<double> q = at.q;
  const auto values_at = [&](double distance) {
    q[p] = inside(at.q[p] + distance, p);
    return fitted(q);
  };
  std::vector<double> found(at.fitted.size());
  if (central && room_above >= step && room_below >= step) {
    const auto above = values_at(step);
    const double reach_above = q[p] - at.q[p];
    const auto below = above ? values_at(-step) : std::nullopt;
    const double reach = reach_above - (q[p] - at.q[p]);
    if (!above || !below || !(reach > 0)) return {};
    for (std::size_t k = 0; k < found.size(); ++k) found[k] = ((*above)[k] - (*below)[k]) / reach;
    return found;
  }
  const double side = room_above >= room_below ? 1 : -1;
  step = std::min(step, std::max(room_above, room_below) / (central ? 2 : 1));
  const auto once = values_at(side * step);
  const double h = q[p] - at.q[p];
  if (!once || h == 0) return {};
  if (!central) {
    for (std::size_t k = 0; k < found.size(); ++k) found[k] = ((*once)[k] - at.fitted[k]) / h;
    return found;
  }
  const auto twice = values_at(2 * side * step);
  if (!twice) return {};
  for (std::size_t k = 0; k < found.size(); ++k)
    found[k] = (4 * (*once)[k] - 3 * at.fitted[k] - (*twice)[k]) / (2 * h);
  return found;
}

TableColumns CalibrationProblem::jacobian(const CalibrationPlace& at, const std::vector<double>& scales,
                                          const std::vector<bool>& held, bool central) {
  TableColumns columns(parameters(), std::vector<double>(rows_.y.size()));
  for (std::size_t p = 0; p < parameters(); ++p) {
    if (held[p]) continue;
    std::optional<std::vector<double>> column;
    // Smaller steps near the edge of the domain, and none that rounding loses.
    for (double share = parameters_[p].step; !column && share > parameters_[p].step * 1e-4; share /= 30)
      column = slopes(at, p, std::max(share * scales[p], 1e-9 * std::abs(at.q[p])), central);
    if (!column) refuse_place("where its derivatives are taken");
    columns[p] = *std::move(column);
  }
  return columns;
}

CalibrationTangent CalibrationProblem::tangent(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                                               const std::vector<bool>& held, double hidden) const {
  CalibrationTangent found;
  TableColumns columns;
  for (std::size_t p = 0; p < parameters(); ++p) {
    if (held[p]) continue;
    std::vector<double> column = observed(at, rows_jacobian[p]);
    const double length = length_of(column);
    if (length > 0)
      for (double& value : column) value /= length;
    found.parameters.push_back(p);
    found.lengths.push_back(length);
    columns.push_back(std::move(column));
  }
  if (columns.empty()) return found;
  found.svd = singular_values(columns);
  double sum = 0;
  for (std::size_t k = 0; k < found.svd.values.size(); ++k) {
    const double product = scalar_product(found.svd.u[k], at.residual);
    found.along.push_back(product);
    // The largest always counts.
    const double least = (sparing_ ? sparing_unseen() : unseen) * found.svd.values[0];
    if (!(found.svd.values[k] > (k == 0 ? least : std::max(hidden, least)))) continue;
    found.rank = k + 1;
    sum += product * product;
  }
  found.offset = std::sqrt(sum);
  return found;
}

std::vector<bool> CalibrationProblem::pushed(const CalibrationPlace& at, const TableColumns& rows_jacobian,
                                             const std::vector<bool>& held) const {
  std::vector<bool> all = held;
  for (std::size_t p = 0; p < parameters(); ++p) {
    if (held[p] || (!at_lower(at.q[p], p) && !at_upper(at.q[p], p))) continue;
    const double wanted = scalar_product(observed(at, rows_jacobian[p]), at.residual);
    if ((wanted < 0 && at_lower(at.q[p], p)) || (wanted > 0 && at_upper(at.q[p], p))) all[p] = true;
  }
  return all;
}

// Levenberg–Marquardt step within bounds.
std::vector<double> CalibrationProblem::stepped(const CalibrationPlace& at, const CalibrationTangent& tangent,
                                                double damping) const {
  std::vector<double> step(tangent.parameters.size());
  for (std::size_t k = 0; k < tangent.rank; ++k) {
    const double s = tangent.svd.values[k], share = tangent.along[k] * s / (s * s + damping);
    for (std::size_t i = 0; i < step.size(); ++i) step[i] += share * tangent.svd.v[k][i];
  }
  std::vector<double> q = at.q;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const std::size_t p = tangent.parameters[i];
    if (tangent.lengths[i] > 0) q[p] = inside(q[p] + step[i] / tangent.lengths[i], p);
  }
  return q;
}

// First lower place along rising damping.
std::optional<CalibrationPlace> CalibrationProblem::better(const CalibrationPlace& at,
                                                           const CalibrationTangent& tangent,
                                                           const std::vector<double>* roots,
                                                           double& damping) {
  // A sparing fit tries five.
  const double most = sparing_ ? 1e4 : 1e16, harder = sparing_ ? 300 : 10;
  if (sparing_) damping = std::min(damping, 1e-4);
  for (; damping < most; damping *= harder) {
    const std::vector<double> q = stepped(at, tangent, damping);
    if (q == at.q) return {};
    auto there = place(q, roots);
    if (there && there->sum < at.sum) return there;
  }
  return {};
}

// Scale of a parameter: its start; for 0 a quarter of its bounds, or the largest power of ten that changes
// the model by at most the size of the data.
std::vector<double> CalibrationProblem::natural_scales(const CalibrationPlace& at) {
  std::vector<double> scales;
  for (std::size_t p = 0; p < parameters(); ++p) {
    const CalibrationParameter& of = parameters_[p];
    if (at.q[p] != 0) {
      scales.push_back(std::abs(at.q[p]));
      continue;
    }
    if (of.lower && of.upper) {
      scales.push_back((*of.upper - *of.lower) / 4);
      continue;
    }
    const double wanted = std::max(size_, std::numeric_limits<double>::min());
    const auto moves_no_further = [&](int power) {
      std::vector<double> q = at.q;
      q[p] = (of.upper ? -1 : 1) * elementary::pow(10, power);
      const auto there = fitted(q);
      if (!there) return false;
      std::vector<double> change(there->size());
      for (std::size_t k = 0; k < change.size(); ++k) change[k] = own_[k] * ((*there)[k] - at.fitted[k]);
      return length_of(change) <= wanted;
    };
    constexpr int largest = 6, smallest = -17;
    int power = largest;
    if (sparing_) {
      // Larger moves change the model more: bisect.
      int low = smallest - 1, high = largest + 1;
      while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (moves_no_further(middle) ? low : high) = middle;
      }
      power = low;
    } else {
      while (power >= smallest && !moves_no_further(power)) --power;
    }
    scales.push_back(power >= smallest ? elementary::pow(10, power) : 1);
  }
  return scales;
}

CalibrationMinimum CalibrationProblem::minimum(const std::vector<double>& start,
                                               const CalibrationMinimum& before) {
  auto begin = place(start, nullptr);
  if (!begin) refuse_place("at the start");
  CalibrationMinimum found;
  found.place = *std::move(begin);
  found.scales = before.scales.empty() ? natural_scales(found.place) : before.scales;
  if (sparing_) return sparing_minimum(std::move(found), before);
  const std::vector<double> natural = found.scales;
  double damping = 1e-4;
  bool central = false;
  for (found.iterations = 0;; ++found.iterations) {
    found.rows_jacobian =
        jacobian(found.place, found.scales, std::vector<bool>(parameters(), false), central);
    if (found.iterations == 0 && before.scales.empty()) refuse_still(found);
    const CalibrationTangent at = free_tangent(found.place, found.rows_jacobian);
    const double length = length_of(found.place.residual),
                 floor = calibration_rounding * size_of(found.place);
    const auto offset_within = [&](double share) {
      return at.offset <= share * length || at.offset <= floor;
    };
    if (!central && offset_within(near_enough_for_central)) {
      central = true;
      continue;
    }
    if (central && offset_within(calibration_orthogonal)) {
      // A last full step: nearby sums differ by rounding only.
      if (auto last = place(stepped(found.place, at, 0), nullptr)) found.place = *std::move(last);
      return found;
    }
    if (found.iterations >= most_calibration_steps)
      throw Error(
          ErrorCode::not_converged,
          "the calibration found no minimum in " + std::to_string(most_calibration_steps) +
              " steps; it ended at " + parameters_text(found.place.q),
          "begin nearer to the answer, set `lower` and `upper` in lab.calibrate, or fit fewer parameters");
    auto next = better(found.place, at, &found.place.roots, damping);
    if (!next) {
      if (!central) {
        central = true;
        damping = 1e-4;
        continue;
      }
      if (!offset_within(noise_of_model)) throw_no_lower(found.place.q);
      found.noisy = !offset_within(1e-3);
      return found;
    }
    found.place = *std::move(next);
    weigh(found.place, nullptr);
    damping = std::max(damping * 1e-3, 1e-20);
    for (std::size_t i = 0; i < at.parameters.size(); ++i) {
      const std::size_t p = at.parameters[i];
      const double acts = at.lengths[i] > 0 ? 0.01 * size_of(found.place) / at.lengths[i] : natural[p];
      found.scales[p] = std::max(std::abs(found.place.q[p]), std::min(natural[p], acts));
      if (!(found.scales[p] > 0)) found.scales[p] = natural[p];
    }
  }
}

std::optional<CalibrationPlace> CalibrationProblem::minimum_beside(const CalibrationPlace& start,
                                                                   std::size_t p,
                                                                   const CalibrationMinimum& beside,
                                                                   double gain) {
  if (sparing_) return sparing_beside(start, p, beside, gain);
  std::vector<bool> held(parameters(), false);
  held[p] = true;
  CalibrationPlace at = start;
  double damping = 1e-4;
  for (int step = 0; step < 30; ++step) {
    const TableColumns slopes_here = jacobian(at, beside.scales, held, false);
    const CalibrationTangent here = tangent(at, slopes_here, pushed(at, slopes_here, held));
    if (here.offset * here.offset <= gain) return at;
    auto next = better(at, here, &beside.place.roots, damping);
    if (!next)
      return here.offset <= noise_of_model * length_of(at.residual) ? std::optional(at) : std::nullopt;
    const bool little = at.sum - next->sum <= 0.1 * gain && here.offset * here.offset <= 4 * gain;
    at = *std::move(next);
    if (little) return at;
    damping = std::max(damping * 1e-3, 1e-20);
  }
  return {};
}

double CalibrationProblem::size_of(const CalibrationPlace& at) const {
  return length_of(products(at.roots, rows_.y));
}

}  // namespace asperity
