// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/surface/measure.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/text.hpp"
#include "engine/metrology/levelling.hpp"

namespace asperity::lua {

namespace {
constexpr const char* measured_sentence =
    "how many points were measured, the others left out; nil where every point was";

std::vector<RecordField<Roughness>> roughness_fields(bool areal) {
  using R = Roughness;
  std::vector<RecordField<R>> fields{
      {"Ra", &R::Ra, dimension::length, "mean magnitude of the heights about their mean"},
      {"Rq", &R::Rq, dimension::length, "root mean square of the heights about their mean"},
      {"amplitude", &R::amplitude, dimension::length, "peak to valley"},
      {"skewness", &R::skewness, "of the heights; 0 where all are equal"},
      {"kurtosis", &R::kurtosis, "of the heights; 3 of Gaussian ones, 0 where all are equal"},
      {"rms_slope", &R::rms_slope,
       "root mean square slope between neighbouring nodes, never across the rim; where points were not "
       "measured, of the pairs along each direction that were, nan where there is none"},
      {"peak", &R::peak, dimension::length, "the greatest height, as stored"},
      {"valley", &R::valley, dimension::length, "the least height, as stored"},
      {"mean", &R::mean, dimension::length, "of the heights, as stored"}};
  if (areal)
    fields.insert(fields.end(), {{"Sa", &R::Ra, dimension::length, "Ra by its areal name"},
                                 {"Sq", &R::Rq, dimension::length, "Rq by its areal name"},
                                 {"Sz", &R::amplitude, dimension::length, "amplitude by its areal name"},
                                 {"Ssk", &R::skewness, "skewness by its areal name"},
                                 {"Sku", &R::kurtosis, "kurtosis by its areal name"},
                                 {"Sdq", &R::rms_slope, "rms_slope by its areal name"}});
  fields.emplace_back("measured", &R::measured, measured_sentence);
  return fields;
}

std::vector<Option<FractalDimensionOptions>> fractal_dimension_options() {
  using O = FractalDimensionOptions;
  return {
      choice("method", &O::method,
             {{"length", DimensionMethod::length},
              {"psd", DimensionMethod::psd},
              {"structure", DimensionMethod::structure},
              {"box", DimensionMethod::box},
              {"madogram", DimensionMethod::madogram}},
             "profile length (the paper's eq. 3), spectrum (mean power in half-octave bands), structure "
             "function, box counting or madogram; the `lengths` of the result are what the method measures "
             "at each of its `steps`, profile lengths by \"length\" alone; \"psd\" and \"box\" refuse points "
             "not measured"),
      integers("steps", &O::steps, 2, 1 << 30, "steps in samples, e.g. {1, 2, 4, 8, 16}")
          .defaults_to("{1, 2, 4, 8, 16}"),
      flag("offsets", &O::offsets, "method length: average over all starting points"),
      quantity("tip", &O::tip, dimension::length, above(0),
               "radius of the tip that traced it: steps below its reliability cut-off are not believed"),
      flag("pooled", &O::pooled,
           "one line through the average over profiles instead of the mean of each one's D"),
      flag("wrap", &O::wrap, "steps continue across the rim").defaults_to("false"),
  };
}

}  // namespace

const RecordType<Roughness> profile_roughness_type{
    "Roughness", "roughness", "Amplitude and slope statistics of a profile (ISO 21920-2).",
    roughness_fields(false)};
const RecordType<Roughness> areal_roughness_type{"ArealRoughness", "roughness",
                                                 "Amplitude and slope statistics of a surface (ISO 25178-2).",
                                                 roughness_fields(true)};

const RecordType<MeasuredSpectrum> spectrum_type{
    "Spectrum",
    "spectrum",
    "Power spectral density, one entry of each list a shell of waves that holds any, by rising q.",
    {{"q", &MeasuredSpectrum::q, "wave number of each shell, rad/m: the mean over its waves"},
     {"C", &MeasuredSpectrum::C, "power spectral density of each shell, m^4 of a surface, m^3 of a profile"},
     {"count", &MeasuredSpectrum::count, "waves of each shell, those of both signs counted"},
     {"rms_height", &MeasuredSpectrum::rms_height, dimension::length,
      "root of the power of all waves: Rq without a window"},
     {"rms_slope", &MeasuredSpectrum::rms_slope,
      "root mean square slope of the waves that interpolate the heights"},
     {"measured", &MeasuredSpectrum::measured, measured_sentence},
     {"window",
      [](const MeasuredSpectrum& s) {
        constexpr std::array windows = {"automatic", "none", "hann"};
        return windows[static_cast<std::size_t>(s.window)];
      },
      "the taper that was used, \"none\" or \"hann\""},
     {"units",
      [](const MeasuredSpectrum& s) { return s.areal ? "q in rad/m, C in m^4" : "q in rad/m, C in m^3"; },
      "of q and C, in words"}}};

const RecordType<FractalDimension> fractal_dimension_type{
    "FractalDimension",
    "fractal dimension",
    "The fractal dimension of profiles, and the data of the fit. For exact fractional Brownian profiles of "
    "D = 1.1, 1.5 and 1.9 the methods find, on 150 samples: structure and madogram 1.15, 1.50, 1.92; psd "
    "0.99, 1.49, 2.15; box 1.06, 1.27, 1.53; length of steep heights 1.14, 1.49, 1.92. On 8000: structure "
    "and madogram 1.12, 1.50, 1.90; psd 1.05, 1.50, 1.96; box 1.07, 1.39, 1.70; length of steep heights "
    "1.11, 1.49, 1.91.",
    {{"D", &FractalDimension::D, "fractal dimension of the profiles, from 1 to 2"},
     {"error", &FractalDimension::error,
      "standard deviation of D over the profiles, of one, standard error of its line; with \"box\" the bias "
      "of counting boxes too, as measured on fractional Brownian profiles"},
     {"lengths", &FractalDimension::lengths,
      "what the method measures at each step, averaged over the profiles: m^2 of \"structure\" and \"psd\", "
      "m of \"madogram\", plain numbers of the others"},
     {"steps", &FractalDimension::steps, "in samples; with \"psd\" wavelengths"},
     {"r_squared", &FractalDimension::r_squared, "of the line through the lengths, both on logarithmic axes"},
     {"profiles", &FractalDimension::profiles, "how many gave a D"},
     {"measured", &FractalDimension::measured, measured_sentence},
     {"resolved", &FractalDimension::resolved,
      "whether D can be believed, as far as the method itself can tell: not where the dimension runs from "
      "step to step, as below the shortest wave of a face or the reach of a tip"},
     {"reason",
      [](const FractalDimension& f) { return f.reason.empty() ? std::nullopt : std::optional(f.reason); },
      "why it is not resolved; nil where it is"}}};

const Block<SpectrumOptions> spectrum_block{
    {choice("window", &SpectrumOptions::window,
            {{"automatic", Window::automatic}, {"none", Window::none}, {"hann", Window::hann}},
            "taper towards the rim; automatic: none for periodic surfaces, otherwise hann"),
     integer("bins", &SpectrumOptions::bins, at_least(0),
             "shells of equal ratio; 0: one a multiple of the fundamental")}};

const Block<FractalDimensionOptions> profile_fractal_dimension_block{fractal_dimension_options()};
const Block<FractalDimensionOptions> areal_fractal_dimension_block{[] {
  std::vector<Option<FractalDimensionOptions>> options = fractal_dimension_options();
  options.push_back(choice("along", &FractalDimensionOptions::along,
                           {{"x", Along::x}, {"y", Along::y}, {"both", Along::both}},
                           "which profiles: rows, columns or both"));
  return options;
}()};

const Block<GaussianFilter> filter_block{
    {quantity("short_wave", &GaussianFilter::short_wave, dimension::length, above(0),
              "waves shorter than this are attenuated"),
     quantity(
         "long_wave", &GaussianFilter::long_wave, dimension::length, above(0).or_never(),
         "waves longer than this are attenuated; the `long_wave` of a generator is the longest it makes"),
     flag("robust", &GaussianFilter::robust,
          "the mean line of `long_wave` follows the bulk of the heights, not deep scratches or spikes (ISO "
          "16610-31, -71; biweights of the residuals)")}};

void warn_of_empty_filter(const Call& call, const GaussianFilter& filter, double length, double spacing) {
  const auto warn = [&](const char* key, double wave, const std::string& why) {
    call.warn(quoted(key) + " is " + format_quantity(wave, dimension::length) + ", and " + why);
  };
  // For a cut-off equal to the length.
  constexpr double rounding = 1e-9;
  if (filter.long_wave && std::isfinite(*filter.long_wave) && *filter.long_wave > length * (1 + rounding))
    warn("long_wave", *filter.long_wave,
         "the length is " + format_quantity(length, dimension::length) +
             ": little more than the mean is removed");
  if (filter.short_wave && std::isfinite(*filter.short_wave) && *filter.short_wave > length * (1 + rounding))
    warn("short_wave", *filter.short_wave,
         "the length is " + format_quantity(length, dimension::length) +
             ": little more than the mean is left");
  if (filter.short_wave && *filter.short_wave < 2 * spacing * (1 - rounding))
    warn("short_wave", *filter.short_wave,
         "points " + format_quantity(spacing, dimension::length) + " apart carry no wave so short");
}

const Block<LevelKeys> level_block{
    {integer("degree", &LevelKeys::degree, between(0, max_levelling_degree),
             "of the polynomial taken away: 0 the mean, 1 the plane, 2 the quadratic form")}};

const Block<CutKeys> cut_block{
    {number("fraction", &CutKeys::fraction, between(0, 1),
            "of the peak-to-valley; heights above max - fraction * peak-to-valley are brought down to it")
         .required()}};

}  // namespace asperity::lua
