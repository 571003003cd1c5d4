// SPDX-License-Identifier: GPL-3.0-or-later
// A stylus profiler: straight traverses at random places and angles over a surface, sampled at equal
// spacing, each height that of a spherical tip resting on the surface (spherical_tip.hpp). The traces are
// as the tip gives them: nothing is levelled or filtered. Beside them stands what the tip made of
// the surface, compared with a needle on the same lines. Not modelled: noise, drift, skid, load. On a surface
// with holes only a needle (tip 0) can be followed; its traces have holes where a node around was not
// measured.
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

struct StylusOptions {
  double tip = 2e-6;              // m, radius of the tip, >= 0
  std::optional<double> spacing;  // m between samples; default speed/rate if both are given, else 0.25 µm
  double length = 2e-3;           // m of a trace
  std::optional<double> speed;    // m/s along the trace
  std::optional<double> rate;     // samples a second
};

inline constexpr double stylus_spacing = 0.25e-6;
inline constexpr int most_stylus_samples = 1 << 24;
inline constexpr int most_traces = 100000;

// Where a trace begins and the direction it takes, radians counter-clockwise from x.
struct Traverse {
  Point start;
  double angle = 0;
};

// What the tip did to the traces, against a needle on the same lines. Ratios are sums over all traces,
// with the tip over without; 1 where both are 0.
struct TipEffect {
  double ra_ratio = 1, rms_slope_ratio = 1, amplitude_ratio = 1;
  double mean_lift = 0, greatest_lift = 0;  // m, of the tip's lowest point above the surface
};

struct StylusScan {
  std::vector<Profile> traces;
  std::vector<Traverse> lines;
  TipEffect effect;
};

// An immutable value.
class Stylus {
 public:
  // Throws Error{bad_value} naming the option: a tip below 0, a length under two or over 2^24 samples,
  // lengths that are not finite and positive, and a `spacing` that is not speed/rate to 1e-9.
  explicit Stylus(const StylusOptions& options);

  double tip() const { return tip_; }
  double spacing() const { return spacing_; }
  double length() const { return length_; }
  int samples() const;  // of one trace: whole spacings in the length
  // The third of spacing = speed/rate follows from two; nothing where only the spacing is known.
  std::optional<double> speed() const { return speed_; }
  std::optional<double> rate() const { return rate_; }
  std::string digest() const;

  // Line k depends on seed, k and the size of the surface alone, so the same seed goes over the same ground
  // again after a contact. On a periodic surface start and angle are uniform and the line may
  // wrap round the tile several times; on any other the angle is uniform among those at which the whole
  // line fits between the outermost nodes, then the place among those where it does. Throws
  // Error{bad_value} naming `length` where no line fits, or `count` outside 1 … 100000.
  std::vector<Traverse> lines(const Surface& surface, int count, std::uint64_t seed) const;

  // The heights of one traverse. Cost: samples · cells within reach of the tip. Throws Error{bad_value} for a
  // surface with holes where the tip is not a needle, or where no sample of the line was measured.
  Profile trace(const Surface& surface, const Traverse& line) const;

  // Traces along lines(), of measured samples where there are holes. Same bits for any number of threads.
  StylusScan scan(const Surface& surface, int count, std::uint64_t seed,
                  Monitor& monitor = Monitor::silent()) const;

 private:
  Point at(const Traverse& line, std::size_t k) const;

  double tip_, spacing_, length_;
  std::optional<double> speed_, rate_;
};

}  // namespace asperity
