// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of areal parameters: one row each, with the discretisation in the sentence. A group (heights,
// slopes, curve, hills, texture) is computed on first access.
#include <algorithm>
#include <cmath>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/metrology/scale_dependence.hpp"

namespace asperity::lua {

namespace {

using Parameters = ArealParameters;
using Number = std::optional<double>;

struct ArealRow {
  const char* name;
  Dimension dimension;
  const char* sentence;
  Number (*value)(const Parameters&);
};

Number known(const std::optional<TextureAspect>& texture, Number TextureAspect::*member) {
  return texture ? (*texture).*member : Number();
}
Number known(const std::optional<TextureDirection>& direction, double TextureDirection::*member) {
  return direction ? Number((*direction).*member) : Number();
}
// Undefined for equal heights.
Number unless_flat(const Parameters& p, Number value) { return p.flat() ? Number() : value; }
Number of_hills(const Parameters& p, Number value) {
  return p.has_inside() ? unless_flat(p, value) : Number();
}

// data table
const std::vector<ArealRow>& areal_rows() {
  using P = Parameters;
  static const Dimension length = dimension::length, number = dimension::number, angle = dimension::angle;
  static constexpr Dimension per_area{-2, 0, 0, 0}, per_length{-1, 0, 0, 0};
  static const std::vector<ArealRow> rows{
      {"Sa", length, "mean magnitude of the heights about their mean",
       [](const P& p) { return Number(p.heights().Ra); }},
      {"Sq", length, "root mean square of the heights about their mean",
       [](const P& p) { return Number(p.heights().Rq); }},
      {"Ssk", number, "skewness of the heights (moments over n); nil where all are equal",
       [](const P& p) { return unless_flat(p, p.heights().skewness); }},
      {"Sku", number, "kurtosis of the heights, 3 of Gaussian ones; nil where all are equal",
       [](const P& p) { return unless_flat(p, p.heights().kurtosis); }},
      {"Sp", length, "greatest height above the mean",
       [](const P& p) { return Number(p.heights().peak - p.heights().mean); }},
      {"Sv", length, "greatest depth below the mean",
       [](const P& p) { return Number(p.heights().mean - p.heights().valley); }},
      {"Sz", length, "Sp + Sv", [](const P& p) { return Number(p.heights().amplitude); }},
      {"Sdq", number,
       "root mean square slope: over the edges along x and those along y, each by its own number",
       [](const P& p) { return p.slopes().Sdq; }},
      {"Sdq_seven", number, "root mean square slope by the rule of seven samples along both axes",
       [](const P& p) { return p.slopes().Sdq_seven; }},
      {"Sdr", number,
       "developed area over the area of the cells, less 1: the mean of both splittings into triangles",
       [](const P& p) { return p.slopes().Sdr; }},
      {"u_Sa", length,
       "standard uncertainty of Sa: s/√16 of its values on 4 x 4 tiles, which must be ten Sal wide; 2.13 "
       "times for 95 %",
       [](const P& p) { return p.uncertainty().Sa; }},
      {"u_Sq", length, "standard uncertainty of Sq, as u_Sa", [](const P& p) { return p.uncertainty().Sq; }},
      {"u_Ssk", number, "standard uncertainty of Ssk, as u_Sa",
       [](const P& p) { return p.uncertainty().Ssk; }},
      {"u_Sku", number, "standard uncertainty of Sku, as u_Sa",
       [](const P& p) { return p.uncertainty().Sku; }},
      {"u_Sdq", number, "standard uncertainty of Sdq, as u_Sa",
       [](const P& p) { return p.uncertainty().Sdq; }},
      {"u_Sdr", number, "standard uncertainty of Sdr, as u_Sa",
       [](const P& p) { return p.uncertainty().Sdr; }},
      {"Sal", length,
       "shortest way on which the autocorrelation falls to 0.2: rays every half degree over a cubic spline",
       [](const P& p) { return known(p.texture(), &TextureAspect::Sal); }},
      {"Str", number, "shortest over longest of these ways; nil where one of them leaves half the map",
       [](const P& p) { return known(p.texture(), &TextureAspect::Str); }},
      {"Str_bound", number, "where Str is nil, what it is below",
       [](const P& p) { return known(p.texture(), &TextureAspect::Str_bound); }},
      {"Std", angle,
       "direction of the lay, from x towards y: where waves have most power, in bins of half a degree, "
       "turned by a right angle; it means nothing where Str is near 1",
       [](const P& p) { return known(p.direction(), &TextureDirection::lay); }},
      {"Std_wave", angle, "direction of the waves of most power, at right angles to Std",
       [](const P& p) { return known(p.direction(), &TextureDirection::wave); }},
      {"Sk", length,
       "core height: the fall of the least-squares line of the material ratio curve over its flattest 40 %",
       [](const P& p) { return Number(p.core().Sk); }},
      {"Spk", length, "reduced peak height", [](const P& p) { return Number(p.core().Spk); }},
      {"Svk", length, "reduced dale depth", [](const P& p) { return Number(p.core().Svk); }},
      {"Smr1", number, "material ratio at the upper end of the core, 0 to 1",
       [](const P& p) { return unless_flat(p, p.core().Smr1); }},
      {"Smr2", number, "material ratio at the lower end of the core, 0 to 1",
       [](const P& p) { return unless_flat(p, p.core().Smr2); }},
      {"Spkx", length, "from the core to the highest point",
       [](const P& p) { return Number(p.core().Spkx); }},
      {"Svkx", length, "from the core to the lowest point", [](const P& p) { return Number(p.core().Svkx); }},
      {"Sk_window", number,
       "material ratio at which the flattest 40 % begin; near a knee of the curve Sk, Spk and Smr1 hang on "
       "it",
       [](const P& p) { return unless_flat(p, p.core().window); }},
      {"Sxp", length, "height between the material ratios 2.5 % and 50 %",
       [](const P& p) { return Number(p.curve().height_difference(0.025, 0.5)); }},
      {"Vmp", length, "peak material volume per area, to 10 %",
       [](const P& p) { return Number(p.volumes().Vmp); }},
      {"Vmc", length, "core material volume per area, 10 to 80 %",
       [](const P& p) { return Number(p.volumes().Vmc); }},
      {"Vvc", length, "core void volume per area, 10 to 80 %",
       [](const P& p) { return Number(p.volumes().Vvc); }},
      {"Vvv", length, "dale void volume per area, from 80 %",
       [](const P& p) { return Number(p.volumes().Vvv); }},
      {"Spd", per_area,
       "peaks per area: summits that stand `pruning` of Sz above their saddle, none at the rim or beside a "
       "hole",
       [](const P& p) { return of_hills(p, p.hills().Spd); }},
      {"Svd", per_area, "pits per area, by the same rule",
       [](const P& p) { return of_hills(p, p.hills().Svd); }},
      {"Spc", per_length, "mean curvature of the peaks, by three samples each way",
       [](const P& p) { return of_hills(p, p.hills().Spc); }},
      {"S5p", length, "mean height of the five highest peaks above the mean; nil under five",
       [](const P& p) { return of_hills(p, p.hills().S5p); }},
      {"S5v", length, "mean depth of the five deepest pits; nil under five",
       [](const P& p) { return of_hills(p, p.hills().S5v); }},
      {"S10z", length, "S5p + S5v", [](const P& p) { return of_hills(p, p.hills().S10z); }},
  };
  return rows;
}

Values areal_number(Call& call) {
  const auto& rows = areal_rows();
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const ArealRow& r) { return r.name == call.function_name(); });
  return {Value(row->value(call.self<Parameters>()))};
}

const Block<ArealPreparation>& areal_block() {
  using O = ArealPreparation;
  static const Block<O> block{
      "areal_parameters",
      {integer("F", &O::F, between(0, max_levelling_degree),
               "F-operation: degree of the polynomial taken away first; without it none"),
       quantity("S", &O::S, dimension::length, above(0),
                "nesting index of the S-filter: shorter waves are attenuated; without it none"),
       quantity("L", &O::L, dimension::length, above(0),
                "nesting index of the L-filter: longer waves are attenuated; without it none"),
       number("pruning", &O::pruning, between(0, 1),
              "of Sz: how far a hill must rise above its saddle to count")}};
  return block;
}

Values areal_parameters_of(Call& call) {
  const ArealPreparation preparation = call.options(areal_block());
  const Surface& surface = call.self<Surface>();
  const Grid& grid = surface.grid();
  Values result = {object(ArealParameters(surface, preparation))};
  if (preparation.S || preparation.L)
    warn_of_empty_filter(call, {preparation.S, preparation.L}, std::max(grid.size_x, grid.size_y),
                         std::min(grid.hx(), grid.hy()));
  return result;
}

Values why_not(Call& call) {
  const std::string name = call.text(1, "name");
  const auto& rows = areal_rows();
  if (std::none_of(rows.begin(), rows.end(), [&](const ArealRow& r) { return r.name == name; }))
    throw Error(ErrorCode::unknown_name, "there is no areal parameter " + quoted(name),
                "give a field such as \"Str\"");
  const std::string why = call.self<Parameters>().why_not(name);
  return {why.empty() ? Value() : Value(why)};
}

std::string describe_parameters(const void* self) {
  const auto& p = *static_cast<const Parameters*>(self);
  const Grid& g = p.prepared().grid();
  return "areal parameters of " + std::to_string(g.nx) + " x " + std::to_string(g.ny) + " points, " +
         std::to_string(p.prepared().measured()) + " measured; " + p.how();
}

Values bearing_of(Call& call) {
  return {object(MaterialRatioCurve(call.self<Surface>().measured_heights().values()))};
}
Values autocorrelation_of(Call& call) { return {object(Autocorrelation(call.self<Surface>()))}; }

struct ScaleDependenceKeys {
  ScaleQuantity of = ScaleQuantity::slope;
  ScaleAxis along = ScaleAxis::x;
  std::vector<int> cells;
  std::optional<double> tip;
};
const Block<ScaleDependenceKeys>& scale_dependence_block() {
  using O = ScaleDependenceKeys;
  static const Block<O> block{
      "scale_dependence",
      {choice("of", &O::of,
              {{"slope", ScaleQuantity::slope},
               {"curvature", ScaleQuantity::curvature},
               {"height", ScaleQuantity::height}},
              "slope over a distance, curvature over twice a distance, or height about the planes of blocks"),
       choice("along", &O::along, {{"x", ScaleAxis::x}, {"y", ScaleAxis::y}}, "which way the stencils lie"),
       custom<O>("cells", "integer[]", "distances in cells; of heights the blocks a side",
                 [](const Argument& value, const OptionInfo& info, O& o, Problems& problems) {
                   if (!value.is_table() || value.length() < 1)
                     return detail::wrong_type(value, info, "a list of whole numbers", problems);
                   for (std::int64_t k = 1; k <= value.length(); ++k)
                     value.element(k, [&](const Argument& step) {
                       if (auto n = detail::read_integer(step, info, between(1, max_cells), problems))
                         o.cells.push_back(static_cast<int>(*n));
                     });
                 })
           .defaults_to("{1, 2, 4, …} to a quarter of the map"),
       quantity(
           "tip", &O::tip, dimension::length, above(0),
           "radius of the tip that measured the map: the result then says which distances are reliable")}};
  return block;
}

struct MeasuredScales {
  ScaleDependence found;
  std::optional<double> cut_off;  // m
  std::optional<std::vector<bool>> reliable;
};

const RecordType<MeasuredScales>& scale_dependence_type() {
  using S = MeasuredScales;
  const auto of = [](std::vector<double> ScaleDependence::*member) {
    return [member](const S& s) { return s.found.*member; };
  };
  static const RecordType<S> type{
      "ScaleDependence",
      "scale dependence",
      "Root mean square slope, curvature or height by the distance over which it is taken.",
      {{"distance", of(&ScaleDependence::distance),
        "of the whole stencil, m, rising; of heights the width of the blocks"},
       {"value", of(&ScaleDependence::value),
        "root mean square at each distance: a slope, 1/m or m; nan where nothing was measured"},
       {"least", of(&ScaleDependence::least), "of curvature alone: the most negative at each distance, 1/m"},
       {"cut_off", &S::cut_off, dimension::length,
        "where `tip` is given, the distance from which on the map is reliable along the way of the stencils "
        "(surface:reliability)"},
       {"reliable", &S::reliable, "where `tip` is given, whether each distance is at the cut-off or above"}}};
  return type;
}

Values scale_dependence_of(Call& call) {
  ScaleDependenceKeys keys = call.options(scale_dependence_block());
  const Surface& surface = call.self<Surface>();
  const int along = keys.along == ScaleAxis::x ? surface.grid().nx : surface.grid().ny;
  if (keys.cells.empty())
    for (int l = 1; l <= std::max(1, along / 4); l *= 2) keys.cells.push_back(l);
  // For heights, `cells` counts blocks, so the largest count has the narrowest blocks.
  if (keys.of == ScaleQuantity::height)
    std::sort(keys.cells.rbegin(), keys.cells.rend());
  else
    std::sort(keys.cells.begin(), keys.cells.end());
  MeasuredScales scales{scale_dependence(surface, keys.of, keys.along, keys.cells), {}, {}};
  if (keys.tip) {
    scales.cut_off = tip_cut_off(surface, keys.along, *keys.tip);
    scales.reliable.emplace();
    for (const double distance : scales.found.distance)
      scales.reliable->push_back(distance >= *scales.cut_off * (1 - 1e-9));
  }
  return {scale_dependence_type()(scales)};
}

struct ReliabilityKeys {
  double tip = 0;
  double share = 0.5;
};
const Block<ReliabilityKeys>& reliability_block() {
  using O = ReliabilityKeys;
  static const Block<O> block{
      "reliability",
      {quantity("tip", &O::tip, dimension::length, above(0), "radius of the tip that measured the map")
           .required(),
       number("share", &O::share, above(0), "of 1/tip: what curvature makes a scale suspect")}};
  return block;
}

struct TipCutOffs {
  double x = 0, y = 0;
};
const RecordType<TipCutOffs>& reliability_type() {
  using T = TipCutOffs;
  static const RecordType<T> type{
      "Reliability",
      "reliability",
      "From which scale on a tip of this radius can have measured what stands in the map: shorter stencils "
      "have, somewhere, hollows sharper than the tip. 0: all scales; half the map: none.",
      {{"x", &T::x, dimension::length, "of stencils along x"},
       {"y", &T::y, dimension::length, "of stencils along y"},
       {"cut_off", [](const T& t) { return std::max(t.x, t.y); }, dimension::length,
        "the greater of the two"}}};
  return type;
}
Values reliability_of(Call& call) {
  const ReliabilityKeys keys = call.options(reliability_block());
  const Surface& surface = call.self<Surface>();
  return {reliability_type()(TipCutOffs{tip_cut_off(surface, ScaleAxis::x, keys.tip, keys.share),
                                        tip_cut_off(surface, ScaleAxis::y, keys.tip, keys.share)})};
}

Values curve_height(Call& call) { return {call.self<MaterialRatioCurve>().height(call.number(1, "ratio"))}; }
Values curve_ratio(Call& call) {
  return {call.self<MaterialRatioCurve>().ratio(call.quantity(1, "height", dimension::length))};
}
Values curve_material(Call& call) {
  return {call.self<MaterialRatioCurve>().material_volume(call.number(1, "ratio"))};
}
Values curve_void(Call& call) {
  return {call.self<MaterialRatioCurve>().void_volume(call.number(1, "ratio"))};
}

std::string describe_curve(const void* self) {
  return "material ratio curve of " +
         std::to_string(static_cast<const MaterialRatioCurve*>(self)->measured()) + " heights";
}
std::size_t bytes_of_curve(const void* self) {
  return static_cast<const MaterialRatioCurve*>(self)->measured() * sizeof(double);
}

Values correlation_at(Call& call) {
  const double i = call.number(1, "i"), j = call.number(2, "j");
  if (i != std::floor(i) || j != std::floor(j)) refuse("a lag is not whole cells", "give whole numbers");
  return {call.self<Autocorrelation>()(static_cast<int>(i), static_cast<int>(j))};
}
std::string describe_correlation(const void* self) {
  const auto& f = *static_cast<const Autocorrelation*>(self);
  return "autocorrelation to lags of " + std::to_string(f.lags_x()) + " x " + std::to_string(f.lags_y()) +
         " cells";
}
std::size_t bytes_of_correlation(const void* self) {
  const auto& f = *static_cast<const Autocorrelation*>(self);
  return (2 * static_cast<std::size_t>(f.lags_x()) + 1) * (static_cast<std::size_t>(f.lags_y()) + 1) *
         sizeof(double);
}

}  // namespace

std::vector<Function> parameter_methods() {
  return {
      {.name = "areal_parameters",
       .body = areal_parameters_of,
       .sentence = "The areal parameters of ISO 25178-2, of the map as it is or after F-operation, S- and "
                   "L-filter. Each group is computed when a field of it is first read.",
       .options = &areal_block(),
       .options_optional = true,
       .returns = "ArealParameters",
       .example = "print(s:areal_parameters{ F=1, S=\"50 um\", L=\"0.4 mm\" }.Sq)"},
      {.name = "bearing",
       .body = bearing_of,
       .sentence =
           "The material ratio curve (Abbott-Firestone) of the measured heights, exact and not binned.",
       .returns = "MaterialRatioCurve",
       .example = "print(s:bearing():ratio(0))"},
      {.name = "autocorrelation",
       .body = autocorrelation_of,
       .sentence = "The autocorrelation of the heights about their mean, by pairs of measured points, "
                   "nothing wrapped, to lags of half the map.",
       .returns = "Autocorrelation",
       .example = "print(s:autocorrelation():at(3, 0))"},
      {.name = "scale_dependence",
       .body = scale_dependence_of,
       .sentence =
           "Slope, curvature or height by scale (Sanner et al. 2022); with `tip`, from which scale on "
           "it is reliable.",
       .options = &scale_dependence_block(),
       .options_optional = true,
       .returns = "ScaleDependence",
       .example = "print(s:scale_dependence{ of=\"slope\" }.value[1])"},
      {.name = "reliability",
       .body = reliability_of,
       .sentence = "From which scale on the map can be what a spherical tip would have measured.",
       .options = &reliability_block(),
       .returns = "Reliability",
       .example = "print(s:reliability{ tip=\"2 um\" }.cut_off)"},
  };
}

std::vector<const RecordInfo*> parameter_results() { return {&scale_dependence_type(), &reliability_type()}; }

template <>
const Class& class_of<ArealParameters>() {
  static const Class type = [] {
    Class c;
    c.name = "ArealParameters";
    c.article_name = "areal parameters";
    c.sentence =
        "The areal parameters of a map (ISO 25178-2), of the points that were measured. One that the map "
        "does not define is nil: why_not says why.";
    c.describe = describe_parameters;
    c.native_bytes = [](const void* self) {
      return static_cast<const Parameters*>(self)->prepared().measured_heights().size() * sizeof(double);
    };
    c.digest = text_of<&Parameters::digest>;
    for (const ArealRow& row : areal_rows())
      c.fields.push_back({row.name, "number?", row.sentence, row.dimension, areal_number});
    c.fields.push_back(getter<Parameters>("measured", "integer", "points that were measured",
                                          [](const Parameters& of) { return of.prepared().measured(); }));
    c.fields.push_back(getter<Parameters>("prepared", "Surface", "the map after F-operation, S- and L-filter",
                                          [](const Parameters& of) { return object(of.prepared()); }));
    c.fields.push_back(getter<&Parameters::how>("how", "string", "what was done to the map first, in words"));
    c.methods = {{.name = "why_not",
                  .body = why_not,
                  .sentence = "Why a parameter is not defined on this map; nil where it is.",
                  .parameters = {{"name", "string", "of a field, such as \"Str\""}},
                  .returns = "string?",
                  .example = "local a = s:areal_parameters() print(a.Str or a:why_not \"Str\")"}};
    return c;
  }();
  return type;
}

template <>
const Class& class_of<MaterialRatioCurve>() {
  static const Class type = [] {
    Class c;
    c.name = "MaterialRatioCurve";
    c.article_name = "a material ratio curve";
    c.sentence =
        "Which share of the points lies above each height; heights count from the mean, ratios from 0 to 1.";
    c.describe = describe_curve;
    c.native_bytes = bytes_of_curve;
    c.fields = {
        getter<&MaterialRatioCurve::measured>("measured", "integer", "points that were measured"),
        getter<&MaterialRatioCurve::mean>(
            "mean", "number", "of the heights, from which those of the curve count", dimension::length)};
    c.methods = {{.name = "height",
                  .body = curve_height,
                  .sentence = "The height above which a share of the points lies, Smc(ratio).",
                  .parameters = {{"ratio", "number", "0 to 1"}},
                  .returns = "number",
                  .example = "print(s:bearing():height(0.1))"},
                 {.name = "ratio",
                  .body = curve_ratio,
                  .sentence = "The share of the points at or above a height, Smr(height).",
                  .parameters = {{"height", "quantity", "from the mean"}},
                  .returns = "number",
                  .example = "print(s:bearing():ratio \"0.2 um\")"},
                 {.name = "material_volume",
                  .body = curve_material,
                  .sentence = "Material above the height of a ratio, per area, Vm(ratio), in m.",
                  .parameters = {{"ratio", "number", "0 to 1"}},
                  .returns = "number",
                  .example = "print(s:bearing():material_volume(0.1))"},
                 {.name = "void_volume",
                  .body = curve_void,
                  .sentence = "Void below the height of a ratio, per area, Vv(ratio), in m.",
                  .parameters = {{"ratio", "number", "0 to 1"}},
                  .returns = "number",
                  .example = "print(s:bearing():void_volume(0.8))"}};
    return c;
  }();
  return type;
}

template <>
const Class& class_of<Autocorrelation>() {
  static const Class type = [] {
    Class c;
    c.name = "Autocorrelation";
    c.article_name = "an autocorrelation";
    c.sentence = "The autocorrelation of a surface at lags of whole cells, 1 at the origin.";
    c.describe = describe_correlation;
    c.native_bytes = bytes_of_correlation;
    c.fields = {getter<Autocorrelation>("lags", "{integer, integer}",
                                        "the longest lags along x and y, in cells",
                                        [](const Autocorrelation& of) {
                                          return List{{of.lags_x(), of.lags_y()}};
                                        })};
    c.methods = {
        {.name = "at",
         .body = correlation_at,
         .sentence = "At a lag of i cells along x and j along y; nan where no pair of points was measured.",
         .parameters = {{"i", "integer", "along x"}, {"j", "integer", "along y"}},
         .returns = "number",
         .example = "print(s:autocorrelation():at(0, 3))"}};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
