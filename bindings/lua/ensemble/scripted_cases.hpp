// SPDX-License-Identifier: GPL-3.0-or-later
// Cases of a lab.ensemble for the scheduler.
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
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

Function ensemble_function();

// Without values and seed.
CaseSetup common_setup(lua_State* L, Session& session, std::shared_ptr<const PackedValue> run);

// `setup(k)`: case k; called concurrently.
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

// `setup(k)`: case k; called concurrently. Throws as the scheduler's run_cases. `place`: in the script.
// `reports_failures`: the script continues after failed cases.
std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  const StoredCases& kept, const std::string& place, bool reports_failures,
                                  Session& session);

}  // namespace asperity::lua
