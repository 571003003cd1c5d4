// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/surface/measure.hpp"

#include <cmath>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/text.hpp"
#include "engine/metrology/levelling.hpp"

namespace asperity::lua {

Record roughness_record(const Roughness& r, bool areal) {
  Record record;
  record.name = "roughness";
  record.add("Ra", r.Ra, dimension::length)
      .add("Rq", r.Rq, dimension::length)
      .add("amplitude", r.amplitude, dimension::length)
      .add("skewness", r.skewness)
      .add("kurtosis", r.kurtosis)
      .add("rms_slope", r.rms_slope)
      .add("peak", r.peak, dimension::length)
      .add("valley", r.valley, dimension::length)
      .add("mean", r.mean, dimension::length);
  if (areal)
    record.add("Sa", r.Ra, dimension::length)
        .add("Sq", r.Rq, dimension::length)
        .add("Sz", r.amplitude, dimension::length)
        .add("Ssk", r.skewness)
        .add("Sku", r.kurtosis)
        .add("Sdq", r.rms_slope);
  return record;
}

namespace {
Value numbers(const std::vector<double>& values) {
  return Value::Numbers(std::make_shared<const Array<double>>(values.begin(), values.end()));
}
}  // namespace

Record spectrum_record(const Spectrum& s, bool areal) {
  Record record;
  record.name = "spectrum";
  List counts;
  for (const std::int64_t n : s.count) counts.items.emplace_back(n);
  const char* windows[] = {"automatic", "none", "hann"};
  record.add("q", numbers(s.q))
      .add("C", numbers(s.C))
      .add("count", std::move(counts))
      .add("rms_height", s.rms_height, dimension::length)
      .add("rms_slope", s.rms_slope)
      .add("window", windows[static_cast<int>(s.window)])
      .add("units", areal ? "q in rad/m, C in m^4" : "q in rad/m, C in m^3");
  return record;
}

Record fractal_dimension_record(const FractalDimension& f) {
  Record record;
  record.name = "fractal dimension";
  record.add("D", f.D)
      .add("error", f.error)
      .add("lengths", numbers(f.lengths))
      .add("steps", numbers(f.steps))
      .add("r_squared", f.r_squared)
      .add("profiles", f.profiles)
      .add("resolved", f.resolved)
      .add("reason", f.reason.empty() ? Value() : Value(f.reason));
  return record;
}

const Block<SpectrumOptions>& spectrum_block() {
  using O = SpectrumOptions;
  static const Block<O> block{
      "spectrum",
      {choice("window", &O::window,
              {{"automatic", Window::automatic}, {"none", Window::none}, {"hann", Window::hann}},
              "taper towards the rim; automatic: none for periodic surfaces, otherwise hann"),
       integer("bins", &O::bins, at_least(0),
               "shells of equal ratio; 0: one a multiple of the fundamental")}};
  return block;
}

const Block<FractalDimensionOptions>& fractal_dimension_block(bool surface) {
  using O = FractalDimensionOptions;
  auto make = [](bool areal) {
    std::vector<Option<O>> options = {
        choice(
            "method", &O::method,
            {{"length", DimensionMethod::length},
             {"psd", DimensionMethod::psd},
             {"structure", DimensionMethod::structure},
             {"box", DimensionMethod::box},
             {"madogram", DimensionMethod::madogram}},
            "profile length (the paper's eq. 3), spectrum (mean power in half-octave bands), structure "
            "function, box counting or madogram; the `lengths` of the result are what the method measures at "
            "each of its `steps`, profile lengths by \"length\" alone"),
        custom<O>("steps", "integer[]", "steps in samples, e.g. {1, 2, 4, 8, 16}",
                  [](const Argument& value, const OptionInfo& info, O& o, Problems& problems) {
                    if (!value.is_table() || value.length() < 2)
                      return detail::wrong_type(value, info, "a list of two or more whole numbers", problems);
                    for (std::int64_t k = 1; k <= value.length(); ++k)
                      value.element(k, [&](const Argument& step) {
                        if (auto n = detail::read_integer(step, info, between(1, 1 << 30), problems))
                          o.steps.push_back(static_cast<int>(*n));
                      });
                  })
            .defaults_to("{1, 2, 4, 8, 16}"),
        flag("offsets", &O::offsets, "method length: average over all starting points"),
        flag("pooled", &O::pooled,
             "one line through the average over profiles instead of the mean of each one's D"),
        custom<O>("wrap", "boolean", "steps continue across the rim",
                  [](const Argument& value, const OptionInfo& info, O& o, Problems& problems) {
                    if (value.is_boolean())
                      o.wrap = value.boolean();
                    else
                      detail::wrong_type(value, info, "true or false", problems);
                  })
            .defaults_to("false"),
    };
    if (areal)
      options.push_back(choice("along", &O::along, {{"x", Along::x}, {"y", Along::y}, {"both", Along::both}},
                               "which profiles: rows, columns or both"));
    return Block<O>("fractal_dimension", std::move(options));
  };
  static const Block<O> of_surface = make(true), of_profile = make(false);
  return surface ? of_surface : of_profile;
}

const Block<GaussianFilter>& filter_block() {
  using O = GaussianFilter;
  static const Block<O> block{
      "filtered",
      {quantity("short_wave", &O::short_wave, dimension::length, above(0),
                "waves shorter than this are attenuated"),
       quantity(
           "long_wave", &O::long_wave, dimension::length, above(0).or_never(),
           "waves longer than this are attenuated; the `long_wave` of a generator is the longest it makes")}};
  return block;
}

void warn_of_empty_filter(const Call& call, const GaussianFilter& filter, double length, double spacing) {
  const auto warn = [&](const char* key, double wave, const std::string& why) {
    call.session().monitor().warn(where(call.L) + call.function_name() + ": " + quoted(key) + " is " +
                                  format_quantity(wave, dimension::length) + ", and " + why);
  };
  // A cut-off given as the length itself, computed another way, is that length.
  constexpr double rounding = 1e-9;
  if (filter.long_wave && std::isfinite(*filter.long_wave) && *filter.long_wave > length * (1 + rounding))
    warn("long_wave", *filter.long_wave,
         "no wave is longer than the " + format_quantity(length, dimension::length) +
             " there are: little more than the mean is taken away");
  if (filter.short_wave && *filter.short_wave < 2 * spacing * (1 - rounding))
    warn("short_wave", *filter.short_wave,
         "points " + format_quantity(spacing, dimension::length) + " apart carry no wave so short");
}

const Block<LevelKeys>& level_block() {
  static const Block<LevelKeys> block{
      "levelled",
      {integer("degree", &LevelKeys::degree, between(0, max_levelling_degree),
               "of the polynomial taken away: 0 the mean, 1 the plane, 2 the quadratic form")}};
  return block;
}

const Block<CutKeys>& cut_block() {
  static const Block<CutKeys> block{
      "cut",
      {number("fraction", &CutKeys::fraction, between(0, 1),
              "of the peak-to-valley; heights above max - fraction * peak-to-valley are brought down to it")
           .required()}};
  return block;
}

}  // namespace asperity::lua
