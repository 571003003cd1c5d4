// SPDX-License-Identifier: GPL-3.0-or-later
// One height of a Weierstrass–Mandelbrot surface (surface/generators/weierstrass_mandelbrot.hpp) to the last
// digit of a double: the sum of its definition in as many bits as its highest wave number has, and 128 more.
// It shares nothing with the generator but the draw of the phases. Slow: one cosine of thousands of bits a
// wave.
#pragma once

#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

namespace asperity::exact {

// Height of node (i, j) in m, for seeded or golden phases and the whole band; what the options hold of
// `ny`, `band`, `phase_function` and `material` does not enter. O(M n_max) cosines. Throws Error{bad_value}
// for phases given as a function.
double weierstrass_mandelbrot_height(const WeierstrassMandelbrotOptions& options, int i, int j);

}  // namespace asperity::exact
