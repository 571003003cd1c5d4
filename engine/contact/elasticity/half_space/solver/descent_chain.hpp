// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a descent on one grid in turn, the quick one first and the one that is sure in theory last,
// each from the feasible pressures of the one before.
#pragma once

#include <string>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"

namespace asperity {

struct ChainEnd {
  StageEnd stage;
  std::string name;
};

enum class ChainEffort {
  start,  // of a finer grid: pressures may end outside their bounds, with gaps as the steps left them
  brief,  // an answer, or none without the last resort
  full    // an answer, down to thousands of projected gradients
};

// Until one converges.
ChainEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort);

}  // namespace asperity
