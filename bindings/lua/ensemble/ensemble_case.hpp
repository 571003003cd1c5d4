// SPDX-License-Identifier: GPL-3.0-or-later
// One case of an ensemble in a fresh Lua state: function and values are copied in, the row is copied out.
// Cases do not see each other; output and warnings are shown later, in the order of cases.
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
  std::vector<CaseValue> values;  // in message order
  std::uint64_t seed = 1;
  bool trusted = false;
  int depth = 1;  // enclosing ensembles
  std::shared_ptr<Refinement> refinement;
  std::shared_ptr<Variation> variation;
  std::shared_ptr<RunKnobs> knobs;
  std::shared_ptr<Ledger> ledger;
  ResultStore* results = nullptr;  // of the run; may be null
  ScriptSpelling script;
  std::shared_ptr<const LoadedFiles> loaded;  // of a replayed or resumed run, or null
  std::string script_digest;                  // of script and arguments
  int ensemble = 0;                           // in the run, from 1
  bool watched = false;                       // check the stop flag now and then
};

struct CaseResult : FinishedCase {
  std::shared_ptr<const PackedValue> row;  // null on failure
  std::string digest;                      // of the row
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;  // used
  bool drew = false;           // used random numbers: the seed matters
  double seconds = 0;
};

// The current states, for stops. Thread-safe.
class RunningStates {
 public:
  // All states raise "interrupted" at their next instruction.
  void interrupt();

  // Registers a state; destroy before closing the state.
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

std::string case_name(const std::vector<CaseValue>& values);

// Never throws: errors become failures.
CaseResult run_case(const CaseSetup& setup, RunningStates& states);

// A sentence about allowed values of `run`.
std::string wrong_return(const std::string& found);

}  // namespace asperity::lua
