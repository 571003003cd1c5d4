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

// User time in single precision over that in double, for tolerances of 1e-3, 1e-5 and 1e-7, by
// bench_half_space precision=6 seeds=2 threads=1 (and boundary=free) on a machine that others used, which
// moved single numbers by some 0.05, and more where a solve takes a few milliseconds:
//
//     cells      periodic            free
//      64²       1.08  1.35  0.94    1.33  1.54  1.48
//     128²       1.04  0.98  1.06    1.32  1.37  1.49
//     256²       1.12  0.94  0.99    1.29  1.15  1.13
//     512²       1.01  0.93  0.89    1.04  1.00  0.98
//     1024²      0.95  0.89  0.86    0.99  0.89  0.89
//
// A tenth is saved from the last on; before it, what is saved is lost in what the timings differ by.
inline constexpr std::int64_t fewest_nodes_for_single = std::int64_t{1024} * 1024;

// Down to this tolerance a solve takes as many transforms in either precision. At 1e-8 single precision takes
// 8 to 14 % more on a free boundary, at 1e-9 12 to 25 % more on any, and at 1e-12 mostly nearly twice as
// many, for it is begun again in double.
inline constexpr double tightest_tolerance_for_single = 1e-7;

struct PrecisionChoice {
  Accuracy::Precision precision = Accuracy::Precision::double_;
  std::string why;  // in a few words, for people
};

// For a solve of `scene` on the cells of `grid`. A precision named by the script stays.
PrecisionChoice choose_precision(const Scene& scene, const Grid& grid, double tolerance);

}  // namespace asperity
