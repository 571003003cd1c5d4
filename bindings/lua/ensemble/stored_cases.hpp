// SPDX-License-Identifier: GPL-3.0-or-later
// Whole cases of an ensemble in the run's store, for resumed runs, edited scripts and other processes. The
// key: behaviour of the function (not its file), the case's values, and if used, the seed and the given
// knobs. A stored case is valid while its input files are unchanged; clock and environment are not checked.
// Not for trusted scripts (--trust), studies and variations.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity::lua {

class Session;

// Exact to the bit. `given`: the case's values, written as references. Throws Error{not_permitted} for a row
// without bytes, Error{bad_file} for invalid bytes.
std::string case_bytes(const CaseResult& result, const std::vector<CaseValue>& given);
CaseResult case_from_bytes(std::string_view bytes, const std::vector<CaseValue>& given);

// For heavy calls in cases; may be null. Used by other threads.
ResultStore* results_for_cases(const Session& session);

// Prefix of failure keys: a failure must never hide a later result.
inline constexpr std::string_view failed_case = "failed ";

// Of one ensemble. Thread-safe.
class StoredCases {
 public:
  StoredCases(const Session& session, const PackedValue& run);

  // None if missing or outdated. Returns failures only `with_failures`.
  std::optional<CaseResult> find(const CaseSetup& setup, bool with_failures) const;
  bool keeps() const { return store_ != nullptr; }
  // With and without random numbers and knobs. Keys of failures begin with `failed_case`.
  std::vector<std::string> keys(const CaseSetup& setup) const;
  // Stores failures and cheap cases only if `always`. Never fails.
  void keep(const CaseSetup& setup, const CaseResult& result, bool always) const;

 private:
  std::optional<CaseResult> find_under(const std::string& key, const CaseSetup& setup) const;
  std::string key_of(const CaseSetup& setup, bool drew, bool asked) const;

  ResultStore* store_ = nullptr;
  PackedValue::Content content_;
  std::string folder_;  // of the script
  std::string script_;  // for an incomplete digest
};

}  // namespace asperity::lua
