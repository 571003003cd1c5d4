// SPDX-License-Identifier: GPL-3.0-or-later
// Methods shared by surfaces and profiles: roughness, spectrum, fractal dimension, levelling, filtering.
#pragma once

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/metrology/fractal_dimension.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/metrology/spectrum.hpp"

namespace asperity::lua {

// Profile names (Ra …); for surfaces also areal names (Sa, Sq, Sz, Ssk, Sku, Sdq).
const RecordType<Roughness>& roughness_type(bool areal);
struct MeasuredSpectrum : Spectrum {
  bool areal = false;
};
const RecordType<MeasuredSpectrum>& spectrum_type();
const RecordType<FractalDimension>& fractal_dimension_type();

struct LevelKeys {
  int degree = 1;
};
const Block<SpectrumOptions>& spectrum_block();
const Block<FractalDimensionOptions>& fractal_dimension_block(bool surface);
const Block<GaussianFilter>& filter_block();
// Warns of a cut-off outside the wavelengths of heights with this length and spacing.
void warn_of_empty_filter(const Call& call, const GaussianFilter& filter, double length, double spacing);
const Block<LevelKeys>& level_block();

struct CutKeys {
  double fraction = 0;
};
const Block<CutKeys>& cut_block();

}  // namespace asperity::lua
