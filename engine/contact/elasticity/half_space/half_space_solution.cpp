// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_solution.hpp"

#include <algorithm>
#include <utility>

#include "engine/contact/elasticity/half_space/contact_stiffness.hpp"

namespace asperity {

HalfSpaceSolution::HalfSpaceSolution(std::shared_ptr<const ContactGeometry> geometry,
                                     HalfSpaceProblem problem, HalfSpaceAnswer answer, double lower_share)
    : problem_(std::move(problem)),
      at_(std::move(answer)),
      geometry_(std::move(geometry)),
      lower_share_(lower_share) {}

const std::optional<PlannedYield>& HalfSpaceSolution::limit() const {
  static const std::optional<PlannedYield> none;
  return none;
}

double HalfSpaceSolution::stiffness() const {
  return at_.contacts > 0 ? contact_stiffness(problem_, at_, Monitor::silent()) : 0.0;
}

double HalfSpaceSolution::mean_gap() const {
  return sum([&](std::size_t k) { return faces(k) ? std::max(0.0, at_.gap[k]) : 0.0; }) /
         static_cast<double>(geometry().facing());
}

PressureSplit HalfSpaceSolution::split(double threshold) const {
  PressureSplit result;
  for (const double p : at_.pressure.values())
    if (p > 0) ++(p >= threshold ? result.above : result.below);
  result.sum_below = sum([&](std::size_t k) {
    const double p = at_.pressure[k];
    return p > 0 && p < threshold ? p : 0.0;
  });
  return result;
}

Array<std::uint8_t> HalfSpaceSolution::contact_mask() const {
  Array<std::uint8_t> mask(at_.pressure.size());
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = at_.pressure[k] > 0 ? 1 : 0;
  return mask;
}

Field HalfSpaceSolution::gap_field() const {
  return field([&](std::size_t k) { return at_.pressure[k] > 0 ? 0.0 : std::max(0.0, at_.gap[k]); });
}

Field HalfSpaceSolution::displacement_field() const {
  Field u = field([&](std::size_t k) { return displacement(k); });
  if (!problem_.overhangs) return u;
  // Ground that nothing faces moves with the rest.
  const Field all = displacement_under(problem_, moving_pressures());
  for (std::size_t k = 0; k < u.size(); ++k)
    if (!faces(k)) u[k] = all[k];
  return u;
}

Field HalfSpaceSolution::lower_under_load() const {
  return lower_heights(geometry(), limit(), deformation());
}

Field HalfSpaceSolution::upper_under_load() const {
  return upper_heights(geometry(), limit(), deformation());
}

}  // namespace asperity
