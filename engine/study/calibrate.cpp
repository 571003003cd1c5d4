// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/statistics/polynomial_chaos.hpp"
#include "engine/study/calibration_problem.hpp"

namespace asperity {

namespace {

constexpr double level_of_specimens = 0.5;  // p-value; else specimen means
constexpr double through_every_row = 1e-9;  // residuals, relative to the data
constexpr double no_part = 0.01;            // negligible component
constexpr double moved_little = 0.2;        // half-widths; more voids an interval
constexpr double moved_far = 3;             // the same; more voids the estimate

std::string row_name(const CalibrationRows& rows, std::size_t k) {
  return "row " + std::to_string(rows.numbers.empty() ? k + 1 : rows.numbers[k]);
}

void check_rows(const CalibrationRows& rows) {
  const std::size_t n = rows.y.size();
  for (const std::size_t length : {rows.u.size(), rows.specimens.size(), rows.numbers.size()})
    if (length != 0 && length != n)
      refuse("the calibration has " + std::to_string(n) + " values of y and " + std::to_string(length) +
                 " of another column",
             "give one for each row");
  for (std::size_t k = 0; k < n; ++k) {
    if (!std::isfinite(rows.y[k])) refuse("y is not finite in " + row_name(rows, k), "leave the row out");
    if (!has_square(rows.y[k]))
      refuse("y is " + format_short(rows.y[k]) + " in " + row_name(rows, k) +
                 ", and its square leaves the range of numbers",
             "give it in another unit");
    if (!rows.u.empty() && !(std::isfinite(rows.u[k]) && rows.u[k] > 0))
      refuse("the uncertainty `u` is " + format_short(rows.u[k]) + " in " + row_name(rows, k),
             "give a finite value above 0, or leave the row out");
  }
}

void check_parameters(std::span<const CalibrationParameter> parameters) {
  if (parameters.empty())
    refuse("the calibration has no parameters",
           "name them with the values to begin from, as in { tau0={ start=0.3 } }");
  for (const CalibrationParameter& of : parameters) {
    const auto finite = [](const std::optional<double>& value) { return !value || std::isfinite(*value); };
    if (!std::isfinite(of.start) || !finite(of.lower) || !finite(of.upper))
      refuse("parameter " + quoted(of.name) + " has a start or a bound that is not finite",
             "give finite values, and leave out a bound that is not there");
    if (of.lower && of.upper && !(*of.lower < *of.upper))
      refuse("parameter " + quoted(of.name) + " has `lower` " + format_short(*of.lower) + " and `upper` " +
                 format_short(*of.upper),
             "`lower` must be below `upper`; to fix a parameter, write its value into the model");
    if ((of.lower && of.start < *of.lower) || (of.upper && of.start > *of.upper))
      refuse("parameter " + quoted(of.name) + " starts at " + format_short(of.start) + ", outside its bounds",
             "start between `lower` and `upper`");
    if (!(of.step > 1e-9 && of.step <= 0.5))
      refuse("parameter " + quoted(of.name) + " has a `step` of " + format_short(of.step),
             "give a share of the parameter from 1e-9 to 0.5, such as 1e-3");
  }
  for (std::size_t a = 0; a < parameters.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (parameters[a].name == parameters[b].name)
        refuse("two parameters are called " + quoted(parameters[a].name), "give each its own name");
}

std::vector<std::pair<std::string, CalibrationGroup>> specimen_groups(const CalibrationRows& rows) {
  std::vector<std::pair<std::string, CalibrationGroup>> found;
  std::map<std::string, std::size_t> places;
  for (std::size_t k = 0; k < rows.specimens.size(); ++k) {
    const auto [at, fresh] = places.emplace(rows.specimens[k], found.size());
    if (fresh) found.emplace_back(rows.specimens[k], CalibrationGroup{});
    found[at->second].second.rows.push_back(k);
  }
  return found;
}

struct SpecimenVariances {
  double within = 0, between = 0;
  SpecimenScatter test;
};

// `weighted`: residuals times root weights. Needs more rows than specimens, more specimens than parameters.
SpecimenVariances variances_of(const std::vector<std::pair<std::string, CalibrationGroup>>& groups,
                               const std::vector<double>& weighted, std::size_t parameters) {
  const auto n = static_cast<double>(weighted.size()), m = static_cast<double>(groups.size());
  double between = 0, within = 0, squares = 0;
  for (const auto& [name, group] : groups) {
    const auto count = static_cast<double>(group.rows.size());
    double mean = 0;
    for (const std::size_t row : group.rows) mean += weighted[row] / count;
    between += count * mean * mean;
    squares += count * count;
    for (const std::size_t row : group.rows) within += (weighted[row] - mean) * (weighted[row] - mean);
  }
  SpecimenVariances found;
  found.test.between = groups.size() - parameters;
  found.test.within = weighted.size() - groups.size();
  const auto between_degrees = static_cast<double>(found.test.between),
             within_degrees = static_cast<double>(found.test.within);
  found.within = within / within_degrees;
  const double mean_square = between / between_degrees, repeats = (n - squares / n) / (m - 1);
  found.between = std::max(0.0, (mean_square - found.within) / repeats);
  if (found.within > 0) {
    found.test.f = mean_square / found.within;
    found.test.p_value = 1 - f_cdf(found.test.f, between_degrees, within_degrees);
  } else if (mean_square > 0) {
    found.test.f = infinity;
    found.test.p_value = 0;
  }
  return found;
}

std::vector<CalibrationGroup> specimen_observations(
    const std::vector<std::pair<std::string, CalibrationGroup>>& groups, const SpecimenVariances& variances) {
  std::vector<CalibrationGroup> found;
  double sum = 0;
  for (const auto& [name, group] : groups) {
    const double variance = variances.between + variances.within / static_cast<double>(group.rows.size());
    found.push_back({group.rows, variance > 0 ? 1 / std::sqrt(variance) : 1});
    sum += found.back().weight;
  }
  for (CalibrationGroup& group : found) group.weight *= static_cast<double>(found.size()) / sum;
  return found;
}

// Covariance for unit scatter; 0 for fixed parameters.
TableColumns covariance_of(const CalibrationTangent& at, std::size_t parameters) {
  TableColumns covariance(parameters, std::vector<double>(parameters));
  for (std::size_t i = 0; i < at.parameters.size(); ++i)
    for (std::size_t j = 0; j < at.parameters.size(); ++j) {
      if (!(at.lengths[i] > 0 && at.lengths[j] > 0)) continue;
      double sum = 0;
      for (std::size_t k = 0; k < at.rank; ++k)
        sum += at.svd.v[k][i] * at.svd.v[k][j] / (at.svd.values[k] * at.svd.values[k]);
      covariance[at.parameters[i]][at.parameters[j]] = sum / (at.lengths[i] * at.lengths[j]);
    }
  return covariance;
}

std::vector<bool> determined_parameters(const CalibrationTangent& at, std::size_t parameters) {
  std::vector<bool> determined(parameters, true);
  for (std::size_t i = 0; i < at.parameters.size(); ++i) {
    double part = 0;
    for (std::size_t k = at.rank; k < at.svd.values.size(); ++k) part += at.svd.v[k][i] * at.svd.v[k][i];
    if (!(at.lengths[i] > 0) || part > no_part * no_part) determined[at.parameters[i]] = false;
  }
  return determined;
}

class CalibrationWork {
 public:
  CalibrationWork(const CalibrationRows& rows, const CalibrationBatch& model,
                  std::span<const CalibrationParameter> parameters, const CalibrationOptions& options,
                  Monitor& monitor)
      : rows_(rows), options_(options), problem_(rows, model, parameters, options, monitor) {}

  Calibration run() {
    const std::size_t p = problem_.parameters();
    const auto of_profile = static_cast<std::int64_t>(options_.profile && rows_.replicates < 2 ? 2 * p : 0);
    problem_.expect(
        static_cast<std::int64_t>(options_.sparing ? 2 * p + 4 : 5 * (p + 1) + 2 * (2 * p + 1)) + of_profile,
        of_profile);
    std::vector<double> start;
    for (std::size_t k = 0; k < p; ++k) start.push_back(problem_.parameter(k).start);
    fit(start);
    bool profiled = false;
    for (int again = 0; options_.profile && rows_.replicates < 2 && variance_ > 0 && again < 3; ++again) {
      problem_.say("profile likelihood");
      profiles_.assign(p, {});
      const std::optional<std::vector<double>> lower = profile();
      profiled = !lower;
      if (profiled) break;
      // Restart at the lower sum.
      problem_.say("fit again");
      fit(*lower);
      ++begun_again_;
    }
    confirm(profiled);
    return described();
  }

 private:
  // Rows, then specimen means if specimens scatter more.
  void fit(const std::vector<double>& start) {
    groups_ = specimen_groups(rows_);
    test_.reset();
    by_specimens_ = false;
    std::vector<CalibrationGroup> each;
    for (std::size_t k = 0; k < rows_.y.size(); ++k) each.push_back({{k}, 1});
    problem_.observe(std::move(each));
    settle(start);
    if (rows_.specimens.empty() || tangent_.rank == 0) return;
    const bool wanted = options_.basis == CalibrationBasis::specimens;
    const std::size_t used = tangent_.rank + static_cast<std::size_t>(std::ranges::count(held_, true));
    if (groups_.size() <= used) {
      if (wanted)
        refuse_infeasible("basis=\"specimens\" has " + counted(groups_.size(), "specimen") + " for " +
                              counted(problem_.parameters(), "parameter"),
                          "measure more specimens than there are parameters");
      return;
    }
    SpecimenVariances variances;
    if (groups_.size() < rows_.y.size()) {
      variances = variances_of(groups_, problem_.weighted_residuals(at_.place), used);
      test_ = variances.test;
    }
    if (options_.basis == CalibrationBasis::rows) return;
    if (!wanted && !(variance_ > 0 && test_ && test_->p_value < level_of_specimens)) return;
    problem_.say("fit of the means of specimens");
    problem_.observe(specimen_observations(groups_, variances));
    by_specimens_ = true;
    try {
      settle(at_.place.q);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::not_converged) throw;
      throw Error(ErrorCode::not_converged, "for the means of specimens, " + error.sentence(),
                  "vary the conditions of specimens; intervals of basis=\"rows\" leave out their scatter");
    }
  }

  void settle(const std::vector<double>& start) {
    at_ = problem_.minimum(start, at_);
    iterations_ += at_.iterations;
    describe_place();
  }

  void describe_place() {
    const std::vector<bool> none(problem_.parameters(), false);
    held_ = problem_.pushed(at_.place, at_.rows_jacobian, none);
    let_go(problem_.tangent(at_.place, at_.rows_jacobian, none, at_.hidden));
    tangent_ = problem_.tangent(at_.place, at_.rows_jacobian, held_, at_.hidden);
    // Fixed parameters stay outside undetermined directions.
    covariance_ = covariance_of(tangent_, problem_.parameters());
    determined_ = determined_parameters(tangent_, problem_.parameters());
    moved_.assign(problem_.parameters(), 0);
    bounds_.clear();
    const std::size_t held = static_cast<std::size_t>(std::ranges::count(held_, true));
    const std::size_t observations = problem_.groups().size(), used = tangent_.rank + held;
    degrees_ = observations > used ? observations - used : 0;
    // Exact fit: residuals are rounding errors.
    const double rounding = through_every_row * problem_.size_of(at_.place);
    scatter_ = degrees_ > 0 && at_.place.sum > rounding * rounding
                   ? at_.place.sum / static_cast<double>(degrees_)
                   : 0;
    variance_ = known_scatter() ? 1 : scatter_;
    for (std::size_t p = 0; p < problem_.parameters(); ++p)
      if (held_[p]) leave_bound(p);
  }

  std::vector<double> moves_with(const std::vector<double>& observed) const {
    std::vector<double> moves(problem_.parameters());
    for (std::size_t k = 0; k < tangent_.rank; ++k) {
      const std::vector<double>&u = tangent_.svd.u[k], &v = tangent_.svd.v[k];
      const double along = scalar_product(observed, u) / tangent_.svd.values[k];
      for (std::size_t i = 0; i < v.size(); ++i)
        if (tangent_.lengths[i] > 0) moves[tangent_.parameters[i]] += v[i] * along / tangent_.lengths[i];
    }
    return moves;
  }

  std::vector<double> observed_column(std::size_t p) const {
    return problem_.observed(at_.place, at_.rows_jacobian[p]);
  }

  // Range of p from its bound to the cut of S; moves of the others.
  void leave_bound(std::size_t p) {
    const std::vector<double> column = observed_column(p);
    CalibrationBound bound{p, 0, moves_with(column)};
    std::vector<double> across = column;  // uncompensated
    for (std::size_t i = 0; i < bound.moves.size(); ++i) {
      const std::vector<double> other = observed_column(i);
      for (std::size_t k = 0; k < across.size(); ++k) across[k] -= bound.moves[i] * other[k];
      bound.moves[i] = i == p ? 1 : -bound.moves[i];
    }
    const double allowed = cut() * variance_, bend = length_of(across),
                 push = std::abs(scalar_product(column, at_.place.residual));
    bound.range = allowed / (push + std::sqrt(push * push + bend * bend * allowed));
    if (degrees_ == 0 && !known_scatter()) bound.range = infinity;
    const CalibrationParameter& of = problem_.parameter(p);
    if (of.lower && of.upper) bound.range = std::min(bound.range, *of.upper - *of.lower);
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      const double move = std::abs(bound.moves[i]) * bound.range,
                   reach = factor() * std::sqrt(variance_ * covariance_[i][i]);
      if (i == p || !(move > 0) || (!determined_[i] && moved_[i] == 0)) continue;
      moved_[i] += move / reach;
      if (moved_[i] > moved_far) determined_[i] = false, bound.decides = true;
    }
    bounds_.push_back(std::move(bound));
  }

  // Whether `u` determines the scatter.
  bool known_scatter() const { return !rows_.u.empty() && !options_.relative_u && !by_specimens_; }

  // Frees a parameter that can leave its bound along an undetermined direction. `all`: tangent with every
  // parameter.
  void let_go(const CalibrationTangent& all) {
    for (std::size_t k = all.rank; k < all.svd.values.size(); ++k) {
      const std::vector<double>& v = all.svd.v[k];
      bool onward = true, backward = true;
      for (std::size_t p = 0; p < v.size(); ++p) {
        const double part = std::abs(v[p]) > no_part && all.lengths[p] > 0 ? v[p] : 0;
        const bool low = problem_.at_lower(at_.place.q[p], p), high = problem_.at_upper(at_.place.q[p], p);
        if ((part > 0 && high) || (part < 0 && low)) onward = false;
        if ((part > 0 && low) || (part < 0 && high)) backward = false;
      }
      if (!onward && !backward) continue;
      for (std::size_t p = 0; p < v.size(); ++p)
        if (std::abs(v[p]) > no_part) held_[p] = false;
    }
  }

  // Unless the profile confirms the derivatives, wider differences replace them.
  void confirm(bool profiled) {
    bool sure = profiled && !at_.noisy;
    for (std::size_t p = 0; sure && p < determined_.size(); ++p)
      sure = determined_[p] && !held_[p] && profiles_[p].as_foretold;
    if (sure) return;
    problem_.say("width of differences");
    auto firm = problem_.firm_slopes(at_);
    if (!firm) return;
    const std::vector<bool> determined = determined_, held = held_;
    TableColumns before = std::exchange(at_.rows_jacobian, std::move(firm->rows_jacobian));
    at_.hidden = firm->hidden;
    describe_place();
    if (determined_ == determined && held_ == held && !std::ranges::count(determined, false)) {
      at_.rows_jacobian = std::move(before);
      at_.hidden = 0;
      describe_place();
      return;
    }
    if (!profiles_.empty() && rows_.replicates < 2) {
      profiles_.assign(problem_.parameters(), {});
      profile();
    }
  }

  double factor() const {
    if (interval_degrees_ > 0) return student_t_factor(options_.confidence, interval_degrees_);
    return student_t_factor(options_.confidence,
                            degrees_ > 0 && !known_scatter() ? static_cast<double>(degrees_) : infinity);
  }
  double cut() const { return factor() * factor(); }

  std::optional<std::vector<double>> profile() {
    const double allowed = cut() * variance_;
    for (std::size_t p = 0; p < problem_.parameters(); ++p) {
      if (!determined_[p]) continue;
      problem_.say("profile likelihood of " + problem_.parameter(p).name);
      const std::size_t after = problem_.parameters() - p - 1;
      problem_.expect(static_cast<std::int64_t>(2 + 2 * after), static_cast<std::int64_t>(2 * after));
      std::vector<double> guide(problem_.parameters());
      double reach = 0;
      if (held_[p]) {
        const auto bound = std::ranges::find(bounds_, p, &CalibrationBound::parameter);
        if (bound == bounds_.end() || bound->decides) continue;
        guide = bound->moves;
        reach = bound->range;
      } else {
        for (std::size_t i = 0; i < guide.size(); ++i) guide[i] = covariance_[i][p] / covariance_[p][p];
        reach = factor() * std::sqrt(variance_ * covariance_[p][p]);
      }
      guide[p] = 1;
      if (!(std::isfinite(reach) && reach > 0)) continue;
      profiles_[p] = profile_of(problem_, at_, p, guide, reach, allowed, variance_);
      if (profiles_[p].lower_sum) return profiles_[p].lower_sum;
    }
    return {};
  }

  // Adds replicate scatter to the covariance: the mean moves all rows and, unless specimens are the
  // observations, each face its specimen's rows.
  void add_faces() {
    const std::size_t replicates = rows_.replicates;
    faces_.assign(problem_.parameters(), std::vector<double>(problem_.parameters()));
    if (replicates < 2) return;
    std::vector<CalibrationGroup> faces;
    for (const auto& [name, group] : groups_) faces.push_back(group);
    if (faces.empty()) faces.emplace_back().rows.resize(rows_.y.size());
    if (groups_.empty()) std::iota(faces[0].rows.begin(), faces[0].rows.end(), std::size_t{0});
    const auto add = [&](const std::vector<double>& of_rows, double share) {
      const std::vector<double> moves = moves_with(problem_.observed(at_.place, of_rows));
      for (std::size_t i = 0; i < moves.size(); ++i)
        for (std::size_t j = 0; j < moves.size(); ++j) faces_[i][j] += share * moves[i] * moves[j];
    };
    const double share = 1 / static_cast<double>(replicates - 1);
    for (const std::vector<double>& deviation : problem_.replicate_deviations(at_.place)) {
      add(deviation, share / static_cast<double>(replicates));
      for (const CalibrationGroup& face : by_specimens_ ? std::vector<CalibrationGroup>() : faces) {
        std::vector<double> own(deviation.size());
        for (const std::size_t row : face.rows) own[row] = deviation[row];
        add(own, share);
      }
    }
    const double scale = variance_ > 0 ? variance_ : 1;
    double degrees = known_scatter() ? infinity : static_cast<double>(degrees_);
    const double own_degrees = degrees;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const double rows = variance_ * covariance_[i][i], of_faces = faces_[i][i], sum = rows + of_faces;
      if (!(sum > 0)) continue;
      // Smallest Welch–Satterthwaite degrees.
      degrees = std::min(
          degrees, sum * sum / ((rows > 0 ? rows * rows / own_degrees : 0) + of_faces * of_faces * share));
      for (std::size_t j = 0; j < faces_.size(); ++j)
        covariance_[i][j] = (variance_ * covariance_[i][j] + faces_[i][j]) / scale;
    }
    variance_ = scale;
    interval_degrees_ = degrees;
  }

  Calibration described() {
    add_faces();
    Calibration found;
    const std::size_t count = problem_.parameters();
    found.confidence = options_.confidence;
    found.observations = problem_.groups().size();
    found.degrees = degrees_;
    found.by_specimens = by_specimens_;
    found.sum_of_squares = at_.place.sum;
    found.residual_deviation = std::sqrt(scatter_);
    found.cut = cut();
    found.iterations = iterations_;
    found.fitted = at_.place.fitted;
    for (std::size_t k = 0; k < rows_.y.size(); ++k) found.residuals.push_back(rows_.y[k] - found.fitted[k]);
    const bool spread = degrees_ > 0 || known_scatter();
    const double t = factor();
    for (std::size_t p = 0; p < count; ++p) {
      CalibratedParameter of;
      of.name = problem_.parameter(p).name;
      of.determined = determined_[p];
      of.at_lower = held_[p] && problem_.at_lower(at_.place.q[p], p);
      of.at_upper = held_[p] && !of.at_lower;
      if (of.determined) {
        of.value = at_.place.q[p];
        if (!held_[p] && spread && moved_[p] <= moved_little) {
          of.standard_error = std::sqrt(variance_ * covariance_[p][p]);
          of.low = *of.value - t * *of.standard_error;
          of.high = *of.value + t * *of.standard_error;
          of.share_of_faces = *of.standard_error > 0 ? faces_[p][p] / (variance_ * covariance_[p][p]) : 0;
        }
        if (p < profiles_.size()) {
          of.profile_low = profiles_[p].low;
          of.profile_high = profiles_[p].high;
          of.profile = profiles_[p].points;
        }
      }
      found.parameters.push_back(std::move(of));
    }
    found.correlation.assign(count, std::vector<std::optional<double>>(count));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        if (determined_[i] && determined_[j] && !held_[i] && !held_[j])
          found.correlation[i][j] =
              i == j ? 1
                     : std::clamp(covariance_[i][j] / std::sqrt(covariance_[i][i] * covariance_[j][j]), -1.0,
                                  1.0);
    if (!tangent_.svd.values.empty() && tangent_.rank == tangent_.svd.values.size())
      found.condition = tangent_.svd.values.front() / tangent_.svd.values.back();
    add_band(found, spread, t);
    add_specimens(found);
    const CalibrationFindings findings{problem_,  at_,          tangent_,  covariance_, held_,
                                       bounds_,   moved_,       variance_, scatter_,    spread ? t : 0,
                                       profiles_, begun_again_, options_};
    add_verdict(found, findings);
    found.calls = problem_.calls();
    return found;
  }

  void add_band(Calibration& found, bool spread, double t) const {
    for (std::size_t k = 0; k < rows_.y.size(); ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < covariance_.size(); ++i)
        for (std::size_t j = 0; j < covariance_.size(); ++j)
          sum += at_.rows_jacobian[i][k] * covariance_[i][j] * at_.rows_jacobian[j][k];
      const double reach = t * std::sqrt(variance_ * std::max(sum, 0.0));
      found.fitted_low.push_back(spread ? std::optional(found.fitted[k] - reach) : std::nullopt);
      found.fitted_high.push_back(spread ? std::optional(found.fitted[k] + reach) : std::nullopt);
    }
  }

  void add_specimens(Calibration& found) const {
    const std::vector<double> weighted = problem_.weighted_residuals(at_.place);
    for (const auto& [name, group] : groups_) {
      double sum = 0;
      for (const std::size_t row : group.rows) sum += weighted[row];
      found.specimens.push_back({name, group.rows.size(), sum / static_cast<double>(group.rows.size())});
    }
    found.specimen_scatter = test_;
  }

  const CalibrationRows& rows_;
  const CalibrationOptions& options_;
  CalibrationProblem problem_;
  CalibrationMinimum at_;
  CalibrationTangent tangent_;
  std::vector<bool> held_, determined_;
  std::vector<CalibrationBound> bounds_;
  std::vector<double> moved_;  // half-widths, by leaving bounds
  TableColumns covariance_;
  TableColumns faces_;  // covariance from replicates
  double interval_degrees_ = 0;
  std::vector<std::pair<std::string, CalibrationGroup>> groups_;
  std::optional<SpecimenScatter> test_;
  std::vector<CalibrationProfile> profiles_;
  std::size_t degrees_ = 0;
  double scatter_ = 0, variance_ = 0;  // of unit weight: residuals; for intervals
  bool by_specimens_ = false;
  int iterations_ = 0, begun_again_ = 0;
};

}  // namespace

void check_calibration(const CalibrationRows& rows, std::span<const CalibrationParameter> parameters,
                       const CalibrationOptions& options) {
  check_rows(rows);
  check_parameters(parameters);
  if (!(options.confidence > 0 && options.confidence < 1))
    refuse("`confidence` is " + format_short(options.confidence), "give a share between 0 and 1");
  if (rows.y.size() < parameters.size())
    refuse("the calibration has " + counted(rows.y.size(), "row") + " for " +
               counted(parameters.size(), "parameter"),
           "measure more rows, or write values of some parameters into the model");
  if (options.scatter == CalibrationScatter::relative && !rows.u.empty())
    refuse("`u` and scatter=\"relative\" both give the scatter of the rows", "give one of them");
  if (options.basis == CalibrationBasis::specimens && rows.specimens.empty())
    refuse("basis=\"specimens\" needs the specimen of each row",
           "name its column, as in specimen=\"specimen\"");
}

Calibration calibrate(const CalibrationRows& rows, const CalibrationModel& model,
                      std::span<const CalibrationParameter> parameters, const CalibrationOptions& options,
                      Monitor& monitor) {
  const CalibrationBatch in_turn = [&model](std::span<const CalibrationQuery> queries,
                                            const std::function<void(std::size_t)>& done) {
    std::vector<double> values;
    for (const CalibrationQuery& query : queries) {
      stop_flag().check();
      values.push_back(model(query.parameters, query.row));
      done(values.size());
      if (!std::isfinite(values.back())) break;
    }
    return values;
  };
  return calibrate(rows, in_turn, parameters, options, monitor);
}

Calibration calibrate(const CalibrationRows& rows, const CalibrationBatch& model,
                      std::span<const CalibrationParameter> parameters, const CalibrationOptions& options,
                      Monitor& monitor) {
  check_calibration(rows, parameters, options);
  return CalibrationWork(rows, model, parameters, options, monitor).run();
}

}  // namespace asperity
