// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "bindings/lua/ensemble/scripted_cases.hpp"
#include "bindings/lua/ensemble/transfer.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/specimen/explanation.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

constexpr std::size_t most_cases = 1'000'000;
// Each level has a thread and a Lua state.
constexpr int deepest_case = 8;

enum class OnFailure { error, report };

struct EnsembleKeys {
  using Values = std::vector<CaseValue>;
  struct Varied {
    std::string key;
    Values values;
  };
  std::optional<std::vector<Varied>> over;  // sorted by key
  std::optional<std::vector<Values>> cases;
  Table units;  // of names such as "Ra [um]"
  OnFailure on_failure = OnFailure::error;

  std::size_t count() const {
    if (cases) return cases->size();
    std::size_t product = 1;
    for (const Varied& varied : *over) product *= varied.values.size();
    return product;
  }
  // From 0; the last key varies fastest.
  Values values(std::size_t k) const {
    if (cases) return (*cases)[k];
    Values result(over->size());
    for (std::size_t key = over->size(); key-- > 0;) {
      const Values& list = (*over)[key].values;
      result[key] = list[k % list.size()];
      k /= list.size();
    }
    return result;
  }
};

std::string value_text(const Argument& value) {
  if (value.is_unknown()) return "?";
  if (value.is_boolean()) return value.boolean() ? "true" : "false";
  if (value.is_number())
    return value.integer() ? std::to_string(*value.integer()) : format_short(value.number(), 10);
  if (value.is_text()) return "\"" + std::string(value.text().substr(0, 60)) + "\"";
  return value.describe();
}

CaseValue read_value(const std::string& key, const Argument& value, const std::string& name) {
  return {
      key,
      pack(value.state(), value.index(), Cargo::data, name,
           "a case is described by numbers, strings, booleans, tables of these, and values such as surfaces"),
      value_text(value)};
}

// In um under "Ra [um]"; the case has it under `Ra`, in SI.
CaseValue read_value(EnsembleKeys& keys, std::string_view key, const Argument& value,
                     const std::string& path) {
  const TableColumn column = split_column_unit(key);
  if (column.unit.empty() || !value.is_number()) return read_value(std::string(key), value, path);
  keys.units.declare_unit(column.name, column.unit);
  const Argument::StackGuard guard(value.state());
  lua_pushnumber(value.state(), from_unit(value.number(), column.unit));
  CaseValue read = read_value(column.name, Argument(value.state(), -1), path);
  read.text = value_text(value) + " " + column.unit;
  return read;
}

void read_over(const Argument& value, const OptionInfo& info, EnsembleKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table of lists, such as { seed = {1, 2, 3} }", problems);
  keys.over.emplace();
  value.each([&](const Argument& key, const Argument& list) {
    if (!key.is_text()) {
      problems.push_back(quoted(info.name) + " holds a value without a key; write `name = { ... }`");
      return;
    }
    const std::string name(key.text());
    const std::string path = info.name + "." + name;
    EnsembleKeys::Values values;
    if (list.is_unknown()) {
      values.push_back({name, pack(list.state(), list.index(), Cargo::data, path, ""), "?"});
    } else if (!list.is_table()) {
      return detail::wrong_type(list, path, "a list of values, such as {" + value_text(list) + "}", problems);
    }
    if (list.is_table() && !list.is_list()) {
      problems.push_back(quoted(path) + " is not a list; write its values one after the other, without nil");
      return;
    }
    if (list.is_table())
      list.elements([&](const Argument& item, std::int64_t k) {
        values.push_back(read_value(keys, name, item, path + "[" + std::to_string(k) + "]"));
      });
    const std::string plain = values.empty() ? name : values.front().key;
    keys.over->push_back({plain, std::move(values)});
  });
  if (problems.empty() && keys.over->empty())
    problems.push_back(quoted(info.name) + " names nothing to vary; give at least one list");
  std::ranges::sort(*keys.over, {}, &EnsembleKeys::Varied::key);
  const auto twice = std::ranges::adjacent_find(*keys.over, {}, &EnsembleKeys::Varied::key);
  if (twice != keys.over->end())
    problems.push_back(quoted(info.name) + " names " + quoted(twice->key) + " twice; give one list");
}

void read_cases(const Argument& value, const OptionInfo& info, EnsembleKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a list of cases, such as { {D = 2, seed = 1}, ... }", problems);
  keys.cases.emplace();
  value.elements([&](const Argument& item, std::int64_t k) {
    const std::string path = info.name + "[" + std::to_string(k) + "]";
    if (!item.is_table()) return detail::wrong_type(item, path, "a table of named values", problems);
    EnsembleKeys::Values values;
    item.each([&](const Argument& key, const Argument& part) {
      if (key.is_text())
        values.push_back(read_value(keys, key.text(), part, path + "." + std::string(key.text())));
      else
        problems.push_back(quoted(path) + " holds a value without a key; write `name = value`");
    });
    std::ranges::sort(values, {}, &CaseValue::key);
    keys.cases->push_back(std::move(values));
  });
}

void check_keys(EnsembleKeys& keys, Problems& problems) {
  if (!keys.over && !keys.cases)
    problems.push_back("`over` is missing; give the values to vary, e.g. { seed = {1, 2, 3} }");
  if (keys.over && keys.cases) problems.push_back("both `over` and `cases` are given; give one of them");
  if (!keys.over) return;
  double product = 1;
  for (const auto& varied : *keys.over) product *= static_cast<double>(varied.values.size());
  if (product > static_cast<double>(most_cases))
    problems.push_back("`over` makes " + format_short(product) + " cases; at most " +
                       std::to_string(most_cases) + " are run");
}

const Block<EnsembleKeys> ensemble_block{
    {custom<EnsembleKeys>("over", "table",
                          "name -> list of values; every combination is a case, in the order of the names "
                          "with the last one varying fastest",
                          read_over),
     custom<EnsembleKeys>("cases", "table", "the cases themselves, a list of tables, in place of over",
                          read_cases),
     function<EnsembleKeys>("run", "a function(case)",
                            "function(case) returning a table of results, called once a case in a fresh "
                            "copy of everything it uses: no other case sees its changes")
         .required(),
     choice("on_failure", &EnsembleKeys::on_failure,
            {{"error", OnFailure::error}, {"report", OnFailure::report}},
            "failed cases, once all others have run: an error that names them, with the other rows in "
            "ensemble_kept.csv; or the list rows.failed of {index, case, message}, and rows of the others")},
    check_keys};

Map case_values(const std::vector<CaseValue>& values) {
  Map map;
  for (const CaseValue& value : values) map.items.emplace_back(value.key, value.value);
  return map;
}

// From one case run in this state.
Values dry_rows(const Call& call, const EnsembleKeys& keys, const Argument& run) {
  lua_State* L = call.L;
  const std::size_t count = keys.count();
  const std::vector<CaseValue> first = keys.values(0);
  const Argument::StackGuard guard(L);
  lua_pushvalue(L, run.index());
  push_checked(L, case_values(first), "a case");
  if (const auto failure = failure_of_call(L, 1, 1)) refuse(case_name(first) + ": " + *failure);
  const Argument returned(L, -1);
  std::vector<std::string> fields;
  bool known = true;
  if (returned.is_table())
    returned.each([&](const Argument& key, const Argument&) {
      if (key.is_text())
        fields.emplace_back(key.text());
      else
        known = false;
    });
  else if (const auto record = record_at(L, -1))
    for (const Record::Entry& entry : record->entries) fields.push_back(entry.field);
  else if (returned.is_unknown())
    known = false;
  else
    refuse(case_name(first) + ": " + wrong_return(returned.describe()));
  std::sort(fields.begin(), fields.end());
  List rows;
  rows.rows = true;
  for (std::size_t k = 0; k < count; ++k) {
    Map row;
    for (const std::string& field : fields) row.items.emplace_back(field, Unknown{});
    for (const CaseValue& value : keys.values(k)) row.items.emplace_back(value.key, value.value);
    rows.items.push_back(known ? Value(std::move(row)) : Value(Unknown{}));
  }
  if (keys.on_failure == OnFailure::report) rows.named.emplace_back("failed", List{});
  return {std::move(rows)};
}

std::vector<std::size_t> failed_cases(const std::vector<CaseResult>& results) {
  std::vector<std::size_t> failed;
  for (std::size_t k = 0; k < results.size(); ++k)
    if (!results[k].failure.empty()) failed.push_back(k);
  return failed;
}

void record(const Session& session, const EnsembleKeys& keys, const std::vector<CaseResult>& results) {
  if (session.run == nullptr || session.is_case) return;
  Digester digester;
  for (const CaseResult& result : results) digester.add(result.failure.empty() ? result.digest : "failed");
  Json line = Json::object({{"cases", results.size()}});
  if (keys.over) {
    std::vector<std::string> names;
    for (const auto& varied : *keys.over) names.push_back(varied.key);
    line.set("over", Json::strings(names));
  }
  if (const std::vector<std::size_t> failed = failed_cases(results); !failed.empty()) {
    Json::List list;
    for (const std::size_t k : failed)
      list.push_back(Json::object({{"index", k + 1},
                                   {"case", case_name(keys.values(k))},
                                   {"message", without_traceback(results[k].failure)}}));
    line.set("failed", Json(std::move(list)));
  }
  line.set("result", digester.hex());
  session.run->journal().write("ensemble", line);
}

void note_inputs(const Session& session, const std::vector<CaseResult>& results) {
  for (const CaseResult& result : results)
    for (const RunKnob& knob : result.knobs) {
      session.knobs->make(knob);  // not made by a stored or remote case
      if (session.notes != nullptr) session.notes->knobs.push_back(knob);
    }
  note_knobs(session);
  for (const CaseResult& result : results) note_inputs_of_case(session, result.inputs);
}

// Saves plain cells in a notebook against later errors. Returns the file, or "" without a run directory.
std::string keep_rows(const Call& call, const std::vector<CaseResult>& results) {
  const Session& session = call.session();
  if (session.run == nullptr || session.is_case) return {};
  const std::shared_ptr<Notebook> book = session.run->notebook("ensemble_kept");
  bool any = false;
  for (const CaseResult& result : results) {
    if (result.row == nullptr) continue;
    const Argument::StackGuard guard(call.L);
    push_checked(call.L, result.row, "the rows of an ensemble");
    std::vector<Entry> row;
    Argument(call.L, -1).each([&row](const Argument& key, const Argument& value) {
      if (!key.is_text() || key.text().empty()) return;
      if (value.is_number())
        row.push_back({std::string(key.text()), value.number()});
      else if (value.is_boolean())
        row.push_back({std::string(key.text()), value.boolean()});
      else if (value.is_text())
        row.push_back({std::string(key.text()), std::string(value.text())});
    });
    std::ranges::sort(row, {}, &Entry::column);
    if (row.empty()) continue;
    book->write(row);
    any = true;
  }
  return any ? book->csv().filename().string() : std::string();
}

// After the other cases are stored.
[[noreturn]] void refuse_failures(const Call& call, const EnsembleKeys& keys,
                                  const std::vector<CaseResult>& results,
                                  const std::vector<std::size_t>& failed) {
  const auto named = [&](std::size_t k) { return case_name(keys.values(k)) + ": "; };
  const std::string& first = results[failed.front()].failure;
  if (results.size() == 1) refuse(named(0) + first);
  const std::size_t others = results.size() - failed.size();
  std::string sentence =
      std::to_string(failed.size()) + " of " + std::to_string(results.size()) + " cases failed";
  const std::string file = keep_rows(call, results);
  if (others > 0)
    sentence +=
        others == 1 ? ", and the other one ran" : ", and the other " + std::to_string(others) + " ran";
  if (!file.empty()) sentence += " (their results are in " + file + ")";
  constexpr std::size_t most = 50;
  for (std::size_t n = 0; n < std::min(most, failed.size()); ++n) {
    sentence += "\n  ";
    for (const char c : named(failed[n]) + without_traceback(results[failed[n]].failure))
      sentence += c == '\n' ? std::string("\n    ") : std::string(1, c);
  }
  if (failed.size() > most) sentence += "\n  and " + std::to_string(failed.size() - most) + " more";
  if (const std::size_t at = first.find("\nstack traceback:"); at != std::string::npos)
    sentence += "\nwhere the first of them failed:" + first.substr(at);
  refuse(sentence);
}

Values ensemble(Call& call) {
  const EnsembleKeys keys = call.options(ensemble_block);
  Session& session = call.session();
  if (session.depth >= deepest_case)
    refuse("this ensemble is inside " + std::to_string(deepest_case) + " others",
           "let the outer ones vary more keys in `over` instead");
  return with_key(call.argument(1), "run", [&](const Argument& run) -> Values {
    const CaseSetup common = common_setup(call.L, session,
                                          pack(call.L, run.index(), Cargo::functions, "run",
                                               "make it inside `run`, or use it on the rows that come back"));
    ++session.numbered_ensembles;
    std::string place = where(call.L);
    place = place.empty() ? "of the script" : "at " + place.substr(0, place.size() - 2);
    if (keys.count() == 0)
      refuse(std::string(keys.cases ? "`cases` is empty" : "a list in `over` is empty") +
                 ", so there is no case",
             "give each list a value");
    if (session.dry_run) {
      const Explanation::Repeating cases(session.explanation.get(), static_cast<std::int64_t>(keys.count()));
      if (session.on_ensemble)
        session.on_ensemble(place, keys.count(), [&](std::size_t k) { return case_name(keys.values(k)); });
      // `run` is called in this state, and nested ensembles are neither counted nor listed.
      const Temporarily listed(session.on_ensemble, nullptr);
      const Temporarily numbered(session.numbered_ensembles, session.numbered_ensembles);
      return dry_rows(call, keys, run);
    }
    const Stream seeds(session.seed, "ensemble");
    const auto setup = [&](std::size_t k) {
      CaseSetup one = common;
      one.values = keys.values(k);
      one.seed = seeds.bits(k);
      return one;
    };
    const StoredCases kept(session, *common.run);
    std::vector<CaseResult> results =
        run_cases(keys.count(), setup, kept, place, keys.on_failure == OnFailure::report, session);
    note_inputs(session, results);
    record(session, keys, results);
    const std::vector<std::size_t> failed = failed_cases(results);
    if (!failed.empty() && keys.on_failure == OnFailure::error) refuse_failures(call, keys, results, failed);
    List rows, failures;
    rows.rows = failures.rows = true;
    for (const TableColumn& column : keys.units.columns()) rows.units.emplace_back(column.name, column.unit);
    for (const std::size_t k : failed) {
      Map failure;
      failure.items.emplace_back("index", static_cast<std::int64_t>(k) + 1);
      failure.items.emplace_back("case", case_values(keys.values(k)));
      failure.items.emplace_back("message", without_traceback(results[k].failure));
      failures.items.emplace_back(std::move(failure));
    }
    for (CaseResult& result : results)
      if (result.row != nullptr) rows.items.emplace_back(std::move(result.row));
    if (keys.on_failure == OnFailure::report) rows.named.emplace_back("failed", std::move(failures));
    return {std::move(rows)};
  });
}

}  // namespace

Function ensemble_function() {
  return {.name = "ensemble",
          .body = ensemble,
          .sentence =
              "Runs a function for every case of a study, on all threads, and returns one row a case: the "
              "values of the case and the returned values. Order and values do not depend on the number of "
              "threads. A failed case is reported on standard error, and the others run on; then "
              "`on_failure` decides.",
          .options = &ensemble_block,
          .returns = "table[]",
          .example =
              "local rows = lab.ensemble{ over={ D={2.2, 2.5}, seed={1, 2} }, run=function(case) return { "
              "twice=2 * case.D } end }"};
}

}  // namespace asperity::lua
