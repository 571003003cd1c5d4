// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian filters of ISO 16610-21 (profiles) and -61 (surfaces): waves shorter than `short_wave` (λs, S) or
// longer than `long_wave` (λc, L) are attenuated, by half at the cut-off. The mean line transmits wavelength
// λ by
//
//   exp(-π (α λc/λ)²) = 2^-(λc/λ)²,  α = √(ln 2 / π);
//
// long_wave subtracts the line, short_wave returns it. `robust` (ISO 16610-31, -71, degree 0) resists
// scratches and spikes: Tukey's biweight of residuals r, (1 - (r/c)²)² within c = 4.4478 median |r|, until c
// changes by less than 1e-4 relative.
//
// Periodic data uses the transfer function; other data the sampled Gaussian, cut at 1e-16, at rims and holes
// scaled to unit weight (slopes bend there). Cut-offs below two cells transmit more short waves than the
// standard.
#pragma once

#include <optional>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct GaussianFilter {
  std::optional<double> short_wave;  // m, > 0
  std::optional<double> long_wave;   // m, > short_wave; infinite: none
  bool robust = false;               // mean line of long_wave
};

// Cost O(nodes · log n), two grid copies (`robust`: five to fifteen times two filters, three more copies).
// Material, periodicity and holes stay. With long_wave the mean is 0 (about 0 if not periodic). Thread-safe.
// Throws Error{bad_value} naming a missing, non-positive or unordered cut-off, or `robust` without long_wave;
// Error{not_converged} if the robust line does not settle or passes exactly through over half of the heights.
Surface gaussian_filtered(const Surface& surface, const GaussianFilter& filter);
Profile gaussian_filtered(const Profile& profile, const GaussianFilter& filter);

}  // namespace asperity
