// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/light_contact.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"

namespace asperity {

namespace {

double highest_of(std::span<const double> heights) {
  return -over_nodes<0, 1>(heights.size(), [&](std::size_t k, double* v) { v[0] = -heights[k]; })[0];
}

class LightContact {
 public:
  LightContact(ContactLevel& level, DescentFields& fields, const RawHeights& heights, double tolerance)
      : level_(level), fields_(fields), heights_(heights), tolerance_(tolerance) {}

  bool refine(ChainEnd& end);

 private:
  static constexpr double light = 0.01;  // an approach, of what gaps are measured by
  static constexpr double soft = 1e-3;   // what one node at the cap sinks, of the same

  // Once more from the pressures there are; false, and they stay, where that does not converge.
  bool again(double length, ChainEnd& end);
  void by_approach(double approach, ChainEnd& end);
  void at_the_cap(double cap, ChainEnd& end);
  double offset() const { return contact_quality(level_, fields_.pressure, fields_.gap).offset; }
  // What one node sinks, about, under the pressure `p` on it alone.
  double sunk(double p) const { return LinearHardening::own_compliance * std::sqrt(level_.shape.aspect) * p; }

  ContactLevel& level_;
  DescentFields& fields_;
  const RawHeights& heights_;
  double tolerance_;
};

bool LightContact::again(double length, ChainEnd& end) {
  level_.length = length;
  const UnsetArray<double> before = fields_.pressure;
  const ChainEnd finer = run_chain(level_, fields_, tolerance_, ChainEffort::brief);
  if (finer.stage.converged)
    end = finer;
  else
    fields_.pressure = before;
  return finer.stage.converged;
}

void LightContact::by_approach(double approach, ChainEnd& end) {
  constexpr double right = 0.5;  // of the approach that gaps were measured by
  constexpr int most_rounds = 60;
  // Without a limit on its pressure the highest node alone would sink so far; the first approach is perhaps
  // only what the tolerance left.
  const double alone = sunk(level_.total_load());
  const bool elastic =
      !std::isfinite(greatest_pressure(level_.limit)) && std::holds_alternative<PressureCap>(level_.limit);
  if (!(approach > 0) || elastic) approach = std::min(approach > 0 ? approach : alone, alone);
  for (int round = 0; round < most_rounds; ++round) {
    if (!again(approach, end)) return;
    approach = offset();
    if (!(approach > 0) || approach > right * level_.length) return;
  }
}

// Soft ground: all is at the cap above some height, and all is open below; nodes at that height share the
// rest.
void LightContact::at_the_cap(double cap, ChainEnd& end) {
  const UnsetArray<double>& p = fields_.pressure;
  for (std::size_t k = 0; k < p.size(); ++k)
    if (p[k] > 0 && p[k] < cap) {
      level_.count_from(heights_.values[k]);
      again(sunk(cap), end);
      return;
    }
}

bool LightContact::refine(ChainEnd& end) {
  const double highest = highest_of(heights_.values), length = level_.length;
  const double cap = greatest_pressure(level_.limit);
  const double approach = (highest - heights_.origin) * heights_.factor + offset();
  const bool from_peak = approach < light * length;
  if (from_peak) {
    level_.count_from(highest);
    by_approach(approach, end);
  }
  const bool is_soft = std::isfinite(cap) && sunk(cap) < soft * length;
  if (is_soft) {
    at_the_cap(cap, end);
    level_.count_from(from_peak ? highest : heights_.origin);
  }
  if (from_peak || is_soft) level_.gap(fields_.pressure, fields_.gap);
  level_.length = length;
  return from_peak;
}

}  // namespace

bool refine_light_contact(ContactLevel& level, DescentFields& fields, const RawHeights& heights,
                          double tolerance, ChainEnd& end) {
  return LightContact(level, fields, heights, tolerance).refine(end);
}

}  // namespace asperity
