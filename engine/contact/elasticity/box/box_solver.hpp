// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements under a plane: P_i = k δ_i with δ_i = max(0, d − (h_max − h_i)), one box per node, no shear
// between boxes (Hanaor, Gan & Einav 2013, there with k = E/A and ν = 0). The mean pressure is piecewise
// linear in the depth d: every prescribed quantity has a closed form, also past full contact. No volume is
// conserved.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/solver.hpp"

namespace asperity {

class YieldingElements;

class BoxSolution : public Solution {
 public:
  double flatten() const override {
    const double height = drops().peak_to_valley();
    return height > 0 ? std::min(1.0, approach() / height) : 0.0;
  }
  double mean_gap() const override {
    return drops().remaining_gap(approach()) / static_cast<double>(drops().size());
  }

 protected:
  BoxSolution(PlacedContact contact, std::shared_ptr<const SortedDrops> drops, Numbers numbers)
      : Solution(std::move(contact), std::move(numbers)), drops_(std::move(drops)) {}

  const SortedDrops& drops() const { return *drops_; }
  double modulus() const { return plan().elasticity->modulus; }
  double approach() const { return numbers().approach; }
  // All nodes; elements exist only at facing nodes.
  double nodes() const { return static_cast<double>(geometry().grid().nodes()); }
  double cell() const { return geometry().grid().cell_area(); }

 private:
  std::shared_ptr<const SortedDrops> drops_;
};

class BoxSolver final : public Solver {
 public:
  // O(n) once (a sort); a press costs O(log n).
  BoxSolver(const Plan& plan, double reference_pressure, std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Besides check(PressRequest), refuses pressures in (0, 1e-280 moduli), overflow of approach or peak, and
  // `indentation` or `flatten` of equal heights.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  Solution::Numbers resolve(const PressRequest& request) const;

  double reference_pressure_;  // Pa; much smaller loads are refused
  std::shared_ptr<const SortedDrops> drops_;
};

// Yielding boxes and rigid elements under a plane (yielding_elements.hpp). Rigid elements with a single yield
// pressure H are the bearing model of Abbott and Firestone (1933): contact area = load / H.
class YieldingBoxSolver final : public Solver {
 public:
  // Finite hardness. O(n) once (a sort); a press O(log n), on hardened bodies O(n log n).
  YieldingBoxSolver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry);

  using Solver::press;
  // Besides check(PressRequest), refuses mean pressures at or above the hardness without hardening
  // (Error{infeasible}), or in (0, 1e-280 hardness), overflow of depth or energy, and `indentation` or
  // `flatten` of equal heights.
  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  class UnderLoad;  // the Solution
  std::shared_ptr<const YieldingElements> elements(const YieldLaw& law) const;

  MetMemory hardness_;  // empty before the first event
  std::shared_ptr<const SortedDrops> drops_;
  std::shared_ptr<const YieldingElements> alike_;  // with one yield pressure
};

}  // namespace asperity
