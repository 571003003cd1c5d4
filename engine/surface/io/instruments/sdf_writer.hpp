// SPDX-License-Identifier: GPL-3.0-or-later
// A surface as SDF of ISO 25178-71, binary (bISO-1.0), heights in metres as doubles, missing points NaN. What
// reads back has the same heights, bit for bit, and the same holes; a size is the spacing times the points
// and may differ in its last digit, and of a map of one line the width is that of a trace. The header counts
// points with 16 bits: 65535 a side.
#pragma once

#include <string>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The same surface gives the same bytes. Throws Error{bad_value} for more than 65535 points a side,
// Error{bad_file} where the file cannot be written.
void write_sdf(const Surface& surface, const std::string& path, Monitor& monitor = Monitor::silent());

}  // namespace asperity
