// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of one lab.ensemble for the scheduler: each a call of the script's function in a Lua state of its
// own, kept in the store of the run.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "bindings/lua/ensemble/stored_cases.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

// What the cases of one more ensemble of the run have in common: all of a setup but its values and its seed.
CaseSetup common_setup(lua_State* L, Session& session, std::shared_ptr<const PackedValue> run);

// Cases that setup(k) describes; it is called from several threads at once.
class ScriptedCases : public EnsembleCases {
 public:
  ScriptedCases(std::size_t count, std::function<CaseSetup(std::size_t)> setup, const StoredCases& kept)
      : count_(count), setup_(std::move(setup)), kept_(kept) {}

  std::size_t count() const override { return count_; }
  std::string name(std::size_t k) const override;
  Finished compute(std::size_t k) override;
  void interrupt() override { states_.interrupt(); }
  Finished failed(const std::string& why) const override;
  void fail(FinishedCase& found, const std::string& why) const override;
  Finished find_kept(std::size_t k, bool with_failures) const override;
  void keep(std::size_t k, const FinishedCase& found, bool always) const override;
  std::string bytes(std::size_t k, const FinishedCase& found) const override;
  Finished from_bytes(std::size_t k, std::string_view bytes) const override;

 private:
  const std::size_t count_;
  const std::function<CaseSetup(std::size_t)> setup_;
  const StoredCases& kept_;
  RunningStates states_;
};

// setup(k) describes case k and is called from several threads at once. Throws what run_cases of the
// scheduler throws; `place` is that of the ensemble in the script, `reports_failures` whether the script goes
// on past cases that failed.
std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  const StoredCases& kept, const std::string& place, bool reports_failures,
                                  Session& session);

}  // namespace asperity::lua
