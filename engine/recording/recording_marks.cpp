// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/recording_marks.hpp"

#include <algorithm>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

namespace {

constexpr double per_deviation = 0.6745;  // of a Gaussian

double median_of(Array<double>& values) { return values.empty() ? 0 : upper_median(values); }

// Correlated noise: a first-order autoregression with coefficient r. The mean of n readings is as accurate as
// of n (1 - r)/(1 + r) independent ones (Bartlett 1935). Second differences over L readings have the variance
// s² (1.5 - 2 r^L + 0.5 r^2L); medians of their magnitudes at L = 1 and a greater L give r and s. Residuals
// of the pieces exclude ramps and clock jitter.
struct NoiseCorrelation {
  double deviation = 0;    // of a reading
  double independent = 1;  // share of independent readings
};

constexpr double greatest_correlation = 0.98, least_correlation = 0.4;

// For noise of variance 1.
double bend_variance(double r, int stride) {
  const double far = elementary::pow(r, stride);
  return 1.5 - 2 * far + 0.5 * far * far;
}

struct Bends {
  std::size_t count = 0;
  double square = 0;  // of the deviation, from the median
};

// Without the ends of pieces: corners.
Bends bends_of(std::span<const double> time, std::span<const double> value,
               std::span<const StraightPiece> pieces, int stride) {
  Array<double> magnitudes;
  // At its limit a sensor has no noise.
  const double top = *std::ranges::max_element(value);
  const auto lag = static_cast<std::size_t>(stride);
  constexpr std::size_t rim = 1;
  for (const StraightPiece& piece : pieces) {
    const double slope = piece.line.slope();
    const auto left = [&](std::size_t k) {
      return value[k] - piece.line.y - slope * (time[k] - piece.line.t);
    };
    for (std::size_t k = piece.first + rim + lag; k + lag + rim <= piece.last; ++k)
      if (value[k] != top || value[k - lag] != top || value[k + lag] != top)
        magnitudes.push_back(std::abs(left(k) - 0.5 * (left(k - lag) + left(k + lag))));
  }
  if (magnitudes.empty()) return {};
  const double deviation = median_of(magnitudes) / per_deviation;
  return {magnitudes.size(), deviation * deviation};
}

// None for white noise (r below 0.4) or too few readings. O(n).
std::optional<NoiseCorrelation> noise_correlation(std::span<const double> time, std::span<const double> value,
                                                  std::span<const StraightPiece> pieces) {
  constexpr std::size_t enough = 400;
  const Bends near = bends_of(time, value, pieces, 1);
  if (near.count < enough || !(near.square > 0)) return {};
  for (const int stride : {16, 8, 4}) {
    const Bends far = bends_of(time, value, pieces, stride);
    if (far.count < enough) continue;
    // Increases with r, from 1 on.
    const double ratio = far.square / near.square;
    const auto ratio_of = [stride](double r) { return bend_variance(r, stride) / bend_variance(r, 1); };
    double low = 0, high = greatest_correlation;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (ratio_of(middle) < ratio ? low : high) = middle;
    }
    if (low < least_correlation) return {};
    return NoiseCorrelation{std::sqrt(near.square / bend_variance(low, 1)), (1 - low) / (1 + low)};
  }
  return {};
}

// Medians of three, against single outliers.
double highest_of_three(std::span<const double> y, double sign) {
  double highest = -INFINITY;
  for (std::size_t k = 0; k + 2 < y.size(); ++k) {
    const double a = sign * y[k], b = sign * y[k + 1], c = sign * y[k + 2];
    highest = std::max(highest, std::max(std::min(a, b), std::min(std::max(a, b), c)));
  }
  return sign * highest;
}

}  // namespace

RecordingMarks::RecordingMarks(const PressRecording& recording, const DetectionOptions& options,
                               Monitor& monitor)
    : recording_(recording), options_(options), monitor_(monitor) {
  take_samples();
  refuse_negative_compression();
  measure_noise();
  pieces_ = straight_pieces(t_, y_, effective_noise_, evidence_, monitor_);
  follow_correlation();
  find_zero();
  find_levels();
  join_levels();
  look_between();
  time_marks();
  std::ranges::sort(stray_);
}

void RecordingMarks::refuse(const std::string& finding, const std::string& hint) const {
  refuse_bad_file("\"" + recording_.name + "\" " + finding, hint);
}

void RecordingMarks::take_samples() {
  for (std::size_t k = 0; k < recording_.time.size(); ++k) {
    if (std::isnan(recording_.load[k])) continue;
    t_.push_back(recording_.time[k]);
    y_.push_back(recording_.load[k]);
    row_.push_back(static_cast<std::uint32_t>(k));
  }
  constexpr std::size_t fewest = 10;
  if (t_.size() < fewest)
    refuse("holds " + std::to_string(t_.size()) + " samples of the load, too few to find events in",
           "read it with events=\"rows\" if each of its rows is an event");
  // Squares of times and loads must not overflow.
  constexpr double least = 1e-100, most = 1e100;
  const auto [low, high] = std::ranges::minmax_element(y_);
  const double span = t_.back() - t_.front(), greatest = std::max(std::abs(*low), std::abs(*high));
  if (!(span >= least && span <= most && std::abs(t_.back()) <= most && std::abs(t_.front()) <= most) ||
      !(greatest <= most && (greatest == 0 || greatest >= least)))
    refuse("holds extreme times or loads: " + format_short(span) + " s in all, up to " + quantity(greatest),
           "check the units of its columns");
  Array<double> steps;
  for (std::size_t k = 0; k + 1 < t_.size(); ++k) steps.push_back(t_[k + 1] - t_[k]);
  interval_ = median_of(steps);
  stray_ = mend_stray_readings(t_, y_, options_.noise);
  shortest_hold_ = options_.shortest_hold.value_or(4 * interval_);
  evidence_ = options_.evidence.value_or(10 + 4 * elementary::log(static_cast<double>(t_.size())));
  top_ = highest_of_three(y_, 1);
  bottom_ = highest_of_three(y_, -1);
  range_ = top_ - bottom_;
}

void RecordingMarks::refuse_negative_compression() const {
  constexpr std::size_t some = 5;
  Array<double> begin(y_.begin(), y_.begin() + std::min<std::ptrdiff_t>(some, std::ssize(y_)));
  const double first = median_of(begin);
  if (!(-bottom_ > 2 * std::max(top_, 0.0)) || !(first - bottom_ > top_ - first)) return;
  refuse("goes down from " + quantity(first) + " to " + quantity(bottom_) + ", and up to " + quantity(top_) +
             " only: it counts compression as negative",
         "change the sign of its column of loads");
}

void RecordingMarks::measure_noise() {
  double resolution = INFINITY;  // of raw readings; mended ones have more digits
  for (std::size_t k = 1; k + 1 < t_.size(); ++k)
    if (const double step = std::abs(recording_.load[row_[k]] - recording_.load[row_[k - 1]]); step > 0)
      resolution = std::min(resolution, step);
  noise_ = options_.noise.value_or(noise_of_bends(t_, y_, bottom_ + 0.5 * range_));
  // Rounding of readings and curvature of ramps count as noise.
  constexpr double of_a_step = 0.3, of_the_range = 1e-4;
  effective_noise_ =
      std::max({noise_, std::isinf(resolution) ? 0 : of_a_step * std::min(resolution, 0.02 * range_),
                of_the_range * range_});
  if (!(range_ > 8 * noise_) || !(top_ > 0))
    refuse("holds no load above its noise: the readings go from " + quantity(bottom_) + " to " +
               quantity(top_) + ", and scatter by " + quantity(noise_),
           "give the noise as `noise` if it is less");
}

// Correlated readings scatter more than second differences show; pieces are cut again.
void RecordingMarks::follow_correlation() {
  if (options_.noise || effective_noise_ > noise_) return;
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    const std::optional<NoiseCorrelation> found = noise_correlation(t_, y_, pieces_);
    if (!found || !(range_ > 8 * found->deviation)) return;
    effective_noise_ = noise_ = found->deviation;
    independent_ = found->independent;
    pieces_ = straight_pieces(t_, y_, piece_noise(), evidence_, monitor_);
  }
}

double RecordingMarks::change_of(const StraightPiece& piece) const {
  return std::abs(piece.line.slope()) * (t_[piece.last] - t_[piece.first]);
}

bool RecordingMarks::is_level(const StraightPiece& piece, double tolerance) const {
  constexpr double fewest = 3;
  const double by_chance = piece_noise() * std::sqrt(12 * evidence_ / piece.line.n);
  return piece.line.n >= fewest && change_of(piece) <= std::max(tolerance, by_chance);
}

void RecordingMarks::find_zero() {
  const double scale = std::max(std::abs(top_), std::abs(bottom_));
  drift_ = options_.zero_drift * scale;
  if (options_.zero) {
    zeros_.push_back({t_.front(), *options_.zero});
    drift_ = options_.zero_drift * std::abs(top_ - *options_.zero);
    return;
  }
  std::vector<double> levels;
  for (const StraightPiece& piece : pieces_)
    if (is_level(piece, drift_)) levels.push_back(piece.line.y);
  const double least = levels.empty() ? bottom_ : std::ranges::min(levels);
  // Recordings usually begin before the press: a lowest first level is zero.
  constexpr double near_zero = 0.05, doubtful = 0.25;
  const auto is_low = [&](double level) { return level <= least + near_zero * scale; };
  const bool begins_low = !levels.empty() && is_low(levels.front());
  const std::string give = "give the reading without load as `zero` if this is wrong";
  if (least <= near_zero * scale || (begins_low && levels.front() <= doubtful * scale)) {
    const auto first = std::ranges::find_if(levels, is_low);
    first_zero_ = first == levels.end() ? least : *first;
    if (std::abs(*first_zero_) > near_zero * scale)
      monitor_.warn("\"" + recording_.name + "\": the reading " + quantity(*first_zero_) + ", " +
                    share(*first_zero_ / scale) + " of the highest, is read as the zero of the sensor; " +
                    give);
  } else if (least <= doubtful * scale) {
    monitor_.warn("\"" + recording_.name + "\": the lowest load held, " + quantity(least) + " or " +
                  share(least / scale) +
                  " of the highest, is read as a load, not as the zero of the sensor; " + give);
  }
  if (!first_zero_) zeros_.push_back({t_.front(), 0});
}

std::vector<bool> RecordingMarks::find_rests() {
  constexpr double near_zero = 0.05;
  double zero = first_zero_.value_or(zeros_.empty() ? 0 : zeros_.front().level);
  double zero_doubt = 0;  // 1/n of the previous rest; negligible for white noise
  std::vector<bool> is_rest;
  std::vector<Mark> rests;
  for (const StraightPiece& piece : pieces_) {
    const double load = piece.line.y - zero, error = piece_noise() * std::sqrt(1 / piece.line.n + zero_doubt);
    const bool after_rest = !is_rest.empty() && is_rest.back();
    is_rest.push_back(load <= std::max(drift_, 4 * error) && is_level(piece, drift_));
    if (!is_rest.back() || std::abs(load) > near_zero * range_ || !first_zero_) continue;
    zero = piece.line.y;
    if (independent_ < 1) zero_doubt = 1 / piece.line.n;
    if (after_rest && !rests.empty())
      rests.back().last = piece.last;
    else
      rests.push_back({Mark::Kind::rest, piece.first, piece.last});
  }
  if (first_zero_) {
    for (Mark& rest : rests) {
      trim(rest);
      zeros_.push_back({rest.line.t, rest.line.y});
    }
    if (zeros_.empty()) zeros_.push_back({t_.front(), *first_zero_});
  }
  for (std::size_t k = 0; k < t_.size(); ++k) y_[k] -= zero_at(t_[k]);
  for (StraightPiece& piece : pieces_) {
    piece.line = {};
    for (std::size_t k = piece.first; k <= piece.last; ++k) piece.line.add(t_[k], y_[k]);
  }
  return is_rest;
}

void RecordingMarks::find_levels() {
  const std::vector<bool> is_rest = find_rests();
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const StraightPiece& piece = pieces_[k];
    const double load = piece.line.y;
    if (is_rest[k] || (load > 0 && is_level(piece, options_.same_load * load)))
      levels_.push_back(
          {is_rest[k] ? Mark::Kind::rest : Mark::Kind::hold, piece.first, piece.last, piece.line});
  }
}

bool RecordingMarks::one_level(const Mark& a, const Mark& b) {
  if (a.kind != b.kind) return false;
  const double level = a.line.y, error = piece_noise() * std::sqrt(1 / a.line.n + 1 / b.line.n);
  const double tolerance =
      std::max(4 * error, a.kind == Mark::Kind::rest ? drift_ : options_.same_load * std::abs(level));
  if (std::abs(b.line.y - level) > tolerance) return false;
  const double band = std::max(tolerance, certain * effective_noise_);
  constexpr std::size_t glitch = 3;
  constexpr double of_the_range = 0.05;  // larger ones are examined already
  Array<std::uint32_t> out;
  for (std::size_t k = a.last + 1; k < b.first; ++k)
    if (const double off = std::abs(y_[k] - level); off > band) {
      if (out.size() == glitch || off > std::max(3 * band, of_the_range * range_)) return false;
      out.push_back(static_cast<std::uint32_t>(k));
    }
  if (out.empty()) return true;
  if (b.first - a.last - 1 > glitch + 2) return false;
  stray_.insert(stray_.end(), out.begin(), out.end());
  return true;
}

void RecordingMarks::join_levels() {
  for (const Mark& level : levels_) {
    if (!marks_.empty() && one_level(marks_.back(), level)) {
      marks_.back().last = level.last;
      marks_.back().line = marks_.back().line.joined(level.line);
    } else {
      marks_.push_back(level);
    }
  }
  std::erase_if(marks_, [this](const Mark& mark) {
    return mark.kind == Mark::Kind::hold &&
           (t_[mark.last] - t_[mark.first] < (1 - 1e-9) * shortest_hold_ || mark.last - mark.first < 3);
  });
  for (Mark& mark : marks_) trim(mark);
}

// A corner may be at the ends.
void RecordingMarks::trim(Mark& mark) const {
  const std::size_t count = mark.last - mark.first + 1, off = std::min<std::size_t>(2, count / 8);
  const double level = mark.line.y, band = certain * effective_noise_ + options_.same_load * range_;
  const bool known = mark.line.n > 0;
  LineMoments line;
  for (std::size_t k = mark.first + off; k + off <= mark.last; ++k)
    if (!known || std::abs(y_[k] - level) <= band) line.add(t_[k], y_[k]);
  if (line.n > 0) mark.line = line;
}

double RecordingMarks::zero_at(double time) const {
  const auto after = std::ranges::lower_bound(zeros_, time, {}, &Zero::time);
  if (after == zeros_.begin()) return zeros_.front().level;
  if (after == zeros_.end()) return zeros_.back().level;
  const Zero& before = *(after - 1);
  const double w = (time - before.time) / (after->time - before.time);
  return before.level + w * (after->level - before.level);
}

void RecordingMarks::look_between() {
  std::vector<Mark> all;
  const std::vector<Mark> levels = std::move(marks_);
  const std::size_t n = t_.size();
  const double unloaded = std::max(drift_, 4 * effective_noise_);
  for (std::size_t k = 0; k <= levels.size(); ++k) {
    const std::size_t first = k == 0 ? 0 : levels[k - 1].last + 1;
    const std::size_t end = k == levels.size() ? n : levels[k].first;
    // Short rests without a level.
    std::size_t begun = first;
    constexpr std::size_t shortest = 3;
    for (std::size_t i = first; i < end;) {
      std::size_t j = i;
      while (j < end && y_[j] < unloaded) ++j;
      const bool after_rest = !all.empty() && all.back().kind == Mark::Kind::rest && i == all.back().last + 1;
      const bool before_rest = j == end && k < levels.size() && levels[k].kind == Mark::Kind::rest;
      const bool at_rim = (i == 0 || j == n) && j > i;
      if (after_rest && j > i) {
        all.back().last = j - 1;
        begun = j;
      } else if (!before_rest && (j - i >= shortest || at_rim)) {
        look_for_peak(all, begun, i, nullptr);
        Mark rest{Mark::Kind::rest, i, j - 1, {}};
        for (std::size_t s = i; s < j; ++s) rest.line.add(t_[s], y_[s]);
        all.push_back(rest);
        begun = j;
      }
      i = std::max(j, i + 1);
    }
    look_for_peak(all, begun, end, k < levels.size() ? &levels[k] : nullptr);
    if (k < levels.size()) {
      if (!all.empty() && all.back().kind == Mark::Kind::rest && levels[k].kind == Mark::Kind::rest) {
        all.back().last = levels[k].last;
        all.back().line = all.back().line.joined(levels[k].line);
      } else {
        all.push_back(levels[k]);
      }
    }
  }
  marks_ = std::move(all);
}

void RecordingMarks::look_for_peak(std::vector<Mark>& all, std::size_t first, std::size_t end,
                                   const Mark* next) {
  if (first >= end) return;
  const auto top = std::max_element(y_.begin() + static_cast<std::ptrdiff_t>(first),
                                    y_.begin() + static_cast<std::ptrdiff_t>(end));
  const auto at = static_cast<std::size_t>(top - y_.begin());
  const Mark* before = all.empty() ? nullptr : &all.back();
  const auto level = [&](const Mark* mark) {
    return mark != nullptr && mark->kind != Mark::Kind::rest ? mark->line.y : 0.0;
  };
  const double base = std::max(level(before), level(next));
  const bool pulse = base <= 0;
  const double least =
      std::max(certain * effective_noise_, pulse ? 2 * drift_ : options_.least_overshoot * base);
  if (!(*top - base > least)) return;
  const double half = 0.5 * (*top + base);
  std::size_t left = at, right = at;
  const auto low = [&](std::size_t k) { return y_[k] < half; };
  while (left > first && !(low(left - 1) && (left < first + 2 || low(left - 2)))) --left;
  while (right + 1 < end && !(low(right + 1) && (right + 2 >= end || low(right + 2)))) ++right;
  if (pulse && left == right) {
    stray_.push_back(static_cast<std::uint32_t>(at));
    return;
  }
  const auto crossing = [&](std::size_t in, std::size_t out) {
    const double w = y_[in] > y_[out] ? (y_[in] - half) / (y_[in] - y_[out]) : 0.5;
    return t_[in] + std::clamp(w, 0.0, 1.0) * (t_[out] - t_[in]);
  };
  Mark peak{Mark::Kind::peak, left, right, {1, t_[at], *top, 0, 0, 0}};
  peak.begin = left > 0 ? crossing(left, left - 1) : t_[left];
  peak.end = right + 1 < t_.size() ? crossing(right, right + 1) : t_[right];
  peak.dwell_error = interval_ / std::sqrt(6.0);
  peak.pulse = pulse;
  all.push_back(peak);
}

std::string RecordingMarks::quantity(double value) const {
  return format_quantity(value, recording_.by == PressBy::load ? dimension::force : dimension::pressure, 4);
}
std::string RecordingMarks::share(double value) { return format_short(100 * value, 2) + " %"; }

double rounded(double value, double error) {
  if (!(error > 0) || !std::isfinite(value)) return value;
  const int power = static_cast<int>(std::floor(elementary::log10(error)));
  if (power < -300 || power > 300) return value;
  return power < 0 ? std::round(value * elementary::pow(10.0, -power)) / elementary::pow(10.0, -power)
                   : std::round(value / elementary::pow(10.0, power)) * elementary::pow(10.0, power);
}

}  // namespace asperity
