// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest pressures that respect their bounds and carry the load: p = clip(y + λ, 0, H), Σ p = load,
// with λ the root of a monotone, piecewise linear function, found by safeguarded Newton steps. Values
// at 0 and H stay exactly there. Also restricted to some nodes, the others only clipped.
#pragma once

#include <cstdint>
#include <span>

namespace asperity {

// `target` may be `y`. `shift_where`: nodes that λ moves (1), or empty for all. Σ p = load to a few ulps of
// the sum. Returns false, `target` untouched, where the marked nodes cannot carry the load between the
// bounds. Precondition: 0 <= load <= upper·nodes for the whole grid.
bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> shift_where, double upper,
                     double load, std::span<double> target);

}  // namespace asperity
