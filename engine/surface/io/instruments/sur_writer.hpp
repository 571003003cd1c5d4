// SPDX-License-Identifier: GPL-3.0-or-later
// A surface as a file of Digital Surf (SUR), which MountainsMap and most programs of surface metrology read.
// The format holds integers: heights are rounded to whole steps of the greatest height / 2^30, or of the
// range / 2^31 where heights lie far from zero, which the comment of the file states; sizes are rounded to
// single precision. A point that was not measured is the least number less 2, and the header says that there
// are such points. Reading back gives every height within half a step and the holes exactly; the size of a
// map of one line is that of a trace, which has no width.
#pragma once

#include <string>

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The same surface gives the same bytes. Throws Error{bad_value} for sizes or heights that single precision
// does not hold, Error{bad_file} where the file cannot be written.
void write_sur(const Surface& surface, const std::string& path, Monitor& monitor = Monitor::silent());

}  // namespace asperity
