// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/descent_chain.hpp"

#include "engine/contact/elasticity/half_space/solver/active_set_descent.hpp"
#include "engine/contact/elasticity/half_space/solver/spectral_gradient.hpp"

namespace asperity {

ChainEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort) {
  constexpr int quick = 300, shake = 12, last_resort = 3000;
  ChainEnd end;
  for (int stage = 0; stage < 5; ++stage) {
    if (effort != ChainEffort::full && stage > 2) break;
    if (stage == 4) {
      end.stage = spectral_gradient(level, fields, tolerance, last_resort);
      end.name = "spectral projected gradients, after the descents stalled";
    } else if (stage % 2 == 1) {
      end.stage = spectral_gradient(level, fields, tolerance, shake);
      end.name = "spectral projected gradients";
    } else {
      end.stage = active_set_descent(level, fields, tolerance, quick, effort != ChainEffort::start);
      end.name = stage == 0 ? "preconditioned descent" : "preconditioned descent, restarted";
    }
    if (end.stage.converged) break;
  }
  return end;
}

}  // namespace asperity
