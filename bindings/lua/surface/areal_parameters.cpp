// SPDX-License-Identifier: GPL-3.0-or-later
// Areal parameters: one row each, with the discretisation in the sentence. A group (heights, slopes, curve,
// hills, texture) is computed on first access.
#include <algorithm>
#include <cmath>
#include <functional>
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

// A number, nil if undefined.
struct ArealField : Getter {
  template <class Read>
  ArealField(const char* field, Dimension unit, const char* meaning, Read read)
      : Getter(getter<Parameters>(field, "number?", meaning, read, unit)), number(read) {}
  std::function<Number(const Parameters&)> number;
};
// data table
const std::vector<ArealField>& areal_fields() {
  using P = Parameters;
  static const Dimension length = dimension::length, number = dimension::number, angle = dimension::angle;
  static constexpr Dimension per_area{-2, 0, 0, 0}, per_length{-1, 0, 0, 0};
  static const std::vector<ArealField> fields{
      {"Sa", length, "mean magnitude of the heights about their mean",
       [](const P& p) { return p.heights().Ra; }},
      {"Sq", length, "root mean square of the heights about their mean",
       [](const P& p) { return p.heights().Rq; }},
      {"Ssk", number, "skewness of the heights (moments over n); nil where all are equal",
       [](const P& p) { return unless_flat(p, p.heights().skewness); }},
      {"Sku", number, "kurtosis of the heights, 3 of Gaussian ones; nil where all are equal",
       [](const P& p) { return unless_flat(p, p.heights().kurtosis); }},
      {"Sp", length, "greatest height above the mean",
       [](const P& p) { return p.heights().peak - p.heights().mean; }},
      {"Sv", length, "greatest depth below the mean",
       [](const P& p) { return p.heights().mean - p.heights().valley; }},
      {"Sz", length, "Sp + Sv", [](const P& p) { return p.heights().amplitude; }},
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
       [](const P& p) { return p.core().Sk; }},
      {"Spk", length, "reduced peak height", [](const P& p) { return p.core().Spk; }},
      {"Svk", length, "reduced dale depth", [](const P& p) { return p.core().Svk; }},
      {"Smr1", number, "material ratio at the upper end of the core, 0 to 1",
       [](const P& p) { return unless_flat(p, p.core().Smr1); }},
      {"Smr2", number, "material ratio at the lower end of the core, 0 to 1",
       [](const P& p) { return unless_flat(p, p.core().Smr2); }},
      {"Spkx", length, "from the core to the highest point", [](const P& p) { return p.core().Spkx; }},
      {"Svkx", length, "from the core to the lowest point", [](const P& p) { return p.core().Svkx; }},
      {"Sk_window", number,
       "material ratio at which the flattest 40 % begin; near a knee of the curve Sk, Spk and Smr1 hang on "
       "it",
       [](const P& p) { return unless_flat(p, p.core().window); }},
      {"Sxp", length, "height between the material ratios 2.5 % and 50 %",
       [](const P& p) { return p.curve().height_difference(0.025, 0.5); }},
      {"Vmp", length, "peak material volume per area, to 10 %", [](const P& p) { return p.volumes().Vmp; }},
      {"Vmc", length, "core material volume per area, 10 to 80 %",
       [](const P& p) { return p.volumes().Vmc; }},
      {"Vvc", length, "core void volume per area, 10 to 80 %", [](const P& p) { return p.volumes().Vvc; }},
      {"Vvv", length, "dale void volume per area, from 80 %", [](const P& p) { return p.volumes().Vvv; }},
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
  return fields;
}

const Block<ArealPreparation> areal_block{
    {integer("F", &ArealPreparation::F, between(0, max_levelling_degree),
             "F-operation: degree of the polynomial taken away first; without it none"),
     quantity("S", &ArealPreparation::S, dimension::length, above(0),
              "nesting index of the S-filter: shorter waves are attenuated; without it none"),
     quantity("L", &ArealPreparation::L, dimension::length, above(0),
              "nesting index of the L-filter: longer waves are attenuated; without it none"),
     number("pruning", &ArealPreparation::pruning, between(0, 1),
            "of Sz: how far a hill must rise above its saddle to count")}};

Values areal_parameters_of(Call& call) {
  const ArealPreparation preparation = call.options(areal_block);
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
  if (std::ranges::find(areal_fields(), std::string_view(name), &Getter::name) == areal_fields().end())
    refuse_name("there is no areal parameter " + quoted(name), "give a field such as \"Str\"");
  const std::string why = call.self<Parameters>().why_not(name);
  return {why.empty() ? Value() : Value(why)};
}

std::string describe_parameters(const Parameters& p) {
  const Grid& g = p.prepared().grid();
  std::string text = "areal parameters of " + std::to_string(g.nx) + " x " + std::to_string(g.ny) +
                     " points, " + std::to_string(p.prepared().measured()) + " measured; " + p.how();
  for (const ArealField& field : areal_fields())
    if (const Number value = field.number(p)) {
      constexpr std::size_t width = 10;
      text += "\n  " + field.name + std::string(width - std::min(width - 1, field.name.size()), ' ') +
              show(Record::Entry{field.name, *value, field.dimension});
    }
  return text;
}

struct ScaleDependenceKeys {
  ScaleQuantity of = ScaleQuantity::slope;
  ScaleAxis along = ScaleAxis::x;
  std::vector<int> cells;
  std::optional<double> tip;
};
const Block<ScaleDependenceKeys> scale_dependence_block{
    {choice("of", &ScaleDependenceKeys::of,
            {{"slope", ScaleQuantity::slope},
             {"curvature", ScaleQuantity::curvature},
             {"height", ScaleQuantity::height}},
            "slope over a distance, curvature over twice a distance, or height about the planes of blocks"),
     choice("along", &ScaleDependenceKeys::along, {{"x", ScaleAxis::x}, {"y", ScaleAxis::y}},
            "which way the stencils lie"),
     integers("cells", &ScaleDependenceKeys::cells, 1, max_cells,
              "distances in cells; of heights the blocks a side")
         .defaults_to("{1, 2, 4, …} to a quarter of the map"),
     quantity("tip", &ScaleDependenceKeys::tip, dimension::length, above(0),
              "radius of the tip that measured the map: the result then says which distances are reliable")}};

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
  ScaleDependenceKeys keys = call.options(scale_dependence_block);
  const Surface& surface = call.self<Surface>();
  const int along = keys.along == ScaleAxis::x ? surface.grid().nx : surface.grid().ny;
  if (keys.cells.empty())
    for (int l = 1; l <= std::max(1, along / 4); l *= 2) keys.cells.push_back(l);
  // For heights, `cells` counts blocks: the largest count has the narrowest.
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
const Block<ReliabilityKeys> reliability_block{
    {quantity("tip", &ReliabilityKeys::tip, dimension::length, above(0),
              "radius of the tip that measured the map")
         .required(),
     number("share", &ReliabilityKeys::share, above(0), "of 1/tip: what curvature makes a scale suspect")}};

struct TipCutOffs {
  double x = 0, y = 0;
};
const RecordType<TipCutOffs> reliability_type{
    "Reliability",
    "reliability",
    "Smallest scale at which a tip of this radius can have measured the map: shorter stencils have, "
    "somewhere, hollows sharper than the tip. 0: all scales; half the map: none.",
    {{"x", &TipCutOffs::x, dimension::length, "of stencils along x"},
     {"y", &TipCutOffs::y, dimension::length, "of stencils along y"},
     {"cut_off", [](const TipCutOffs& t) { return std::max(t.x, t.y); }, dimension::length,
      "the greater of the two"}}};

using RatioCurve = MaterialRatioCurve;

double correlation_at(const Autocorrelation& f, const Call& call) {
  const double i = call.number(1, "i"), j = call.number(2, "j");
  if (i != std::floor(i) || j != std::floor(j)) refuse("a lag is not whole cells", "give whole numbers");
  return f(static_cast<int>(i), static_cast<int>(j));
}

}  // namespace

std::vector<Function> parameter_methods() {
  return {
      {.name = "areal_parameters",
       .body = areal_parameters_of,
       .sentence = "The areal parameters of ISO 25178-2, of the map as it is or after F-operation, S- and "
                   "L-filter. Each group is computed at the first read of a field.",
       .options = optional(areal_block),
       .returns = "ArealParameters",
       .example = "print(s:areal_parameters{ F=1, S=\"50 um\", L=\"0.4 mm\" }.Sq)"},
      {.name = "bearing",
       .body = method([](const Surface& s) { return MaterialRatioCurve(s.measured_heights().values()); }),
       .sentence =
           "The material ratio curve (Abbott-Firestone) of the measured heights, exact and not binned.",
       .returns = "MaterialRatioCurve",
       .example = "print(s:bearing():ratio(0))"},
      {.name = "autocorrelation",
       .body = method([](const Surface& s) { return Autocorrelation(s); }),
       .sentence = "The autocorrelation of the heights about their mean, by pairs of measured points, "
                   "nothing wrapped, to lags of half the map.",
       .returns = "Autocorrelation",
       .example = "print(s:autocorrelation():at(3, 0))"},
      {.name = "scale_dependence",
       .body = scale_dependence_of,
       .sentence = "Slope, curvature or height by scale (Sanner et al. 2022); with `tip`, from which scale "
                   "on it is reliable.",
       .options = optional(scale_dependence_block),
       .returns = "ScaleDependence",
       .example = "print(s:scale_dependence{ of=\"slope\" }.value[1])"},
      {.name = "reliability",
       .body = [](Call& call) -> Values {
         const ReliabilityKeys keys = call.options(reliability_block);
         const Surface& surface = call.self<Surface>();
         return {reliability_type(TipCutOffs{tip_cut_off(surface, ScaleAxis::x, keys.tip, keys.share),
                                             tip_cut_off(surface, ScaleAxis::y, keys.tip, keys.share)})};
       },
       .sentence = "Smallest scale at which a spherical tip can have measured the map.",
       .options = &reliability_block,
       .returns = "Reliability",
       .example = "print(s:reliability{ tip=\"2 um\" }.cut_off)"},
  };
}

std::vector<const RecordInfo*> parameter_results() { return {&scale_dependence_type(), &reliability_type}; }

Class make_class(For<ArealParameters>) {
  Class c{"ArealParameters", "areal parameters",
          "The areal parameters of a map (ISO 25178-2), of the points that were measured. One that the map "
          "does not define is nil: why_not says why."};
  c.describe = text_of<describe_parameters>;
  c.iterates_numbers = true;
  c.native_bytes =
      from_value([](const Parameters& p) { return p.prepared().measured_heights().size() * sizeof(double); });
  c.digest = text_of<&Parameters::digest>;
  c.fields.assign(areal_fields().begin(), areal_fields().end());
  append(
      c.fields,
      getter<&Parameters::prepared, &Surface::measured>("measured", "integer", "points that were measured"),
      getter<&Parameters::prepared>("prepared", "Surface", "the map after F-operation, S- and L-filter"),
      getter<&Parameters::how>("how", "string", "preparation of the map, in words"));
  c.methods = {{.name = "why_not",
                .body = why_not,
                .sentence = "Why a parameter is not defined on this map; nil where it is.",
                .parameters = {{"name", "string", "of a field, such as \"Str\""}},
                .returns = "string?",
                .example = "local a = s:areal_parameters() print(a.Str or a:why_not \"Str\")"}};
  return c;
}

Class make_class(For<MaterialRatioCurve>) {
  Class c{"MaterialRatioCurve", "a material ratio curve",
          "Share of the points above each height; heights count from the mean, ratios from 0 to 1."};
  c.describe = from_value([](const RatioCurve& curve) -> std::string {
    return "material ratio curve of " + std::to_string(curve.measured()) + " heights";
  });
  c.native_bytes = from_value([](const RatioCurve& curve) { return curve.measured() * sizeof(double); });
  c.fields = {
      getter<&RatioCurve::measured>("measured", "integer", "points that were measured"),
      getter<&RatioCurve::mean>("mean", "number", "of the heights, from which those of the curve count",
                                dimension::length)};
  c.methods = {{.name = "height",
                .body = method([](const RatioCurve& curve, Call& call) {
                  return curve.height(call.number(1, "ratio"));
                }),
                .sentence = "The height exceeded by a share of the points, Smc(ratio).",
                .parameters = {{"ratio", "number", "0 to 1"}},
                .returns = "number",
                .example = "print(s:bearing():height(0.1))"},
               {.name = "ratio",
                .body = method([](const RatioCurve& curve, Call& call) {
                  return curve.ratio(call.quantity(1, "height", dimension::length));
                }),
                .sentence = "The share of the points at or above a height, Smr(height).",
                .parameters = {{"height", "quantity", "from the mean"}},
                .returns = "number",
                .example = "print(s:bearing():ratio \"0.2 um\")"},
               {.name = "material_volume",
                .body = method([](const RatioCurve& curve, Call& call) {
                  return curve.material_volume(call.number(1, "ratio"));
                }),
                .sentence = "Material above the height of a ratio, per area, Vm(ratio), in m.",
                .parameters = {{"ratio", "number", "0 to 1"}},
                .returns = "number",
                .example = "print(s:bearing():material_volume(0.1))"},
               {.name = "void_volume",
                .body = method([](const RatioCurve& curve, Call& call) {
                  return curve.void_volume(call.number(1, "ratio"));
                }),
                .sentence = "Void below the height of a ratio, per area, Vv(ratio), in m.",
                .parameters = {{"ratio", "number", "0 to 1"}},
                .returns = "number",
                .example = "print(s:bearing():void_volume(0.8))"}};
  return c;
}

Class make_class(For<Autocorrelation>) {
  Class c{"Autocorrelation", "an autocorrelation",
          "The autocorrelation of a surface at lags of whole cells, 1 at the origin."};
  c.describe = from_value([](const Autocorrelation& f) -> std::string {
    return "autocorrelation to lags of " + std::to_string(f.lags_x()) + " x " + std::to_string(f.lags_y()) +
           " cells";
  });
  c.native_bytes = from_value([](const Autocorrelation& f) {
    return (2 * static_cast<std::size_t>(f.lags_x()) + 1) * (static_cast<std::size_t>(f.lags_y()) + 1) *
           sizeof(double);
  });
  c.fields = {getter<Autocorrelation>(
      "lags", "{integer, integer}", "the longest lags along x and y, in cells",
      [](const Autocorrelation& of) { return along_axes(of.lags_x(), of.lags_y()); })};
  c.methods = {
      {.name = "at",
       .body = method([](const Autocorrelation& f, Call& call) { return correlation_at(f, call); }),
       .sentence = "At a lag of i cells along x and j along y; nan where no pair of points was measured.",
       .parameters = {{"i", "integer", "along x"}, {"j", "integer", "along y"}},
       .returns = "number",
       .example = "print(s:autocorrelation():at(0, 3))"}};
  return c;
}

}  // namespace asperity::lua
