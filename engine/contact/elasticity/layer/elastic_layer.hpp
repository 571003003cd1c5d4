// SPDX-License-Identifier: GPL-3.0-or-later
// An elastic layer of thickness t on a rigid base: how far its surface sinks under a wave of pressure, beside
// a half-space of the same material, whose compliance is 2/(E*|q|). With x = |q| t and a = 3 − 4ν the share
// is
//   bonded base        (a sinh 2x − 2x) / (a cosh 2x + 2x² + (1 + a²)/2)
//   frictionless base  (cosh 2x − 1) / (sinh 2x + 2x)
// (Johnson 1985 §5.8; plane strain of each wave). It goes to 1 as x grows. A uniform pressure compresses the
// layer without lateral strain, K(0) = t (1+ν)(1−2ν)/(E (1−ν)), on either base. Long waves on a bonded base
// come to that; on a frictionless one, where the layer gives way sideways under a wave, to t (1−ν²)/E, which
// is more. Of Poisson's ratio 1/2 K(0) is 0, and on a bonded base K goes as q² t³.
#pragma once

#include "engine/contact/elastic_model.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"

namespace asperity {

enum class LayerBase { bonded, frictionless };

struct ElasticLayer {
  double thickness = 0;  // m
  double poisson = 0;    // in (-1, 0.5]
  LayerBase base = LayerBase::bonded;
};

// The share at x = |q| t >= 0, in [0, 1]; 0 at x = 0. To some 1e-15 of itself at any x, infinity included.
double layer_share(double x, double poisson, LayerBase base);

// As a solver of the half-space takes it.
WaveShare wave_share(const ElasticLayer& layer);

// K(0) E*/t = (1 − 2ν)/(1 − ν)², E* being that of the layer alone.
double uniform_share(double poisson);

// A contact on an elastic layer: what a scene may ask of one, and what it adds to a plan. The layer is the
// lower body, of its material, on a rigid base; what presses on it is rigid. The solver is that of the
// half-space with another multiplier.
struct LayerOptions {
  double thickness = 0;  // m, > 0
  LayerBase base = LayerBase::bonded;
  static const ElasticModel& model();
};

}  // namespace asperity
