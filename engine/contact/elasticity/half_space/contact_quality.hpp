// SPDX-License-Identifier: GPL-3.0-or-later
// How far pressures are from the solution on one grid: the offset δ that suits them best, and the
// greatest of the certificate's penetration and complementarity for it. With a cap the penetration is
// pointwise; without one the two agree when δ is the pressure-weighted mean gap. Pressures outside their
// bounds are judged as if settled on them; the load is not judged here.
#pragma once

#include <limits>
#include <span>

#include "engine/contact/elasticity/half_space/contact_level.hpp"
#include "engine/contact/elasticity/half_space/lane_terms.hpp"

namespace asperity {

struct ContactQuality {
  double residual = 0;  // greatest relative entry of penetration and complementarity
  double penetration = 0, complementarity = 0;
  double offset = 0;        // δ by which the residual is measured and the answer given
  double interior_gap = 0;  // mean of g over the elastic interior; the bracket's middle where it is empty
  double interior = 0;      // nodes strictly between the bounds that do not yield
  double yielded = 0;       // nodes past their yield pressure
  double load = 0;          // Σ p, settled
  double settled = 0;       // nodes that had to be settled
  bool within = true;       // nothing had to be settled
};

// A step still to be taken: p += length · direction, g += length · image.
struct PressureStep {
  double length = 0;
  const double *direction, *image;

  // At node k, or at as many as a vector has lanes.
  template <class Value>
  void take(std::size_t k, double* p, double* g, Value& pressure, Value& gap) const {
    Value along, across;
    lane_terms::read(p + k, pressure);
    lane_terms::read(g + k, gap);
    lane_terms::read(direction + k, along);
    lane_terms::read(image + k, across);
    pressure += length * along;
    gap += length * across;
    lane_terms::put(pressure, p + k);
    lane_terms::put(gap, g + k);
  }
};

// One pass over the nodes, two with a cap. g = K p − h for p as given. `balance` as in PressureLimit::settle.
ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g,
                               double balance = std::numeric_limits<double>::quiet_NaN());

// The same after a step, which the pass takes on its way.
ContactQuality contact_quality(const ContactLevel& level, std::span<double> p, std::span<double> g,
                               const PressureStep& step, double balance);

}  // namespace asperity
