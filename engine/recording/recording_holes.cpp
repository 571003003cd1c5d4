// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/recording_marks.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

class Steps {
 public:
  explicit Steps(std::span<const double> time) : time_(time) {
    Array<double> steps;
    steps.reserve(time.size());
    for (std::size_t k = 0; k + 1 < time.size(); ++k) steps.push_back(step(k));
    median_ = least_but(steps, steps.size() / 2);
    constexpr std::size_t one_in = 20;
    long_ = least_but(steps, (steps.size() - 1) - std::max<std::size_t>(1, steps.size() / one_in));
  }

  double median() const { return median_; }
  double long_step() const { return std::max(median_, long_); }

  std::size_t absent_after(std::size_t row) const {
    constexpr double least = 2.5, most = 1e9;
    if (!(step(row) >= least * long_step())) return 0;
    const double before = row >= beside ? median_of_three(row - beside) : 0;
    const double after = row + beside + 1 < time_.size() ? median_of_three(row + 1) : 0;
    const double usual = std::max({long_step(), before, after});
    if (!(step(row) >= least * usual)) return 0;
    return static_cast<std::size_t>(std::min(most, std::round(step(row) / usual) - 1));
  }

 private:
  static constexpr std::size_t beside = 3;

  double step(std::size_t row) const { return time_[row + 1] - time_[row]; }
  double median_of_three(std::size_t row) const {
    const double a = step(row), b = step(row + 1), c = step(row + 2);
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
  static double least_but(Array<double>& steps, std::size_t shorter) {
    const auto at = steps.begin() + static_cast<std::ptrdiff_t>(shorter);
    std::nth_element(steps.begin(), at, steps.end());
    return *at;
  }

  std::span<const double> time_;
  double median_ = 0, long_ = 0;
};

}  // namespace

RecordedHoles recorded_holes(const PressRecording& recording, std::span<const std::uint32_t> row) {
  const Steps steps(recording.time);
  RecordedHoles found{{}, steps.median(), steps.long_step()};
  for (std::size_t k = 0; k + 1 < row.size(); ++k) {
    RecordedHole hole{k, row[k + 1] - row[k] - 1, 0};
    for (std::size_t r = row[k]; r < row[k + 1]; ++r) hole.absent += steps.absent_after(r);
    if (hole.missing() > 0) found.holes.push_back(hole);
  }
  return found;
}

}  // namespace asperity
