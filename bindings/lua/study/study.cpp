// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/study/study.hpp"
#include "bindings/lua/study/asked_function.hpp"

#include <cmath>
#include <utility>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/study/study_result.hpp"

namespace asperity::lua {

namespace {

Values rows_of_study(Call& call) {
  const StudyResult& result = call.self<Study>().result;
  List list;
  for (const StudyRow& row : result.rows) {
    Map map = knobs_map(result.knobs_of(row));
    const auto add = [&](const char* name, Value value) { map.items.emplace_back(name, std::move(value)); };
    add("way", result.way_of(row).name);
    for (const auto& [name, value] : {std::pair{"value", row.value},
                                      {"error", row.error},
                                      {"absolute_error", row.absolute_error},
                                      {"held_error", row.held_error},
                                      {"seconds", row.seconds},
                                      {"seconds_low", row.seconds_low},
                                      {"seconds_high", row.seconds_high},
                                      {"first_seconds", row.first_seconds}})
      if (std::isfinite(value)) map.items.emplace_back(name, value);
    add("runs", static_cast<std::int64_t>(row.runs.size()));
    add("failed", row.end == StudyRow::End::failed);
    add("left_out", row.end == StudyRow::End::left_out);
    add("steady", row.steady);
    add("pareto", row.pareto);
    if (!row.reason.empty())
      add("reason", (row.end == StudyRow::End::left_out ? "left out: " : "") + row.reason);
    list.items.emplace_back(std::move(map));
  }
  return {std::move(list)};
}

Values chart_study(Call& call) {
  const Study& study = call.self<Study>();
  const std::string file = call.given(1) ? call.text(1, "path") : safe_file_name(study.name) + ".svg";
  picture_format(file);
  const LineChart lines = study_chart(study.result, "");
  const std::string path = writable_path(call, file);
  for (const std::string& warning : draw(lines, path)) call.session().monitor().warn(warning);
  if (const auto& run = call.session().run)
    run->journal().write("chart", Json::object({{"study", study.name}, {"file", file}}));
  return {path};
}

struct CheapestKeys {
  double error = 0;
};
const Block<CheapestKeys> cheapest_block{
    {number("error", &CheapestKeys::error, above(0),
            "greatest error, relative to the truth (absolute where the truth is 0)")
         .required()}};
Values cheapest_setting(Call& call) {
  const double error = call.options(cheapest_block).error;
  auto study = call.shared_self<Study>();
  const StudyRow& row = cheapest(study->result, error);
  const auto place = static_cast<std::size_t>(&row - study->result.rows.data());
  return {object(StudyChoice{std::move(study), place})};
}

std::string describe_study(const void* self) { return study_text(static_cast<const Study*>(self)->result); }

}  // namespace

void record_request(RunDirectory* run, const std::string& name, const StudyRequest& request) {
  if (run == nullptr) return;
  run->journal().write("study", Json::object({{"name", name}, {"asked", to_json(request)}}));
}

void record_calls(RunDirectory* run, const std::string& name, std::span<const StudyRun> calls) {
  if (run == nullptr) return;
  for (const StudyRun& call : calls) {
    Json line = Json::object({{"name", name}});
    if (call.way != nullptr) line.set("way", *call.way);
    line.set("knobs", to_json(*call.knobs)).set("round", call.round);
    if (call.value) line.set("value", *call.value);
    line.set("unhashed", Json::object({{"seconds", call.seconds}}));
    run->journal().write("study run", line);
  }
}

void record_result(RunDirectory* run, const std::string& name, const StudyResult& result) {
  if (run == nullptr) return;
  Json line = Json::object({{"name", name}});
  line.set("found", answers_json(result));
  Json::List seconds;
  for (const StudyRow& row : result.rows) {
    seconds.emplace_back();
    if (std::isfinite(row.seconds)) seconds.back() = row.seconds;
  }
  line.set("unhashed", Json::object({{"seconds", std::move(seconds)},
                                     {"asked_seconds", result.asked_seconds},
                                     {"total_seconds", result.total_seconds}}));
  run->journal().write("study end", line);
  const std::filesystem::path file = run->path_for(safe_file_name(name) + ".csv");
  if (!run->dry()) write_atomically(file, study_table(result).csv());
}

Class make_class(For<Study>) {
  Class c{"Study", "a study",
          "Result of a study of work and precision. print() shows its rows and the cheapest setting for 10 "
          "%, 1 % and 0.1 %."};
  c.describe = describe_study;
  c.fields = {
      getter<&Study::result, &StudyResult::truth>("truth", "number",
                                                  "the value that errors are measured against"),
      getter<&Study::result, &StudyResult::truth_seconds>(
          "truth_seconds", "number", "what that value took; 0 if it was given", dimension::time),
      getter<&Study::result, &StudyResult::relative>(
          "relative", "boolean",
          "whether `error` is relative to the truth; it is absolute where the truth is 0"),
      getter<&Study::result, &StudyResult::calls>("calls", "integer", "how often `ask` was called"),
      getter<&Study::result, &StudyResult::asked_seconds>(
          "seconds", "number", "time inside `ask`, over all calls", dimension::time),
      getter<&Study::result, &StudyResult::overhead>("overhead", "number",
                                                     "time of the study itself, over that inside `ask`"),
  };
  c.methods = {
      {.name = "rows",
       .body = rows_of_study,
       .sentence = "One table a setting: way, the knobs, value, error (relative to the truth), "
                   "absolute_error, held_error (greatest error among it and the finer settings of its way), "
                   "seconds (median), seconds_low and seconds_high (fastest and slowest run), first_seconds "
                   "(of the first run, which is not timed), runs, steady (all answers the same bits), pareto "
                   "(nothing is both faster and closer), failed, left_out and the reason.",
       .returns = "table[]",
       .example =
           "for _, row in ipairs(study:rows()) do print(row.way, row.cells, row.error, row.seconds) end"},
      {.name = "chart",
       .body = chart_study,
       .sentence = "Draws error against time on logarithmic axes, a line per way, bars from the fastest to "
                   "the slowest run, rings around unbeaten settings, and marks at the rim for settings "
                   "that failed or were left out; returns the file.",
       .parameters = {{"path", "string?",
                       "an .svg, .png or .pdf under the run directory; default <name>.svg"}},
       .returns = "string",
       .example = "study:chart \"work_precision.svg\"",
       .heavy = true},
      {.name = "cheapest",
       .body = cheapest_setting,
       .sentence = "The fastest setting with at most the requested error, if every finer measured setting "
                   "of the same way has it too: a setting near the truth by accident, where the error "
                   "changes its sign, is not taken. Settings count as finer along the list of their way "
                   "(turned round where `cells` falls or `tolerance` rises). Among settings with "
                   "bit-identical answers the first listed is taken, unless another takes less than half "
                   "its time. If no setting is good enough, the error names the best.",
       .options = &cheapest_block,
       .returns = "StudyChoice",
       .example = "local best = study:cheapest{ error=1e-3 } print(best, best.seconds, best.error)"},
  };
  return c;
}

Class make_class(For<StudyChoice>) {
  Class c{"StudyChoice", "a setting of a study",
          "A setting that a study chose. print() shows its knobs as Lua source, to be pasted."};
  c.describe = from_value([](const StudyChoice& choice) -> std::string {
    return lua_source(choice.study->result.knobs_of(choice.found()));
  });
  c.fields = {
      getter<StudyChoice>(
          "knobs", "table", "its knobs, as `ask` was given them",
          [](const StudyChoice& of) { return knobs_map(of.study->result.knobs_of(of.found())); }),
      getter<StudyChoice>("way", "string", "the name of its way",
                          [](const StudyChoice& of) { return of.study->result.way_of(of.found()).name; }),
      getter<&StudyChoice::found, &StudyRow::seconds>("seconds", "number", "median of its runs",
                                                      dimension::time),
      getter<&StudyChoice::found, &StudyRow::value>("value", "number", "its answer"),
      getter<&StudyChoice::found, &StudyRow::error>("error", "number", "its error, relative to the truth"),
      getter<&StudyChoice::found, &StudyRow::absolute_error>("absolute_error", "number",
                                                             "its distance from the truth"),
      getter<&StudyChoice::found, &StudyRow::held_error>(
          "held_error", "number", "greatest error among it and the finer settings of its way"),
      getter<&StudyChoice::found, &StudyRow::confirmed>("confirmed", "integer",
                                                        "how many finer settings of its way were measured"),
  };
  return c;
}

}  // namespace asperity::lua
