// SPDX-License-Identifier: GPL-3.0-or-later
// Partial slip: a contact under the load P is sheared by Q < f P (f: Coulomb's coefficient). By Jäger and
// Ciavarella (1998) the tractions are q = f (p − p*), with p* the pressures of a second normal contact under
// P* = P − Q/f. The contact area under P* sticks; the rest slips. Displacement U = C f (δ(P) − δ(P*)), C the
// tangential over the normal compliance (contact/effects/tangential.hpp). Spheres: c/a = (1 − Q/(f P))^(1/3)
// (Cattaneo, Mindlin).
//
// Exact for like elastic bodies with ν = 0, or boxes, while Q rises from zero at constant P, or at falling P
// and P*. For other ν, shear along Q only and the mean compliance over directions. No history of Q, no
// yield.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/contact/solver.hpp"

namespace asperity {

struct ShearRequest {
  // One of both: Q, N on the tile; Q/(f P), 0 … 1. May be zero.
  std::optional<double> force{}, ratio{};
  double friction = 0;  // f, > 0
};

// A value, cheap to copy; thread-safe.
class PartialSlip {
 public:
  double load() const { return normal_.load(); }                // P, N on the tile
  double friction() const { return friction_; }                 // f
  double ratio() const { return ratio_; }                       // Q/(f P), 0 … 1
  double force() const { return ratio_ * friction_ * load(); }  // Q, N on the tile
  bool slides() const { return !stuck_; }                       // all slips: Q = f P

  std::int64_t stick_contacts() const { return stuck_ ? stuck_->contacts() : 0; }  // nodes
  double stick_area() const { return stuck_ ? stuck_->area() : 0; }                // m²
  double stick_fraction() const;                                                   // of the contact area
  double slip_fraction() const { return 1 - stick_fraction(); }
  double displacement() const;  // U, m, of the far bodies
  // Pa/m, d(Q/tile)/dU at this Q, as State::stiffness; 0 in full slip. First call: one linear solve.
  double stiffness() const;
  // "shear" (Pa, along Q) or "stick" (1 or 0). Throws Error{unknown_name}.
  Field field(std::string_view name) const;

  // Under P; cost() is that of the second solve, or zero.
  const State& normal() const { return normal_; }
  StateCost cost() const { return cost_; }
  std::string text() const;

 private:
  friend PartialSlip shear(const Solver& contact, const State& normal, const ShearRequest& request,
                           Monitor& monitor);
  PartialSlip(State normal, double friction, double ratio, double compliance_ratio)
      : normal_(std::move(normal)), friction_(friction), ratio_(ratio), compliance_ratio_(compliance_ratio) {}

  State normal_;
  std::optional<State> stuck_;  // under P*; none in full slip
  double friction_, ratio_, compliance_ratio_;
  StateCost cost_;
};

// Throws Error{bad_state} naming a missing effect.
bool has_tangential(const Effects& effects);
void require_tangential(const Effects& effects);

// `normal`: a state of `contact`. Throws Error{bad_state} without `tangential` or load, {bad_value} for
// `force`, `ratio` or `friction` out of range, {infeasible} if Q > f P, and as Solver::press.
PartialSlip shear(const Solver& contact, const State& normal, const ShearRequest& request,
                  Monitor& monitor = Monitor::silent());

}  // namespace asperity
