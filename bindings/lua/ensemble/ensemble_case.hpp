// SPDX-License-Identifier: GPL-3.0-or-later
// One case of an ensemble in a fresh Lua state: function and values are copied in, the row is copied out.
// Cases are independent; output and warnings appear later, in the order of cases.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/run/case_scheduler.hpp"

namespace asperity {
class ResultStore;
}

namespace asperity::lua {

struct CaseValue {
  std::string key;
  std::shared_ptr<const PackedValue> value;
  std::string text;  // "2.5", "\"cold\"", "a surface"
};

struct CaseSetup : SessionSettings {
  std::shared_ptr<const PackedValue> run;
  std::vector<CaseValue> values;   // in message order
  ResultStore* results = nullptr;  // of the run; may be null
  int ensemble = 0;                // in the run, from 1
  bool watched = false;            // check the stop flag
};

struct CaseResult : FinishedCase {
  std::shared_ptr<const PackedValue> row;  // null on failure
  std::string digest;                      // of the row
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;  // used
  bool drew = false;           // the seed matters
  double seconds = 0;
};

// The current states, for stops. Thread-safe.
class RunningStates {
 public:
  // Raises "interrupted" at each next instruction.
  void interrupt();

  // A registered state; destroy before closing the state.
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

// The allowed values of `run`.
std::string wrong_return(const std::string& found);

}  // namespace asperity::lua
