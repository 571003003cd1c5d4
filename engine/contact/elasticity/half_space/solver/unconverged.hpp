// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a half-space solve that did not come as close as it was asked to.
#pragma once

#include <string>

#include "engine/contact/certificate.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

// Throws Error{not_converged}: what was reached under the mean pressure [Pa] after so many applications of
// the half-space, and what would work.
[[noreturn]] void throw_unconverged(double mean_pressure, const Certificate& reached, double tolerance,
                                    int applications, const Grid& grid);

// What would work; names cells that are much longer than wide, which converge badly.
std::string unconverged_hint(const Grid& grid);

}  // namespace asperity
