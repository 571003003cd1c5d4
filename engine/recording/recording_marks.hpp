// SPDX-License-Identifier: GPL-3.0-or-later
// Rests, holds and peaks of a recording in order of time, from straight pieces and stray readings. O(n
// log n) in the samples.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/recording/press_recording.hpp"

namespace asperity {

// A recording cut into few straight pieces: the pair with the least increase of squared misfit is joined
// until a join costs more than `evidence` noise variances (bottom-up piecewise linear approximation; Keogh et
// al. 2001); then each cut moves to the best fit. Deterministic; O(n log n); not a global optimum.

struct LineMoments {
  double n = 0, t = 0, y = 0;     // count, means
  double tt = 0, ty = 0, yy = 0;  // about the means

  void add(double time, double value);
  LineMoments joined(const LineMoments& next) const;
  double slope() const { return tt > 0 ? ty / tt : 0; }
  // Squared misfit of the best line; never negative.
  double misfit() const;
};

struct StraightPiece {
  std::size_t first = 0, last = 0;  // samples, inclusive
  LineMoments line;
};

// `time` increases strictly; `value` is finite; `noise` > 0. In order, without gaps.
Array<StraightPiece> straight_pieces(std::span<const double> time, std::span<const double> value,
                                     double noise, double evidence, Monitor& monitor);

// Stray readings: up to three in a row off the lines through their neighbours. A running median over nine
// readings finds suspects (Hampel's filter); a suspect is stray if it is also off the lines before, after and
// across it: corners, steps and overshoots stay. Two or three readings may be a press, or a rest between
// different loads, if the load changes as fast elsewhere; a single reading is never a press. Lower readings
// in a hold are no release.

// Standard deviation from second differences; the greater value of above and below `middle`.
double noise_of_bends(std::span<const double> time, std::span<const double> load, double middle);

// Moves stray readings to the line across them; returns their ascending numbers. `time` increases strictly.
// O(n).
Array<std::uint32_t> mend_stray_readings(std::span<const double> time, std::span<double> load,
                                         std::optional<double> noise);

struct DetectionOptions {
  enum class Overshoot { press, ignore };
  std::optional<double> noise{};          // N or Pa, standard deviation
  std::optional<double> zero{};           // N or Pa, reading without load
  double zero_drift = 0.01;               // share of the highest load
  double same_load = 0.02;                // share of the load
  std::optional<double> shortest_hold{};  // s; else four usual steps of time
  std::optional<double> evidence{};       // noise variances saved by a cut; else 10 + 4 ln samples
  Overshoot overshoot = Overshoot::press;
  double least_overshoot = 0.01;                     // share of adjacent load; and six noises
  double least_turn = 0.5 * std::numbers::pi / 180;  // rad
  std::optional<double> turn_step{};                 // rad; unit of turns
};

// Without digits below the error.
double rounded(double value, double error);

class RecordingMarks {
 public:
  // In standard deviations: a million Gaussian samples stay below 4.9.
  static constexpr double certain = 6;

  struct Mark {
    enum class Kind { rest, hold, peak };
    Kind kind = Kind::rest;
    std::size_t first = 0, last = 0;  // samples
    LineMoments line{};               // level above zero
    double begin = 0, end = 0, dwell_error = 0;
    double begin_error = 0, end_error = 0;
    double begin_doubt = 0, end_doubt = 0;  // s, possible shortening
    bool pulse = false;                     // a peak between rests

    bool loaded() const { return kind != Kind::rest; }
  };

  // Throws as detect_events does.
  RecordingMarks(const PressRecording& recording, const DetectionOptions& options, Monitor& monitor);

  const std::vector<Mark>& marks() const { return marks_; }
  // Too short for the noise.
  const std::vector<Mark>& doubtful() const { return doubtful_; }
  // Mended samples, in order.
  std::span<const std::uint32_t> stray() const { return stray_; }
  // Readings without load in order; one if given or not found.
  struct Zero {
    double time, level;
  };
  const std::vector<Zero>& zeros() const { return zeros_; }

  // Samples with a load: time, load above zero, row.
  std::span<const double> time() const { return t_; }
  std::span<const double> load() const { return y_; }
  std::span<const std::uint32_t> row() const { return row_; }
  std::size_t line(std::size_t sample) const { return recording_.line[row_[sample]]; }

  // Standard deviations: of a reading, and per reading in means.
  double noise() const { return noise_; }
  double independent_noise() const { return noise_ / std::sqrt(independent_); }
  double effective_noise() const { return effective_noise_; }
  double interval() const { return interval_; }
  double shortest_hold() const { return shortest_hold_; }
  double evidence() const { return evidence_; }
  double drift() const { return drift_; }

  std::string quantity(double value) const;
  static std::string share(double value);
  [[noreturn]] void refuse(const std::string& finding, const std::string& hint = {}) const;

 private:
  double zero_at(double time) const;
  struct Corner {
    double time, error, doubt;  // doubt: of the error, inside the level
    std::size_t sample;
  };
  void take_samples();
  void refuse_negative_compression() const;
  void measure_noise();
  void follow_correlation();
  double piece_noise() const { return effective_noise_ / std::sqrt(independent_); }
  void find_zero();
  std::vector<bool> find_rests();
  void find_levels();
  void join_levels();
  void trim(Mark& mark) const;
  void look_between();
  void look_for_peak(std::vector<Mark>& all, std::size_t first, std::size_t end, const Mark* next);
  std::pair<std::size_t, std::size_t> window(const Mark& a, const Mark& b) const;
  void drop_stairs();
  void time_marks();
  void time_each();
  bool drop_doubtful();
  double change_of(const StraightPiece& piece) const;
  bool is_level(const StraightPiece& piece, double tolerance) const;
  bool one_level(const Mark& a, const Mark& b);
  const StraightPiece& piece_at(std::size_t sample) const;
  Corner corner(const Mark& mark, int step) const;

  const PressRecording& recording_;
  const DetectionOptions& options_;
  Monitor& monitor_;
  Array<double> t_, y_;
  Array<std::uint32_t> row_;
  double interval_ = 0, shortest_hold_ = 0, evidence_ = 0, noise_ = 0, effective_noise_ = 0;
  double independent_ = 1;  // independent share
  double top_ = 0, bottom_ = 0, range_ = 0;
  double drift_ = 0;                  // greatest, of successive rests
  std::optional<double> first_zero_;  // none: without rest, or given
  std::vector<Zero> zeros_;
  Array<StraightPiece> pieces_;
  std::vector<Mark> levels_, marks_, doubtful_;
  Array<std::uint32_t> stray_;
};

// Turns between loads. O(rows).
struct RecordedTurn {
  double time;   // s
  double angle;  // rad
  std::size_t line;
};

// In order of time. `highest`: N or Pa. Throws as detect_events does.
std::vector<RecordedTurn> recorded_turns(const PressRecording& recording, const DetectionOptions& options,
                                         const RecordingMarks& marks, double highest);

}  // namespace asperity
