// SPDX-License-Identifier: GPL-3.0-or-later
// A surface as a file of Gwyddion: one map in metres, bit for bit. Points that were not measured stand under
// a mask, as Gwyddion has it, and the metadata say so.
#pragma once

#include <string>

#include "engine/surface/surface.hpp"

namespace asperity {

// Throws Error{bad_value} for a surface past 4 GiB, with its mask, which the format cannot hold, and
// Error{bad_file}.
void write_gwy(const Surface& surface, const std::string& path);

}  // namespace asperity
