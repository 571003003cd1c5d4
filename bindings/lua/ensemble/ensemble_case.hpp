// SPDX-License-Identifier: GPL-3.0-or-later
// One case of an ensemble, in a Lua state of its own: the function and the case's values are put into
// a fresh state, the function is called, and what it returned is taken out again. Nothing of a case
// is seen by another, and nothing reaches the outside but the result: what the case prints and warns
// of is kept, to be shown in the order of the cases.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/case_input.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "engine/run/case_scheduler.hpp"

namespace asperity {
class Ledger;
class ResultStore;
}  // namespace asperity

namespace asperity::lua {

struct Refinement;
class Variation;

struct CaseValue {
  std::string key;
  std::shared_ptr<const PackedValue> value;
  std::string text;  // "2.5", "\"cold\"", "a surface"
};

struct CaseSetup {
  std::shared_ptr<const PackedValue> run;
  std::vector<CaseValue> values;  // in the order in which messages name them
  std::uint64_t seed = 1;
  bool trusted = false;
  int depth = 1;  // ensembles the case stands inside
  std::shared_ptr<Refinement> refinement;
  std::shared_ptr<Variation> variation;
  std::shared_ptr<RunKnobs> knobs;
  std::shared_ptr<Ledger> ledger;
  ResultStore* results = nullptr;             // of the run; may be null
  ScriptSpelling script;                      // how the script is named
  std::shared_ptr<const LoadedFiles> loaded;  // of the run, where it is replayed or resumed; may be null
  std::string script_digest;                  // of the text of the script and its arguments
  int ensemble = 0;                           // of the run, which the case is part of; counted from 1
  bool watched = false;                       // look at the stop flag every few thousand instructions
};

struct CaseResult : FinishedCase {
  std::shared_ptr<const PackedValue> row;  // null if it failed
  std::string digest;                      // of the row
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;  // that it asked for
  bool drew = false;           // random numbers, which its seed decides
  double seconds = 0;
};

// The states that run now, so that a stop can reach them. Thread-safe.
class RunningStates {
 public:
  // Makes them all raise "interrupted" at their next instruction.
  void interrupt();

  // A state is among them while this lives; it must not be closed before.
  class Member {
   public:
    Member(RunningStates& states, lua_State* L);
    ~Member();
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

   private:
    RunningStates& states_;
    lua_State* L_;
  };

 private:
  std::mutex mutex_;
  std::vector<lua_State*> states_;
};

// "case D = 2.5, seed = 3"
std::string case_name(const std::vector<CaseValue>& values);

// Never throws: what goes wrong is the failure of the result.
CaseResult run_case(const CaseSetup& setup, RunningStates& states);

// What `run` may return besides a table, as a sentence for errors.
std::string wrong_return(const std::string& found);

}  // namespace asperity::lua
