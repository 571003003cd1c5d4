// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/material_ratio.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"

namespace asperity {

namespace {

constexpr double window_width = 0.4;

// Fixed runs, merged pairwise.
void sort_downwards(std::span<double> values) {
  constexpr std::size_t run = std::size_t{1} << 17;
  const std::size_t n = values.size();
  for_each_block(n, run, [&](std::size_t first, std::size_t last) {
    std::ranges::sort(values.subspan(first, last - first), std::greater<>());
  });
  if (n <= run) return;
  Array<double> other(n);
  std::span<double> from = values, to = other;
  for (std::size_t width = run; width < n; width *= 2) {
    for_each_block(n, 2 * width, [&](std::size_t first, std::size_t last) {
      const std::size_t middle = std::min(n, first + width);
      std::merge(from.data() + first, from.data() + middle, from.data() + middle, from.data() + last,
                 to.data() + first, std::greater<>());
    });
    std::swap(from, to);
  }
  if (from.data() != values.data()) std::copy(from.begin(), from.end(), values.begin());
}

}  // namespace

MaterialRatioCurve::MaterialRatioCurve(std::span<const double> heights) {
  heights_.reserve(heights.size());
  for (const double z : heights)
    if (!std::isnan(z)) heights_.push_back(z);
  if (heights_.empty())
    refuse("there are no heights to make a material ratio curve of", "give at least one measured point");
  mean_ = exact_mean(heights_, range(heights_));
  for (double& z : heights_) z -= mean_;
  sort_downwards(heights_);
}

double MaterialRatioCurve::at(double place) const {
  const auto k = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last_place()));
  if (k + 1 >= heights_.size()) return heights_[k];
  return heights_[k] + (place - static_cast<double>(k)) * (heights_[k + 1] - heights_[k]);
}

double MaterialRatioCurve::height(double ratio) const {
  require(ratio >= 0 && ratio <= 1, "ratio", ratio, "", "a material ratio is a share from 0 to 1");
  return at(ratio * last_place());
}

double MaterialRatioCurve::ratio(double height) const {
  const auto below =
      std::partition_point(heights_.begin(), heights_.end(), [=](double h) { return h >= height; });
  if (below == heights_.begin()) return 0;
  if (below == heights_.end()) return 1;
  const double upper = *(below - 1), lower = *below;
  const double place = static_cast<double>(below - heights_.begin() - 1) + (upper - height) / (upper - lower);
  return place / last_place();
}

// Partial segments at both ends, whole ones between.
double MaterialRatioCurve::integral(double first, double last) const {
  if (!(last > first)) return 0;
  const double whole_first = std::ceil(first), whole_last = std::floor(last);
  const auto part = [&](double a, double b) { return (b - a) * (at(a) + at(b)) / 2; };
  if (whole_last < whole_first) return part(first, last);
  const auto begin = static_cast<std::size_t>(whole_first), end = static_cast<std::size_t>(whole_last);
  const double whole = blocked_sums<1>(end - begin, [&](std::size_t k) {
    return std::array{(heights_[begin + k] + heights_[begin + k + 1]) / 2};
  })[0];
  return part(first, whole_first) + whole + part(whole_last, last);
}

double MaterialRatioCurve::material_volume(double p) const {
  const double c = height(p);
  if (heights_.size() == 1) return 0;
  return integral(0, p * last_place()) / last_place() - p * c;
}

double MaterialRatioCurve::void_volume(double p) const {
  const double c = height(p);
  if (heights_.size() == 1) return 0;
  return (1 - p) * c - integral(p * last_place(), last_place()) / last_place();
}

// Ties (two windows of a sine, all of a triangle): the first.
double MaterialRatioCurve::window() const {
  const double width = window_width * last_place(), span = heights_.front() - heights_.back();
  const auto windows = static_cast<std::size_t>(std::floor(last_place() - width)) + 1;
  const auto fall = [&](std::size_t k) { return heights_[k] - at(static_cast<double>(k) + width); };
  double least = fall(0);
  for (std::size_t k = 1; k < windows; ++k) least = std::min(least, fall(k));
  std::size_t first = 0;
  while (fall(first) > least + 1e-9 * span) ++first;
  return static_cast<double>(first);
}

CoreOfCurve MaterialRatioCurve::core() const {
  CoreOfCurve core;
  if (heights_.front() == heights_.back()) return core;
  const double width = window_width * last_place();
  const double first = window(), last = first + width, middle = first + width / 2;
  // ∫ (u - middle) c du, exact on straight pieces.
  const auto moment = [&](double a, double b) {
    const double ca = at(a), cb = at(b);
    return (b - a) / 6 * ((a - middle) * (2 * ca + cb) + (b - middle) * (ca + 2 * cb));
  };
  const double whole_first = std::ceil(first), whole_last = std::floor(last);
  double turning = 0;
  if (whole_last < whole_first) {
    turning = moment(first, last);
  } else {
    const auto begin = static_cast<std::size_t>(whole_first), end = static_cast<std::size_t>(whole_last);
    turning = moment(first, whole_first) + moment(whole_last, last) +
              blocked_sums<1>(end - begin, [&](std::size_t k) {
                const double u = static_cast<double>(begin + k) - middle, ca = heights_[begin + k],
                             cb = heights_[begin + k + 1];
                return std::array{(u * (2 * ca + cb) + (u + 1) * (ca + 2 * cb)) / 6};
              })[0];
  }
  const double slope = 12 * turning / (width * width * width), level = integral(first, last) / width;
  const double top = level - slope * middle, bottom = level + slope * (last_place() - middle);
  core.window = first / last_place();
  core.Sk = top - bottom;
  core.Smr1 = ratio(top);
  core.Smr2 = ratio(bottom);
  const double above = integral(0, core.Smr1 * last_place()) / last_place() - core.Smr1 * top;
  const double below =
      (1 - core.Smr2) * bottom - integral(core.Smr2 * last_place(), last_place()) / last_place();
  core.Spk = core.Smr1 > 0 ? 2 * above / core.Smr1 : 0;
  core.Svk = core.Smr2 < 1 ? 2 * below / (1 - core.Smr2) : 0;
  core.Spkx = heights_.front() - top;
  core.Svkx = bottom - heights_.back();
  return core;
}

VolumesOfCurve MaterialRatioCurve::volumes() const {
  VolumesOfCurve volumes;
  const double material = material_volume(0.8), voids = void_volume(0.8);
  volumes.Vmp = material_volume(0.1);
  volumes.Vmc = material - volumes.Vmp;
  volumes.Vvv = voids;
  volumes.Vvc = void_volume(0.1) - voids;
  return volumes;
}

}  // namespace asperity
