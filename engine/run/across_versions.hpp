// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a run recorded by another minor version, compared with the results of this version: the rows of
// notebooks and the verdicts of expectations. Versions may round differently and may change laws, so numbers
// are compared to `digits_kept`; digests, files, keys and warnings are not compared.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/run/recorded_run.hpp"

namespace asperity {

// Relative. Other last digits of the heights change a solve within its tolerance (1e-6 by default), and a
// derived number by up to ten times as much (tests/contact/half_space/half_space_digits_test.cpp).
inline constexpr double digits_kept = 1e-5;

// "0.2.0" and "0.2.7", not "0.3.0". Equal texts are the same version.
bool same_minor_version(std::string_view one, std::string_view other);

struct AcrossVersions {
  std::vector<Difference> differences;  // in the order of the record
  std::int64_t compared = 0;            // values and verdicts of the record
};

// A run that did not end is compared as far as it came. A number below 1e-12 of the greatest number of its
// column is rounding, and is not compared.
AcrossVersions compare_across_versions(const RecordedRun& recorded, const RecordedRun& again);

}  // namespace asperity
