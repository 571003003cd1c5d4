// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/operator/compliance_multiplier.hpp"

#include <algorithm>

namespace asperity {

double ComplianceMultiplier::greatest_from(double q) const {
  double greatest = 2 / q * share(q);
  if (!shares()) return greatest;
  // Below x = 4 it is smooth in log x.
  for (double wave = q; wave * length < 4; wave *= 1.25)
    greatest = std::max(greatest, 2 / wave * share(wave));
  return greatest;
}

ComplianceMultiplier ComplianceMultiplier::on_coarser(double pitch) const {
  ComplianceMultiplier result = *this;
  result.length /= pitch;
  result.uniform /= pitch;
  return result;
}

ComplianceMultiplier in_cells(const WaveShare& share, double hx, bool with_mean) {
  const double length = share.length / hx;
  return {share.share, length, with_mean ? length * share.uniform : 0};
}

}  // namespace asperity
