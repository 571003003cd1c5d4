// SPDX-License-Identifier: GPL-3.0-or-later
// The Gaussian filters of ISO 16610-21 (profiles) and ISO 16610-61 (surfaces): waves shorter than
// `short_wave` (the nesting index S, λs) and longer than `long_wave` (L, λc) are attenuated, each by
// half at its cut-off. The mean line of cut-off λc keeps the share
//
//   exp(-π (α λc/λ)²) = 2^-(λc/λ)²,  α = √(ln 2 / π),
//
// of a wave of length λ in any direction; long_wave subtracts that mean line, short_wave keeps it.
// The filter does not remove form (see levelling.hpp). It is linear unless `robust` is asked for: then the
// mean line that long_wave subtracts follows the bulk of the heights and not its deep scratches or high
// spikes (ISO 16610-31, ISO 16610-71, the Gaussian regression of degree 0): heights are weighted by Tukey's
// biweight of their residuals, (1 - (r/c)²)² within c = 4.4478 median |r|, and again until c moves by less
// than 1e-4 of itself.
//
// Periodic surfaces and closed outlines are filtered by that transfer function itself, two
// transforms in all. Elsewhere heights are convolved with the sampled Gaussian, and at the rim the
// part of it that lies outside is left out and the rest scaled to unit weight: a constant stays what
// it is, a slope bends within half a cut-off of the rim. The kernel is cut where it has fallen under
// 1e-16. Sampled, a cut-off under about two cells passes more of the shortest waves than the standard
// says.
//
// Points of a map that were not measured have no weight, and the rest is scaled to unit weight as at a rim,
// on a periodic surface too, whose filter is then divided by that of 1 where measured and 0 where not: a
// slope bends beside a hole. They stay not measured.
#pragma once

#include <optional>

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct GaussianFilter {
  std::optional<double> short_wave;  // m, > 0
  std::optional<double> long_wave;   // m, > short_wave; infinite means none
  bool robust = false;               // the mean line of long_wave
};

// The mean line keeps the share 2^-(cut_off/wavelength)² of a wave. Cost O(nodes · log n) for any cut-offs,
// by zero-padded transforms of rows, then columns; two copies of the grid. Material and periodicity stay.
// With a long_wave the mean of a periodic result is 0; elsewhere about 0. Same bits for any number of
// threads; thread-safe. A robust mean line costs two filters an iteration, five to fifteen of them, and three
// more copies of the grid. Throws Error{bad_value} naming `short_wave` or `long_wave` when neither is given,
// one is not positive, short_wave is not below long_wave, or `robust` is asked for without a long_wave;
// Error{not_converged} for heights whose robust mean line keeps moving, or of which more than half lie
// exactly on it.
Surface gaussian_filtered(const Surface& surface, const GaussianFilter& filter);
Profile gaussian_filtered(const Profile& profile, const GaussianFilter& filter);

}  // namespace asperity
