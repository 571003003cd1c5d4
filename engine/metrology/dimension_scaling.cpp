// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/dimension_scaling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/text.hpp"

namespace asperity {

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  const double x_mean = mean(x), y_mean = mean(y);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double dx = x[k] - x_mean, dy = y[k] - y_mean;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  LineFit fit;
  fit.slope = xy / xx;
  fit.intercept = y_mean - fit.slope * x_mean;
  double left = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double residual = (y[k] - y_mean) - fit.slope * (x[k] - x_mean);
    left += residual * residual;
  }
  fit.r_squared = yy > 0 ? std::clamp(1 - left / yy, 0.0, 1.0) : 1;
  if (x.size() > 2) fit.slope_error = std::sqrt(left / (n - 2) / xx);
  return fit;
}

namespace {

constexpr double share_of_run = 0.4, least_run = 0.03, greatest_run = 0.1;
constexpr double scatters = 2;
// Factor of the scatter at D = 1; growth with D.
constexpr double scatter_at_one = 0.4, scatter_growth = 1.2;
constexpr int stretches = 4;

double dimension_between(const ScalingSteps& s, std::size_t a, std::size_t b) {
  const double slope = (s.log_statistics[b] - s.log_statistics[a]) / elementary::log(s.steps[b] / s.steps[a]);
  return s.at_zero + s.per_slope * slope;
}

// Stretches of about equal logarithmic length.
std::vector<std::size_t> ends_of_stretches(std::span<const double> steps) {
  std::vector<std::size_t> ends;
  const double whole = elementary::log(steps.back() / steps.front());
  for (int k = 0; k <= stretches; ++k) {
    const double wanted = steps.front() * elementary::exp(whole * k / stretches);
    const auto nearest = std::min_element(steps.begin(), steps.end(), [=](double a, double b) {
      return std::abs(elementary::log(a / wanted)) < std::abs(elementary::log(b / wanted));
    });
    const auto at = static_cast<std::size_t>(nearest - steps.begin());
    if (ends.empty() || at > ends.back()) ends.push_back(at);
  }
  return ends;
}

// First and last step of the longest row of three or more with local dimensions within `within`; ties:
// smallest spread. Equal if there is none.
std::pair<std::size_t, std::size_t> constant_over(std::span<const double> local, double within) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  double best_spread = infinity;
  for (std::size_t first = 0; first < local.size(); ++first) {
    double least = local[first], greatest = local[first];
    for (std::size_t k = first; k < local.size(); ++k) {
      least = std::min(least, local[k]);
      greatest = std::max(greatest, local[k]);
      const double spread = greatest - least;
      if (spread > within) break;
      const std::size_t steps = k + 1 - first, most = best.second - best.first;
      if (k == first || steps < most || (steps == most && spread >= best_spread)) continue;
      best = {first, k + 1};
      best_spread = spread;
    }
  }
  return best;
}

std::string between(std::span<const double> steps, std::size_t a, std::size_t b) {
  return "between steps of " + format_short(steps[a]) + " and " + format_short(steps[b]);
}

struct BiasRow {
  double known;
  std::array<double, 3> found;
};
constexpr std::array<double, 3> bias_samples = {150, 1024, 16384};
constexpr BiasRow bias_rows[] = {
    {1.05, {1.039, 1.048, 1.040}}, {1.1, {1.071, 1.069, 1.072}},  {1.2, {1.106, 1.132, 1.136}},
    {1.3, {1.162, 1.193, 1.213}},  {1.4, {1.225, 1.258, 1.310}},  {1.5, {1.277, 1.331, 1.393}},
    {1.6, {1.348, 1.403, 1.473}},  {1.7, {1.395, 1.467, 1.548}},  {1.8, {1.455, 1.535, 1.620}},
    {1.9, {1.520, 1.605, 1.693}},  {1.95, {1.548, 1.636, 1.730}},
};

double bias_at(std::size_t column, double D) {
  double found_before = 1, bias_before = 0;
  for (const BiasRow& row : bias_rows) {
    const double found = row.found[column], bias = row.known - found;
    if (D <= found) {
      const double place = std::max(0.0, D - found_before) / (found - found_before);
      return bias_before + place * (bias - bias_before);
    }
    found_before = found;
    bias_before = bias;
  }
  return bias_before;
}

}  // namespace

std::vector<double> local_dimensions(const ScalingSteps& scaling) {
  std::vector<double> local;
  for (std::size_t k = 0; k + 1 < scaling.steps.size(); ++k)
    local.push_back(dimension_between(scaling, k, k + 1));
  return local;
}

std::string running_dimension(const ScalingSteps& scaling, double D, int samples, int profiles,
                              double scatter) {
  const std::span<const double> steps = scaling.steps;
  const std::vector<std::size_t> ends = ends_of_stretches(steps);
  std::vector<double> stretch;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    stretch.push_back(dimension_between(scaling, ends[k], ends[k + 1]));
  if (stretch.size() < 2) return {};
  const bool rises = stretch.back() > stretch.front();
  const auto against = [=](double a, double b) { return rises ? b <= a : b >= a; };
  if (std::ranges::adjacent_find(stretch, against) != stretch.end()) return {};
  const double run = std::abs(stretch.back() - stretch.front());
  const double allowed = std::clamp(share_of_run * (D - 1), least_run, greatest_run);
  const double longest = steps.back(), apart = std::max(1.0, profiles / longest);
  const double of_scatter = std::clamp(scatter_at_one + scatter_growth * (D - 1), scatter_at_one, 1.0);
  if (!(run > allowed + scatters * of_scatter * scatter * std::sqrt(longest / samples / apart))) return {};

  std::string reason = "D runs from " + format_short(stretch.front(), 4) + " " +
                       between(steps, ends[0], ends[1]) + " to " + format_short(stretch.back(), 4) + " " +
                       between(steps, ends[ends.size() - 2], ends.back()) +
                       ": no one dimension describes these steps; ";
  const auto [first, last] = constant_over(local_dimensions(scaling), allowed / 2);
  if (last == first) return reason + "it is constant over no three of them in a row";
  std::string list;
  for (std::size_t k = first; k <= last; ++k) list += (list.empty() ? "" : ", ") + format_short(steps[k]);
  return reason + "it is constant within " + format_short(allowed / 2, 2) + " over `steps={" + list + "}`";
}

std::string smooth_in_small_boxes(const ScalingSteps& scaling, double D) {
  const double smallest = dimension_between(scaling, 0, 1);
  if (smallest - 1 >= share_of_run * (D - 1)) return {};
  return "boxes of " + format_short(scaling.steps[0]) + " and " + format_short(scaling.steps[1]) +
         " samples find " + format_short(smallest, 4) + " where all find " + format_short(D, 4) +
         ": the profile is smooth over short steps; give longer `steps`, or use the method `structure`";
}

double box_counting_bias(double D, int samples) {
  const double at = std::clamp(static_cast<double>(samples), bias_samples.front(), bias_samples.back());
  const std::size_t left = at < bias_samples[1] ? 0 : 1;
  const double low = bias_samples[left], high = bias_samples[left + 1];
  const double place = elementary::log(at / low) / elementary::log(high / low);
  return bias_at(left, D) + place * (bias_at(left + 1, D) - bias_at(left, D));
}

}  // namespace asperity
