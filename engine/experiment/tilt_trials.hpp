// SPDX-License-Identifier: GPL-3.0-or-later
// Repeated trials of a specimen pair on a tilt stage. The specimen's weight presses the tile as it would
// a specimen of its area; the friction law sums the junctions of the contact under the normal force at
// each angle. A rough counter-body is put down afresh for every trial; on a flat every placement is the
// same contact and trials differ only by the scatter asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/experiment/specimen_pair.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/friction/tilt_stage.hpp"

namespace asperity {

struct TiltTrialOptions {
  TiltOptions stage;
  std::optional<double> specimen_area;  // m², > 0; the area of the tile by default
  double scatter = 0;  // relative standard deviation of the friction force from trial to trial, >= 0
  int repeats = 5;     // 1 … 100000
  std::uint64_t seed = 1;
};

struct TiltResult {
  double angle = 0;               // rad, mean over the trials of the exact slip angle
  double held = 0;                // rad, mean of the last step that held: the source paper's measure
  double mu = 0;                  // tan(held); infinite at 90 deg
  double spread = 0;              // standard deviation of tan(held) over the trials (n−1); 0 for one trial
  bool slipped = false;           // every trial slipped; otherwise angle, held and mu are lower bounds
  std::vector<SlipAngle> trials;  // in the order they were made
  std::string note;               // what a reader must know of them, one sentence
};

// Works on a copy: the pair stays as it is. Throws Error{bad_value} naming the option.
TiltResult raise(const SpecimenPair& pair, const JunctionLaw& law, const TiltTrialOptions& options,
                 Monitor& monitor = Monitor::silent());

}  // namespace asperity
