// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <exception>
#include <utility>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/study/asked_function.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/core/require.hpp"
#include "engine/study/work_precision.hpp"

namespace asperity::lua {

namespace {

struct StudyKeys : StudyRequest {
  std::string name = "work_precision";
  bool unknown = false;  // a dry run met an unknown knob
};

void read_way(const Argument& table, const std::string& path, StudyKeys& keys, Problems& problems) {
  if (!table.is_table())
    return detail::wrong_type(table, path, "a way such as { name=\"finer grid\", cells={128, 256} }",
                              problems);
  std::string name;
  std::vector<KnobSweep> knobs;
  table.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text()) {
      problems.push_back(quoted(path) + " holds a value without a key; write `knob = value`");
    } else if (key.text() != "name") {
      const std::string knob(key.text());
      read_sweep(knob, path + "." + knob, value, keys.unknown, knobs, problems);
    } else if (value.is_text() && !value.text().empty()) {
      name = value.text();
    } else {
      detail::wrong_type(value, path + ".name", "the way's name", problems);
      name = "?";
    }
  });
  if (name.empty()) {
    problems.push_back(quoted(path) + " has no `name`; name the way, as in name=\"finer grid\"");
    return;
  }
  if (!problems.empty()) return;
  detail::collect(problems, [&] { keys.ways.push_back(make_way(std::move(name), std::move(knobs))); });
}

void read_ways(const Argument& value, const OptionInfo& info, StudyKeys& keys, Problems& problems) {
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(
        value, info, "a list of ways, such as { { name=\"finer grid\", cells={128, 256} } }", problems);
  value.elements([&](const Argument& way, std::int64_t k) {
    if (way.is_unknown())
      keys.unknown = true;
    else
      read_way(way, info.name + "[" + std::to_string(k) + "]", keys, problems);
  });
}

void read_truth(const Argument& value, const OptionInfo& info, StudyKeys& keys, Problems& problems) {
  if (value.is_table()) {
    Knobs knobs;
    value.each([&](const Argument& key, const Argument& item) {
      const auto read = knob_value(item, keys.unknown);
      if (!key.is_text())
        problems.push_back(quoted(info.name) + " holds a value without a key; write `knob = value`");
      else if (!read)
        detail::wrong_type(item, info.name + "." + std::string(key.text()), knob_kinds, problems);
      else
        knobs.push_back({std::string(key.text()), *read});
    });
    sort_knobs(knobs);
    keys.truth = std::move(knobs);
  } else if (const auto exact = detail::read_any_quantity(
                 value, info.name, "the exact value, or a table of the knobs of a finer setting", problems)) {
    keys.truth = exact->value;
  }
}

const Block<StudyKeys> study_block{
    {function<StudyKeys>("ask", "a function(knobs)",
                         "function(knobs) returning the quantity, one number; nil (and a message) or an "
                         "error where a setting fails")
         .required(),
     custom<StudyKeys>("truth", "number|table",
                       "the exact value, or the knobs of a finer setting whose answer is taken for it",
                       read_truth)
         .required(),
     custom<StudyKeys>("try", "table[]",
                       "the ways: tables with a `name`, and knobs that `ask` understands; a knob given as a "
                       "list is swept, from coarse to fine, and several lists go along together",
                       read_ways)
         .required(),
     integer("repeats", &StudyRequest::repeats, between(1, 100000),
             "timed runs of each setting, after a first one that is not timed"),
     quantity("at_most", &StudyRequest::at_most, dimension::time, above(0),
              "longest time for the whole study, the truth included; it is quoted first, and settings that "
              "would not fit are left out"),
     text("name", &StudyKeys::name, "of the study and of <name>.csv, where its rows are kept")}};

StudyAnswer read_answer(lua_State* L, const Knobs& knobs) {
  const Argument value(L, -2), message(L, -1);
  if (value.is_number()) return {value.number(), ""};
  if (value.is_nil()) return {{}, message.is_text() ? std::string(message.text()) : std::string()};
  refuse("`ask` returned " + value.describe() + " for " + lua_source(knobs),
         "return one number, or nil where the setting failed");
}

class LuaWork final : public StudyWork {
 public:
  LuaWork(const Call& call, const Argument& ask, std::string name)
      : L(call.L), ask_(ask), session_(call.session()), name_(std::move(name)) {}

  void prepare(const Knobs& knobs) override { push_with_knobs(L, ask_, knobs, "the knobs"); }

  StudyAnswer ask(const Knobs& knobs, Monitor& monitor) override {
    const int bottom = lua_gettop(L) - 2;
    const Session::Reporting reporting(session_, monitor);
    const auto failure = failure_of_call(L, 1, 2);
    StudyAnswer answer = failure ? StudyAnswer{{}, *failure} : read_answer(L, knobs);
    lua_settop(L, bottom);
    return answer;
  }

  // Garbage collection stays out of measured times.
  void settle() override { lua_gc(L, LUA_GCCOLLECT); }

  void record(std::span<const StudyRun> runs) override { record_calls(session_.run.get(), name_, runs); }

 private:
  lua_State* L;
  Argument ask_;
  Session& session_;
  std::string name_;
};

// For the first setting only.
Values dry_study(Call& call, const StudyKeys& keys, const Argument& ask) {
  if (!keys.unknown) {
    const Knobs& knobs = keys.ways.front().settings.front();
    LuaWork work(call, ask, keys.name);
    work.prepare(knobs);
    const int bottom = lua_gettop(call.L) - 2;
    if (const auto failure = failure_of_call(call.L, 1, 2))
      refuse(keys.ways.front().name + " " + lua_source(knobs) + ": " + *failure);
    if (!Argument(call.L, -2).is_unknown()) read_answer(call.L, knobs);
    lua_settop(call.L, bottom);
  }
  call.session().gave_placeholders = true;
  return {Object{&class_of<Study>(), nullptr, false}};
}

Values work_precision(Call& call) {
  StudyKeys keys = call.options(study_block);
  Session& session = call.session();
  if (session.is_case)
    throw Error(ErrorCode::not_permitted,
                "a case of an ensemble cannot measure the times of a study: other cases run at the same time",
                "go over the cases in a `for` loop, one study after the other");
  return with_key(call.argument(1), "ask", [&](const Argument& ask) -> Values {
    if (session.dry_run) return dry_study(call, keys, ask);
    auto study = std::make_shared<Study>();
    const int count = ++session.studies[keys.name];
    study->name = keys.name + (count == 1 ? "" : "-" + std::to_string(count));
    LuaWork work(call, ask, study->name);
    WorkPrecision runner(keys, work, session.monitor());
    record_request(session.run.get(), study->name, runner.result().request);
    try {
      runner.run();
    } catch (const std::exception&) {
      record_result(session.run.get(), study->name, runner.result());
      throw;
    }
    study->result = runner.result();
    record_result(session.run.get(), study->name, study->result);
    return {object(std::move(study))};
  });
}

}  // namespace

Function work_precision_function() {
  return {.name = "work_precision",
          .body = work_precision,
          .sentence =
              "Measures the cost of accuracy: computes one quantity by several ways over their settings, "
              "times each as the median of `repeats` runs, and compares with the truth. Every setting is "
              "run once untimed for its answer, then all are timed in rounds; a setting that fails keeps "
              "its row. The expected time of the study is first printed on standard error.",
          .options = &study_block,
          .returns = "Study",
          .example =
              "local study = lab.work_precision{ ask=function(knobs) return lab.surface.sine{ "
              "cells=knobs.cells, size=1, amplitude=\"1 mm\" }:roughness().Ra end, truth={ cells=512 }, "
              "try={ { name=\"finer grid\", cells={ 32, 64, 128 } } } }"};
}

}  // namespace asperity::lua
