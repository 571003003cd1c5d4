// SPDX-License-Identifier: GPL-3.0-or-later
// A loading protocol as a chart: load over time, with its rises, holds, peaks, releases and turns marked and
// labelled. One that was detected in a recording is drawn over what was recorded; any other over its recorded
// times, or over the time its dwells add up to, or, without these, event by event.
#pragma once

#include <string>

#include "engine/plot/chart.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

// Labels are left out past 24 of them; the key tells the marks. Throws Error{bad_value} for a protocol whose
// presses are not all by pressure or all by load.
LineChart protocol_chart(const Protocol& protocol, const std::string& title);

}  // namespace asperity
