// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of every elasticity as an operator: a wave of pressure, a uniform pressure, and the inverse.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::elastic_operator_test {
namespace {

const Grid grid{32, 24, 3e-3, 2e-3};

std::shared_ptr<const ElasticOperator> operator_of(const Elasticity& elasticity) {
  const Scene scene{test::random_surface(grid.nx, grid.ny, 1, grid.size_x, grid.size_y)
                        .with_material(test::elastic(1e9, 0.3)),
                    rigid_material(), Boundary::periodic, elasticity};
  return elasticity.model().make(elasticity.options(),
                                 ContactGeometry(scene, LatticeIsometry(grid.nx, grid.ny)));
}

const Elasticity every[] = {BoxOptions{2e12}, HalfSpaceOptions{}, LayerOptions{4e-4, LayerBase::bonded},
                            LayerOptions{4e-4, LayerBase::frictionless}};

TEST(ElasticOperator, DisplacesByItsMultiplierUnderAWave) {
  constexpr int waves = 3;
  Field p(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) p(i, j) = std::cos(2 * std::numbers::pi * waves * i / grid.nx);
  for (const Elasticity& elasticity : every) {
    const auto k = operator_of(elasticity);
    const double each = k->multiplier(2 * std::numbers::pi * waves / grid.size_x);
    EXPECT_GT(each, 0);
    const Field u = k->apply(p, grid, Boundary::periodic), back = k->inverse(u, grid);
    for (std::size_t n = 0; n < u.size(); ++n) {
      EXPECT_NEAR(u[n], each * p[n], 1e-12 * each) << k->model.name;
      EXPECT_NEAR(back[n], p[n], 1e-12) << k->model.name;
    }
  }
}

TEST(ElasticOperator, SinksByItsComplianceUnderAUniformPressure) {
  const Field p(grid.nx, grid.ny, 1e6);
  for (const Elasticity& elasticity : every) {
    const auto k = operator_of(elasticity);
    const double sinks = 1e6 * k->compliance_of_mean();
    const double scale = sinks + 1e6 * k->multiplier(2 * std::numbers::pi / grid.size_x);
    const Field u = k->apply(p, grid, Boundary::periodic);
    for (const double each : u.values()) EXPECT_NEAR(each, sinks, 1e-12 * scale) << k->model.name;
  }
}

TEST(ElasticOperator, OfRigidBodiesDisplacesNothing) {
  const auto k = operator_of(RigidOptions{});
  EXPECT_TRUE(k->is_local());
  EXPECT_EQ(k->multiplier(1), 0);
  EXPECT_EQ(k->compliance_of_mean(), 0);
}

}  // namespace
}  // namespace asperity::elastic_operator_test
