// SPDX-License-Identifier: GPL-3.0-or-later
// Plan of box elements (pressure = stiffness · shortening, node by node) and of rigid bodies, which deform
// only by yielding. Shares of the shortening: lower_elastic_share().
//
// stiffness: as given, or E*/(peak-to-valley of the combined heights as placed), which needs `young` and
// `poisson` of every body that is not rigid, and unequal heights.
#pragma once

#include "engine/contact/scene/elastic_model.hpp"

namespace asperity {

struct BoxOptions {
  // Pa/m; default as above.
  std::optional<double> stiffness;
  static const ElasticModel& model();
};

// The scene must name an effect to limit the pressure.
struct RigidOptions {
  static const ElasticModel& model();
};

}  // namespace asperity
