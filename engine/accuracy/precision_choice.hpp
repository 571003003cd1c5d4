// SPDX-License-Identifier: GPL-3.0-or-later
// In which precision the steps of a half-space solve are taken where an error is asked for and the script
// names none. What a solve hands out and certifies is in double precision either way, and in double it rounds
// the steps that may be rounded by itself. The rule and what was measured for it are here and nowhere else;
// measure again with bench_half_space.
#pragma once

#include <string>

#include "engine/contact/scene.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

// User time in single precision over that in double, for tolerances of 1e-3, 1e-5 and 1e-7, by
// bench_half_space precision=6 seeds=2 threads=1 sizes=64,128,256,512,1024 (and boundary=free) on a machine
// that others used, which moved single numbers by some 0.05, and more where a solve takes a few milliseconds:
//
//     cells      periodic            free
//      64²       1.19  0.98  0.99    1.68  1.61  1.78
//     128²       1.01  0.96  0.98    1.43  1.36  1.48
//     256²       1.00  1.02  1.01    1.39  1.30  1.39
//     512²       1.04  1.03  1.02    1.26  1.18  1.23
//     1024²      1.05  1.03  1.02    1.19  1.13   -
//
// Either takes as many transforms to these. At 512² single holds 4.2 grids of doubles where double holds 5.1
// on a periodic tile, 7.1 where it holds 7.2 on a free one, whose kernel is made anew for each gap.
struct PrecisionChoice {
  Accuracy::Precision precision = Accuracy::Precision::double_;
  std::string why;  // in a few words, for people
};

// For a solve of `scene` on the cells of `grid`. A precision named by the script stays.
PrecisionChoice choose_precision(const Scene& scene, const Grid& grid);

}  // namespace asperity
