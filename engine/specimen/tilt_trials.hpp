// SPDX-License-Identifier: GPL-3.0-or-later
// Repeated trials of a specimen pair on a tilt stage. The specimen's weight presses the tile as it would
// a specimen of its area; the friction law sums the junctions of the contact under the normal force at
// each angle. A box contact is solved at every angle's load. On a half-space the weight of most specimens
// rests on less than one cell, so the contact is solved where the grid resolves it, at the probe pressures,
// and what a load makes of area and friction there is taken to hold down to the weight: real area grows in
// proportion to load. A weight that presses harder than the least of the probes is solved itself, and as the
// stage is raised the lesser loads down to that probe. So does what an attraction across the gap adds, unless
// the bodies stick without a load (Pastewka & Robbins 2014). A lone spot grows in no such proportion (a
// ball's as load^2/3): where the probes show it and the tile is the specimen, the weight is solved itself, on
// however few nodes. A rough counter-body is put down afresh for every trial; on a flat every placement is
// the same contact and trials differ only by the scatter asked for.
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
  std::optional<double> specimen_area;  // m², > 0; the area of the tile by default
  // Pa, each > 0: pressures of the half-space solves; each is doubled until fifty nodes touch. The result is
  // the mean of their ratios.
  std::vector<double> probe_pressures = {1e6, 3e6};
  double scatter = 0;  // relative standard deviation of the friction force from trial to trial, >= 0
  int repeats = 5;     // 1 … 100000
  std::uint64_t seed = 1;
  // s >= 0 that the junctions rest under the weight before the stage is raised; needs the effect `ageing`.
  std::optional<double> rest{};
};

// A half-space contact solved for the stage.
struct TiltProbe {
  double pressure = 0;        // Pa
  std::int64_t contacts = 0;  // nodes
  bool yields = false;        // some node carries the limit of the pressure
  double area_per_load = 0;   // 1/Pa, of the corrected area
  double mu = 0;              // friction over load, its adhesive part on the corrected area; may be negative
                              // where junctions interlock
  double attraction = 0;      // over load, of bodies that attract each other across the gap
  bool lone_spot = false;     // all nodes in contact hang together, by edges or corners
  std::vector<std::string> limits{};  // state_limits
};

struct TiltResult {
  double angle = 0;               // rad, mean over the trials of the exact slip angle
  double held = 0;                // rad, mean of the last step that held: the source paper's measure
  double mu = 0;                  // tan(held); infinite at 90 deg
  double spread = 0;              // standard deviation of tan(held) over the trials (n−1); 0 for one trial
  bool slipped = false;           // every trial slipped; otherwise angle, held and mu are lower bounds
  std::vector<SlipAngle> trials;  // in the order they were made
  // 1/Pa, on a half-space only: mean over trials, of what was solved under the weight or else of the probes.
  std::optional<double> area_per_load;
  std::vector<TiltProbe> probes;     // in trials that solved anew
  std::vector<TiltProbe> at_weight;  // level, one a trial; empty unless the weight itself was solved
  // How far mu at one probe is from the mean of a trial's, relative, at most: what extrapolating down to the
  // weight may be wrong by. None for a solved weight, a single probe and boxes.
  std::optional<double> probe_spread;
  std::string note;  // condition of the result, one sentence
};

// Works on a copy: the pair stays as it is. Junctions that interlock may push down the slope: friction is
// then zero. Throws Error{bad_value} naming the option, and Error{bad_state} for a rest without `ageing`.
TiltResult raise(const SpecimenPair& pair, const JunctionLaw& law, const TiltTrialOptions& options,
                 Monitor& monitor = Monitor::silent());

// The seed by which a trial, counted from 0, puts a rough counter-body down.
std::uint64_t tilt_placement(const TiltTrialOptions& options, int trial);

}  // namespace asperity
