// SPDX-License-Identifier: GPL-3.0-or-later
// A run by an earlier version beside the same script run by this one. Where laws changed in between, equal
// bytes cannot be asked for: numbers are compared to `digits_kept`, digests of what has other last digits not
// at all, and a difference beyond that is explained where a changed law was met before it. What is left is a
// difference as between runs of one version.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/run/changed_laws.hpp"
#include "engine/run/recorded_run.hpp"

namespace asperity {

// Relative, of two numbers that differ in last digits alone. Other last digits of the heights move the answer
// of a solve within what its tolerance leaves open, 1e-6 unless a script says otherwise; of what is read of a
// state that is up to ten times as much (a flattening met to 1e-8 says its pressure to 9e-8,
// tests/contact/half_space/half_space_digits_test.cpp).
inline constexpr double digits_kept = 1e-5;

struct LawMet {
  const ChangedLaw* law;
  std::int64_t line;  // of the later run's journal, at or before which it was first met
};

struct ExplainedDifference {
  Difference difference;
  std::vector<const ChangedLaw*> laws;  // met at its line or before
};

struct AcrossVersions {
  std::vector<Difference> differences;  // which no changed law explains
  std::vector<ExplainedDifference> explained;
  std::int64_t lines = 0;            // of the record that were compared
  std::int64_t in_last_digits = 0;   // numbers, alone or in texts, that differ within digits_kept
  std::int64_t digests = 0;          // that differ and say nothing
  std::vector<std::string> outputs;  // files whose digests differ and say nothing
};

// `met`: the changed laws that the later run met, without Law::last_digits, which all runs meet. Left out are
// warnings, the sentences of errors and verdicts, keys that the record does not know, and .xdmf files, which
// version 0.1.0 did not list. Rows of notebooks are compared as lines of the journal.
AcrossVersions compare_across_versions(const RecordedRun& recorded, const RecordedRun& again,
                                       std::span<const LawMet> met);

}  // namespace asperity
