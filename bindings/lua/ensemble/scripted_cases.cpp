// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/scripted_cases.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace asperity::lua {

namespace {

class ScriptedCases final : public EnsembleCases {
 public:
  ScriptedCases(std::size_t count, const std::function<CaseSetup(std::size_t)>& setup,
                const StoredCases& kept)
      : count_(count), setup_(setup), kept_(kept) {}

  std::size_t count() const override { return count_; }
  std::string name(std::size_t k) const override { return case_name(setup_(k).values); }
  Finished compute(std::size_t k) override {
    return std::make_unique<CaseResult>(run_case(setup_(k), states_));
  }
  void interrupt() override { states_.interrupt(); }
  Finished failed(const std::string& why) const override {
    auto result = std::make_unique<CaseResult>();
    result->failure = why;
    return result;
  }
  void fail(FinishedCase& found, const std::string& why) const override {
    static_cast<CaseResult&>(found).row.reset();
    found.failure = why;
  }
  Finished find_kept(std::size_t k, bool with_failures) const override {
    std::optional<CaseResult> found = kept_.find(setup_(k), with_failures);
    return found ? std::make_unique<CaseResult>(*std::move(found)) : nullptr;
  }
  void keep(std::size_t k, const FinishedCase& found, bool always) const override {
    kept_.keep(setup_(k), static_cast<const CaseResult&>(found), always);
  }
  std::string bytes(std::size_t k, const FinishedCase& found) const override {
    return case_bytes(static_cast<const CaseResult&>(found), setup_(k).values);
  }
  Finished from_bytes(std::size_t k, std::string_view bytes) const override {
    return std::make_unique<CaseResult>(case_from_bytes(bytes, setup_(k).values));
  }

 private:
  const std::size_t count_;
  const std::function<CaseSetup(std::size_t)>& setup_;
  const StoredCases& kept_;
  RunningStates states_;
};

}  // namespace

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
