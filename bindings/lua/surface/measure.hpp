// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/metrology/fractal_dimension.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/metrology/spectrum.hpp"

namespace asperity::lua {

// Profile names (Ra …); for surfaces also areal names (Sa, Sq, Sz, Ssk, Sku, Sdq).
extern const RecordType<Roughness> profile_roughness_type, areal_roughness_type;
struct MeasuredSpectrum : Spectrum {
  bool areal = false;
};
extern const RecordType<MeasuredSpectrum> spectrum_type;
extern const RecordType<FractalDimension> fractal_dimension_type;

struct LevelKeys {
  int degree = 1;
};
extern const Block<SpectrumOptions> spectrum_block;
extern const Block<FractalDimensionOptions> profile_fractal_dimension_block, areal_fractal_dimension_block;
extern const Block<GaussianFilter> filter_block;
// Warns of a cut-off outside the wavelengths of this length and spacing.
void warn_of_empty_filter(const Call& call, const GaussianFilter& filter, double length, double spacing);
extern const Block<LevelKeys> level_block;

struct CutKeys {
  double fraction = 0;
};
extern const Block<CutKeys> cut_block;

}  // namespace asperity::lua
