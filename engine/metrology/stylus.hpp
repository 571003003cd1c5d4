// SPDX-License-Identifier: GPL-3.0-or-later
// Stylus profiler: straight traverses at random places and angles, sampled at equal spacing by a spherical
// tip, neither levelled nor filtered. Not modelled: noise, drift, skid, load, wear. Surfaces with holes need
// a needle (tip 0); its traces have holes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/surface/operations/sections.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Spherical tip of radius R on a surface S: its lowest point at x rests at the grey-scale dilation
//
//   t(x) = max over |x' - x| <= R of  S(x') + √(R² - |x' - x|²) - R
//
// (Villarrubia 1997, J. Res. NIST 102, 425). Closing (dilation, then erosion; ISO 16610-85) fills places the
// tip cannot enter. SphericalTip uses the bilinear surface; operations on maps use nodes only.

// Thread-safe.
class SphericalTip {
 public:
  // Radius 0: a needle. Throws Error{bad_value} naming `tip` for a negative or infinite radius, or a positive
  // radius on a surface with holes.
  SphericalTip(const Surface& surface, double radius);

  // t in m: not below height_between(surface, point), equal for radius 0. Periodic surfaces continue, others
  // end at the outermost nodes. Cost: cells within reach, where the sphere rises by up to the height range.
  double height(Point point) const;

 private:
  Surface surface_;
  int exponent_;             // length unit: 2^exponent_ m
  double radius_, hx_, hy_;  // in this unit
  double top_;               // m, highest node
};

// At the nodes. Heights never fall; closing is idempotent (to one or two last bits). Periodic surfaces wrap;
// nothing exists beyond other rims. Material and periodicity stay. O(nodes · cells within reach); two grids.
// Throw Error{bad_value} for a negative or infinite radius.
Surface dilated(const Surface& surface, double radius, Monitor& monitor = Monitor::silent());
Surface closed(const Surface& surface, double radius, Monitor& monitor = Monitor::silent());

struct StylusOptions {
  double tip = 2e-6;              // m, tip radius >= 0
  std::optional<double> spacing;  // m; default speed/rate if both are given, else stylus_spacing
  double length = 2e-3;           // m
  std::optional<double> speed;    // m/s
  std::optional<double> rate;     // samples per second
};

inline constexpr double stylus_spacing = 0.25e-6;
inline constexpr int most_stylus_samples = 1 << 24;
inline constexpr int most_traces = 100000;

// Angle: radians counter-clockwise from x.
struct Traverse {
  Point start;
  double angle = 0;
};

// Sums with the tip over sums with a needle; 1 if both are 0.
struct TipEffect {
  double ra_ratio = 1, rms_slope_ratio = 1, amplitude_ratio = 1;
  double mean_lift = 0, greatest_lift = 0;  // m, tip above surface
};

struct StylusScan {
  std::vector<Profile> traces;
  std::vector<Traverse> lines;
  TipEffect effect;
};

class Stylus {
 public:
  // Throws Error{bad_value} naming the option: a negative tip, under two or over 2^24 samples, non-positive
  // or infinite lengths, or `spacing` unlike speed/rate (1e-9).
  explicit Stylus(const StylusOptions& options);

  double tip() const { return tip_; }
  double spacing() const { return spacing_; }
  double length() const { return length_; }
  int samples() const;  // per trace: whole spacings in the length
  // Empty if only the spacing is known.
  std::optional<double> speed() const { return speed_; }
  std::optional<double> rate() const { return rate_; }
  std::string digest() const;

  // Line k depends only on seed, k and surface size, so lines repeat after a contact. Periodic: uniform start
  // and angle, possibly wrapping. Otherwise: angle uniform among fitting ones, then place. Throws
  // Error{bad_value} naming `length` if no line fits, or `count` outside 1 … 100000.
  std::vector<Traverse> lines(const Surface& surface, int count, std::uint64_t seed) const;

  // Cost: samples · cells within reach. Throws Error{bad_value} for a positive tip on a surface with holes,
  // or a line without measured samples.
  Profile trace(const Surface& surface, const Traverse& line) const;

  StylusScan scan(const Surface& surface, int count, std::uint64_t seed,
                  Monitor& monitor = Monitor::silent()) const;

 private:
  Point at(const Traverse& line, std::size_t k) const;

  double tip_, spacing_, length_;
  std::optional<double> speed_, rate_;
};

}  // namespace asperity
