// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/calibration.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

void read_u(const Argument& value, const OptionInfo& info, CalibrationKeys& keys, Problems& problems) {
  if (value.is_number())
    keys.u_number = value.number();
  else if (value.is_text())
    keys.u_text = std::string(value.text());
  else
    detail::wrong_type(value, info, "a column, a number or a quantity", problems);
}

Option<CalibrationKeys> in_options(Option<CalibrationOptions> inner) {
  Option<CalibrationKeys> option;
  option.info = std::move(inner.info);
  option.read = [read = std::move(inner.read)](const Argument& value, const OptionInfo& info,
                                               CalibrationKeys& keys, Problems& problems) {
    read(value, info, keys.options, problems);
  };
  if (inner.show)
    option.show = [show = std::move(inner.show)](const CalibrationKeys& keys) { return show(keys.options); };
  return option;
}

// "`load` is 5 N" for each constant column, except y.
std::vector<std::string> alike_columns(const Rows& table, const std::set<std::size_t>& but) {
  std::vector<std::string> found;
  constexpr std::size_t most = 4;
  for (std::size_t k = 0; k < table.columns().size() && found.size() < most; ++k) {
    if (but.contains(k) || table.rows() < 2 || is_empty(table.cell(0, k))) continue;
    bool same = true;
    for (std::size_t row = 1; row < table.rows() && same; ++row)
      same = same_cell(table.cell(row, k), table.cell(0, k));
    if (same)
      found.push_back(quoted(table.columns()[k].name) + " is " +
                      text_with_unit(table.cell(0, k), table.columns()[k].unit));
  }
  return found;
}

std::string specimen_column_hint(const CalibrationKeys& keys, const Rows& used) {
  if (keys.specimen) return "";
  for (const char* name : {"specimen", "specimens", "sample"}) {
    const auto column = used.find_column(name);
    if (!column) continue;
    std::set<std::string> different;
    for (std::size_t row = 0; row < used.rows(); ++row) different.insert(short_text(used.cell(row, *column)));
    if (different.size() > 1 && different.size() < used.rows())
      return "the rows have a column " + quoted(name) +
             ", which was not named: repeats on one specimen are not independent; give specimen=\"" + name +
             "\"";
  }
  return "";
}

struct ToldParameter {
  CalibratedParameter of;
  Dimension dimension;
};

Dimension dimension_of(const ToldParameter& told) { return told.dimension; }

template <auto member>
RecordField<ToldParameter> told_number(const char* name, const char* sentence) {
  return RecordField<ToldParameter>(
             name, [](const ToldParameter& told) { return std::optional<double>(told.of.*member); }, sentence)
      .in(dimension_of);
}

template <auto member, class Points>
std::vector<double> column_of(const Points& points) {
  std::vector<double> values;
  for (const auto& point : points) values.push_back(point.*member);
  return values;
}

const RecordType<ToldParameter> calibrated_parameter_type{
    "CalibratedParameter",
    "parameter",
    "A parameter of a calibration or a fit, in SI.",
    {told_number<&CalibratedParameter::value>("value",
                                              "its estimate; nil where the rows do not determine it"),
     told_number<&CalibratedParameter::standard_error>(
         "u", "its standard uncertainty; nil at a bound, by which a bound moves it, and without scatter"),
     told_number<&CalibratedParameter::low>("low",
                                            "lower end of its linearised interval, not cut off at a bound"),
     told_number<&CalibratedParameter::high>("high", "upper end of its linearised interval"),
     told_number<&CalibratedParameter::profile_low>(
         "profile_low", "lower end of its interval by profile likelihood; nil where the rows give none"),
     told_number<&CalibratedParameter::profile_high>(
         "profile_high", "upper end of its interval by profile likelihood; nil where the rows give none"),
     {"share_of_faces", [](const ToldParameter& p) { return p.of.share_of_faces; },
      "share of u² that the scatter of replicates makes; 0 without `replicate`"},
     {"determined", [](const ToldParameter& p) { return p.of.determined; }, "whether the rows determine it"},
     {"at_lower", [](const ToldParameter& p) { return p.of.at_lower; }, "whether it is at its lower bound"},
     {"at_upper", [](const ToldParameter& p) { return p.of.at_upper; }, "whether it is at its upper bound"},
     {"profile_values", [](const ToldParameter& p) { return column_of<&ProfilePoint::value>(p.of.profile); },
      "places at which its profile was computed"},
     {"profile_excess", [](const ToldParameter& p) { return column_of<&ProfilePoint::excess>(p.of.profile); },
      "(S - S_min)/s² there; the interval ends where it meets `cut`"}}};

const RecordType<CalibratedSpecimen> calibrated_specimen_type{
    "CalibratedSpecimen",
    "specimen",
    "A specimen of a calibration.",
    {{"name", &CalibratedSpecimen::name, "as its column tells it"},
     {"rows", &CalibratedSpecimen::rows, "how many rows are of it"},
     {"residual", &CalibratedSpecimen::residual,
      "mean of its residuals: relative to the fit with scatter=\"relative\", in units of `u` where that is "
      "known, else in SI"}}};

Record told_parameters(const CalibrationReport& report) {
  Record record;
  record.name = "parameters";
  for (std::size_t p = 0; p < report.found.parameters.size(); ++p) {
    const CalibratedParameter& of = report.found.parameters[p];
    Record one = calibrated_parameter_type({of, report.dimensions[p]});
    one.name = of.name;
    record.add(of.name, std::move(one));
  }
  return record;
}

Map told_values(const CalibrationReport& report) {
  Map map;
  for (const CalibratedParameter& of : report.found.parameters)
    if (of.value) map.items.emplace_back(of.name, *of.value);
  return map;
}

std::vector<double> known_numbers(const std::vector<std::optional<double>>& values) {
  std::vector<double> numbers;
  for (const std::optional<double>& value : values)
    numbers.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  return numbers;
}

List told_correlation(const CalibrationReport& report) {
  List rows;
  for (const auto& row : report.found.correlation)
    rows.items.push_back(detail::value_of_held(known_numbers(row)));
  return rows;
}

using Curve = std::vector<CurvePoint>;

const RecordType<Curve> curve_type{
    "FitCurve",
    "curve",
    "A fitted curve over the range of the points, with the pointwise interval of the curve.",
    {{"x", column_of<&CurvePoint::x, Curve>, "places, ascending"},
     {"y", column_of<&CurvePoint::y, Curve>, "the curve there"},
     {"low", column_of<&CurvePoint::low, Curve>, "lower end of its interval there"},
     {"high", column_of<&CurvePoint::high, Curve>, "upper end of its interval there"}}};

struct CalibrationChartKeys {
  std::optional<std::string> x;
  bool likelihood = false;
  std::string title;
  std::optional<std::string> file;
};

const Block<CalibrationChartKeys> calibration_chart_block{
    {text("x", &CalibrationChartKeys::x, "the column along; without it, measured y against fitted y"),
     flag("likelihood", &CalibrationChartKeys::likelihood,
          "draw the profile likelihood of each parameter instead, with the limit at which its interval ends"),
     text("title", &CalibrationChartKeys::title, "above the chart"),
     text("file", &CalibrationChartKeys::file,
          "an .svg, .png or .pdf under the run directory; default calibration-<y>.svg, with likelihood "
          "calibration-<y>-likelihood.svg")}};

Values chart_calibration(Call& call) {
  const CalibrationReport& report = call.self<CalibrationReport>();
  const CalibrationChartKeys keys = call.options(calibration_chart_block);
  if (keys.likelihood && keys.x)
    refuse("`x` has no effect on the chart of the likelihood, which has the parameters along x",
           "leave out `x` or `likelihood`");
  const std::string file = keys.file.value_or(
      safe_file_name("calibration-" + report.y + (keys.likelihood ? "-likelihood" : "")) + ".svg");
  picture_format(file);
  std::vector<LineChart> panels =
      keys.likelihood ? likelihood_charts(report) : std::vector<LineChart>{calibration_chart(report, keys.x)};
  panels.front().title = keys.title;
  const std::string path = writable_path(call, file);
  warn_of(call, draw(panels, path));
  if (const auto& run = call.session().run)
    run->journal().write("chart", Json::object({{"calibration", report.y}, {"file", file}}));
  return {path};
}

}  // namespace

Option<CalibrationKeys> u_option() {
  return custom<CalibrationKeys>(
      "u", "string|number",
      "standard uncertainty of y: a column, one number in SI, or a quantity; rows weigh by 1/u², and "
      "intervals rest on u, whatever the residuals are. All alike without it",
      read_u);
}

Option<CalibrationKeys> scatter_option() {
  return in_options(
      choice("scatter", &CalibrationOptions::scatter,
             {{"absolute", CalibrationScatter::absolute}, {"relative", CalibrationScatter::relative}},
             "constant scatter of y, or of y relative to the fit (weights 1/fit²)"));
}

Option<CalibrationKeys> specimen_option() {
  return text("specimen", &CalibrationKeys::specimen,
              "the column with the names of specimens; rows of one specimen are repeats, and if specimens "
              "scatter more than repeats, the fit uses their means");
}

Option<CalibrationKeys> basis_option() {
  return in_options(
      choice("basis", &CalibrationOptions::basis,
             {{"automatic", CalibrationBasis::automatic},
              {"rows", CalibrationBasis::rows},
              {"specimens", CalibrationBasis::specimens}},
             "the observations; automatic: rows, and specimens where they scatter (F test at 50 %)"));
}

Option<CalibrationKeys> confidence_option() {
  return in_options(Option<CalibrationOptions>(
      number("confidence", &CalibrationOptions::confidence, inside(0, 1), "of the intervals")));
}

Option<CalibrationKeys> profile_option() {
  return in_options(flag("profile", &CalibrationOptions::profile,
                         "intervals by profile likelihood as well: two sets of parameters each where the "
                         "model is straight, ten or more where it is curved"));
}

CalibrationInput calibration_input(const Rows& table, const CalibrationKeys& keys) {
  const Rows chosen = rows_of(table, keys.where.rows(table));
  if (chosen.rows() == 0 && !keys.where.empty() && !TableFilter().rows(table).empty())
    refuse("no row matches `where` " + keys.where.text(), "give values that its columns hold");
  std::vector<std::pair<std::string, std::string>> named = {{"y", keys.y}};
  const std::size_t y = chosen.column(keys.y, "y");
  std::set<std::size_t> told = {y};
  std::optional<double> u = keys.u_number;
  std::optional<std::size_t> x, weights, u_column, specimen;  // in `named`, except `specimen`
  const auto name = [&](const char* key, const std::string& column) {
    named.emplace_back(key, column);
    told.insert(chosen.column(column, key));
    return named.size() - 1;
  };
  if (keys.x) x = name("x", *keys.x);
  if (keys.weights) weights = name("weights", *keys.weights);
  if (keys.u_text && chosen.find_column(*keys.u_text)) {
    u_column = name("u", *keys.u_text);
  } else if (keys.u_text) {
    try {
      const std::string unit = chosen.columns()[y].unit;
      u = from_unit(parse_quantity_in(*keys.u_text, unit), unit);
    } catch (const Error& error) {
      throw Error(error.code(),
                  "`u` is neither a column of " + chosen.name() + " nor a value of " + quoted(keys.y) + ": " +
                      error.sentence(),
                  "give a column, or a quantity such as \"0.5 deg\"");
    }
  }
  if (keys.specimen) specimen = chosen.column(*keys.specimen, "specimen");
  if (specimen) told.insert(*specimen);
  const NumberColumns numbers = number_columns(chosen, named);
  CalibrationInput found;
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < numbers.rows.size(); ++k) {
    const std::size_t row = numbers.rows[k];
    if (specimen && is_empty(chosen.cell(row, *specimen))) continue;
    const double weight = weights ? numbers.values[*weights][k] : 1;
    if (weight < 0)
      refuse("the weight of row " + std::to_string(row + 1) + " is " + format_short(weight),
             "weights are not negative; give the uncertainty of y as `u` where it is known");
    if (weight == 0) continue;
    used.push_back(row);
    found.numbers.push_back(row + 1);
    found.rows.y.push_back(numbers.values[0][k]);
    if (x) found.rows.x.push_back(numbers.values[*x][k]);
    if (weights) found.rows.u.push_back(1 / std::sqrt(weight));
    if (u_column) found.rows.u.push_back(numbers.values[*u_column][k]);
    if (specimen) found.rows.specimens.push_back(short_text(chosen.cell(row, *specimen)));
  }
  if (u) found.rows.u.assign(found.rows.y.size(), *u);
  found.left_out = chosen.rows() - used.size();
  found.used = rows_of(chosen, used);
  found.rows.numbers = found.numbers;
  found.rows.alike = alike_columns(found.used, told);
  return found;
}

CalibrationReport calibration_report(Call& call, const CalibrationKeys& keys, CalibrationInput input,
                                     Calibration found) {
  if (std::string hint = specimen_column_hint(keys, input.used); !hint.empty())
    found.warnings.push_back(std::move(hint));
  warn_of(call, found.warnings);
  CalibrationReport report;
  report.dimensions.assign(found.parameters.size(), dimension::number);
  report.found = std::move(found);
  report.rows = std::move(input.used);
  report.numbers = std::move(input.numbers);
  report.left_out = input.left_out;
  report.y = split_column_unit(keys.y).name;
  report.scatter = keys.options.scatter;
  report.known_uncertainty = !input.rows.u.empty() && !keys.weights;
  return report;
}

// data table
Class make_class(For<CalibrationReport>) {
  using R = CalibrationReport;
  Class c{"Calibration", "a calibration",
          "A result of lab.calibrate or t:fit. print() shows a line a parameter, correlation, verdict and "
          "warnings."};
  c.describe = text_of<calibration_text>;
  c.digest = text_of<calibration_digest>;
  c.results = {&calibrated_parameter_type, &calibrated_specimen_type, &curve_type};
  c.fields = {
      getter<told_parameters>("parameters", "table<string, CalibratedParameter>",
                              "each parameter under its name"),
      getter<told_values>("values", "table<string, number>",
                          "the estimates by name in SI, without those that are not determined"),
      getter<[](const R& r) {
        std::vector<std::string> names;
        for (const CalibratedParameter& of : r.found.parameters) names.push_back(of.name);
        return names;
      }>("names", "string[]", "of the parameters, in the order of `correlation`"),
      getter<[](const R& r) { return r.y; }>("y", "string", "the fitted column"),
      getter<[](const R& r) { return r.curve ? std::optional(r.curve->x) : std::nullopt; }>(
          "x", "string?", "of t:fit: the column along"),
      getter<[](const R& r) {
        return r.curve && !r.curve->name.empty() ? std::optional(r.curve->name) : std::nullopt;
      }>("name", "string?", "of t:fit: its name in charts"),
      getter<[](const R& r) { return r.curve ? Value(curve_type(r.curve->curve)) : Value(); }>(
          "curve", "FitCurve?", "of t:fit: the curve with its band, for drawing"),
      getter<[](const R& r) { return r.r_squared; }>(
          "r_squared", "number?", "of t:fit: explained share of the scatter of y; nil if all y are equal"),
      getter<[](const R& r) { return r.found.identifiable; }>("identifiable", "boolean",
                                                              "whether the rows determine every parameter"),
      getter<[](const R& r) { return r.found.verdict; }>(
          "verdict", "string", "determined and undetermined parameters, and the basis of the intervals"),
      getter<[](const R& r) { return r.found.combinations; }>(
          "combinations", "string[]", "determined combinations of parameters that the rows do not separate"),
      getter<told_correlation>("correlation", "number[][]",
                               "of the estimates; nan for parameters that are undetermined or at a bound"),
      getter<[](const R& r) { return r.found.condition; }>(
          "condition", "number?",
          "largest over smallest singular value of the Jacobian with columns of length 1; nil where a "
          "direction is not seen"),
      getter<[](const R& r) { return r.numbers.size(); }>("n", "integer", "rows that were used"),
      getter<[](const R& r) { return r.left_out; }>(
          "left_out", "integer", "rows with an empty cell, no finite number or a weight of 0"),
      getter<[](const R& r) { return std::vector<std::int64_t>(r.numbers.begin(), r.numbers.end()); }>(
          "rows", "integer[]", "the rows that were used, counted from 1 after `where`"),
      getter<[](const R& r) { return r.found.fitted; }>("fitted", "number[]", "the model in each row"),
      getter<[](const R& r) { return known_numbers(r.found.fitted_low); }>(
          "fitted_low", "number[]", "lower end of the interval of the model there; nan where there is none"),
      getter<[](const R& r) { return known_numbers(r.found.fitted_high); }>("fitted_high", "number[]",
                                                                            "upper end of it"),
      getter<[](const R& r) { return r.found.residuals; }>("residuals", "number[]",
                                                           "y less the model in each row"),
      getter<[](const R& r) { return r.found.residual_deviation; }>(
          "residual_sd", "number",
          "standard deviation of an observation about the model: relative with scatter=\"relative\", in "
          "units of `u` where that is known; 0 without degrees of freedom"),
      getter<[](const R& r) { return r.found.observations; }>("observations", "integer",
                                                              "rows, or specimens where their means count"),
      getter<[](const R& r) { return r.found.degrees; }>(
          "degrees", "integer", "degrees of freedom: observations less parameters that they determine"),
      getter<[](const R& r) { return r.found.by_specimens; }>("by_specimens", "boolean",
                                                              "whether the means of specimens were fitted"),
      getter<[](const R& r) { return calibrated_specimen_type.list(r.found.specimens); }>(
          "specimens", "CalibratedSpecimen[]", "in the order of their first rows; empty without `specimen`"),
      getter<[](const R& r) {
        return r.found.specimen_scatter ? std::optional(r.found.specimen_scatter->f) : std::nullopt;
      }>("specimen_f", "number?",
         "variance between specimens over that within them, as F has it; nil where it cannot be seen"),
      getter<[](const R& r) {
        return r.found.specimen_scatter ? std::optional(r.found.specimen_scatter->p_value) : std::nullopt;
      }>("specimen_p", "number?", "how often F is larger where specimens do not scatter"),
      getter<[](const R& r) { return r.found.confidence; }>("confidence", "number", "of the intervals"),
      getter<[](const R& r) { return r.found.cut; }>(
          "cut", "number", "of the profile likelihood: t² of the degrees of freedom"),
      getter<[](const R& r) { return r.found.warnings; }>("warnings", "string[]", "what to look at"),
      getter<[](const R& r) { return r.found.calls; }>("calls", "integer", "how often the model was called"),
  };
  c.methods = {
      {.name = "chart",
       .body = chart_calibration,
       .sentence = "Draws the measured rows with the fit and its band, or the profile likelihood of each "
                   "parameter; returns the file. Takes no call of the model.",
       .options = optional(calibration_chart_block),
       .returns = "string",
       .example = "lab.calibrate{ model=function(q, row) return q.mu0 + q.rise * row.N end, data=t, "
                  "y=\"mu\", parameters={ mu0=0.3, rise=0 } }:chart{ x=\"N\" }",
       .heavy = true},
  };
  return c;
}

}  // namespace asperity::lua
