// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of an elastic layer of thickness t on a rigid base under a wave of pressure, as a share of the
// half-space's 2/(E*|q|). With x = |q| t and a = 3 − 4ν the share is
//   bonded base        (a sinh 2x − 2x) / (a cosh 2x + 2x² + (1 + a²)/2)
//   frictionless base  (cosh 2x − 1) / (sinh 2x + 2x)
// (Johnson 1985 §5.8; plane strain of each wave) and tends to 1 as x grows. A uniform pressure compresses
// the layer without lateral strain: K(0) = t (1+ν)(1−2ν)/(E (1−ν)) on either base. Long waves tend to K(0)
// on a bonded base, and to t (1−ν²)/E on a frictionless base. For ν = 1/2, K(0) = 0 and K ~ q² t³ on a
// bonded base.
#pragma once

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/scene/elastic_model.hpp"

namespace asperity {

enum class LayerBase { bonded, frictionless };

struct ElasticLayer {
  double thickness = 0;  // m
  double poisson = 0;    // in (-1, 0.5]
  LayerBase base = LayerBase::bonded;
};

// At x = |q| t in [0, ∞]: in [0, 1], 0 at x = 0, relative error about 1e-15.
double layer_share(double x, double poisson, LayerBase base);

WaveShare wave_share(const ElasticLayer& layer);

// K(0) E*/t = (1 − 2ν)/(1 − ν)², E* of the layer alone.
double uniform_share(double poisson);

// Lower body: the layer; upper body: rigid. Solved as a half-space with another multiplier.
struct LayerOptions {
  double thickness = 0;  // m, > 0
  LayerBase base = LayerBase::bonded;
  static const ElasticModel& model();
};

}  // namespace asperity
