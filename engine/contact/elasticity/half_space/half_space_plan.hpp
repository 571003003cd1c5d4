// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic half-space, and bodies whose compliance differs from it wave by wave, as an operator: modulus,
// split of the displacement, memory and cost.
#pragma once

#include <optional>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/scene/elastic_model.hpp"

namespace asperity {

struct HalfSpaceOptions {
  static const ElasticModel& model();
};

// Multiplier 2/(E*|q|) or a share (periodic), Love's kernel (free).
class HalfSpaceOperator final : public ElasticOperator {
 public:
  // Throws Error{bad_state} naming effect and body for a missing `young` or `poisson`, or two rigid bodies.
  HalfSpaceOperator(const ElasticModel& of, const ContactGeometry& geometry);

  std::optional<WaveShare> share;  // periodic tiles only; none: a half-space

  double multiplier(double q) const override;
  double compliance_of_mean() const override;
  const WaveShare* wave_share() const override { return share ? &*share : nullptr; }
  Field apply(const Field& pressure, const Grid& grid, Boundary boundary) const override;
  Field inverse(const Field& displacement, const Grid& grid) const override;
  void plan(const ContactGeometry& geometry, Plan& plan) const override;
  std::shared_ptr<const Solver> solver(const Plan& plan,
                                       std::shared_ptr<const ContactGeometry> geometry) const override;

 private:
  HalfSpaceCompliance in_cells_of(const Grid& grid, Boundary boundary, bool with_mean) const;
};

}  // namespace asperity
