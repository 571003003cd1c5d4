// SPDX-License-Identifier: GPL-3.0-or-later
// Small contacts for the tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/solver.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::test {

inline Surface surface_of(const Grid& grid, const std::function<double(int, int)>& height) {
  Field z(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) z(i, j) = height(i, j);
  return Surface(grid, std::move(z));
}

// Cells of 1 m x 1 m.
inline Surface row_of(const std::vector<double>& heights) {
  const auto n = static_cast<int>(heights.size());
  return surface_of(Grid{n, 1, static_cast<double>(n), 1.0},
                    [&](int i, int) { return heights[static_cast<std::size_t>(i)]; });
}

inline Surface random_surface(int nx, int ny, std::uint64_t seed, double size_x = 1, double size_y = 1) {
  const Stream stream(seed, "test heights");
  return surface_of(Grid{nx, ny, size_x, size_y},
                    [&](int i, int j) { return stream.normal(static_cast<std::uint64_t>(j * nx + i)); });
}

inline Material elastic(double young, double poisson = 0) {
  Material material;
  material.young = young;
  material.poisson = poisson;
  return material;
}

inline Scene scene_of(Surface lower, UpperBody upper, std::optional<double> stiffness = {},
                      Boundary boundary = Boundary::free) {
  return Scene{std::move(lower), std::move(upper), boundary, BoxOptions{stiffness}, Accuracy{}};
}

// Under a rigid flat.
inline Scene boxes(Surface lower, double stiffness) {
  return scene_of(std::move(lower), rigid_material(), stiffness);
}

inline std::shared_ptr<const Solver> ready(const Scene& scene) {
  check(scene);
  auto geometry = std::make_shared<const ContactGeometry>(
      scene, LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny));
  return make_solver(make_plan(scene, *geometry), geometry);
}

inline State press(const Scene& scene, PressBy by, double value) {
  return ready(scene)->press({by, value, {}});
}

}  // namespace asperity::test
