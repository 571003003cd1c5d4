// SPDX-License-Identifier: GPL-3.0-or-later
// A chart of load over time with labelled events: over the recording of a detected protocol, else over the
// times, the sum of dwells, or event by event.
#pragma once

#include <string>

#include "engine/plot/chart.hpp"
#include "engine/specimen/protocol.hpp"

namespace asperity {

// At most 24 labels, else none. Throws Error{bad_value} for presses by both pressure and load.
LineChart protocol_chart(const Protocol& protocol, const std::string& title);

}  // namespace asperity
