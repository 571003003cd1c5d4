// SPDX-License-Identifier: GPL-3.0-or-later
// lab.calibrate: a model of parameters q (SI) and a row of rows().
#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/calibration.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/study/asked_function.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"
#include "engine/study/calibrate.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

struct CalibrateKeys : CalibrationKeys {
  std::shared_ptr<const Rows> data;
  std::vector<CalibrationParameter> parameters;  // by name: Lua has no order
  std::vector<Dimension> dimensions;
  std::string replicate;  // its key
  std::vector<double> faces;
};

// In SI, or the first quantity's dimension.
std::optional<double> parameter_number(const Argument& value, const std::string& key,
                                       std::optional<Dimension>& dimension, Problems& problems) {
  const auto quantity = detail::read_any_quantity(value, key, "a number or a quantity", problems);
  if (!quantity) return {};
  if (value.is_number()) return quantity->value;
  if (dimension && !(*dimension == quantity->dimension)) {
    problems.push_back(quoted(key) + " is " + describe(quantity->dimension) +
                       ", and another value of the parameter is " + describe(*dimension));
    return {};
  }
  dimension = quantity->dimension;
  return quantity->value;
}

struct NamedParameter {
  CalibrationParameter parameter;
  std::optional<Dimension> dimension;
};

// nil keys count as absent.
NamedParameter parameter_of(const std::string& name, const Argument& table, Problems& problems) {
  static const std::vector<std::string> keys = {"start", "lower", "upper", "step"};
  NamedParameter found;
  found.parameter.name = name;
  const std::string path = "parameters." + name;
  if (!table.is_table()) {
    if (auto start = parameter_number(table, path, found.dimension, problems)) found.parameter.start = *start;
    return found;
  }
  bool started = false;
  table.each([&](const Argument& key, const Argument&) {
    const std::string given = key.is_text() ? std::string(key.text()) : key.describe();
    if (std::ranges::find(keys, given) == keys.end())
      problems.push_back(quoted(path) + " has no key " + quoted(given) + did_you_mean(given, keys) +
                         "; it takes start, lower, upper and step");
  });
  for (const std::string& key : keys)
    with_key(table, key, [&](const Argument& value) {
      if (value.is_nil()) return;
      started = started || key == "start";
      std::optional<Dimension> none = dimension::number;
      const auto read =
          parameter_number(value, path + "." + key, key == "step" ? none : found.dimension, problems);
      if (!read) return;
      if (key == "start") found.parameter.start = *read;
      if (key == "lower" && *read != -std::numeric_limits<double>::infinity()) found.parameter.lower = *read;
      if (key == "upper" && *read != std::numeric_limits<double>::infinity()) found.parameter.upper = *read;
      if (key == "step") found.parameter.step = *read;
    });
  if (!started) problems.push_back(quoted(path + ".start") + " is missing: give the value to begin from");
  return found;
}

void read_parameters(const Argument& value, const OptionInfo& info, CalibrateKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info,
                              "a table such as { tau0={ start=\"500 MPa\", lower=0 }, alpha=0.2 }", problems);
  std::map<std::string, NamedParameter> named;
  value.each([&](const Argument& key, const Argument& table) {
    if (!key.is_text())
      return problems.push_back(quoted(info.name) + " names a parameter by " + key.describe() +
                                "; give each a name, as in { alpha={ start=0.2 } }");
    const std::string name(key.text());
    if (!table.is_unknown()) named.emplace(name, parameter_of(name, table, problems));
  });
  if (named.empty() && problems.empty())
    problems.push_back(quoted(info.name) + " names no parameter; give one as in { alpha={ start=0.2 } }");
  for (auto& [name, one] : named) {
    keys.parameters.push_back(std::move(one.parameter));
    keys.dimensions.push_back(one.dimension.value_or(dimension::number));
    keys.parameters.back().unit = si_unit(keys.dimensions.back());
  }
}

void read_faces(const Argument& value, const OptionInfo& info, CalibrateKeys& keys, Problems& problems) {
  std::size_t count = 0;
  if (value.is_table())
    value.each([&](const Argument& key, const Argument& list) {
      ++count;
      if (key.is_text()) keys.replicate = std::string(key.text());
      if (list.is_table())
        list.elements([&](const Argument& face) {
          if (face.is_number()) keys.faces.push_back(face.number());
        });
    });
  if (count != 1 || keys.replicate.empty() || keys.faces.size() < 2)
    detail::wrong_type(value, info, "one key with two numbers or more, as in { seed={ 1, 2, 3, 4 } }",
                       problems);
}

void read_data(const Argument& value, const OptionInfo& info, CalibrateKeys& keys, Problems& problems) {
  if (const auto* book = value.as<Notebook>()) {
    keys.data = std::make_shared<const Rows>(book->table());
  } else if (Object* object = value.as_object(class_of<Rows>())) {
    if (object->pointer != nullptr) keys.data = std::static_pointer_cast<const Rows>(object->pointer);
  } else if (value.as_object(class_of<Notebook>()) == nullptr) {
    detail::wrong_type(value, info, "a table (lab.table) or a notebook", problems);
  }
}

const Block<CalibrateKeys> calibrate_block{
    {function<CalibrateKeys>(
         "model", "a function(q, row)",
         "function(q, row) returning y, one number: q holds the parameters by name in SI, row the cells of a "
         "row by column as rows() gives them; nil where it has no value")
         .required(),
     custom<CalibrateKeys>("data", "Table|Notebook", "the measured rows", read_data).required(),
     text("y", &CalibrateKeys::y, "the column that the model is to give").required(),
     custom<CalibrateKeys>(
         "parameters", "table",
         "each parameter by its name: { start=, lower=, upper=, step= }, numbers in SI or quantities, or its "
         "start alone. lower and upper may be left out; step is that of differences, relative (0.001), and "
         "wants to be larger for a model with a tolerance of its own",
         read_parameters)
         .required(),
     custom<CalibrateKeys>(
         "replicate", "table",
         "a key of q with numbers, as in { seed={ 1, 2, 3, 4 } }: the model is the mean over them, and their "
         "scatter a part of u that rows of one specimen share; intervals are linearised alone",
         read_faces),
     u_option(), scatter_option(), specimen_option(), basis_option(), confidence_option(), profile_option(),
     where_key(&CalibrateKeys::where)}};

// The rows are on the stack.
class CalibratedFunction {
 public:
  CalibratedFunction(const Call& call, const Argument& function, const Rows& rows, const CalibrateKeys& keys,
                     const std::vector<std::size_t>& numbers)
      : session_(call.session()),
        monitor_(session_.monitor()),
        L(function.state()),
        function_(function.index()),
        parameters_(keys.parameters),
        faces_(keys.faces),
        numbers_(numbers) {
    if (!faces_.empty()) parameters_.push_back({keys.replicate, faces_.front(), {}, {}});
    if (lua_checkstack(L, 20) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
    list_ = rows_of_table(rows);
    push_checked(L, list_, "the rows of the calibration");
    rows_ = lua_gettop(L);
    find_heavy(call, function);
  }

  // True: call rarely.
  bool heavy() const { return heavy_; }

  std::vector<double> operator()(std::span<const CalibrationQuery> queries,
                                 const std::function<void(std::size_t)>& done) {
    std::vector<double> values;
    if (batch_ == nullptr) {
      for (const CalibrationQuery& query : queries) {
        stop_flag().check();
        const std::vector<double> q = values_of(query);
        const bool known = begun_ && query.row == 0 && q == start();
        values.push_back(known ? *std::exchange(begun_, {}) : (*this)(q, query.row));
        done(values.size());
        if (!std::isfinite(values.back())) break;
      }
      return values;
    }
    std::vector<Values> arguments;
    for (const CalibrationQuery& query : queries)
      arguments.push_back({named(values_of(query)), list_.items[query.row]});
    const Session::Reporting reporting(session_, monitor_);
    const std::vector<BatchedAnswer> answers = batch_->answers(arguments, done);
    for (std::size_t k = 0; k < answers.size(); ++k) {
      if (!answers[k].failure.empty())
        throw failure_in(values_of(queries[k]), queries[k].row, without_traceback(answers[k].failure));
      if (!answers[k].number && !answers[k].nil)
        throw wrong_answer(values_of(queries[k]), queries[k].row, answers[k].other);
      values.push_back(answers[k].number.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return values;
  }

  double operator()(std::span<const double> q, std::size_t row) {
    const Argument::StackGuard guard(L);
    lua_pushvalue(L, function_);
    push_checked(L, named(q), "the parameters of the model");
    lua_rawgeti(L, rows_, static_cast<lua_Integer>(row) + 1);
    const Session::Reporting reporting(session_, monitor_);
    if (const auto failure = failure_of_call(L, 2, 1)) throw failure_in(q, row, *failure);
    const Argument result(L, -1);
    if (result.is_nil()) return std::numeric_limits<double>::quiet_NaN();
    if (!result.is_number()) throw wrong_answer(q, row, result.describe());
    return result.number();
  }

 private:
  // Calls the model twice for the first row: a cached model is not heavy.
  void find_heavy(const Call& call, const Argument& function) {
    if (list_.items.empty() || parameters_.empty()) return;
    std::int64_t before = session_.heavy_calls;
    begun_ = (*this)(start(), 0);
    if (session_.heavy_calls == before || !std::isfinite(*begun_)) return;
    std::vector<double> beside = start();
    const CalibrationParameter& first = parameters_.front();
    const double step = 0.02 * (first.start != 0 ? std::abs(first.start) : 1);
    beside[0] += first.upper && first.start + step > *first.upper ? -step : step;
    if (first.lower && beside[0] < *first.lower) return;
    before = session_.heavy_calls;
    (*this)(beside, 0);
    heavy_ = session_.heavy_calls > before;
    if (heavy_) batch_ = call_batch(call, function, "model");
  }

  std::vector<double> values_of(const CalibrationQuery& query) const {
    std::vector<double> q(query.parameters.begin(), query.parameters.end());
    if (!faces_.empty()) q.push_back(faces_[query.replicate]);
    return q;
  }

  Map named(std::span<const double> q) const {
    Map map;
    for (std::size_t k = 0; k < q.size(); ++k) map.items.emplace_back(parameters_[k].name, q[k]);
    return map;
  }
  std::vector<double> start() const {
    std::vector<double> q;
    for (const CalibrationParameter& parameter : parameters_) q.push_back(parameter.start);
    return q;
  }

  Error failure_in(std::span<const double> q, std::size_t row, const std::string& why) const {
    return Error(ErrorCode::bad_value, "the function `model` failed in " + place(q, row) + ": " + why);
  }
  Error wrong_answer(std::span<const double> q, std::size_t row, const std::string& what) const {
    return Error(ErrorCode::bad_value, "the function `model` returned " + what + " for " + place(q, row),
                 "return one number in the unit of y, or nil where there is none");
  }

  std::string place(std::span<const double> q, std::size_t row) const {
    std::string text = "row " + std::to_string(numbers_[row]) + " with ";
    for (std::size_t k = 0; k < q.size(); ++k)
      text += (k > 0 ? ", " : "") + parameters_[k].name + " = " + format_short(q[k]) +
              (parameters_[k].unit.empty() ? "" : " " + parameters_[k].unit);
    return text;
  }

  Session& session_;
  QuietMonitor monitor_;
  std::unique_ptr<CallBatch> batch_;
  List list_;                    // rows
  std::optional<double> begun_;  // first row at the start
  bool heavy_ = false;
  lua_State* L;
  int function_, rows_ = 0;
  std::vector<CalibrationParameter> parameters_;  // and any replicate
  std::vector<double> faces_;
  const std::vector<std::size_t>& numbers_;
};

Values run_calibration(Call& call) {
  const CalibrateKeys keys = call.options(calibrate_block);
  if (keys.data == nullptr) refuse_state("`data` has no rows", "give a table of measured rows");
  CalibrationInput input = calibration_input(*keys.data, keys);
  Session& session = call.session();
  return with_key(call.argument(1), "model", [&](const Argument& function) -> Values {
    const Argument::StackGuard guard(call.L);
    check_calibration(input.rows, keys.parameters, keys.options);
    if (std::ranges::find(keys.parameters, keys.replicate, &CalibrationParameter::name) !=
        keys.parameters.end())
      refuse("`replicate` names " + quoted(keys.replicate) + ", which is a parameter, too",
             "give one of them another name");
    input.rows.replicates = std::max<std::size_t>(keys.faces.size(), 1);
    CalibratedFunction model(call, function, input.used, keys, input.numbers);
    CalibrationOptions options = keys.options;
    options.sparing = model.heavy();
    const CalibrationBatch batch = [&model](std::span<const CalibrationQuery> queries,
                                            const std::function<void(std::size_t)>& done) {
      return model(queries, done);
    };
    Calibration found = calibrate(input.rows, batch, keys.parameters, options, session.monitor());
    CalibrationReport report = calibration_report(call, keys, std::move(input), std::move(found));
    report.dimensions = keys.dimensions;
    return {object(std::move(report))};
  });
}

}  // namespace

Function calibrate_function() {
  return {.name = "calibrate",
          .body = run_calibration,
          .sentence =
              "Fits parameters of a law or a model to measured rows by least squares, and reports for "
              "each: estimate, linearised interval (Student's t), interval by profile likelihood (F), "
              "correlation, and a verdict. A parameter that the rows do not determine gets no number; the "
              "combination that they determine is named. Derivatives are taken by the program.",
          .options = &calibrate_block,
          .returns = "Calibration",
          .example =
              "print(lab.calibrate{ model=function(q, row) return q.mu0 + q.rise * row.N end, data=t, "
              "y=\"mu\", parameters={ mu0={ start=0.3, lower=0 }, rise=0 } })",
          .heavy = true};
}

}  // namespace asperity::lua
