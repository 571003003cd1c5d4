// SPDX-License-Identifier: GPL-3.0-or-later
// Subtracts the least-squares polynomial of terms x^a y^b, a + b <= degree (0 mean, 1 plane or line, 2
// quadratic …). The fit, in polynomials orthonormal on the nodes, runs twice to reach rounding; with holes,
// normal equations. Not robust against outliers.
#pragma once

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

inline constexpr int max_levelling_degree = 5;

// The material stays; above degree 0, periodicity and aliased share do not. Few nodes lower the degree; with
// holes, indistinguishable combinations are left out. Cost O(nodes · degree), with holes O(nodes · degree⁴);
// one grid copy. Throws Error{bad_value} naming `degree` outside 0 … 5.
Surface levelled(const Surface& surface, int degree = 1);
// Refuses a closed outline above degree 0: no ends.
Profile levelled(const Profile& profile, int degree = 1);

}  // namespace asperity
