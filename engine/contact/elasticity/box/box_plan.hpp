// SPDX-License-Identifier: GPL-3.0-or-later
// Box elements (pressure = stiffness · shortening, node by node) and of rigid bodies, which deform
// only by yielding. Shares of the shortening: lower_elastic_share().
//
// stiffness: as given, or E*/(peak-to-valley of the combined heights as placed), which needs `young` and
// `poisson` of every body that is not rigid, and unequal heights.
#pragma once

#include "engine/contact/scene/elastic_model.hpp"

namespace asperity {

struct BoxOptions {
  // Pa/m; default as above.
  std::optional<double> stiffness;
  static const ElasticModel& model();
};

// The scene must limit the pressure.
struct RigidOptions {
  static const ElasticModel& model();
};

// u = p / stiffness at each node; infinite stiffness: rigid.
class BoxOperator final : public ElasticOperator {
 public:
  BoxOperator(const ElasticModel& of, double stiffness, double reference);

  double reference_pressure;  // Pa; much smaller loads are refused

  double multiplier(double) const override { return 1 / modulus; }
  double compliance_of_mean() const override { return 1 / modulus; }
  Field apply(const Field& pressure, const Grid& grid, Boundary boundary) const override;
  Field inverse(const Field& displacement, const Grid& grid) const override;
  void plan(const ContactGeometry& geometry, Plan& plan) const override;
  void plan_after_effects(const ContactGeometry& geometry, Plan& plan) const override;
  std::shared_ptr<const Solver> solver(const Plan& plan,
                                       std::shared_ptr<const ContactGeometry> geometry) const override;
};

}  // namespace asperity
