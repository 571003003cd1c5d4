// SPDX-License-Identifier: GPL-3.0-or-later
// Repeated trials of a specimen pair on a tilt stage. The weight presses the tile as it would a specimen of
// its area; the friction law sums the junctions at each angle's normal force. A box contact is solved at
// every load. On a half-space most weights rest on less than one cell, so the contact is solved at the
// resolved probe pressures, and area and friction per load are assumed equal down to the weight: real area is
// proportional to load, also to that of an attraction, unless bodies stick without load (Pastewka & Robbins
// 2014). Weights above the smallest probe are solved themselves, with the smaller loads of the raise; so is
// the weight on a lone spot (a ball: area ~ load^2/3), if the tile is the specimen. A rough counter-body is
// placed anew for every trial; on a flat, trials differ by scatter.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/friction/junction_law.hpp"
#include "engine/friction/tilt_stage.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity {

struct TiltTrialOptions {
  TiltOptions stage;
  std::optional<double> specimen_area;  // m², > 0; default: the tile
  // Pa, > 0: half-space solves, whose ratios are averaged; each is doubled until fifty nodes touch.
  std::vector<double> probe_pressures = {1e6, 3e6};
  double scatter = 0;  // relative standard deviation of friction, >= 0
  int repeats = 5;     // 1 … 100000
  std::uint64_t seed = 1;
  // s >= 0: under the weight before the raise; needs `ageing`.
  std::optional<double> rest{};
};

struct TiltProbe {
  double pressure = 0;                // Pa
  std::int64_t contacts = 0;          // nodes
  bool yields = false;                // some node is at the limit
  double area_per_load = 0;           // 1/Pa, corrected area
  double mu = 0;                      // with adhesion on the corrected area; negative if junctions interlock
  double attraction = 0;              // over load
  bool lone_spot = false;             // connected by edges or corners
  std::vector<std::string> limits{};  // state_limits
};

struct TiltResult {
  double angle = 0;               // rad, mean of the exact slip angles
  double held = 0;                // rad, mean last held step: the source paper's measure
  double mu = 0;                  // tan(held); infinite at 90 deg
  double spread = 0;              // standard deviation of tan(held) (n−1); 0 for one trial
  bool slipped = false;           // every trial; otherwise angle, held and mu are lower bounds
  std::vector<SlipAngle> trials;  // in order
  // 1/Pa, half-space only: trial mean for the solved weight or the probes.
  std::optional<double> area_per_load;
  std::vector<TiltProbe> probes;     // of trials that solved anew
  std::vector<TiltProbe> at_weight;  // level, one per trial; empty unless solved
  // Greatest relative departure of mu at a probe from the mean: error of the extrapolation. None for a solved
  // weight, single probes and boxes.
  std::optional<double> probe_spread;
  std::string note;  // condition of the result, one sentence
};

// Works on a copy. Negative friction becomes zero. Throws Error{bad_value} naming the option, {bad_state} for
// a rest without `ageing`.
TiltResult raise(const SpecimenPair& pair, const JunctionLaw& law, const TiltTrialOptions& options,
                 Monitor& monitor = Monitor::silent());

// Trials count from 0.
std::uint64_t tilt_placement(const TiltTrialOptions& options, int trial);

// Growth of slip on a raised stage. At the angle θ the weight W presses by W cos θ and pulls by W sin θ, tan
// θ/μ of the sliding force; partial slip (friction/partial_slip.hpp) gives the slipping share. Coulomb's law,
// with the mean μ of the junction law. On a half-space the share at the first probe pressure is assumed down
// to the weight.
struct SlipShare {
  double angle = 0;          // rad
  double ratio = 0;          // pull over sliding force, 0 … 1
  double slip_fraction = 0;  // of the contact area
  // m, between the bodies; none on a half-space.
  std::optional<double> displacement{};
};

// At `steps` (1 … 10000) equal steps up to slip, or the limit. Ignores scatter and repeats. Works on a copy.
// Throws as raise() and shear().
std::vector<SlipShare> slip_growth(const SpecimenPair& pair, const JunctionLaw& law,
                                   const TiltTrialOptions& options, int steps,
                                   Monitor& monitor = Monitor::silent());

}  // namespace asperity
