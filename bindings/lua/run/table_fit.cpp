// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <utility>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/calibration.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/require.hpp"
#include "engine/study/curve_fit.hpp"

namespace asperity::lua {

namespace {

struct FitKeys : CalibrationKeys {
  std::string model;                    // "" for a function
  std::map<std::string, double> start;  // sorted: Lua has no order
  bool function = false;
  std::string name;
};

void read_model(const Argument& value, const OptionInfo& info, FitKeys& keys, Problems& problems) {
  static const std::vector<std::string> words = {"linear", "power"};
  if (value.is_function()) {
    keys.function = true;
    const Argument::StackGuard guard(value.state());
    lua_pushvalue(value.state(), value.index());
    const char* first = lua_getlocal(value.state(), nullptr, 1);
    if (first != nullptr && std::string_view(first) == "x")
      problems.push_back(quoted(info.name) + " is function(x, …); parameters come first: function(q, row)");
  } else if (value.is_text()) {
    if (const auto place = detail::read_word(value, info, words, problems)) keys.model = words[*place];
  } else {
    detail::wrong_type(value, info, "\"linear\", \"power\" or a function(q, row)", problems);
  }
}

void read_start(const Argument& value, const OptionInfo& info, FitKeys& keys, Problems& problems) {
  if (!value.is_table()) return detail::wrong_type(value, info, "a table such as { a=1, b=0.5 }", problems);
  value.each([&](const Argument& key, const Argument& number) {
    if (!key.is_text())
      problems.push_back(quoted(info.name) + " names a parameter by " + key.describe() +
                         "; give each a name, as in { a=1, b=0.5 }");
    else if (number.is_number())
      keys.start.emplace(key.text(), number.number());
    else if (!number.is_unknown())
      problems.push_back("`start." + std::string(key.text()) + "` is " + number.describe() +
                         "; give a number in SI");
  });
}

void check_fit(FitKeys& keys, Problems& problems) {
  if (keys.function && keys.start.empty())
    problems.push_back(
        "`start` is missing: a function needs the names of its parameters and values to begin from, as in { "
        "a=1, b=0.5 }");
  if (!keys.function && !keys.start.empty())
    problems.push_back("`start` has no effect on the model \"" + keys.model + "\"; leave it out");
  const bool u = keys.u_number || keys.u_text;
  if (keys.weights && (u || keys.options.scatter == CalibrationScatter::relative))
    problems.push_back(
        u ? "`weights` and `u` both set the weights of rows; give `u` if it is known"
          : "`weights` and scatter=\"relative\" both set the weights of rows; give one of them");
  keys.options.relative_u = keys.weights.has_value();
}

const Block<FitKeys> fit_block{
    {text("x", &CalibrationKeys::x, "the column along").required(),
     text("y", &CalibrationKeys::y, "the column that is fitted").required(),
     custom<FitKeys>("model", "\"linear\"|\"power\"|function",
                     "\"linear\": y = intercept + slope x; \"power\": y = a x^b; or a function(q, row) that "
                     "returns y from the table q of parameters and the columns of a row, all in SI. Where "
                     "the curve is drawn, row has x only",
                     read_model)
         .required(),
     custom<FitKeys>("start", "table", "for a function: its parameters by name, with values to begin from",
                     read_start),
     u_option(), scatter_option(), specimen_option(), basis_option(),
     text("weights", &CalibrationKeys::weights,
          "a column of relative weights, with intervals that rest on the residuals; `u` instead where the "
          "uncertainty of y is known"),
     where_key(&CalibrationKeys::where), confidence_option(), profile_option(),
     text("name", &FitKeys::name, "its name in charts")},
    check_fit};

// model(q, row): row from the columns of the table, or x alone.
class ScriptModel {
 public:
  ScriptModel(const Argument& function, const std::vector<CalibrationParameter>& start, const Table& rows,
              std::string x)
      : function_(function), rows_(rows), x_(std::move(x)) {
    for (const CalibrationParameter& parameter : start) q_.items.emplace_back(parameter.name, 0.0);
  }

  // On the curve between the rows.
  double operator()(double x, std::span<const double> parameters) const {
    Map row;
    row.items.emplace_back(x_, x);
    return value(std::move(row), parameters);
  }
  double in_row(std::size_t row, std::span<const double> parameters) const {
    return value(row_of(rows_, row), parameters);
  }

 private:
  double value(Map row, std::span<const double> parameters) const {
    Map q = q_;
    for (std::size_t k = 0; k < parameters.size(); ++k) q.items[k].second = parameters[k];
    lua_State* L = function_.state();
    const Argument::StackGuard guard(L);
    if (const auto failure = failure_of_call(function_, {std::move(q), std::move(row)}))
      refuse("the function `model` failed: " + *failure, order);
    const Argument result(L, -1);
    if (!result.is_number())
      refuse("the function `model` returned " + result.describe(),
             std::string("it must return a number; ") + order);
    return result.number();
  }

  static constexpr const char* order = "parameters come first: model=function(q, row) … end";
  Argument function_;
  const Table& rows_;
  std::string x_;
  Map q_;
};

CurveFit fit_of(Call& call, const FitKeys& keys, const CalibrationInput& input) {
  const CalibrationRows& rows = input.rows;
  if (keys.model == "linear") return fit_line(rows, keys.options);
  if (keys.model == "power") return fit_power(rows, keys.options);
  return with_key(call.argument(1), "model", [&](const Argument& function) {
    std::vector<CalibrationParameter> start;
    for (const auto& [name, value] : keys.start) start.push_back({name, value, {}, {}});
    const ScriptModel model(function, start, input.used, split_column_unit(*keys.x).name);
    return fit_model(rows, model, start, keys.options,
                     [&model](std::size_t row, std::span<const double> q) { return model.in_row(row, q); });
  });
}

// In SI, with the display units of the columns.
void show_line_in_units(CalibrationReport& report, const FitKeys& keys) {
  const auto unit_of = [&](const std::string& name) {
    return report.rows.display_unit_of(name, report.rows.column(name, "x"));
  };
  const std::string x = unit_of(*keys.x), y = unit_of(keys.y);
  report.dimensions = {parse_unit(y).dimension, parse_unit(y).dimension / parse_unit(x).dimension};
  if (x.find_first_of("/ ^*") != std::string::npos) return;
  report.units = {y, x.empty() ? y : (y.empty() ? "1" : y) + "/" + x};
}

Values fit_of_columns(Call& call) {
  const FitKeys keys = call.options(fit_block);
  CalibrationInput input = calibration_input(*table_of_self(call), keys);
  CurveFit fit = fit_of(call, keys, input);
  CalibrationReport report = calibration_report(call, keys, std::move(input), std::move(fit.found));
  report.curve = {keys.name, split_column_unit(*keys.x).name, report.y, keys.options.confidence,
                  std::move(fit.curve)};
  report.r_squared = fit.r_squared;
  if (keys.model == "linear") show_line_in_units(report, keys);
  return {object(std::move(report))};
}

}  // namespace

std::optional<FittedCurve> fitted_curve_of(const Argument& value) {
  const auto* report = value.as<CalibrationReport>();
  return report != nullptr ? report->curve : std::nullopt;
}

Function fit_method() {
  return {.name = "fit",
          .body = fit_of_columns,
          .sentence =
              "Fits a curve to two columns by least squares, as lab.calibrate does: parameters with "
              "intervals and correlation, R², residuals, warnings of dependent residuals. `chart{ fit= }` "
              "draws it with its band. Undetermined parameters are an error with their names.",
          .options = &fit_block,
          .returns = "Calibration",
          .example = "print(book:fit{ x=\"N\", y=\"mu\", model=\"linear\" })",
          .unknown_when_dry = true};
}

}  // namespace asperity::lua
