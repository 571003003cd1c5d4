// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/scripted_cases.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "bindings/lua/ensemble/case_roster.hpp"
#include "engine/core/program_identity.hpp"
#include "engine/core/text.hpp"
#include "engine/run/ranks.hpp"

namespace asperity::lua {

CaseSetup common_setup(lua_State* L, Session& session, std::shared_ptr<const PackedValue> run) {
  CaseSetup common;
  static_cast<SessionSettings&>(common) = session;
  common.run = std::move(run);
  ++common.depth;
  common.results = results_for_cases(session);
  common.watched = lua_gethook(L) != nullptr;
  common.ensemble = ++session.ensembles;
  if (session.notes != nullptr) session.notes->drew = true;  // gives the cases' seeds
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

namespace {

// Chooses this process's cases.
class SharedEnsemble {
 public:
  SharedEnsemble(const ScriptedCases& cases, const std::function<CaseSetup(std::size_t)>& setup,
                 const StoredCases& kept, const std::string& place, bool reports_failures,
                 const Session& session)
      : shared_(*session.shared),
        cases_(cases),
        setup_(setup),
        kept_(kept),
        place_(place),
        reports_failures_(reports_failures),
        here_(shared_.one && shared_.one->ensemble == session.numbered_ensembles) {
    if (here_ && shared_.one->number > cases.count())
      shared_.end(SharedEnd::no_such_case, "there is no case " + std::to_string(shared_.one->number) +
                                               ": the ensemble " + place_ + " has " +
                                               std::to_string(cases.count()) + " cases");
    roster_.script = session.script.path;
    roster_.place = place;
    roster_.ensemble = session.numbered_ensembles;
    roster_.shards = shared_.shard ? shared_.shard->count : 0;
    roster_.build = build_identity();
    const auto entry = [&](std::size_t k) { return RosterEntry{cases_.name(k), kept_.keys(setup_(k))}; };
    note_roster(shared_.folder, session.script_digest, roster_, cases.count(), entry, shared_.takes);
  }

  void put_into(CaseSchedule& schedule) {
    if (shared_.shard)
      schedule.own = [shard = *shared_.shard](std::size_t k) { return shard.own(k); };
    else if (shared_.one || shared_.merge_only)
      schedule.own = [this](std::size_t k) { return here_ && k + 1 == shared_.one->number; };
    schedule.needs_others = !here_;
    schedule.report = [this](const StoreReport& report) { say(report); };
  }

 private:
  void say(const StoreReport& report) const {
    std::string failures;
    for (const auto& [k, why] : report.failed)
      failures += "\n  " + cases_.name(k) + ": " + without_traceback(why);
    if (here_) {
      const std::string name = cases_.name(shared_.one->number - 1);
      if (failures.empty()) shared_.end(SharedEnd::stored, name + " is stored in " + shared_.folder);
      shared_.end(SharedEnd::failed, "the case failed:" + failures);
    }
    if (report.missing.empty()) return;
    const std::size_t count = cases_.count(), stored = count - report.missing.size();
    if (shared_.shard) {
      std::size_t own = 0;
      for (std::size_t k = 0; k < count; ++k) own += shared_.shard->own(k) ? 1 : 0;
      const std::string its = "its " + counted(own, "case");
      const std::string of = " of the ensemble " + place_;
      const std::string are = own == 1 ? " is" : " are";
      shared_.end(
          failures.empty() || reports_failures_ ? SharedEnd::stored : SharedEnd::failed,
          "shard " + std::to_string(shared_.shard->index) + " of " + std::to_string(shared_.shard->count) +
              ": " +
              (failures.empty() ? its + of + are + " done"
                                : std::to_string(report.failed.size()) + " of " + its + of + " failed") +
              "; " + std::to_string(stored) + " of " + std::to_string(count) + " are in " + shared_.folder +
              failures);
    }
    const std::string sentence = std::to_string(report.missing.size()) + " of " + std::to_string(count) +
                                 " cases of the ensemble " + place_ + " are not in " + shared_.folder +
                                 which(report.missing);
    if (shared_.one || shared_.merge_only)
      shared_.end(SharedEnd::missing, sentence + of_other_builds(report));
    shared_.tell(sentence + "; computed here" + of_other_builds(report));
  }

  std::string which(const std::vector<std::size_t>& missing) const {
    if (missing.size() == cases_.count()) return "";
    int shards = 0;
    for (const CaseRoster& roster : rosters_in(shared_.folder))
      if (roster.script == roster_.script && roster.ensemble == roster_.ensemble &&
          roster.cases.size() == cases_.count() && roster.shards > 0)
        shards = roster.shards;
    return ": " + cases_text(missing, cases_.count(), shards);
  }

  // Other builds may round differently.
  std::string of_other_builds(const StoreReport& report) const {
    std::string text;
    for (const CaseRoster& roster : rosters_in(shared_.folder)) {
      if (roster.build == roster_.build || roster.cases.size() != cases_.count()) continue;
      const StoreReport there = look_up(shared_.folder, roster);
      std::size_t stored = 0;
      for (const std::size_t k : report.missing)
        if (std::ranges::find(there.missing, k) == there.missing.end() &&
            roster.cases[k].keys == kept_.keys(setup_(k)))
          ++stored;
      if (stored > 0)
        text += "; " + std::to_string(stored) + (stored == 1 ? " is" : " are") +
                " stored by another build, " + roster.build + ", whose results are not used";
    }
    return text;
  }

  const SharedStore& shared_;
  const ScriptedCases& cases_;
  const std::function<CaseSetup(std::size_t)>& setup_;
  const StoredCases& kept_;
  const std::string& place_;
  const bool reports_failures_;
  const bool here_;  // case of --case
  CaseRoster roster_;
};

}  // namespace

std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  const StoredCases& kept, const std::string& place, bool reports_failures,
                                  Session& session) {
  ScriptedCases scripted(cases, setup, kept);
  CaseSchedule schedule{session.monitor()};
  schedule.ensemble = session.ensembles;
  // Nested ensembles are not distributed.
  if (!session.is_case) schedule.ranks = session.ranks;
  const bool follows = session.ranks != nullptr && !session.ranks->leads();
  std::optional<SharedEnsemble> shared;
  if (!session.is_case && session.shared != nullptr && kept.keeps() && !follows)
    shared.emplace(scripted, setup, kept, place, reports_failures, session).put_into(schedule);
  schedule.print = [&session](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), session.output);
  };
  std::vector<CaseResult> results;
  for (const std::unique_ptr<FinishedCase>& found : run_cases(scripted, schedule))
    results.push_back(std::move(static_cast<CaseResult&>(*found)));
  return results;
}

}  // namespace asperity::lua
