// SPDX-License-Identifier: GPL-3.0-or-later
// Error of pressures on one grid: the best offset δ and the greater of penetration and complementarity for
// it. With a cap penetration is pointwise; without one both agree if δ is the pressure-weighted mean gap.
// Pressures outside their bounds count as settled; the load is not judged.
#pragma once

#include <limits>
#include <span>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

struct ContactQuality {
  double residual = 0;  // greatest entry
  double penetration = 0, complementarity = 0;
  double offset = 0;        // δ of the residual
  double interior_gap = 0;  // mean g of the elastic interior, or a substitute
  double interior = 0;      // elastic nodes
  double yielded = 0;       // nodes past their yield pressure
  double load = 0;          // Σ p, settled
  double settled = 0;       // settled nodes
  bool within = true;
};

// Pending steps: p += Σ length · direction, g += gap_length · image.
template <class Stored>
struct PressureStep {
  struct Along {
    double length = 0;
    const Stored* direction = nullptr;
  };
  Along along[2];  // null only if both are
  double gap_length = 0;
  const double* image = nullptr;

  bool none() const { return along[0].length == 0 && along[1].length == 0 && gap_length == 0; }
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

// One pass over the nodes, two with a cap. `balance` as in PressureLimit::settle.
ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g,
                               double balance = std::numeric_limits<double>::quiet_NaN());

// After `step`, taken in the same pass.
template <class Stored>
ContactQuality contact_quality(const ContactLevel& level, std::span<double> p, std::span<double> g,
                               const PressureStep<Stored>& step, double balance);

}  // namespace asperity
