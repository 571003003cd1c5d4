// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"
#include "engine/recording/recording_marks.hpp"

namespace asperity {

namespace {

std::string degrees(double value) { return format_quantity(value, dimension::angle, 4); }

class TurnFinder {
 public:
  TurnFinder(const PressRecording& recording, const DetectionOptions& options, const RecordingMarks& marks,
             double highest)
      : recording_(recording), options_(options), marks_(marks), highest_(highest) {}

  std::vector<RecordedTurn> find() {
    if (recording_.angle.empty()) return {};
    tolerance_ = std::max(options_.least_turn, 8 * angle_noise());
    const auto row = marks_.row();
    std::vector<Heading> headings;
    const std::vector<RecordingMarks::Mark>& marks = marks_.marks();
    for (std::size_t k = 0; k < marks.size();) {
      if (!marks[k].loaded()) {
        ++k;
        continue;
      }
      std::size_t end = k;
      while (end + 1 < marks.size() && marks[end + 1].loaded()) ++end;
      headings.push_back(heading(row[marks[k].first], row[marks[end].last]));
      k = end + 1;
    }
    const std::size_t rows = recording_.time.size();
    const std::size_t first = headings.empty() ? rows - 1 : headings.front().first;
    if (first > 0)
      if (auto start = heading_at_rim(0, first - 1)) headings.insert(headings.begin(), *start);
    if (const std::size_t last = headings.empty() ? 0 : headings.back().last; last + 1 < rows)
      if (auto end = heading_at_rim(rows - 1, last + 1)) headings.push_back(*end);
    const Heading* before = nullptr;
    bool unknown = false;
    for (const Heading& now : headings) {
      if (!now.angle) {
        unknown = true;
        continue;
      }
      if (before != nullptr) take_turn(*before, now, unknown);
      before = &now;
      unknown = false;
    }
    return std::move(turns_);
  }

 private:
  struct Heading {
    std::size_t first, last;  // rows
    std::optional<double> angle;
  };

  double angle_noise() const {
    std::vector<double> steps;
    double last = NAN;
    for (const double angle : recording_.angle) {
      if (std::isnan(angle)) continue;
      if (!std::isnan(last)) steps.push_back(std::abs(angle - last));
      last = angle;
    }
    if (steps.empty()) return 0;
    return upper_median(steps) / (0.6745 * std::sqrt(2.0));
  }

  // The mean angle, which must be constant.
  Heading heading(std::size_t first, std::size_t last) const {
    double sum = 0, start = NAN;
    std::size_t count = 0;
    for (std::size_t k = first; k <= last; ++k) {
      const double angle = recording_.angle[k];
      if (std::isnan(angle)) continue;
      if (std::isnan(start)) start = angle;
      if (std::abs(angle - start) > tolerance_)
        marks_.refuse("turns under load: the angle leaves " + degrees(start) + " in line " +
                          std::to_string(recording_.line[k]) + ", where it is " + degrees(angle) +
                          ", while a load is on from line " + std::to_string(recording_.line[first]) +
                          " to line " + std::to_string(recording_.line[last]),
                      "turn a body after its release; a larger `least_turn` ignores small turns, a larger "
                      "`zero_drift` small loads");
      sum += angle;
      ++count;
    }
    return {first, last, count > 0 ? std::optional<double>(sum / static_cast<double>(count)) : std::nullopt};
  }
  std::optional<Heading> heading_at_rim(std::size_t from, std::size_t to) const {
    constexpr int enough = 5;
    double sum = 0;
    int count = 0;
    std::size_t last = from;
    for (std::size_t k = from; count < enough; from < to ? ++k : --k) {
      if (const double angle = recording_.angle[k]; !std::isnan(angle)) {
        if (count > 0 && std::abs(angle - sum / count) > tolerance_) break;
        sum += angle;
        ++count;
        last = k;
      }
      if (k == to) break;
    }
    if (count == 0) return {};
    return Heading{std::min(from, last), std::max(from, last), sum / count};
  }

  void take_turn(const Heading& before, const Heading& now, bool unknown) {
    double angle = *now.angle - *before.angle;
    if (std::abs(angle) <= tolerance_) return;
    std::size_t k = before.last;
    while (k < now.first && !(std::abs(recording_.angle[k] - *before.angle) > 0.5 * std::abs(angle))) ++k;
    const std::string where =
        "turns by " + degrees(angle) + " about line " + std::to_string(recording_.line[k]);
    if (unknown)
      marks_.refuse(where + ", but lacks the angle while a load was on between line " +
                        std::to_string(recording_.line[before.last]) + " and line " +
                        std::to_string(recording_.line[now.first]) +
                        ": the turn may be before or after the load",
                    "fill the angle in by hand");
    const auto row = marks_.row();
    auto sample = static_cast<std::size_t>(std::ranges::lower_bound(row, k) - row.begin());
    sample = std::min(sample, row.size() - 1);
    const double load = marks_.load()[sample];
    if (load > std::max({2 * marks_.drift(), 6 * marks_.effective_noise(), 0.1 * highest_}))
      marks_.refuse(where + " under a load of " + marks_.quantity(load), "turn a body after its release");
    if (options_.turn_step) {
      const double steps = std::round(angle / *options_.turn_step);
      const double off = angle - steps * *options_.turn_step;
      if (std::abs(off) > 0.2 * *options_.turn_step)
        marks_.refuse(where + ", which is no multiple of " + degrees(*options_.turn_step),
                      "give another `turn_step`, or leave it out");
      angle = steps * *options_.turn_step;
      if (angle == 0) return;
    } else {
      constexpr double degree = std::numbers::pi / 180;
      angle = rounded(angle / degree, std::max(0.05 * tolerance_ / degree, 1e-9)) * degree;
    }
    turns_.push_back({recording_.time[k], angle, recording_.line[k]});
  }

  const PressRecording& recording_;
  const DetectionOptions& options_;
  const RecordingMarks& marks_;
  double highest_;
  double tolerance_ = 0;  // of angles
  std::vector<RecordedTurn> turns_;
};

}  // namespace

std::vector<RecordedTurn> recorded_turns(const PressRecording& recording, const DetectionOptions& options,
                                         const RecordingMarks& marks, double highest) {
  return TurnFinder(recording, options, marks, highest).find();
}

}  // namespace asperity
