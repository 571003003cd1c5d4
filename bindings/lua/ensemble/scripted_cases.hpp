// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of one lab.ensemble for the scheduler: each a call of the script's function in a Lua state of its
// own, kept in the store of the run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "bindings/lua/ensemble/stored_cases.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

// setup(k) describes case k and is called from several threads at once. Throws what run_cases of the
// scheduler throws; `place` is that of the ensemble in the script.
std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  const StoredCases& kept, const std::string& place, Session& session);

}  // namespace asperity::lua
