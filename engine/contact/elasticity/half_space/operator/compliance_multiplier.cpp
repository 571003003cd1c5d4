// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/operator/compliance_multiplier.hpp"

#include <algorithm>

namespace asperity {

double ComplianceMultiplier::greatest_from(double q) const {
  double greatest = 2 / q * share(q);
  if (!layered()) return greatest;
  // Past x = 4 the compliance falls on either base; below it is smooth in log x.
  for (double wave = q; wave * thickness < 4; wave *= 1.25)
    greatest = std::max(greatest, 2 / wave * share(wave));
  return greatest;
}

ComplianceMultiplier ComplianceMultiplier::on_coarser(double pitch) const {
  ComplianceMultiplier result = *this;
  result.thickness /= pitch;
  result.uniform /= pitch;
  return result;
}

ComplianceMultiplier in_cells(const ElasticLayer& layer, double hx, bool with_mean) {
  ComplianceMultiplier result;
  result.thickness = layer.thickness / hx;
  result.poisson = layer.poisson;
  result.base = layer.base;
  if (with_mean && layer.compresses) result.uniform = result.thickness * uniform_share(layer.poisson);
  return result;
}

}  // namespace asperity
