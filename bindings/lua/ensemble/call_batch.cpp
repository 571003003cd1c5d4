// SPDX-License-Identifier: GPL-3.0-or-later
// Script function calls as cases of an implicit ensemble.
#include "bindings/lua/registry/call_batch.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "bindings/lua/ensemble/scripted_cases.hpp"
#include "bindings/lua/ensemble/stored_cases.hpp"
#include "bindings/lua/ensemble/transfer.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

// Makes `run` from the function.
constexpr char run_of_calls[] =
    "local call = ... return function(case) return { answer = call(case.a, case.b) } end";
constexpr std::array<const char*, 2> names_of_arguments = {"a", "b"};
constexpr int deepest_batch = 8;

class BatchedCases final : public ScriptedCases {
 public:
  // `setups` must outlive this object.
  BatchedCases(const std::vector<CaseSetup>& setups, const StoredCases& kept)
      : ScriptedCases(
            setups.size(), [&setups](std::size_t k) { return setups[k]; }, kept),
        reasons_(setups.size()) {}

  const std::string& reason(std::size_t k) const { return reasons_[k]; }
  std::string name(std::size_t k) const override { return "call " + std::to_string(k + 1); }
  // Calls start in order, and later calls are skipped: the reported first failure is the same for any number
  // of threads.
  Finished compute(std::size_t k) override {
    if (k > first_failed_) return std::make_unique<CaseResult>();
    Finished found = ScriptedCases::compute(k);
    if (found->failure.empty() || stop_flag().reason() != StopReason::none) return found;
    std::size_t before = first_failed_;
    while (k < before && !first_failed_.compare_exchange_weak(before, k)) {
    }
    reasons_[k] = std::exchange(found->failure, {});
    return found;
  }

 private:
  std::vector<std::string> reasons_;  // one writer each
  std::atomic<std::size_t> first_failed_ = std::numeric_limits<std::size_t>::max();
};

class ScriptedBatch final : public CallBatch {
 public:
  ScriptedBatch(const Call& call, std::shared_ptr<const PackedValue> run)
      : L(call.L),
        session_(call.session()),
        common_(common_setup(call.L, session_, std::move(run))),
        kept_(session_, *common_.run) {}

  std::vector<BatchedAnswer> answers(const std::vector<Values>& arguments,
                                     const std::function<void(std::size_t)>& done) override {
    std::vector<CaseSetup> setups;
    for (const Values& given : arguments) setups.push_back(setup_of(given));
    QuietMonitor monitor(session_.monitor(), [&](double share) {
      done(static_cast<std::size_t>(std::lround(share * static_cast<double>(setups.size()))));
    });
    BatchedCases cases(setups, kept_);
    CaseSchedule schedule{monitor};
    schedule.ensemble = common_.ensemble;
    schedule.print = [this](std::string_view text) {
      std::fwrite(text.data(), 1, text.size(), session_.output);
    };
    std::vector<BatchedAnswer> found;
    for (const std::unique_ptr<FinishedCase>& one : run_cases(cases, schedule)) {
      found.push_back(answer_of(static_cast<const CaseResult&>(*one)));
      if (found.back().failure.empty()) found.back().failure = cases.reason(found.size() - 1);
    }
    note_knobs(session_);
    done(found.size());
    return found;
  }

 private:
  CaseSetup setup_of(const Values& given) {
    CaseSetup one = common_;
    one.seed = Stream(session_.seed, "calls of a study").bits(calls_++);
    for (std::size_t k = 0; k < given.size(); ++k) {
      const Argument::StackGuard guard(L);
      push_checked(L, given[k], "the arguments of a call");
      one.values.push_back({names_of_arguments[k],
                            pack(L, -1, Cargo::data, "the argument", "give numbers, strings and tables"),
                            Argument(L, -1).describe()});
    }
    return one;
  }

  BatchedAnswer answer_of(const CaseResult& result) {
    BatchedAnswer answer;
    answer.seconds = result.seconds;
    note(result);
    answer.failure = result.failure;
    if (result.row == nullptr) return answer;
    const Argument::StackGuard guard(L);
    push_checked(L, result.row, "the answer of a call");
    with_key(Argument(L, -1), "answer", [&](const Argument& value) {
      answer.nil = value.is_nil();
      if (value.is_number())
        answer.number = value.number();
      else
        answer.other = value.describe();
    });
    return answer;
  }

  void note(const CaseResult& result) {
    for (const RunKnob& knob : result.knobs) {
      session_.knobs->make(knob);  // not made by a stored call
      if (session_.notes != nullptr) session_.notes->knobs.push_back(knob);
    }
    note_inputs_of_case(session_, result.inputs);
  }

  lua_State* L;
  Session& session_;
  const CaseSetup common_;
  const StoredCases kept_;
  std::uint64_t calls_ = 0;
};

}  // namespace

std::unique_ptr<CallBatch> call_batch(const Call& call, const Argument& function, const std::string& name) {
  lua_State* L = call.L;
  if (call.session().depth >= deepest_batch || lua_checkstack(L, 8) == 0) return nullptr;
  const Argument::StackGuard guard(L);
  lua_pushvalue(L, function.index());
  auto wrap = [](lua_State* s) {
    if (luaL_loadbufferx(s, run_of_calls, sizeof run_of_calls - 1, "=asperity", "t") != LUA_OK)
      return lua_error(s);
    lua_insert(s, 1);
    lua_call(s, 1, 1);
    return 1;
  };
  if (protect(L, 1, 1, wrap) != LUA_OK) throw Error(ErrorCode::out_of_memory, error_text(L, -1));
  try {
    return std::make_unique<ScriptedBatch>(call, pack(L, -1, Cargo::functions, name, ""));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_permitted) throw;
    return nullptr;
  }
}

}  // namespace asperity::lua
