// SPDX-License-Identifier: GPL-3.0-or-later
// Partial slip: a contact under the load P is pulled sideways by Q < f P, f Coulomb's coefficient. By Jäger
// and Ciavarella (1998) it is the difference of two normal contacts of the same bodies: the shear tractions
// are q = f (p − p*), with p* the pressures under the load P* = P − Q/f. What touches under P* sticks; the
// rest of the contact slips. The bodies shift by U = C f (δ(P) − δ(P*)), where C is the tangential over the
// normal compliance (contact/effects/tangential.hpp): one more normal solve and nothing else. For spheres it
// is Cattaneo's and Mindlin's solution, c/a = (1 − Q/(f P))^(1/3).
//
// Exact for elastic bodies of Poisson's ratio zero that are alike (or for boxes), the load held and Q raised
// from zero; also where P falls meanwhile, as long as P* falls too. For other ratios the shear is taken to
// point along Q everywhere and the compliance as the mean over directions. No history of Q, no yield.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/contact/solver.hpp"

namespace asperity {

struct ShearRequest {
  // One of both: Q, N on the tile, or Q/(f P), 0 … 1. Both may be zero.
  std::optional<double> force{}, ratio{};
  double friction = 0;  // f, > 0
};

// A contact under load that is pulled sideways. A value, cheap to copy; thread-safe.
class PartialSlip {
 public:
  double load() const { return normal_.load(); }                // P, N on the tile
  double friction() const { return friction_; }                 // f
  double ratio() const { return ratio_; }                       // Q/(f P), 0 … 1
  double force() const { return ratio_ * friction_ * load(); }  // Q, N on the tile
  bool slides() const { return !stuck_; }                       // all of the contact slips: Q = f P

  std::int64_t stick_contacts() const { return stuck_ ? stuck_->contacts() : 0; }  // nodes
  double stick_area() const { return stuck_ ? stuck_->area() : 0; }                // m²
  double stick_fraction() const;                                                   // of the contact area
  double slip_fraction() const { return 1 - stick_fraction(); }
  double displacement() const;  // U, m: of the far parts of the bodies over each other
  // Pa/m, d(Q/tile)/dU at this Q, as State::stiffness is of the load; 0 where all slips. One linear solve
  // when first asked.
  double stiffness() const;
  // "shear" (Pa, along Q) or "stick" (1 or 0). Throws Error{unknown_name}.
  Field field(std::string_view name) const;

  // The contact under P, and what the second solve cost; nothing where none was needed.
  const State& normal() const { return normal_; }
  StateCost cost() const { return cost_; }
  std::string text() const;

 private:
  friend PartialSlip shear(const Solver& contact, const State& normal, const ShearRequest& request,
                           Monitor& monitor);
  PartialSlip(State normal, double friction, double ratio, double compliance_ratio)
      : normal_(std::move(normal)), friction_(friction), ratio_(ratio), compliance_ratio_(compliance_ratio) {}

  State normal_;
  std::optional<State> stuck_;  // under P*; none where all slips
  double friction_, ratio_, compliance_ratio_;
  StateCost cost_;
};

// Whether a scene computes partial slip; require_tangential throws Error{bad_state} naming the effect where
// it does not.
bool has_tangential(const Effects& effects);
void require_tangential(const Effects& effects);

// `normal` must be a state of `contact`. Throws Error{bad_state} without the effect `tangential` or without
// load, Error{bad_value} naming `force`, `ratio` or `friction` out of range, Error{infeasible} where Q > f P:
// it slides; and what Solver::press throws.
PartialSlip shear(const Solver& contact, const State& normal, const ShearRequest& request,
                  Monitor& monitor = Monitor::silent());

}  // namespace asperity
