// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a descent on one grid in turn, the quick one first and the one that is sure in theory last,
// each from the feasible pressures of the one before.
#pragma once

#include <string>

#include "engine/contact/elasticity/half_space/contact_level.hpp"
#include "engine/contact/elasticity/half_space/descent.hpp"

namespace asperity {

struct ChainEnd {
  StageEnd stage;
  std::string name;
};

// Until one converges. `with_last_resort`: down to thousands of projected gradients.
ChainEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, bool with_last_resort);

}  // namespace asperity
