// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of a study: error against the time of one run on logarithmic axes, one line a way with bars
// from the fastest to the slowest run, and rings about the settings that nothing beats. What has no
// error to draw stands at the rim: a failed setting as a cross at the top, at the time after which it
// failed; one that the budget left out as a triangle there, at the time it was expected to take; both
// no further than a small factor from the times measured. One whose answer is the truth to the last
// bit stands as a diamond at the bottom.
#pragma once

#include "engine/plot/chart.hpp"
#include "engine/study/study_result.hpp"

namespace asperity {

// Throws Error{bad_value} if no setting has an error.
LineChart study_chart(const StudyResult& result, const std::string& title);

}  // namespace asperity
