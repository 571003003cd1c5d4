// SPDX-License-Identifier: GPL-3.0-or-later
// Removal of form: the polynomial in x and y that fits the heights best by least squares is
// subtracted. Degree 0 is the mean, 1 the plane (line), 2 the quadratic form, and so on; a surface's
// polynomial has every term x^a y^b with a + b up to the degree. The fit uses polynomials that are
// orthonormal on the nodes themselves (Gram-Schmidt), applied twice, so that a polynomial
// of that degree is removed to rounding whatever its size. It is not robust: outliers pull the fit.
// Of a map with holes the fit is to the nodes that were measured, by the normal equations in polynomials
// that are orthonormal on the smallest rectangle around them, solved repeatedly for what remains.
#pragma once

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

inline constexpr int max_levelling_degree = 5;

// The material stays. Above degree 0 the result is not periodic any more and its share of variance
// past Nyquist is not known. A direction with too few nodes for the degree uses the degree that it
// can carry, and what the measured nodes of a map with holes cannot tell apart is taken away once. Cost
// O(nodes · degree), with holes O(nodes · degree⁴); one copy of the grid. Same bits for any number of
// threads. Throws Error{bad_value} naming `degree` outside 0 … 5.
Surface levelled(const Surface& surface, int degree = 1);
// Also refuses a closed outline above degree 0: it has no ends between which to tilt.
Profile levelled(const Profile& profile, int degree = 1);

}  // namespace asperity
