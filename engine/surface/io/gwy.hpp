// SPDX-License-Identifier: GPL-3.0-or-later
// A surface as a file of Gwyddion: one map in metres, bit for bit.
#pragma once

#include <string>

#include "engine/surface/surface.hpp"

namespace asperity {

// Throws Error{bad_value} for a surface past 4 GiB, which the format cannot hold, and Error{bad_file}.
void write_gwy(const Surface& surface, const std::string& path);

}  // namespace asperity
