// SPDX-License-Identifier: GPL-3.0-or-later
// Two rough bodies on boxes and half-spaces, elasticity alone, on one thread for complete counts.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::counted_scenes {

inline constexpr double never = std::numeric_limits<double>::infinity();
inline constexpr double hardness = 0.15, pressed = 0.01, tolerance = 1e-8;

using Names = std::vector<std::string>;
inline bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct Bench {
  const char* name;
  Boundary boundary;
  Elasticity elasticity;
};
inline const std::vector<Bench> benches = {{"boxes", Boundary::free, BoxOptions{3.0}},
                                           {"periodic half-space", Boundary::periodic, HalfSpaceOptions{}},
                                           {"free half-space", Boundary::free, HalfSpaceOptions{}}};

inline Surface rough(std::uint64_t seed, int cells = 48) {
  SelfAffineOptions options = test::self_affine(make_grid(cells, cells, 1, 1), 0.8, 8.0 / cells, seed);
  options.rms_slope = 0.1;
  return self_affine_surface(options).with_material(test::elastic(1, 0.3));
}

inline Scene bare_scene(const Bench& bench) {
  return {rough(1), rough(2), bench.boundary, bench.elasticity, Accuracy{tolerance}};
}

class OnOneThread : public testing::Test {
 protected:
  void SetUp() override {
    threads_ = thread_count();
    set_thread_count(1);
  }
  void TearDown() override { set_thread_count(threads_); }

 private:
  int threads_ = 1;
};

}  // namespace asperity::counted_scenes
