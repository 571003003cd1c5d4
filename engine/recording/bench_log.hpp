// SPDX-License-Identifier: GPL-3.0-or-later
// The log of a bench: all that was done to a specimen pair since it was made, with what its presses measured,
// as a press log (press_log.hpp) that reads back as the same events.
#pragma once

#include <string>

#include "engine/specimen/specimen_pair.hpp"

namespace asperity {

// Presses stand as they were asked for, by load or by pressure; where a pair was pressed by both or by
// anything else, all stand with the mean pressure that they brought. A press to nothing is a release. Beside
// a press stand results: load or pressure, approach, area fraction, greatest pressure, in SI. Times are there
// if every event has one. Throws Error{bad_state} for a pair to which nothing was done, and what
// press_log_text does.
std::string bench_log_text(const SpecimenPair& pair);

}  // namespace asperity
