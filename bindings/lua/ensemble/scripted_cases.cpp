// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/scripted_cases.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace asperity::lua {

CaseSetup common_setup(lua_State* L, Session& session, std::shared_ptr<const PackedValue> run) {
  CaseSetup common;
  common.run = std::move(run);
  common.trusted = session.trusted;
  common.depth = session.depth + 1;
  common.refinement = session.refinement;
  common.variation = session.variation;
  common.knobs = session.knobs;
  common.ledger = session.ledger;
  common.results = results_for_cases(session);
  common.watched = lua_gethook(L) != nullptr;
  common.script = session.script;
  common.loaded = session.loaded;
  common.script_digest = session.script_digest;
  common.ensemble = ++session.ensembles;
  if (session.notes != nullptr) session.notes->drew = true;  // its cases have seeds made of this one's
  return common;
}

std::string ScriptedCases::name(std::size_t k) const { return case_name(setup_(k).values); }

EnsembleCases::Finished ScriptedCases::compute(std::size_t k) {
  return std::make_unique<CaseResult>(run_case(setup_(k), states_));
}

EnsembleCases::Finished ScriptedCases::failed(const std::string& why) const {
  auto result = std::make_unique<CaseResult>();
  result->failure = why;
  return result;
}

void ScriptedCases::fail(FinishedCase& found, const std::string& why) const {
  static_cast<CaseResult&>(found).row.reset();
  found.failure = why;
}

EnsembleCases::Finished ScriptedCases::find_kept(std::size_t k, bool with_failures) const {
  std::optional<CaseResult> found = kept_.find(setup_(k), with_failures);
  return found ? std::make_unique<CaseResult>(*std::move(found)) : nullptr;
}

void ScriptedCases::keep(std::size_t k, const FinishedCase& found, bool always) const {
  kept_.keep(setup_(k), static_cast<const CaseResult&>(found), always);
}

std::string ScriptedCases::bytes(std::size_t k, const FinishedCase& found) const {
  return case_bytes(static_cast<const CaseResult&>(found), setup_(k).values);
}

EnsembleCases::Finished ScriptedCases::from_bytes(std::size_t k, std::string_view bytes) const {
  return std::make_unique<CaseResult>(case_from_bytes(bytes, setup_(k).values));
}

std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  const StoredCases& kept, const std::string& place, Session& session) {
  ScriptedCases scripted(cases, setup, kept);
  CaseSchedule schedule{session.monitor()};
  schedule.place = place;
  schedule.ensemble = session.ensembles;
  // A case inside a case has no other processes to share its own with.
  if (!session.is_case) {
    schedule.shard = session.shard;
    schedule.ranks = session.ranks;
    schedule.shard_end = session.shard_end;
  }
  schedule.print = [&session](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), session.output);
  };
  std::vector<CaseResult> results;
  for (const std::unique_ptr<FinishedCase>& found : run_cases(scripted, schedule))
    results.push_back(std::move(static_cast<CaseResult&>(*found)));
  return results;
}

}  // namespace asperity::lua
