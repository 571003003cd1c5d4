// SPDX-License-Identifier: GPL-3.0-or-later
// The measuring methods that surfaces and profiles share: roughness, spectrum, fractal dimension,
// levelling and filtering, each with one option block.
#pragma once

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/metrology/fractal_dimension.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/metrology/spectrum.hpp"

namespace asperity::lua {

// Profile names (Ra …), and on surfaces also the areal ones (Sa, Sq, Sz, Ssk, Sku, Sdq).
Record roughness_record(const Roughness& roughness, bool areal);
Record spectrum_record(const Spectrum& spectrum, bool areal);
Record fractal_dimension_record(const FractalDimension& result);

struct LevelKeys {
  int degree = 1;
};
const Block<SpectrumOptions>& spectrum_block();
const Block<FractalDimensionOptions>& fractal_dimension_block(bool surface);
const Block<GaussianFilter>& filter_block();
// Warns of a cut-off that lies past every wave that heights of this length and spacing can carry.
void warn_of_empty_filter(const Call& call, const GaussianFilter& filter, double length, double spacing);
const Block<LevelKeys>& level_block();

// `fraction` of cut{fraction=}.
struct CutKeys {
  double fraction = 0;
};
const Block<CutKeys>& cut_block();

}  // namespace asperity::lua
