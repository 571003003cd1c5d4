// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements, independent of each other over the nodes: pressure = stiffness · shortening; and rigid
// bodies, which give way only by yielding. What they add to a plan: their stiffness with where it comes from,
// how two bodies share the shortening, and the sorted heights.
//
// stiffness: as given, or E*/(peak-to-valley of the combined heights as placed); then both bodies need
// `young` and `poisson` (or are rigid), and the combined heights must not all be equal.
// lower_share: a rigid body takes no shortening; two elastic bodies share it as their compliances
// (1−ν²)/E; where the materials do not say, a flat takes none and two rough bodies take half each.
#pragma once

#include "engine/contact/elastic_model.hpp"

namespace asperity {

struct BoxOptions {
  // Pa/m; by default E*/(peak-to-valley of the combined heights as placed).
  std::optional<double> stiffness;
  static const ElasticModel& model();
};

// No elastic deformation: a node gives way only by yielding, so the scene names what limits the pressure.
struct RigidOptions {
  static const ElasticModel& model();
};

}  // namespace asperity
