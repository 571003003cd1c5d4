// SPDX-License-Identifier: GPL-3.0-or-later
// t:fit: a straight line, a power law or a function of the script fitted to two columns. The function is
// called with x and a table of the parameters by name, one table for all calls; x, y and weights are in the
// units of their columns.
#include <algorithm>
#include <map>

#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/monitor.hpp"
#include "engine/statistics/curve_fit.hpp"
#include "engine/statistics/number_columns.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

struct FitKeys {
  std::string x, y;
  std::string model;  // a word; empty for a function
  bool function = false;
  std::map<std::string, double> start;  // in the order of names, for Lua keeps none
  std::optional<std::string> weights;
  TableFilter where;
  double confidence = 0.95;
  std::string name;
};

void read_model(const Argument& value, const OptionInfo& info, FitKeys& keys, Problems& problems) {
  static const std::vector<std::string> words = {"linear", "power"};
  if (value.is_function()) {
    keys.function = true;
  } else if (value.is_text()) {
    if (const auto place = detail::read_word(value, info, words, problems)) keys.model = words[*place];
  } else {
    detail::wrong_type(value, info, "\"linear\", \"power\" or a function(x, q)", problems);
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
                         "; give a number, in the units of the columns");
  });
}

void check_fit(FitKeys& keys, Problems& problems) {
  if (keys.function && keys.start.empty())
    problems.push_back(
        "`start` is missing: a function needs the names of its parameters and values to begin from, as in { "
        "a=1, b=0.5 }");
  if (!keys.function && !keys.start.empty())
    problems.push_back("`start` is of no use to the model \"" + keys.model + "\", which finds its own");
}

const Block<FitKeys>& fit_block() {
  using K = FitKeys;
  static const Block<K> block{
      "fit",
      {text("x", &K::x, "the column along").required(),
       text("y", &K::y, "the column that is fitted").required(),
       custom<K>("model", "\"linear\"|\"power\"|function",
                 "\"linear\": y = intercept + slope x; \"power\": y = a x^b; or a function(x, q) that "
                 "returns y from x and the table q of the parameters, in the units of the columns",
                 read_model)
           .required(),
       custom<K>("start", "table", "for a function: its parameters by name, with values to begin from",
                 read_start),
       text("weights", &K::weights,
            "a column of relative weights, such as 1/u² with u the uncertainty of y; all alike without it"),
       where_key(&K::where),
       number("confidence", &K::confidence, inside(0, 1), "of the intervals of parameters and curve"),
       text("name", &K::name, "what charts call it")},
      check_fit};
  return block;
}

// A function of the script as a model. Its table and the names of its parameters lie on the stack until the
// guard around it takes them away, so that a call takes no memory of its own.
class ScriptModel {
 public:
  ScriptModel(const Argument& function, const std::vector<FitStart>& start)
      : L_(function.state()), function_(function.index()), count_(static_cast<int>(start.size())) {
    if (lua_checkstack(L_, count_ + 12) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
    struct Fill {
      const std::vector<FitStart>* start;
      int operator()(lua_State* L) {
        luaL_checkstack(L, static_cast<int>(start->size()) + 4, nullptr);
        lua_createtable(L, 0, static_cast<int>(start->size()));
        for (const FitStart& parameter : *start) {
          lua_pushlstring(L, parameter.name.data(), parameter.name.size());
          lua_pushvalue(L, -1);
          lua_pushnumber(L, parameter.value);
          lua_rawset(L, 1);
        }
        return 1 + static_cast<int>(start->size());
      }
    } fill{&start};
    if (protect(L_, 0, 1 + count_, fill) != LUA_OK)
      throw Error(ErrorCode::out_of_memory, "no memory for the parameters of the model");
    table_ = lua_gettop(L_) - count_;
  }

  double operator()(double x, std::span<const double> parameters) const {
    const Argument::StackGuard guard(L_);
    struct Set {
      std::span<const double> values;
      int operator()(lua_State* L) {
        for (std::size_t k = 0; k < values.size(); ++k) {
          lua_pushvalue(L, 2 + static_cast<int>(k));
          lua_pushnumber(L, values[k]);
          lua_rawset(L, 1);
        }
        return 0;
      }
    } set{parameters};
    for (int k = 0; k <= count_; ++k) lua_pushvalue(L_, table_ + k);
    if (protect(L_, 1 + count_, 0, set) != LUA_OK)
      throw Error(ErrorCode::out_of_memory, "no memory for the parameters of the model");
    lua_pushvalue(L_, function_);
    lua_pushnumber(L_, x);
    lua_pushvalue(L_, table_);
    if (lua_pcall(L_, 2, 1, 0) != LUA_OK) {
      stop_flag().check();
      const Argument error(L_, -1);
      throw Error(ErrorCode::bad_value, "the function `model` failed: " +
                                            (error.is_text() ? std::string(error.text()) : error.describe()));
    }
    const Argument result(L_, -1);
    if (!result.is_number())
      throw Error(ErrorCode::bad_value, "the function `model` returned " + result.describe(),
                  "it must return a number");
    return result.number();
  }

 private:
  lua_State* L_;
  int function_, table_ = 0, count_;
};

// --- the record

// A fit of two columns.
struct ColumnFit {
  CurveFit fit;
  std::string name, x, y;
  std::size_t left_out = 0;
  std::vector<std::int64_t> rows;
  std::vector<CurvePoint> curve;
};

const RecordType<FittedParameter>& parameter_type() {
  using P = FittedParameter;
  static const RecordType<P> type{"FitParameter",
                                  "parameter",
                                  "A parameter of a fit, in the units of its columns.",
                                  {{"value", &P::value, "its estimate"},
                                   {"u", &P::standard_error, "its standard uncertainty"},
                                   {"low", &P::low, "lower end of its interval"},
                                   {"high", &P::high, "upper end of its interval"}}};
  return type;
}

std::vector<double> of_points(const std::vector<CurvePoint>& curve, double CurvePoint::*member) {
  std::vector<double> values;
  for (const CurvePoint& point : curve) values.push_back(point.*member);
  return values;
}

using Curve = std::vector<CurvePoint>;

const RecordType<Curve>& curve_type() {
  static const RecordType<Curve> type{
      "FitCurve",
      "curve",
      "A fitted curve over the range of its points, with the pointwise interval of the curve.",
      {{"x", [](const Curve& c) { return of_points(c, &CurvePoint::x); }, "places, ascending"},
       {"y", [](const Curve& c) { return of_points(c, &CurvePoint::y); }, "the curve there"},
       {"low", [](const Curve& c) { return of_points(c, &CurvePoint::low); },
        "lower end of its interval there"},
       {"high", [](const Curve& c) { return of_points(c, &CurvePoint::high); },
        "upper end of its interval there"}}};
  return type;
}

Value parameters_of(const ColumnFit& f) {
  Record record;
  record.name = "parameters";
  for (const FittedParameter& parameter : f.fit.parameters) {
    Record one = parameter_type()(parameter);
    one.name = parameter.name;
    record.add(parameter.name, std::move(one));
  }
  return record;
}

Value values_of_parameters(const ColumnFit& f) {
  Map map;
  for (const FittedParameter& parameter : f.fit.parameters)
    map.items.emplace_back(parameter.name, parameter.value);
  return map;
}

Value correlation_of(const ColumnFit& f) {
  List rows;
  for (const auto& row : f.fit.correlation)
    rows.items.emplace_back(std::make_shared<const Array<double>>(row.begin(), row.end()));
  return rows;
}

const RecordType<ColumnFit>& fit_type() {
  using F = ColumnFit;
  static const RecordType<F> type{
      "Fit",
      "fit",
      "A curve fitted to two columns by least squares. Intervals are Student's, of linearised parameters.",
      {{"name", [](const F& f) { return f.name.empty() ? std::nullopt : std::optional(f.name); },
        "what charts call it; nil where it has none"},
       {"x", &F::x, "the column along"},
       {"y", &F::y, "the column that was fitted"},
       {"model", [](const F& f) { return f.fit.model; }, "what was fitted"},
       {"method", [](const F& f) { return f.fit.method; }, "how"},
       {"parameters", "table<string, FitParameter>", parameters_of,
        "each parameter under its name: value, u, low, high"},
       {"values", "table<string, number>", values_of_parameters,
        "the estimates by name, to call the model with"},
       {"names",
        [](const F& f) {
          std::vector<std::string> names;
          for (const FittedParameter& parameter : f.fit.parameters) names.push_back(parameter.name);
          return names;
        },
        "of the parameters, in the order of `correlation`"},
       {"correlation", "number[][]", correlation_of, "of the estimates of the parameters"},
       {"r_squared", [](const F& f) { return f.fit.r_squared; },
        "share of the scatter of y that the curve explains; nil where every y is the same"},
       {"residual_sd", [](const F& f) { return f.fit.residual_deviation; },
        "standard deviation of a point of weight 1 about the curve"},
       {"residuals", [](const F& f) { return f.fit.residuals; },
        "y less the curve, for each row that was used"},
       {"rows", &F::rows, "the rows that were used, counted from 1 after `where`"},
       {"n", [](const F& f) { return f.fit.points; }, "rows that were used"},
       {"left_out", &F::left_out, "rows with an empty cell, no finite number or a weight of 0"},
       {"degrees", [](const F& f) { return f.fit.degrees; }, "degrees of freedom: rows less parameters"},
       {"confidence", [](const F& f) { return f.fit.confidence; }, "of the intervals"},
       {"curve", &F::curve, curve_type(), "the curve with its band, for drawing"},
       {"warnings", [](const F& f) { return f.fit.warnings; }, "what is hardly determined"}}};
  return type;
}

// --- the method

// `finish` is called with the fit while its model can be called.
template <class Finish>
void with_fit(Call& call, const FitKeys& keys, const FitPoints& points, Finish finish) {
  if (keys.model == "linear") return finish(fit_line(points, keys.confidence));
  if (keys.model == "power") return finish(fit_power(points, keys.confidence));
  with_key(call.argument(1), "model", [&](const Argument& function) {
    std::vector<FitStart> start;
    for (const auto& [name, value] : keys.start) start.push_back({name, value});
    const ScriptModel model(function, start);
    finish(fit_model(points, model, start, keys.confidence));
  });
}

Values fit_of_columns(Call& call) {
  const FitKeys keys = call.options(fit_block());
  const auto whole = table_of_self(call);
  const Rows table = rows_of(*whole, keys.where.rows(*whole));
  std::vector<std::pair<std::string, std::string>> named = {{"x", keys.x}, {"y", keys.y}};
  if (keys.weights) named.emplace_back("weights", *keys.weights);
  const NumberColumns numbers = number_columns(table, named);
  FitPoints points{numbers.values[0], numbers.values[1], {}};
  if (keys.weights) points.weights = numbers.values[2];
  ColumnFit of;
  of.name = keys.name;
  of.x = keys.x;
  of.y = keys.y;
  with_fit(call, keys, points, [&](CurveFit fit) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < points.x.size(); ++k) {
      if (!points.weights.empty() && points.weights[k] == 0) continue;
      of.rows.push_back(static_cast<std::int64_t>(numbers.rows[k] + 1));
      low = std::min(low, points.x[k]);
      high = std::max(high, points.x[k]);
    }
    of.curve = sampled_curve(fit, low, high);
    of.fit = std::move(fit);
    of.fit.at = nullptr;  // the function of the script is not there for longer
  });
  of.left_out = table.rows() - of.rows.size();
  warn_of(call, of.fit.warnings);
  return {fit_type()(of)};
}

std::vector<double> numbers_in(const Record& record, std::string_view field) {
  const Value* value = record.find(field);
  const auto* numbers = value == nullptr ? nullptr : std::get_if<Value::Numbers>(&value->data);
  return numbers == nullptr ? std::vector<double>()
                            : std::vector<double>((*numbers)->begin(), (*numbers)->end());
}

std::string text_in(const Record& record, std::string_view field) {
  const Value* value = record.find(field);
  const auto* found = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
  return found == nullptr ? std::string() : *found;
}

}  // namespace

std::vector<const RecordInfo*> fit_types() { return {&fit_type(), &parameter_type(), &curve_type()}; }

std::optional<FittedCurve> fitted_curve_of(const Argument& value) {
  const std::shared_ptr<Record> record = record_at(value.state(), value.index());
  if (record == nullptr || record->name != fit_type().title) return {};
  const Value* curve = record->find("curve");
  const auto* inner = curve == nullptr ? nullptr : std::get_if<std::shared_ptr<Record>>(&curve->data);
  if (inner == nullptr) return {};
  FittedCurve found{text_in(*record, "name"), text_in(*record, "x"), text_in(*record, "y"), 0.95, {}};
  if (const Value* confidence = record->find("confidence"))
    found.confidence = confidence->number().value_or(0.95);
  const auto x = numbers_in(**inner, "x"), y = numbers_in(**inner, "y"), low = numbers_in(**inner, "low"),
             high = numbers_in(**inner, "high");
  for (std::size_t k = 0; k < std::min({x.size(), y.size(), low.size(), high.size()}); ++k)
    found.curve.push_back({x[k], y[k], low[k], high[k]});
  return found;
}

Function fit_method() {
  return {.name = "fit",
          .body = fit_of_columns,
          .sentence =
              "Fits a curve to two columns by least squares: parameters with intervals and correlation, R², "
              "residuals. `chart{ fit= }` draws it with its band. Parameters that the rows do not determine "
              "are an error that names them.",
          .options = &fit_block(),
          .returns = "Fit",
          .example = "print(book:fit{ x=\"N\", y=\"mu\", model=\"linear\" })",
          .unknown_when_dry = true};
}

}  // namespace asperity::lua
