// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/recording_marks.hpp"

#include <algorithm>
#include <array>

#include "engine/core/grid.hpp"

namespace asperity {

namespace {

constexpr std::size_t median_reach = 4;     // to each side
constexpr std::size_t longest_run = 3;      // stray readings in a row
constexpr std::size_t nearby_samples = 12;  // search range

class StraySearch {
 public:
  StraySearch(std::span<const double> time, std::span<double> load, std::optional<double> noise)
      : t_(time), y_(load), suspect_(load.size()) {
    Array<double> medians;
    for (std::size_t k = 0; k < y_.size(); ++k) medians.push_back(median_around(k));
    const auto [low, high] = std::ranges::minmax_element(medians);
    range_ = *high - *low;
    const double deviation = noise.value_or(noise_of_bends(t_, y_, 0.5 * (*low + *high)));
    constexpr double noises = 8, of_the_range = 0.005;
    tolerance_ = std::max(noises * deviation, of_the_range * range_);
    for (std::size_t k = 0; k < y_.size(); ++k) suspect_[k] = std::abs(y_[k] - medians[k]) > tolerance_;
  }

  // If all loads are so short, both look alike.
  bool tells() const { return range_ > tolerance_; }

  Array<std::uint32_t> mend() {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) acquit(round == rounds - 1);
    find_steepest();
    Array<std::uint32_t> mended;
    for (std::size_t first = 0, end = 0; first < y_.size(); first = std::max(end, first + 1)) {
      for (end = first; end < y_.size() && suspect_[end];) ++end;
      if (end == first || end - first > longest_run || may_be_real(first, end)) continue;
      for (std::size_t k = first; k < end; ++k) {
        y_[k] = between(k, first, end);
        mended.push_back(static_cast<std::uint32_t>(k));
      }
    }
    return mended;
  }

 private:
  double median_around(std::size_t k) const {
    std::array<double, 2 * median_reach + 1> some{};
    const std::size_t count = std::min(some.size(), y_.size());
    const std::size_t first = std::min(k - std::min(k, median_reach), y_.size() - count);
    std::copy_n(y_.begin() + static_cast<std::ptrdiff_t>(first), count, some.begin());
    const auto middle = some.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(some.begin(), middle, some.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  }

  // Through the nearest four unsuspected samples on one side, or two at a corner.
  struct Side {
    double nearest = 0, time = 0;
    LineMoments line{};
    double at(double t) const { return line.y + line.slope() * (t - line.t); }
  };
  std::optional<Side> side_of(std::size_t k, std::size_t step) const {
    std::array<std::size_t, 4> at{};
    std::size_t count = 0;
    Side side;
    for (std::size_t i = k + step, n = 0; i < y_.size() && n < nearby_samples && count < at.size();
         i += step, ++n)
      if (!suspect_[i]) {
        side.line.add(t_[i], y_[i]);
        at[count++] = i;
      }
    if (count == 0) return {};
    side.nearest = y_[at[0]];
    side.time = t_[at[0]];
    if (side.line.misfit() > 0.25 * tolerance_ * tolerance_) {
      side.line = {};
      for (const std::size_t i : {at[0], at[1]}) side.line.add(t_[i], y_[i]);
    }
    return side;
  }

  // Clears suspects between neighbours or on the line before (overshoot); in the last round also overshoots
  // as large as the step.
  void acquit(bool last) {
    std::vector<bool> still = suspect_;
    for (std::size_t k = 0; k < y_.size(); ++k) {
      if (!suspect_[k]) continue;
      const std::optional<Side> before = side_of(k, std::size_t{0} - 1), after = side_of(k, 1);
      if (!before && !after) continue;
      const Side& from = before ? *before : *after;
      const double a = from.nearest, b = after ? after->nearest : a, along = from.at(t_[k]);
      const double step = after ? std::min(std::abs(b - a), std::abs(b - from.at(after->time))) : 0;
      const double margin = tolerance_ + (last ? step : 0);
      still[k] = y_[k] > std::max({a, b, along}) + margin || y_[k] < std::min({a, b, along}) - margin;
    }
    suspect_ = std::move(still);
  }

  void find_steepest() {
    for (std::size_t k = 1; k < y_.size(); ++k)
      if (!suspect_[k] && !suspect_[k - 1]) {
        rise_ = std::max(rise_, y_[k] - y_[k - 1]);
        fall_ = std::max(fall_, y_[k - 1] - y_[k]);
      }
  }

  bool may_be_real(std::size_t first, std::size_t end) const {
    constexpr double steep = 0.3, margin = 1.5, same_load = 0.02;
    if (end - first < 2 || std::min(rise_, fall_) < steep * range_) return false;
    double up = 0, down = 0;
    for (std::size_t k = std::max<std::size_t>(first, 1); k < std::min(end + 1, y_.size()); ++k) {
      up = std::max(up, y_[k] - y_[k - 1]);
      down = std::max(down, y_[k - 1] - y_[k]);
    }
    if (up > margin * rise_ || down > margin * fall_) return false;
    if (first == 0 || end == y_.size()) return true;
    const double before = y_[first - 1], after = y_[end];
    const double other = std::max(tolerance_, same_load * std::abs(before));
    return y_[first] > std::max(before, after) || std::abs(after - before) > other;
  }

  double between(std::size_t k, std::size_t first, std::size_t end) const {
    if (first == 0) return end < y_.size() ? y_[end] : y_[k];
    if (end == y_.size()) return y_[first - 1];
    const double w = (t_[k] - t_[first - 1]) / (t_[end] - t_[first - 1]);
    return y_[first - 1] + w * (y_[end] - y_[first - 1]);
  }

  std::span<const double> t_;
  std::span<double> y_;
  std::vector<bool> suspect_;
  double range_ = 0, tolerance_ = 0;
  double rise_ = 0, fall_ = 0;  // greatest changes between readings
};

}  // namespace

double noise_of_bends(std::span<const double> time, std::span<const double> load, double middle) {
  Array<double> above, below;
  for (std::size_t k = 1; k + 1 < time.size(); ++k) {
    const double w = (time[k + 1] - time[k]) / (time[k + 1] - time[k - 1]);
    const double bend = load[k] - w * load[k - 1] - (1 - w) * load[k + 1];
    const double scaled = std::abs(bend) / std::sqrt(1 + w * w + (1 - w) * (1 - w));
    (load[k] > middle ? above : below).push_back(scaled);
  }
  constexpr std::size_t enough = 30;
  constexpr double of_a_gaussian = 0.6745;  // median magnitude
  const auto median_of = [](Array<double>& few, const Array<double>& many) {
    return few.empty() || (few.size() < enough && many.size() >= enough) ? 0.0 : upper_median(few);
  };
  return std::max(median_of(above, below), median_of(below, above)) / of_a_gaussian;
}

Array<std::uint32_t> mend_stray_readings(std::span<const double> time, std::span<double> load,
                                         std::optional<double> noise) {
  Array<std::uint32_t> all;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    StraySearch search(time, load, noise);
    if (!search.tells()) break;
    const Array<std::uint32_t> mended = search.mend();
    if (mended.empty()) break;
    all.insert(all.end(), mended.begin(), mended.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace asperity
