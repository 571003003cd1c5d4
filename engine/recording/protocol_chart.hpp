// SPDX-License-Identifier: GPL-3.0-or-later
// A chart of load over time with labelled events. A detected protocol is drawn over its recording; others
// over their times, the sum of dwells, or event by event.
#pragma once

#include <string>

#include "engine/plot/chart.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

// No labels if more than 24. Throws Error{bad_value} for presses by both pressure and load.
LineChart protocol_chart(const Protocol& protocol, const std::string& title);

}  // namespace asperity
