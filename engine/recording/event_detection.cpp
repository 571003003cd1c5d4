// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/event_detection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

namespace {

using Mark = RecordingMarks::Mark;
using Span = RecordedSpan;

std::string lines(std::size_t first, std::size_t last, const char* to = " to ") {
  return first == last ? "line " + std::to_string(first)
                       : "lines " + std::to_string(first) + to + std::to_string(last);
}

std::string seconds(double value) { return format_quantity(value, dimension::time, 4); }

// Holes in a recording: empty load cells and absent rows. O(rows). A step lacks rows if it is at least 2.5
// times each of: the median step; the step that one in twenty exceeds; the median of the three steps before;
// the median of the three steps after. So bursts and random logging lose no rows.
struct RecordedHole {
  std::size_t sample;      // before the hole
  std::size_t cells = 0;   // rows without a load
  std::size_t absent = 0;  // estimated
  std::size_t missing() const { return cells + absent; }
};

struct RecordedHoles {
  std::vector<RecordedHole> holes;        // in order
  double median_step = 0, long_step = 0;  // s; one in twenty exceeds long_step
};

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

// `row`: rows with a load, ascending; at least three.
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

class EventMaker {
 public:
  EventMaker(const PressRecording& recording, const DetectionOptions& options, Monitor& monitor)
      : recording_(recording), options_(options), monitor_(monitor), marks_(recording, options, monitor) {}

  Protocol make() {
    look_at_missing();
    describe();
    turns_ = recorded_turns(recording_, options_, marks_, found_.highest);
    make_spans();
    warn();
    std::vector<Protocol::Event> events = make_events();
    if (events.empty())
      marks_.refuse("holds no press: no load holds or peaks at more than " +
                        marks_.quantity(std::max(2 * marks_.drift(), 6 * marks_.effective_noise())) +
                        " above the reading without load",
                    "give a smaller `zero_drift` for lighter presses");
    thin();
    auto found = std::make_shared<const Detection>(std::move(found_));
    return Protocol(std::move(events)).detected_in(std::move(found));
  }

 private:
  void warn(const std::string& sentence) { monitor_.warn("\"" + recording_.name + "\": " + sentence); }
  static double load_of(const Mark& mark) { return mark.line.y; }
  std::string lines_of(const Mark& mark) const {
    return lines(marks_.line(mark.first), marks_.line(mark.last));
  }
  static std::string lines_of(const Span& span) { return lines(span.first_line, span.last_line); }

  void describe() {
    found_.name = recording_.name;
    found_.by = recording_.by;
    found_.samples = marks_.time().size();
    found_.missing = recording_.time.size() - found_.samples;
    found_.interval = marks_.interval();
    found_.noise = marks_.noise();
    found_.zero_drift = marks_.drift();
    found_.shortest_hold = marks_.shortest_hold();
    found_.evidence = marks_.evidence();
    // Evidence of a cut over the samples of the shortest hold and as many next to it.
    const double fewest = std::max(4.0, found_.shortest_hold / found_.interval);
    const double by_chance = marks_.independent_noise() * std::sqrt(2 * found_.evidence / fewest);
    found_.least_load = std::max(found_.zero_drift, by_chance);
    double lowest = INFINITY;
    for (const Mark& mark : marks_.marks()) {
      found_.rested = found_.rested || !mark.loaded();
      if (!mark.loaded()) continue;
      lowest = std::min(lowest, load_of(mark));
      found_.highest = std::max(found_.highest, load_of(mark));
    }
    found_.least_step = std::max(std::isinf(lowest) ? 0 : options_.same_load * lowest, by_chance);
    const auto [low, high] = std::ranges::minmax(marks_.zeros(), {}, &RecordingMarks::Zero::level);
    found_.zero_low = low.level;
    found_.zero_high = high.level;
  }

  std::string place(const RecordedHole& hole) const {
    const std::size_t before = marks_.row()[hole.sample], after = marks_.row()[hole.sample + 1];
    if (hole.absent == 0) return lines(recording_.line[before + 1], recording_.line[after - 1]);
    return "the time between " + lines(recording_.line[before], recording_.line[after], " and ");
  }

  static std::string listed(std::vector<std::string> places, std::string_view last) {
    constexpr std::size_t enough = 12;
    const std::size_t more = places.size() > enough ? places.size() - enough : 0;
    places.resize(places.size() - more);
    return joined(places, last) + (more > 0 ? " and in " + std::to_string(more) + " more places" : "");
  }

  // A hole may hide any event, except inside one hold or rest.
  void look_at_missing() {
    const auto time = marks_.time();
    const RecordedHoles recorded = recorded_holes(recording_, marks_.row());
    std::vector<std::string> lost, brief;
    bool rows_lost = false;
    const std::vector<Mark>& marks = marks_.marks();
    std::size_t next = 0;
    for (const RecordedHole& hole : recorded.holes) {
      const std::size_t k = hole.sample;
      found_.absent += hole.absent;
      while (next < marks.size() && marks[next].last < k + 1) ++next;
      const bool goes_on =
          next < marks.size() && marks[next].kind != Mark::Kind::peak && marks[next].first <= k;
      const Mark* within = goes_on ? &marks[next] : nullptr;
      const double span = time[k + 1] - time[k];
      constexpr std::size_t few = 2;
      if (within != nullptr) {
        if (span > 20 * marks_.interval() && span > 0.2 * (time[within->last] - time[within->first]))
          warn("no load was recorded for " + seconds(span) + " in " + place(hole) +
               ", and is assumed constant at " + marks_.quantity(within->line.y));
      } else if (hole.missing() <= few) {
        brief.push_back(place(hole));
      } else {
        lost.push_back(place(hole));
        rows_lost = rows_lost || hole.absent > 0;
      }
    }
    if (!lost.empty())
      marks_.refuse(
          "lacks the load in " + listed(lost, " and ") + " while it changes, so the events there are unknown",
          std::string("fill the ") + (rows_lost ? "rows" : "cells") +
              " in by hand, or cut the recording there");
    if (!brief.empty())
      warn("the load is missing while it changes, in " + listed(brief, ", ") +
           "; a steady change is assumed");
    constexpr double uneven = 5;
    if (recorded.long_step > uneven * recorded.median_step)
      warn("one time step in twenty is " + seconds(recorded.long_step) + " or longer, and half are " +
           seconds(recorded.median_step) + " or shorter: events within a long step are not found");
  }

  // --- spans

  void add(Span span) { found_.spans.push_back(span); }

  void make_spans() {
    const std::vector<Mark>& marks = marks_.marks();
    std::size_t turn = 0;
    for (std::size_t k = 0; k < marks.size(); ++k) {
      const Mark& mark = marks[k];
      const Mark* before = k > 0 ? &marks[k - 1] : nullptr;
      const std::size_t first = marks_.line(mark.first), last = marks_.line(mark.last);
      const bool on = mark.loaded(), was_on = before != nullptr && before->loaded();
      if (before != nullptr && (on || was_on)) {
        Span way{Span::Kind::rise, before->end, mark.begin};
        way.load = on ? load_of(mark) : 0;
        way.kind = !on                                     ? Span::Kind::release
                   : was_on && way.load < load_of(*before) ? Span::Kind::fall
                                                           : Span::Kind::rise;
        way.first_line = marks_.line(before->last);
        way.last_line = first;
        add(way);
      }
      Span span{on ? mark.kind == Mark::Kind::peak ? Span::Kind::peak : Span::Kind::hold : Span::Kind::rest,
                mark.begin, mark.end};
      span.load = on ? load_of(mark) : 0;
      span.load_error = marks_.independent_noise() / std::sqrt(std::max(1.0, mark.line.n));
      if (const Mark* rest = nearest_rest(k); rest != nullptr && !options_.zero)
        span.load_error =
            elementary::hypot(span.load_error, marks_.independent_noise() / std::sqrt(rest->line.n));
      span.dwell_error = mark.dwell_error;
      span.first_line = first;
      span.last_line = last;
      add(span);
      const double until = k + 1 < marks.size() ? marks[k + 1].begin : INFINITY;
      for (; turn < turns_.size() && !on && turns_[turn].time <= until; ++turn) {
        Span turned{Span::Kind::turn, std::clamp(turns_[turn].time, mark.begin, mark.end)};
        turned.end = turned.begin;
        turned.angle = turns_[turn].angle;
        turned.first_line = turned.last_line = turns_[turn].line;
        add(turned);
      }
    }
  }

  const Mark* nearest_rest(std::size_t k) const {
    const std::vector<Mark>& marks = marks_.marks();
    for (std::size_t i = k + 1; i-- > 0;)
      if (!marks[i].loaded()) return &marks[i];
    for (std::size_t i = k; i < marks.size(); ++i)
      if (!marks[i].loaded()) return &marks[i];
    return nullptr;
  }

  std::vector<Protocol::Event> make_events() const {
    std::vector<Protocol::Event> events;
    bool under_load = false;
    double last = -INFINITY;
    const double instant = marks_.interval() / 100;
    const auto push = [&](Protocol::Step step, double time, const Span& span) {
      last = std::max(last, rounded(time, instant));
      events.push_back({std::move(step), last, recording_.name + " " + lines_of(span)});
    };
    for (const Span& span : found_.spans) {
      const bool peak = span.kind == Span::Kind::peak;
      if (span.kind == Span::Kind::hold || (peak && !is_ignored(span))) {
        // A load must not round to zero.
        const double error = std::min(std::max(0.1 * span.load_error, 1e-9 * found_.highest), span.load);
        push(PressRequest{recording_.by, rounded(span.load, error), rounded(span.end - span.begin, instant)},
             span.begin, span);
        under_load = true;
      } else if (span.kind == Span::Kind::release) {
        if (under_load) push(Protocol::Release{}, span.begin, span);
        under_load = false;
      } else if (span.kind == Span::Kind::turn) {
        push(Protocol::Rotate{span.angle}, span.begin, span);
      }
    }
    return events;
  }

  bool is_pulse(const Span& span) const {
    return std::any_of(marks_.marks().begin(), marks_.marks().end(), [&](const Mark& mark) {
      return mark.kind == Mark::Kind::peak && mark.pulse && mark.begin == span.begin;
    });
  }
  bool is_ignored(const Span& peak) const {
    return options_.overshoot == DetectionOptions::Overshoot::ignore && !is_pulse(peak);
  }

  // --- warnings

  void warn() {
    const std::vector<Mark>& marks = marks_.marks();
    if (found_.highest > 0 && found_.least_load > 0.1 * found_.highest)
      warn("a reading scatters by " + marks_.quantity(found_.noise) + ", " +
           marks_.share(found_.noise / found_.highest) + " of the highest load: noise hides a hold of " +
           seconds(found_.shortest_hold) + " below " + marks_.quantity(found_.least_load));
    if (!marks.empty() && marks.back().loaded())
      warn("it ends under load, in line " + std::to_string(marks_.line(marks.back().last)) +
           ": the last dwell goes to the last sample, and no release follows");
    if (!marks.empty() && marks.front().loaded())
      warn("it begins under load: the first dwell is counted from the first sample");
    if (!found_.rested && !options_.zero)
      warn("it has no rest without load: the zero is assumed to be 0; give `zero` if this is wrong");
    std::size_t told = 0, n = 0;
    for (const Span& span : found_.spans) {
      if (span.kind == Span::Kind::peak && is_pulse(span)) {
        if (++n <= 5)
          warn("the load in " + lines_of(span) + " is not held: its peak of " + marks_.quantity(span.load) +
               " is read as a press, and the " + seconds(span.end - span.begin) +
               " above half of it as dwell");
      } else if (span.kind == Span::Kind::peak && is_ignored(span)) {
        warn("an overshoot to " + marks_.quantity(span.load) + " in " + lines_of(span) +
             " is left out, by `overshoot`");
      } else if (span.kind == Span::Kind::hold) {
        const double dwell = span.end - span.begin;
        if (3 * span.dwell_error > std::max(2 * found_.interval, 0.05 * dwell) && ++told <= 5)
          warn("the dwell of " + seconds(dwell) + " at " + marks_.quantity(span.load) + " in " +
               lines_of(span) + " is known to +-" + seconds(2 * span.dwell_error) + " only");
        if (span.load < 0.05 * found_.highest && found_.rested && !options_.zero)
          warn("the reading in " + lines_of(span) + " is " + marks_.quantity(span.load) +
               " above the zero before it, " + marks_.share(span.load / found_.highest) +
               " of the highest load, and is read as a hold; give a greater `zero_drift` if the zero drifts");
      }
    }
    if (n > 5) warn("and " + std::to_string(n - 5) + " more loads are not held");
    if (told > 5) warn("and the dwells of " + std::to_string(told - 5) + " more holds are as uncertain");
    std::size_t doubts = 0;
    for (const Mark& mark : marks_.doubtful())
      if (++doubts <= 5)
        warn("the load in " + lines_of(mark) + " may have stayed at " + marks_.quantity(load_of(mark)) +
             " for a moment; the noise hides it, and it is left out");
    if (doubts > 5) warn("and " + std::to_string(doubts - 5) + " more such moments are left out");
    warn_of_scatter();
    warn_of_limit();
    warn_of_stray();
  }

  void warn_of_stray() {
    const auto stray = marks_.stray();
    if (stray.empty()) return;
    constexpr std::size_t enough = 12;
    std::vector<std::string> runs;
    std::size_t more = 0;
    for (std::size_t k = 0, next = 0; k < stray.size(); k = next) {
      for (next = k + 1; next < stray.size() && stray[next] <= stray[next - 1] + 1;) ++next;
      const std::size_t first = marks_.line(stray[k]), last = marks_.line(stray[next - 1]);
      if (runs.size() == enough)
        more += next - k;
      else
        runs.push_back(std::to_string(first) + (last > first ? " to " + std::to_string(last) : ""));
    }
    if (more > 0) runs.push_back(std::to_string(more) + " more");
    const bool one = stray.size() == 1;
    warn(std::to_string(stray.size()) + (one ? " stray reading is" : " stray readings are") +
         " left out, in " + (one ? "line " : "lines ") + joined(runs, " and ") +
         (one ? ": it is" : ": they are") + " off the line of the readings around");
  }

  // A sensor at its limit repeats one reading.
  void warn_of_limit() {
    if (!(marks_.noise() > 0)) return;
    const auto row = marks_.row();
    double top = -INFINITY;
    for (std::size_t k = 0; k < row.size(); ++k)
      if (!std::ranges::binary_search(marks_.stray(), k)) top = std::max(top, recording_.load[row[k]]);
    constexpr std::size_t fewest = 8;
    constexpr double most_of_it = 0.8;
    std::size_t count = 0;
    std::string where;
    for (const Mark& mark : marks_.marks()) {
      if (!mark.loaded()) continue;
      std::size_t equal = 0;
      for (std::size_t k = mark.first; k <= mark.last; ++k) equal += recording_.load[row[k]] == top ? 1 : 0;
      if (equal < fewest ||
          static_cast<double>(equal) < most_of_it * static_cast<double>(mark.last - mark.first + 1))
        continue;
      if (++count == 1) where = lines_of(mark);
    }
    if (count > 0)
      warn("the load stays at its greatest reading, " + marks_.quantity(top) + ", to the last digit in " +
           where + (count > 1 ? " and in " + std::to_string(count - 1) + " more holds" : "") +
           ", while readings scatter by " + marks_.quantity(marks_.noise()) +
           " elsewhere: the sensor may be at its limit, and the load higher");
  }

  // Correlated noise or a wandering load.
  void warn_of_scatter() {
    for (const Mark& mark : marks_.marks()) {
      if (mark.kind != Mark::Kind::hold) continue;
      const double scatter = std::sqrt(mark.line.misfit() / mark.line.n);
      if (scatter < 3 * marks_.effective_noise() || scatter < 0.01 * load_of(mark)) continue;
      warn("the load in " + lines_of(mark) + " scatters by " + marks_.quantity(scatter) +
           ", from sample to sample by " + marks_.quantity(marks_.noise()) +
           " only: it drifts, and its mean is less certain; give the first value as `noise` if it is noise");
      return;
    }
  }

  void thin() {
    constexpr std::size_t stretches = 1500;
    const auto t = marks_.time();
    const auto y = marks_.load();
    const std::size_t n = t.size(), each = n <= 2 * stretches ? 1 : (n + stretches - 1) / stretches;
    const auto add_sample = [&](std::size_t k) {
      found_.time.push_back(t[k]);
      found_.load.push_back(y[k]);
    };
    for (std::size_t first = 0; first < n; first += each) {
      std::size_t low = first, high = first;
      for (std::size_t k = first; k < std::min(n, first + each); ++k) {
        if (y[k] < y[low]) low = k;
        if (y[k] > y[high]) high = k;
      }
      add_sample(std::min(low, high));
      if (low != high) add_sample(std::max(low, high));
    }
  }

  const PressRecording& recording_;
  const DetectionOptions& options_;
  Monitor& monitor_;
  RecordingMarks marks_;
  Detection found_;
  std::vector<RecordedTurn> turns_;
};

}  // namespace

Protocol detect_events(const PressRecording& recording, const DetectionOptions& options, Monitor& monitor) {
  return EventMaker(recording, options, monitor).make();
}

// --- text

std::string_view name(RecordedSpan::Kind kind) {
  constexpr std::array<std::string_view, 7> names = {"rest", "rise",    "hold", "peak",
                                                     "fall", "release", "turn"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string Detection::text() const {
  const Dimension unit = by == PressBy::load ? dimension::force : dimension::pressure;
  const auto quantity = [unit](double value) { return format_quantity(value, unit, 4); };
  std::string all = "recording " + name + ": " + std::to_string(samples) + " samples, every " +
                    format_quantity(interval, dimension::time, 4) + " or so";
  if (missing > 0) all += ", " + std::to_string(missing) + " more without a load";
  if (absent > 0) all += ", some " + std::to_string(absent) + " more absent";
  all += "\n  noise          " + quantity(noise) + " a sample";
  if (highest > 0) all += ", " + format_short(100 * noise / highest, 2) + " % of the highest load";
  all += "\n  without load   " +
         (!rested ? std::string("never")
                  : quantity(zero_low) + (zero_low < zero_high ? " to " + quantity(zero_high) : "") +
                        " is read, and taken off");
  all += "\n  seen           holds of " + format_quantity(shortest_hold, dimension::time, 4) +
         " and more above " + quantity(least_load);
  all += "\n  one hold       are loads next to each other within " + quantity(least_step) + " or so";
  all += "\n  cut            where it saves " + format_short(evidence, 3) + " squares of the noise";
  const auto count = [&](RecordedSpan::Kind kind) {
    const auto n = std::ranges::count(spans, kind, &RecordedSpan::kind);
    return std::to_string(n) + " " + std::string(asperity::name(kind)) + (n == 1 ? "" : "s");
  };
  using Kind = RecordedSpan::Kind;
  return all + "\n  found          " + count(Kind::hold) + ", " + count(Kind::peak) + ", " +
         count(Kind::release) + ", " + count(Kind::turn);
}

}  // namespace asperity
