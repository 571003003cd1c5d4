// SPDX-License-Identifier: GPL-3.0-or-later
// How far pressures are from the solution on one grid: the offset δ that suits them best, and the
// greatest of the certificate's penetration and complementarity for it. With a cap the penetration is
// pointwise; without one the two agree when δ is the pressure-weighted mean gap. Pressures outside their
// bounds are judged as if settled on them; the load is not judged here.
#pragma once

#include <limits>
#include <span>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

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

// Steps still to be taken: p += Σ length · direction, g += gap_length · image.
template <class Stored>
struct PressureStep {
  struct Along {
    double length = 0;
    const Stored* direction = nullptr;
  };
  Along along[2];  // null only where both are
  double gap_length = 0;
  const double* image = nullptr;

  bool none() const { return along[0].length == 0 && along[1].length == 0 && gap_length == 0; }
  // At node k, or at as many as a vector has lanes.
  template <class Value>
  void take(std::size_t k, double* p, double* g, Value& pressure, Value& gap) const {
    Value last, before, change;
    lane_terms::read(p + k, pressure);
    lane_terms::read(along[0].direction + k, last);
    lane_terms::read(along[1].direction + k, before);
    pressure += along[0].length * last + along[1].length * before;
    lane_terms::put(pressure, p + k);
    lane_terms::read(g + k, gap);
    lane_terms::read(image + k, change);
    gap += gap_length * change;
    lane_terms::put(gap, g + k);
  }
};

// One pass over the nodes, two with a cap. g = K p − h for p as given. `balance` as in PressureLimit::settle.
ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g,
                               double balance = std::numeric_limits<double>::quiet_NaN());

// The same after steps, which the pass takes on its way.
template <class Stored>
ContactQuality contact_quality(const ContactLevel& level, std::span<double> p, std::span<double> g,
                               const PressureStep<Stored>& step, double balance);

}  // namespace asperity
