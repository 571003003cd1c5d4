// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/calibration.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "engine/core/monitor.hpp"
#include "engine/study/curve_fit.hpp"

namespace asperity::lua {

namespace {

struct FitKeys : CalibrationKeys {
  std::string model;                    // a word; empty for a function
  std::map<std::string, double> start;  // sorted, because Lua keeps no order
  bool function = false;
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
  const bool u = keys.u_number || keys.u_text;
  if (keys.weights && (u || keys.options.scatter == CalibrationScatter::relative))
    problems.push_back(u ? "`weights` and `u` both say how rows weigh; give `u` where it is known"
                         : "`weights` and scatter=\"relative\" both say how rows weigh; give one of them");
  keys.options.relative_u = keys.weights.has_value();
}

const Block<FitKeys>& fit_block() {
  using K = FitKeys;
  static const Block<K> block{
      "fit",
      {text("x", &CalibrationKeys::x, "the column along").required(),
       text("y", &CalibrationKeys::y, "the column that is fitted").required(),
       custom<K>("model", "\"linear\"|\"power\"|function",
                 "\"linear\": y = intercept + slope x; \"power\": y = a x^b; or a function(x, q) that "
                 "returns y from x and the table q of the parameters, in the units of the columns",
                 read_model)
           .required(),
       custom<K>("start", "table", "for a function: its parameters by name, with values to begin from",
                 read_start),
       u_option(), scatter_option(), specimen_option(), basis_option(),
       text("weights", &CalibrationKeys::weights,
            "a column of relative weights, with intervals that rest on the residuals; `u` instead where the "
            "uncertainty of y is known"),
       where_key(&CalibrationKeys::where), confidence_option(), profile_option(),
       text("name", &K::name, "what charts call it")},
      check_fit};
  return block;
}

// Parameter table and names stay on the stack until the surrounding guard removes them, so that a call
// allocates nothing.
class ScriptModel {
 public:
  ScriptModel(const Argument& function, const std::vector<CalibrationParameter>& start)
      : L_(function.state()), function_(function.index()), count_(static_cast<int>(start.size())) {
    if (lua_checkstack(L_, count_ + 12) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
    struct Fill {
      const std::vector<CalibrationParameter>* start;
      int operator()(lua_State* L) {
        luaL_checkstack(L, static_cast<int>(start->size()) + 4, nullptr);
        lua_createtable(L, 0, static_cast<int>(start->size()));
        for (const CalibrationParameter& parameter : *start) {
          lua_pushlstring(L, parameter.name.data(), parameter.name.size());
          lua_pushvalue(L, -1);
          lua_pushnumber(L, parameter.start);
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

CurveFit fit_of(Call& call, const FitKeys& keys, const CalibrationRows& rows) {
  if (keys.model == "linear") return fit_line(rows, keys.options);
  if (keys.model == "power") return fit_power(rows, keys.options);
  return with_key(call.argument(1), "model", [&](const Argument& function) {
    std::vector<CalibrationParameter> start;
    for (const auto& [name, value] : keys.start) start.push_back({name, value, {}, {}});
    const ScriptModel model(function, start);
    return fit_model(rows, model, start, keys.options);
  });
}

Values fit_of_columns(Call& call) {
  const FitKeys keys = call.options(fit_block());
  CalibrationInput input = calibration_input(*table_of_self(call), keys);
  CurveFit fit = fit_of(call, keys, input.rows);
  CalibrationReport report = calibration_report(call, keys, std::move(input), std::move(fit.found));
  report.curve = {keys.name, split_column_unit(*keys.x).name, report.y, keys.options.confidence,
                  std::move(fit.curve)};
  report.r_squared = fit.r_squared;
  return {object(std::move(report))};
}

}  // namespace

std::optional<FittedCurve> fitted_curve_of(const Argument& value) {
  const Object* object = value.as_object(class_of<CalibrationReport>());
  return object != nullptr && object->pointer != nullptr
             ? std::static_pointer_cast<const CalibrationReport>(object->pointer)->curve
             : std::nullopt;
}

Function fit_method() {
  return {
      .name = "fit",
      .body = fit_of_columns,
      .sentence =
          "Fits a curve to two columns by least squares, as lab.calibrate does: parameters with intervals "
          "and correlation, R², residuals, warnings of dependent residuals. `chart{ fit= }` "
          "draws it with its band. Undetermined parameters are an error with their names.",
      .options = &fit_block(),
      .returns = "Calibration",
      .example = "print(book:fit{ x=\"N\", y=\"mu\", model=\"linear\" })",
      .unknown_when_dry = true};
}

}  // namespace asperity::lua
