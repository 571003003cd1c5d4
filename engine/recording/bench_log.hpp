// SPDX-License-Identifier: GPL-3.0-or-later
// The history of a specimen pair with results, as a press log (press_log.hpp).
#pragma once

#include <string>

#include "engine/specimen/specimen_pair.hpp"

namespace asperity {

// Presses all by load, or all by pressure, stay as requested; otherwise they get their mean pressures. A
// press to zero is a release. Results: load or pressure, approach, area fraction, peak pressure, in SI.
// Throws Error{bad_state} without history, and as press_log_text does.
std::string bench_log_text(const SpecimenPair& pair);

}  // namespace asperity
