// SPDX-License-Identifier: GPL-3.0-or-later
// In which precision the steps of a half-space solve are taken where an error is asked for and the script
// names none: in single precision where that was measured to save time and the tolerance is within its reach.
// What a solve hands out and certifies is in double precision either way. The rule and what was measured for
// it are here and nowhere else; measure again with bench_half_space.
#pragma once

#include <cstdint>
#include <string>

#include "engine/contact/scene.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

// SINGLE_TABLE
inline constexpr std::int64_t fewest_nodes_for_single = std::int64_t{1024} * 1024;

// Down to this tolerance a solve takes as many transforms in either precision. At 1e-8 single precision takes
// 13 % more on a free boundary, at 1e-9 14 to 25 % more on any, and at 1e-12 nearly twice as many, for it is
// begun again in double.
inline constexpr double tightest_tolerance_for_single = 1e-7;

struct PrecisionChoice {
  Accuracy::Precision precision = Accuracy::Precision::double_;
  std::string why;  // in a few words, for people
};

// For a solve of `scene` on the cells of `grid`. A precision named by the script stays.
PrecisionChoice choose_precision(const Scene& scene, const Grid& grid, double tolerance);

}  // namespace asperity
