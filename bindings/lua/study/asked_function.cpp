// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/study/asked_function.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/sample_mean.hpp"

namespace asperity::lua {

namespace {

[[noreturn]] void no_number(const Argument& answer, const Knobs& knobs) {
  refuse("`ask` returned " + answer.describe() + " for " + lua_source(knobs), "return one number");
}

// On failure adds a problem and returns nothing.
std::optional<Quantity> quantity_of(const Argument& value, const std::string& path, Problems& problems) {
  constexpr std::string_view wanted = "a number or a quantity such as \"1.1 GPa\"";
  if (!value.is_nil()) return detail::read_any_quantity(value, path, wanted, problems);
  problems.push_back(quoted(path) + " is missing; give " + std::string(wanted));
  return {};
}

constexpr const char* input_example = "give { value=, u= }, such as { value=\"1.1 GPa\", u=\"0.1 GPa\" }";

InputShape read_shape(const Argument& given, const std::string& place, Problems& problems) {
  const auto shapes = input_shapes().first(4);
  const auto found = std::ranges::find(shapes, given.is_text() ? given.text() : "");
  if (found == shapes.end())
    detail::wrong_type(given, place, "\"normal\", \"uniform\", \"lognormal\" or \"triangular\"", problems);
  return static_cast<InputShape>(found - shapes.begin());
}

std::vector<Quantity> read_sample(const Argument& given, const std::string& place, Problems& problems) {
  std::vector<Quantity> sample;
  if (given.is_table())
    given.elements([&](const Argument& item, std::int64_t k) {
      if (const auto read = quantity_of(item, place + "[" + std::to_string(k) + "]", problems))
        sample.push_back(*read);
    });
  if (sample.size() < 10)
    problems.push_back(quoted(place) + " has fewer than 10 numbers; give the mean of a few readings, " +
                       "u = s / sqrt(n) and degrees = n - 1");
  return sample;
}

// A share of the value, which may not be read yet.
void resolve_share(const Argument& table, const std::string& path, Quantity& share) {
  with_key(table, "value", [&](const Argument& of) {
    Problems ignored;
    if (const auto whole = quantity_of(of, path, ignored))
      share = Quantity{std::abs(whole->value) * share.value, whole->dimension};
  });
}

void read_input(const std::string& name, const std::string& path, const Argument& table, InputKeys& keys,
                Problems& problems) {
  if (!table.is_table()) {
    problems.push_back(quoted(path) + " is " + table.describe() + "; " + input_example);
    return;
  }
  UncertainInput input;
  input.name = name;
  bool unknown = false;
  std::optional<Quantity> value, u;
  std::vector<Quantity> sample;
  const std::size_t before = problems.size();
  table.each([&](const Argument& key, const Argument& given) {
    static const std::vector<std::string> names = {"value", "u", "shape", "degrees", "sample"};
    const std::string text(key.is_text() ? key.text() : ""), place = path + "." + text;
    if (std::ranges::find(names, text) == names.end()) {
      problems.push_back(quoted(path) + " has no key " + (key.is_text() ? quoted(text) : key.describe()) +
                         did_you_mean(text, names) +
                         "; it takes `value`, `u`, `shape`, `degrees` or `sample`");
    } else if (given.is_unknown()) {
      unknown = true;
    } else if (text == "shape") {
      input.shape = read_shape(given, place, problems);
    } else if (text == "degrees") {
      input.degrees = given.is_number() ? given.number() : 0;
    } else if (text == "sample") {
      sample = read_sample(given, place, problems);
    } else {
      auto read = quantity_of(given, place, problems);
      if (text == "u" && given.is_text() && given.text().find('%') != std::string_view::npos && read)
        resolve_share(table, path, *read);
      (text == "u" ? u : value) = read;
    }
  });
  keys.unknown = keys.unknown || unknown;
  if (unknown || problems.size() > before) return;
  if (!sample.empty()) {
    input.shape = InputShape::sample;
    for (const Quantity& of : sample) input.sample.push_back(of.value);
    std::ranges::sort(input.sample);
    const SampleMean mean = sample_mean(input.sample);
    value = Quantity{mean.mean, sample.front().dimension};
    u = Quantity{*mean.deviation, sample.front().dimension};
  }
  for (const auto& [key, read] : {std::pair("value", value), std::pair("u", u)})
    if (!read) problems.push_back(quoted(path) + " has no " + quoted(key) + "; " + input_example);
  if (!value || !u) return;
  if (!(value->dimension == u->dimension)) {
    problems.push_back(quoted(path) + " has a value that is " + describe(value->dimension) +
                       " and an uncertainty that is " + describe(u->dimension) +
                       "; give both in units of one kind");
    return;
  }
  input.value = value->value;
  input.uncertainty = u->value;
  input.dimension = value->dimension;
  keys.inputs.push_back(std::move(input));
}

void read_calibration(const Object& object, const std::string& path, InputKeys& keys, Problems& problems) {
  keys.unknown = keys.unknown || object.pointer == nullptr;  // a placeholder
  if (keys.unknown) return;
  const auto& report = *static_cast<const CalibrationReport*>(object.pointer.get());
  for (std::size_t k = 0; k < report.found.parameters.size(); ++k) {
    const CalibratedParameter& of = report.found.parameters[k];
    if (!of.value || !of.standard_error) {
      problems.push_back(
          quoted(path) + " gives " + quoted(of.name) +
          " no uncertainty; print the calibration, and calibrate only parameters that its rows determine");
      continue;
    }
    UncertainInput& input = keys.inputs.emplace_back();
    input.name = of.name;
    input.value = *of.value;
    input.uncertainty = *of.standard_error;
    input.degrees = static_cast<double>(report.found.degrees);
    input.dimension = report.dimensions[k];
    for (std::size_t j = 0; j < k; ++j)
      if (const auto& both = report.found.correlation[j][k]; both && *both != 0)
        keys.correlations.push_back({report.found.parameters[j].name, of.name, *both});
  }
}

}  // namespace

std::optional<KnobValue> knob_value(const Argument& value, bool& unknown) {
  if (value.is_unknown()) {
    unknown = true;
    return KnobValue(0.0);
  }
  if (value.is_boolean()) return KnobValue(value.boolean());
  if (value.is_number())
    return value.integer() && lua_isinteger(value.state(), value.index()) != 0 ? KnobValue(*value.integer())
                                                                               : KnobValue(value.number());
  if (value.is_text()) return KnobValue(std::string(value.text()));
  return {};
}

void read_sweep(const std::string& name, const std::string& path, const Argument& value, bool& unknown,
                std::vector<KnobSweep>& knobs, Problems& problems) {
  KnobSweep knob{name, {}, value.is_table()};
  const auto take = [&](const Argument& item, const std::string& place) {
    if (auto read = knob_value(item, unknown))
      knob.values.push_back(*std::move(read));
    else
      detail::wrong_type(item, place, std::string(knob_kinds) + ", and convert it inside `ask`", problems);
  };
  if (!value.is_table()) {
    take(value, path);
  } else {
    if (!value.is_list()) {
      problems.push_back(quoted(path) + " is not a list; write its values one after the other, without nil");
      return;
    }
    value.elements(
        [&](const Argument& item, std::int64_t k) { take(item, path + "[" + std::to_string(k) + "]"); });
  }
  knobs.push_back(std::move(knob));
}

Map knobs_map(const Knobs& knobs) {
  Map map;
  for (const Knob& one : knobs)
    std::visit([&](const auto& value) { map.items.emplace_back(one.name, Value(value)); }, one.value);
  return map;
}

void push_with_knobs(lua_State* L, const Argument& function, const Knobs& knobs, const char* table) {
  if (lua_checkstack(L, 8) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
  lua_pushvalue(L, function.index());
  push_checked(L, knobs_map(knobs), table);
}

void AskedFunction::call(const Knobs& knobs) const {
  push_with_knobs(L_, ask_, knobs, "the table of `ask`");
  if (const auto failure = failure_of_call(L_, 1, 1))
    refuse("`ask` failed for " + lua_source(knobs) + ": " + *failure);
}

AskedFunction::Answer AskedFunction::operator()(const Knobs& knobs, Monitor& monitor) const {
  stop_flag().check();
  const Argument::StackGuard guard(L_);
  const Session::Reporting reporting(session_, monitor);
  const auto begun = std::chrono::steady_clock::now();
  call(knobs);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  const Argument answer(L_, -1);
  if (!answer.is_number()) no_number(answer, knobs);
  return {answer.number(), took.count()};
}

void AskedFunction::try_once(const Knobs& knobs) const {
  const Argument::StackGuard guard(L_);
  call(knobs);
  const Argument answer(L_, -1);
  if (!answer.is_number() && !answer.is_unknown()) no_number(answer, knobs);
}

AskedRuns::AskedRuns(const Call& call, const Argument& ask)
    : ask_(call, ask), session_(call.session()), batch_(call_batch(call, ask, "ask")) {}

std::vector<AskedFunction::Answer> AskedRuns::operator()(const std::vector<Knobs>& runs,
                                                         const std::function<void(double)>& done) {
  std::vector<AskedFunction::Answer> found;
  if (!heavy_) {
    std::optional<SingleThreaded> alone;
    if (batch_ != nullptr && !begun_) alone.emplace();
    const std::int64_t before = session_.heavy_calls;
    for (const Knobs& knobs : runs) {
      QuietMonitor monitor(session_.monitor(), [&, furthest = 0.0](double share) mutable {
        if (share <= furthest) return;  // never falls
        done(static_cast<double>(found.size()) + (furthest = std::min(share, 1.0)));
      });
      found.push_back(ask_(knobs, monitor));
      done(static_cast<double>(found.size()));
    }
    heavy_ = batch_ != nullptr && !begun_ && session_.heavy_calls > before;
    begun_ = true;
    return found;
  }
  std::vector<Values> arguments;
  for (const Knobs& knobs : runs) arguments.push_back({Value(knobs_map(knobs))});
  QuietMonitor quiet(session_.monitor());
  const Session::Reporting reporting(session_, quiet);
  const std::vector<BatchedAnswer> answers =
      batch_->answers(arguments, [&done](std::size_t count) { done(static_cast<double>(count)); });
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const BatchedAnswer& answer = answers[k];
    if (!answer.failure.empty())
      refuse("`ask` failed for " + lua_source(runs[k]) + ": " + without_traceback(answer.failure));
    if (!answer.number)
      refuse("`ask` returned " + answer.other + " for " + lua_source(runs[k]), "return one number");
    found.push_back({*answer.number, answer.seconds});
  }
  return found;
}

void RunProgress::report(const std::string& part, double share) {
  const std::chrono::duration<double> since = PartMonitor::Clock::now() - begun_;
  monitor_.progress_of_parts(title_, share, part, since.count());
}

void read_inputs(const Argument& value, const OptionInfo& info, InputKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info,
                              "a table such as { hardness={ value=\"1.1 GPa\", u=\"0.1 GPa\" } }", problems);
  value.each([&](const Argument& key, const Argument& input) {
    if (!key.is_text())
      problems.push_back(quoted(info.name) +
                         " has an entry without a name; write `hardness = { value=, u= }`");
    else if (input.is_unknown())
      keys.unknown = true;
    else if (const Object* found = input.as_object(class_of<CalibrationReport>()))
      read_calibration(*found, info.name + "." + std::string(key.text()), keys, problems);
    else
      read_input(std::string(key.text()), info.name + "." + std::string(key.text()), input, keys, problems);
  });
  // Lua tables have no order.
  std::ranges::sort(keys.inputs, {}, &UncertainInput::name);
}

void sort_knobs(Knobs& knobs) { std::ranges::sort(knobs, {}, &Knob::name); }

}  // namespace asperity::lua
