// SPDX-License-Identifier: GPL-3.0-or-later
// The threads that work through the cases of an ensemble. They take cases in order; the calling
// thread waits, shows progress, what cases printed and warned of in the order of the cases, and
// carries a stop to the states that run. Cases that are kept are taken from the store; a shard takes those
// of others there as well, and other processes may work through cases with it. With more than one of them the
// engine's own loops stay on the thread of their case; results are the same bits for any number.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bindings/lua/ensemble_case.hpp"
#include "bindings/lua/kept_cases.hpp"
#include "bindings/lua/session.hpp"

namespace asperity::lua {

// setup(k) describes case k and is called from several threads at once. A case that fails is told as a
// warning and the others run on, so that which ones fail does not depend on timing. Returns the results of
// all. Throws Error when the run is to stop, after every state has closed. A shard without all the cases of
// others ends the process by session.shard_end, told `place` of the script.
std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  const KeptCases& kept, const std::string& place, Session& session);

}  // namespace asperity::lua
