// SPDX-License-Identifier: GPL-3.0-or-later
// What a periodic tile makes of one wave of pressure, in cell units (hx = 1, E* = 1): K(q) = 2/|q| of a
// half-space, and that times the share of a layer (elastic_layer.hpp). Plain data and functions of one wave:
// operators and preconditioners ask once for each wave of a grid, and keep what they need.
#pragma once

#include <limits>

#include "engine/contact/elasticity/layer/elastic_layer.hpp"

namespace asperity {

struct ComplianceMultiplier {
  double thickness = std::numeric_limits<double>::infinity();  // t, in cells along x; infinite: a half-space
  double poisson = 0.5;
  LayerBase base = LayerBase::bonded;
  double uniform = 0;  // K(0); 0: a mean pressure moves nothing

  bool layered() const { return thickness < std::numeric_limits<double>::infinity(); }
  // K(q)·q/2, 1 of a half-space. q > 0.
  double share(double q) const { return layered() ? layer_share(q * thickness, poisson, base) : 1; }
  // The greatest K of waves from q on: that of q, but where short waves meet a layer that is softer to them.
  double greatest_from(double q) const;
  // On a grid whose cells are `pitch` times as wide.
  ComplianceMultiplier on_coarser(double pitch) const;
};

// Of a layer, on cells `hx` m wide. `with_mean`: with its K(0), if it compresses at all.
ComplianceMultiplier in_cells(const ElasticLayer& layer, double hx, bool with_mean);

}  // namespace asperity
