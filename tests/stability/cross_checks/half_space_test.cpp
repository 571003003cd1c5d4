// SPDX-License-Identifier: GPL-3.0-or-later
// The half-space solver against the dense direct solution.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/stability/cross_checks/dense_contact.hpp"
#include "tests/stability/properties/scene.hpp"

namespace asperity::stability::half_space_test {
namespace {

DenseProblem dense(const Trial& trial, const State& state) {
  const ContactGeometry& geometry = state.geometry();
  const std::span<const double> h = geometry.combined().values();
  DenseProblem problem;
  problem.grid = geometry.grid();
  problem.boundary = geometry.boundary();
  problem.modulus = contact_modulus(geometry, {}, {}, {});
  problem.heights.resize(static_cast<Eigen::Index>(h.size()));
  // Subtracting the highest node keeps the digits of light contacts.
  const double highest = geometry.combined_range().max;
  for (std::size_t k = 0; k < h.size(); ++k) problem.heights[static_cast<Eigen::Index>(k)] = h[k] - highest;
  problem.cap = trial.cap();
  if (trial.hardens()) {
    problem.yield = trial.hardness();
    problem.hardening = trial.scene.effects.find<PlasticityOptions>()->hardening;
  }
  return problem;
}

class AgainstDense : public testing::TestWithParam<int> {};

TEST_P(AgainstDense, PressuresAndApproachAgree) {
  constexpr int scenes = 250;                             // per seed
  constexpr double pressures = 2e-9, approaches = 1e-10;  // measured 4.6e-10 of the peak and 1.1e-11
  const Wanted wanted{.model = Wanted::Model::half_space,
                      .tolerance = 1e-12,
                      .lightest = 1e-6,
                      .heaviest = 3,
                      .most_cells = 24};
  const auto seed = static_cast<std::uint64_t>(GetParam());
  int compared = 0;
  for (std::uint64_t n = 0; n < scenes; ++n) {
    Trial trial = draw_trial(seed, n, wanted);
    trial.scene.accuracy.on_failure = Accuracy::OnFailure::best;
    const State state = SpecimenPair(trial.scene).press({PressBy::pressure, trial.pressure, {}});
    const DenseProblem problem = dense(trial, state);
    const DenseAnswer answer = solve_densely(problem, trial.pressure);
    if (!answer.solved && trial.hardens()) continue;  // cycling: one scene in a thousand
    ASSERT_TRUE(answer.solved) << script(trial, "the dense solver goes round in circles", "");
    const Field& p = *state.field("pressure");
    const double peak = answer.pressure.maxCoeff();
    double worst = 0;
    for (std::size_t k = 0; k < p.size(); ++k)
      worst = std::max(worst, std::abs(p[k] - answer.pressure[static_cast<Eigen::Index>(k)]));
    EXPECT_LE(worst, pressures * peak)
        << script(trial, "seed " + std::to_string(seed) + ", scene " + std::to_string(n), "");
    // A periodic flat has no approach; one cell's displacement sets the scale.
    const double length =
        std::abs(answer.offset) + peak * std::sqrt(trial.scene.lower.grid().cell_area()) / problem.modulus;
    EXPECT_NEAR(state.approach(), answer.offset, approaches * length) << n;
    ++compared;
  }
  EXPECT_GE(compared, scenes - 2);
}
INSTANTIATE_TEST_SUITE_P(Seeds, AgainstDense, testing::Values(1, 2, 3, 4),
                         [](const auto& seed) { return "Seed" + std::to_string(seed.param); });

}  // namespace
}  // namespace asperity::stability::half_space_test
