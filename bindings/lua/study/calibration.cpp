// SPDX-License-Identifier: GPL-3.0-or-later
// What lab.calibrate returns: its fields, and its charts.
#include <limits>
#include <utility>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

// --- the records

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

const RecordType<ToldParameter>& calibrated_parameter_type() {
  using P = ToldParameter;
  using C = CalibratedParameter;
  static const RecordType<P> type{
      "CalibratedParameter",
      "parameter",
      "A parameter of a calibration, in SI.",
      {told_number<&C::value>("value", "its estimate; nil where the rows do not determine it"),
       told_number<&C::standard_error>(
           "u", "its standard uncertainty; nil at a bound, and where no scatter is seen"),
       told_number<&C::low>("low", "lower end of its linearised interval, not cut off at a bound"),
       told_number<&C::high>("high", "upper end of its linearised interval"),
       told_number<&C::profile_low>(
           "profile_low", "lower end of its interval by profile likelihood; nil where the rows give none"),
       told_number<&C::profile_high>(
           "profile_high", "upper end of its interval by profile likelihood; nil where the rows give none"),
       {"determined", [](const P& p) { return p.of.determined; }, "whether the rows determine it"},
       {"at_lower", [](const P& p) { return p.of.at_lower; }, "whether it stands at its lower bound"},
       {"at_upper", [](const P& p) { return p.of.at_upper; }, "whether it stands at its upper bound"},
       {"profile_values",
        [](const P& p) {
          std::vector<double> values;
          for (const ProfilePoint& point : p.of.profile) values.push_back(point.value);
          return values;
        },
        "places at which its profile was computed"},
       {"profile_excess",
        [](const P& p) {
          std::vector<double> values;
          for (const ProfilePoint& point : p.of.profile) values.push_back(point.excess);
          return values;
        },
        "(S - S_min)/s² there; the interval ends where it meets `cut`"}}};
  return type;
}

const RecordType<CalibratedSpecimen>& calibrated_specimen_type() {
  using S = CalibratedSpecimen;
  static const RecordType<S> type{
      "CalibratedSpecimen",
      "specimen",
      "A specimen of a calibration.",
      {{"name", &S::name, "as its column tells it"},
       {"rows", &S::rows, "how many rows are of it"},
       {"residual", &S::residual,
        "mean of its residuals: relative to the fit with scatter=\"relative\", in units of `u` where that is "
        "known, else in the unit of y"}}};
  return type;
}

// --- the fields

template <auto read>
Values of_calibration(Call& call) {
  return {detail::value_of_held(read(call.self<CalibrationReport>()))};
}

Values told_parameters(Call& call) {
  const CalibrationReport& report = call.self<CalibrationReport>();
  Record record;
  record.name = "parameters";
  for (std::size_t p = 0; p < report.found.parameters.size(); ++p) {
    const CalibratedParameter& of = report.found.parameters[p];
    Record one = calibrated_parameter_type()({of, report.dimensions[p]});
    one.name = of.name;
    record.add(of.name, std::move(one));
  }
  return {std::move(record)};
}

Values told_values(Call& call) {
  Map map;
  for (const CalibratedParameter& of : call.self<CalibrationReport>().found.parameters)
    if (of.value) map.items.emplace_back(of.name, *of.value);
  return {std::move(map)};
}

Values told_correlation(Call& call) {
  List rows;
  for (const auto& row : call.self<CalibrationReport>().found.correlation) {
    auto numbers = std::make_shared<Array<double>>();
    for (const std::optional<double>& value : row)
      numbers->push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    rows.items.emplace_back(Value::Numbers(std::move(numbers)));
  }
  return {std::move(rows)};
}

Values told_specimens(Call& call) {
  return {calibrated_specimen_type().list(call.self<CalibrationReport>().found.specimens)};
}

std::vector<double> known_numbers(const std::vector<std::optional<double>>& values) {
  std::vector<double> numbers;
  for (const std::optional<double>& value : values)
    numbers.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  return numbers;
}

template <auto read>
Getter field(const char* name, const char* type, const char* sentence) {
  return {name, type, sentence, {}, of_calibration<read>};
}

// --- the charts

struct CalibrationChartKeys {
  std::optional<std::string> x;
  bool likelihood = false;
  std::string title;
  std::optional<std::string> file;
};

const Block<CalibrationChartKeys>& calibration_chart_block() {
  using K = CalibrationChartKeys;
  static const Block<K> block{
      "chart",
      {text("x", &K::x, "the column along; without it measured y stands against that of the fit"),
       flag("likelihood", &K::likelihood,
            "draw the profile likelihood of each parameter instead, with the limit at which its interval "
            "ends"),
       text("title", &K::title, "above the chart"),
       text("file", &K::file,
            "an .svg, .png or .pdf under the run directory; default calibration-<y>.svg, with likelihood "
            "calibration-<y>-likelihood.svg")}};
  return block;
}

Values chart_calibration(Call& call) {
  const CalibrationReport& report = call.self<CalibrationReport>();
  const CalibrationChartKeys keys = call.options(calibration_chart_block());
  if (keys.likelihood && keys.x)
    throw Error(ErrorCode::bad_value,
                "`x` is of no use to the chart of the likelihood, which has the parameters along",
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

template <>
const Class& class_of<CalibrationReport>() {
  using R = CalibrationReport;
  static const Class type = [] {
    Class c;
    c.name = "Calibration";
    c.article_name = "a calibration";
    c.sentence =
        "What lab.calibrate found. print() shows a line a parameter, their correlation and the verdict.";
    c.describe = [](const void* self) { return calibration_text(*static_cast<const R*>(self)); };
    c.digest = [](const void* self) { return calibration_digest(*static_cast<const R*>(self)); };
    c.results = {&calibrated_parameter_type(), &calibrated_specimen_type()};
    c.fields = {
        {"parameters",
         "table<string, CalibratedParameter>",
         "each parameter under its name",
         {},
         told_parameters},
        {"values",
         "table<string, number>",
         "the estimates by name in SI, without those that are not determined",
         {},
         told_values},
        field<[](const R& r) {
          std::vector<std::string> names;
          for (const CalibratedParameter& of : r.found.parameters) names.push_back(of.name);
          return names;
        }>("names", "string[]", "of the parameters, in the order of `correlation`"),
        field<[](const R& r) { return r.found.identifiable; }>("identifiable", "boolean",
                                                               "whether the rows determine every parameter"),
        field<[](const R& r) { return r.found.verdict; }>(
            "verdict", "string", "what the rows determine and what not, and on what the intervals rest"),
        field<[](const R& r) { return r.found.combinations; }>(
            "combinations", "string[]",
            "what the rows determine in the place of parameters that they do not tell apart"),
        {"correlation",
         "number[][]",
         "of the estimates; nan beside parameters that are not determined or stand at a bound",
         {},
         told_correlation},
        field<[](const R& r) { return r.found.condition; }>(
            "condition", "number?",
            "largest over smallest singular value of the Jacobian with columns of length 1; nil where a "
            "direction is not seen"),
        field<[](const R& r) { return r.numbers.size(); }>("n", "integer", "rows that were used"),
        field<[](const R& r) { return r.left_out; }>("left_out", "integer",
                                                     "rows with an empty cell or no finite number"),
        field<[](const R& r) { return std::vector<std::int64_t>(r.numbers.begin(), r.numbers.end()); }>(
            "rows", "integer[]", "the rows that were used, counted from 1 after `where`"),
        field<[](const R& r) { return r.found.fitted; }>("fitted", "number[]", "the model in each row"),
        field<[](const R& r) { return known_numbers(r.found.fitted_low); }>(
            "fitted_low", "number[]",
            "lower end of the interval of the model there; nan where there is none"),
        field<[](const R& r) { return known_numbers(r.found.fitted_high); }>("fitted_high", "number[]",
                                                                             "upper end of it"),
        field<[](const R& r) { return r.found.residuals; }>("residuals", "number[]",
                                                            "y less the model in each row"),
        field<[](const R& r) { return r.found.residual_deviation; }>(
            "residual_sd", "number",
            "standard deviation of an observation about the model: relative with scatter=\"relative\", in "
            "units of `u` where that is known; 0 without degrees of freedom"),
        field<[](const R& r) { return r.found.observations; }>("observations", "integer",
                                                               "rows, or specimens where their means count"),
        field<[](const R& r) { return r.found.degrees; }>(
            "degrees", "integer", "degrees of freedom: observations less parameters that they determine"),
        field<[](const R& r) { return r.found.by_specimens; }>("by_specimens", "boolean",
                                                               "whether the means of specimens were fitted"),
        {"specimens",
         "CalibratedSpecimen[]",
         "in the order of their first rows; empty without `specimen`",
         {},
         told_specimens},
        field<[](const R& r) {
          return r.found.specimen_scatter ? std::optional(r.found.specimen_scatter->f) : std::nullopt;
        }>("specimen_f", "number?",
           "variance between specimens over that within them, as F has it; nil where it cannot be seen"),
        field<[](const R& r) {
          return r.found.specimen_scatter ? std::optional(r.found.specimen_scatter->p_value) : std::nullopt;
        }>("specimen_p", "number?", "how often F is larger where specimens do not scatter"),
        field<[](const R& r) { return r.found.confidence; }>("confidence", "number", "of the intervals"),
        field<[](const R& r) { return r.found.cut; }>(
            "cut", "number", "of the profile likelihood: t² of the degrees of freedom"),
        field<[](const R& r) { return r.found.warnings; }>("warnings", "string[]", "what to look at"),
        field<[](const R& r) { return r.found.calls; }>("calls", "integer", "how often the model was called"),
    };
    c.methods = {
        {.name = "chart",
         .body = chart_calibration,
         .sentence = "Draws the measured rows with the fit and its band, or the profile likelihood of each "
                     "parameter; returns the file. Takes no call of the model.",
         .options = &calibration_chart_block(),
         .options_optional = true,
         .returns = "string",
         .example =
             "lab.calibrate{ model=function(q, row) return q.mu0 + q.rise * row.N end, data=t, y=\"mu\", "
             "parameters={ mu0=0.3, rise=0 } }:chart{ x=\"N\" }",
         .heavy = true},
    };
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
