// SPDX-License-Identifier: GPL-3.0-or-later
// Reading one node of a field by numbers that came from a script, and so may be anything.
#pragma once

#include "engine/core/grid.hpp"

namespace asperity {

// The value at node (i, j). Throws Error{bad_value} unless both are whole numbers inside the field.
double node_value(const Field& field, double i, double j);

}  // namespace asperity
