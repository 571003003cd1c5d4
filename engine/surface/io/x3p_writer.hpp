// SPDX-License-Identifier: GPL-3.0-or-later
// Writes X3P (ISO 25178-72): incremental x and y, absolute z in double precision, MD5 of the data.
// No date but a fixed one, so that the same surface gives the same bytes.
#pragma once

#include <string>

#include "engine/surface/surface.hpp"

namespace asperity {

// Throws Error{bad_file} when the file cannot be written. Increments carry more digits than a double
// holds, so that the size reads back exactly.
void write_x3p(const Surface& surface, const std::string& path);

}  // namespace asperity
