// SPDX-License-Identifier: GPL-3.0-or-later
// Whole cases of an ensemble in the store of its run: what a case found, under a key made of what its
// function does (not of how the script is called and where it lies), the case's values and, where the case
// drew random numbers, its seed, and where it asked for knobs, what was given for them. A run that is
// resumed, an edited script and other processes find them there. What a case read from files is kept with it,
// and holds only while the files are the same; what it asked of the clock or the environment stays as it was.
// Nothing is kept of cases whose script may do anything (--trust), of studies and of variations.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity::lua {

class Session;

// A finished case as bytes, bit for bit. `given` are the case's own values: its row names them, and holds
// none of them. Throws Error{not_permitted} for a row that bytes cannot carry, Error{bad_file} for bytes that
// case_bytes did not write.
std::string case_bytes(const CaseResult& result, const std::vector<CaseValue>& given);
CaseResult case_from_bytes(std::string_view bytes, const std::vector<CaseValue>& given);

// Where cases, which run on other threads, take heavy calls from and keep them; null where nothing is kept.
ResultStore* results_for_cases(const Session& session);

// A failure has a separate key, so it never hides a later result of another process.
inline constexpr std::string_view failed_case = "failed ";

// Of one ensemble. Thread-safe.
class StoredCases {
 public:
  StoredCases(const Session& session, const PackedValue& run);

  // None where it is not kept or no longer holds. A failure counts only `with_failures`.
  std::optional<CaseResult> find(const CaseSetup& setup, bool with_failures) const;
  bool keeps() const { return store_ != nullptr; }
  // Possible keys of a case, with and without random numbers and knobs. The key of a failure begins with
  // `failed_case`.
  std::vector<std::string> keys(const CaseSetup& setup) const;
  // Failures are kept only where `always`, and cases that cost next to nothing as well. Never fails.
  void keep(const CaseSetup& setup, const CaseResult& result, bool always) const;

 private:
  std::optional<CaseResult> find_under(const std::string& key, const CaseSetup& setup) const;
  // By whether it drew random numbers, and asked for knobs.
  std::string key_of(const CaseSetup& setup, bool drew, bool asked) const;

  ResultStore* store_ = nullptr;
  PackedValue::Content content_;
  std::string folder_;  // of the script
  std::string script_;  // what else the key holds where values cannot be told by their digest
};

}  // namespace asperity::lua
