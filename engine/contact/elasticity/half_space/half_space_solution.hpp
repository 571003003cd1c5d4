// SPDX-License-Identifier: GPL-3.0-or-later
// Common part of half-space solutions, with or without attraction. Stiffness: rise of the mean pressure with
// the approach at fixed contact set, K_FF x = 1 on the free nodes F, Σx / n (Pa/m). Capped nodes do not
// contribute; nodes past their yield pressure add 1/K_h to K.
#pragma once

#include <vector>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/solution.hpp"

namespace asperity {

class HalfSpaceSolution : public Solution {
 public:
  Certificate certificate() const override { return at_.certificate; }
  // At fixed attraction.
  double stiffness() const override;
  double mean_gap() const override;
  PressureSplit split(double threshold) const override;
  Field pressure_field() const override { return at_.pressure; }
  Field gap_field() const override;
  Field displacement_field() const override;

 protected:
  HalfSpaceSolution(PlacedContact contact, HalfSpaceProblem problem, HalfSpaceAnswer answer,
                    double attraction = 0, std::vector<double> preload = {});

  // Contact pressures less the attraction.
  virtual Field moving_pressures() const { return at_.pressure; }

  double nodes() const { return static_cast<double>(at_.pressure.size()); }
  bool faces(std::size_t k) const { return problem_.faces(k); }
  // K p of both bodies, m; small terms near a light contact.
  double displacement(std::size_t k) const {
    return at_.gap[k] + (at_.approach - (geometry().combined_range().max - (*problem_.heights)[k]));
  }
  template <class Function>
  Field field(Function function) const {
    Field result(problem_.grid.nx, problem_.grid.ny);
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = function(k);
    return result;
  }
  template <class Function>
  double sum(Function function) const {
    return block_sum(field(function).values());
  }

  HalfSpaceProblem problem_;
  HalfSpaceAnswer at_;
};

// 10 to 20 applications of K, relative accuracy about 1e-8. +∞ in full elastic contact of a periodic
// half-space (1/K(0) of a layer), 0 without free nodes.
double contact_stiffness(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, Monitor& monitor);

}  // namespace asperity
