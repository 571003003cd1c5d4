// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/recording/recording_marks.hpp"

namespace asperity {

namespace {

// A ramp between two known levels, hidden by noise: least squares over a refined grid of centres and lengths.
struct RampInNoise {
  double begin = 0, end = 0;  // s
  double misfit = 0;
};

double misfit(std::span<const double> time, std::span<const double> value, double from, double to,
              double centre, double half) {
  double sum = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double share = half > 0 ? std::clamp(0.5 + 0.5 * (time[k] - centre) / half, 0.0, 1.0)
                                  : (time[k] < centre ? 0.0 : 1.0);
    const double off = value[k] - from - share * (to - from);
    sum += off * off;
  }
  return sum;
}

RampInNoise fit_hidden_ramp(std::span<const double> time, std::span<const double> value, double from,
                            double to) {
  const double first = time.front(), last = time.back(), whole = last - first;
  double best_centre = 0.5 * (first + last), best_half = 0;
  double least = misfit(time, value, from, to, best_centre, best_half);
  const auto look = [&](double centre, double half) {
    half = std::min({half, centre - first, last - centre});
    if (half < 0) return;
    const double now = misfit(time, value, from, to, centre, half);
    if (now < least) {
      least = now;
      best_centre = centre;
      best_half = half;
    }
  };
  constexpr int centres = 32, lengths = 10;
  for (int c = 1; c < centres; ++c)
    for (int l = 0; l <= lengths; ++l) look(first + whole * c / centres, 0.5 * whole * l / lengths);
  double step = whole / centres;
  for (int round = 0; round < 6; ++round, step *= 0.5) {
    const double centre = best_centre, half = best_half;
    for (int c = -1; c <= 1; ++c)
      for (int l = -1; l <= 1; ++l) look(centre + c * step, std::max(0.0, half + l * step));
  }
  return {best_centre - best_half, best_centre + best_half, least};
}

double step_misfit(std::span<const double> value, double from, double to) {
  double now = 0;
  for (const double v : value) now += (v - to) * (v - to);
  double least = now;
  for (const double v : value) {
    now += (v - from) * (v - from) - (v - to) * (v - to);
    least = std::min(least, now);
  }
  return least;
}

}  // namespace

const StraightPiece& RecordingMarks::piece_at(std::size_t sample) const {
  return *std::partition_point(pieces_.begin(), pieces_.end(),
                               [sample](const StraightPiece& piece) { return piece.last < sample; });
}

// Begin (step -1) or end (step 1) of a level.
RecordingMarks::Corner RecordingMarks::corner(const Mark& mark, int step) const {
  const std::size_t rim = step < 0 ? mark.first : mark.last;
  if (step < 0 ? rim == 0 : rim + 1 == t_.size()) return {t_[rim], 0, 0, rim};
  const auto beside = [step](std::size_t k) { return step < 0 ? k - 1 : k + 1; };
  // A drifting hold has two end levels.
  const bool slopes = std::abs(mark.line.slope()) * std::sqrt(mark.line.tt) > 4 * piece_noise();
  const double level = mark.line.y + (slopes ? mark.line.slope() * (t_[rim] - mark.line.t) : 0);
  const StraightPiece& piece = piece_at(beside(rim));
  const LineMoments& line = piece.line;
  constexpr double enough = 4;
  const double slope = line.slope();
  if (line.n >= enough && std::abs(slope) * std::sqrt(line.tt) > enough * piece_noise() &&
      change_of(piece) > drift_) {
    const double meets = line.t + (level - line.y) / slope;
    const double error =
        independent_noise() *
        std::sqrt(1 / line.n + (meets - line.t) * (meets - line.t) / line.tt + 1 / mark.line.n) /
        std::abs(slope);
    const double low = step < 0 ? t_[piece.first] : t_[mark.first];
    const double high = step < 0 ? t_[mark.last] : t_[piece.last];
    return {std::clamp(meets, low, high), error, error, rim};
  }
  const double band = std::max(4 * effective_noise_, 0.005 * std::abs(level));
  std::size_t k = rim;
  const auto has_more = [&] { return step < 0 ? k > 0 : k + 1 < t_.size(); };
  while (has_more() && std::abs(y_[beside(k)] - level) <= band) k = beside(k);
  const double gap = has_more() ? std::abs(t_[beside(k)] - t_[k]) : 0;
  // A long gap adds no doubt beyond the recorded loads.
  return {t_[k], gap / std::sqrt(12.0), std::min(gap, interval_) / std::sqrt(12.0), k};
}

// Samples that may hide a change between neighbouring holds: a ramp of m samples fitted as a step costs m/12
// of the squared change.
std::pair<std::size_t, std::size_t> RecordingMarks::window(const Mark& a, const Mark& b) const {
  const double change = std::abs(a.line.y - b.line.y) / piece_noise();
  const double hidden = change > 0 ? 12 * evidence_ / (change * change) : 1e9;
  const double between = static_cast<double>(b.first - a.last);
  const auto half_window =
      static_cast<std::size_t>(std::clamp(std::max(1.5 * hidden, 1.5 * between), 8.0, 400.0));
  const std::size_t middle = (a.last + b.first) / 2;
  const std::size_t first =
      std::max(a.first + (a.last - a.first) / 4, middle > half_window ? middle - half_window : 0);
  const std::size_t last = std::min(b.last - (b.last - b.first) / 4, middle + half_window);
  return {first, last};
}

// A slow ramp may look like stairs: drop a hold if a ramp fits as well.
void RecordingMarks::drop_stairs() {
  constexpr std::size_t next_to = 4;
  for (std::size_t k = 1; k + 1 < marks_.size();) {
    const Mark &a = marks_[k - 1], &b = marks_[k], &c = marks_[k + 1];
    const bool holds = a.kind == Mark::Kind::hold && b.kind == Mark::Kind::hold && c.kind == Mark::Kind::hold;
    const bool monotone = (b.line.y - a.line.y) * (c.line.y - b.line.y) > 0;
    const std::size_t count = b.last - b.first + 1;
    constexpr std::size_t most = 400;
    if (!holds || !monotone || count > most || b.first - a.last > next_to || c.first - b.last > next_to) {
      ++k;
      continue;
    }
    const std::size_t first = std::max(a.first, b.first > count ? b.first - count : 0);
    const std::size_t last = std::min(c.last, b.last + count);
    const std::size_t middle = (b.first + b.last) / 2;
    const std::span<const double> y(y_), t(t_);
    const double stairs = step_misfit(y.subspan(first, middle - first + 1), a.line.y, b.line.y) +
                          step_misfit(y.subspan(middle + 1, last - middle), b.line.y, c.line.y);
    const RampInNoise ramp = fit_hidden_ramp(t.subspan(first, last - first + 1),
                                             y.subspan(first, last - first + 1), a.line.y, c.line.y);
    if (ramp.misfit > stairs + evidence_ * piece_noise() * piece_noise()) {
      ++k;
      continue;
    }
    marks_.erase(marks_.begin() + static_cast<std::ptrdiff_t>(k));
    k = std::max<std::size_t>(k, 2) - 1;
  }
}

void RecordingMarks::time_marks() {
  drop_stairs();
  for (bool all = false; !all;) {
    time_each();
    all = !drop_doubtful();
  }
}

// A short hold within the uncertainty of its ends is a bend.
bool RecordingMarks::drop_doubtful() {
  const std::size_t before = marks_.size();
  for (std::size_t k = 0; k < marks_.size(); ++k) {
    Mark& mark = marks_[k];
    const auto loaded = [this](std::size_t i) { return i < marks_.size() && marks_[i].loaded(); };
    const double doubt = elementary::hypot(mark.begin_doubt, mark.end_doubt);
    if (mark.kind != Mark::Kind::hold || mark.end - mark.begin > 3 * doubt) continue;
    if (!loaded(k - 1) && !loaded(k + 1)) continue;
    const double top = *std::max_element(y_.begin() + static_cast<std::ptrdiff_t>(mark.first),
                                         y_.begin() + static_cast<std::ptrdiff_t>(mark.last) + 1);
    const double beside =
        std::max(loaded(k - 1) ? marks_[k - 1].line.y : 0.0, loaded(k + 1) ? marks_[k + 1].line.y : 0.0);
    if (top - beside > std::max(certain * effective_noise_, options_.least_overshoot * beside)) {
      mark.kind = Mark::Kind::peak;  // a remaining overshoot
      mark.line = {1, mark.line.t, top, 0, 0, 0};
      mark.begin_error = mark.end_error = interval_ / std::sqrt(12.0);
      continue;
    }
    doubtful_.push_back(mark);
    marks_.erase(marks_.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return marks_.size() < before;
}

void RecordingMarks::time_each() {
  for (Mark& mark : marks_) {
    if (mark.kind == Mark::Kind::peak) continue;
    const Corner begin = corner(mark, -1), end = corner(mark, 1);
    mark.begin = begin.time;
    mark.end = end.time;
    mark.begin_error = begin.error;
    mark.end_error = end.error;
    mark.begin_doubt = begin.doubt;
    mark.end_doubt = end.doubt;
  }
  constexpr double plain = 30;  // times the noise
  for (std::size_t k = 0; k + 1 < marks_.size(); ++k) {
    Mark &a = marks_[k], &b = marks_[k + 1];
    const double change = std::abs(a.line.y - b.line.y) / piece_noise();
    if (a.kind == Mark::Kind::peak || b.kind == Mark::Kind::peak || a.kind == Mark::Kind::rest) {
      if (a.kind != Mark::Kind::rest || b.kind != Mark::Kind::hold) continue;
    }
    constexpr std::size_t most = 600;
    if (change > plain || b.first - a.last > most) continue;
    const auto [first, last] = window(a, b);
    if (last < first + 4) continue;
    const std::span<const double> y(y_), t(t_);
    const RampInNoise ramp = fit_hidden_ramp(t.subspan(first, last - first + 1),
                                             y.subspan(first, last - first + 1), a.line.y, b.line.y);
    a.end = ramp.begin;
    b.begin = ramp.end;
    const double samples = (ramp.end - ramp.begin) / interval_;
    a.end_error = b.begin_error = a.end_doubt = b.begin_doubt =
        interval_ * std::max(0.3, 3.5 * std::sqrt(samples + 2) / change);
  }
  double last = t_.front();
  for (Mark& mark : marks_) {
    if (mark.kind != Mark::Kind::peak) mark.dwell_error = elementary::hypot(mark.begin_error, mark.end_error);
    // In order, even if noise moves corners.
    mark.begin = std::max(mark.begin, last);
    mark.end = std::max(mark.end, mark.begin);
    last = mark.end;
  }
}

}  // namespace asperity
