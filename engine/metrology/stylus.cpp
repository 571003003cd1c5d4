// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/stylus.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/metrology/spherical_tip.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

constexpr double same = 1e-9;  // relative tolerance of lengths given twice

double spacing_of(const StylusOptions& o) {
  require_positive("spacing", o.spacing);
  require_positive("speed", o.speed);
  require_positive("rate", o.rate);
  if (o.speed && !o.rate && !o.spacing)
    refuse("`speed` is given without `rate`, so the distance between samples is not known",
           "give `rate`, such as \"100 Hz\", or `spacing`");
  if (!o.speed || !o.rate) return o.spacing.value_or(stylus_spacing);
  const double travelled = *o.speed / *o.rate;
  if (!(std::isfinite(travelled) && travelled > 0))
    refuse("`speed`/`rate` is " + format_short(travelled) + " m",
           "give a speed and a rate that make a spacing");
  if (!o.spacing) return travelled;
  if (std::abs(*o.spacing - travelled) > same * travelled)
    refuse("`spacing` is " + metres(*o.spacing) + ", and `speed`/`rate` is " + metres(travelled),
           "give two of the three, or three that agree");
  return *o.spacing;
}

std::int64_t whole_spacings(double length, double spacing) {
  return static_cast<std::int64_t>(std::floor(length / spacing * (1 + same)));
}

double ratio(double with, double without) { return with == without ? 1 : with / without; }

// Angles at which a line fits into a rectangle; the tolerance admits the diagonal.
std::optional<Range> fitting_angles(double length, double width, double height) {
  const double low = length > width ? elementary::acos(width / length) : 0;
  const double high = length > height ? elementary::asin(height / length) : 0.5 * std::numbers::pi;
  if (low > high + same) return {};
  return Range{.min = low, .max = std::max(low, high)};
}

}  // namespace

Stylus::Stylus(const StylusOptions& options)
    : tip_(options.tip),
      spacing_(spacing_of(options)),
      length_(options.length),
      speed_(options.speed),
      rate_(options.rate) {
  require_positive("length", length_);
  require(std::isfinite(tip_) && tip_ >= 0, "tip", tip_, "m", "give a finite radius of 0 or more");
  if (!(length_ >= 2 * spacing_ * (1 - same)))
    refuse("`length` is " + metres(length_) + " and `spacing` " + metres(spacing_),
           "give a length of at least two spacings, " + metres(2 * spacing_));
  if (!(length_ / spacing_ <= most_stylus_samples))
    refuse("a trace of " + metres(length_) + " with a sample every " + metres(spacing_) + " has " +
               format_short(length_ / spacing_) + " samples",
           "give a shorter `length` or a wider `spacing`: at most " + std::to_string(most_stylus_samples) +
               " samples");
  if (speed_ && !rate_) rate_ = *speed_ / spacing_;
  if (rate_ && !speed_) speed_ = *rate_ * spacing_;
}

int Stylus::samples() const { return static_cast<int>(whole_spacings(length_, spacing_)); }

std::string Stylus::digest() const {
  Digester digester;
  digester.add("stylus").add(tip_).add(spacing_).add(length_).add(speed_.value_or(0)).add(rate_.value_or(0));
  return digester.hex();
}

std::vector<Traverse> Stylus::lines(const Surface& surface, int count, std::uint64_t seed) const {
  if (count < 1 || count > most_traces)
    refuse("`count` is " + std::to_string(count),
           "give a whole number from 1 to " + std::to_string(most_traces));
  const Grid& g = surface.grid();
  const Stream stream(seed, "stylus");
  std::vector<Traverse> lines(static_cast<std::size_t>(count));
  const bool wraps = surface.traits().periodic;
  const double travel = (samples() - 1) * spacing_;
  const double width = (g.nx - 1) * g.hx(), height = (g.ny - 1) * g.hy();
  const std::optional<Range> angles = fitting_angles(travel, width, height);
  if (!wraps && !angles)
    refuse("a trace of `length` " + metres(length_) +
               " does not fit on a surface that is not periodic, with nodes over " + metres(width) + " x " +
               metres(height),
           elementary::hypot(width, height) >= 2 * spacing_
               ? "give a `length` of at most " + metres(elementary::hypot(width, height)) + ", its diagonal"
               : "give a larger surface");
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double across = stream.uniform(4 * k), along = stream.uniform(4 * k + 1);
    const double turn = stream.uniform(4 * k + 2);
    if (wraps) {
      lines[k] = {{across * g.size_x, along * g.size_y}, 2 * std::numbers::pi * turn};
      continue;
    }
    // One quarter turn suffices: random bits mirror it.
    const double angle = angles->min + angles->span() * turn;
    const double dx = travel * elementary::cos(angle), dy = travel * elementary::sin(angle);
    const std::uint64_t quarter = stream.below(4 * k + 3, 4);
    const bool back_x = (quarter & 1) != 0, back_y = (quarter & 2) != 0;
    const double x = across * std::max(width - dx, 0.0), y = along * std::max(height - dy, 0.0);
    lines[k] = {{back_x ? x + dx : x, back_y ? y + dy : y},
                elementary::atan2(back_y ? -dy : dy, back_x ? -dx : dx)};
  }
  return lines;
}

Point Stylus::at(const Traverse& line, std::size_t k) const {
  const double way = static_cast<double>(k) * spacing_;
  return {line.start.x + way * elementary::cos(line.angle), line.start.y + way * elementary::sin(line.angle)};
}

Profile Stylus::trace(const Surface& surface, const Traverse& line) const {
  const SphericalTip tip(surface, tip_);
  Array<double> heights(static_cast<std::size_t>(samples()));
  constexpr std::size_t samples_a_block = 256;
  const std::size_t blocks = (heights.size() + samples_a_block - 1) / samples_a_block;
  parallel_for(static_cast<std::int64_t>(blocks), [&](std::int64_t block) {
    const std::size_t first = static_cast<std::size_t>(block) * samples_a_block;
    for (std::size_t k = first; k < std::min(heights.size(), first + samples_a_block); ++k)
      heights[k] = tip.height(at(line, k));
  });
  if (!surface.complete() && known_count(heights) == 0)
    refuse("the trace from (" + metres(line.start.x) + ", " + metres(line.start.y) +
               ") goes over points alone that were not measured",
           "take another `seed`, a longer trace, or fill the holes first");
  return remade_with(!surface.complete(), spacing_, std::move(heights));
}

StylusScan Stylus::scan(const Surface& surface, int count, std::uint64_t seed, Monitor& monitor) const {
  StylusScan result;
  result.lines = lines(surface, count, seed);
  double ra[2] = {}, slope[2] = {}, amplitude[2] = {}, lift = 0;
  Task task(monitor, "stylus traces", count);
  for (const Traverse& line : result.lines) {
    Profile felt = trace(surface, line);
    Array<double> below(static_cast<std::size_t>(felt.size())), lifts(below.size());
    for (std::size_t k = 0; k < below.size(); ++k) {
      below[k] = height_between(surface, at(line, k));
      lifts[k] = felt.measured_heights()[k] - below[k];
    }
    lift += known_mean(lifts);
    result.effect.greatest_lift = std::max(result.effect.greatest_lift, known_range(lifts).max);
    const Profile needle = remade_with(!surface.complete(), spacing_, std::move(below));
    for (const int with : {0, 1}) {
      const Roughness r = roughness(with != 0 ? felt : needle);
      ra[with] += r.Ra;
      slope[with] += r.rms_slope;
      amplitude[with] += r.amplitude;
    }
    result.traces.push_back(std::move(felt));
    task.advance();
  }
  result.effect.mean_lift = lift / count;
  result.effect.ra_ratio = ratio(ra[1], ra[0]);
  result.effect.rms_slope_ratio = ratio(slope[1], slope[0]);
  result.effect.amplitude_ratio = ratio(amplitude[1], amplitude[0]);
  return result;
}

}  // namespace asperity
