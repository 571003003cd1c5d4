// SPDX-License-Identifier: GPL-3.0-or-later
// Every physical effect that a scene can name, a line each, and those that the program leaves out on purpose.
// Whoever reads a scene asks here first, so that an effect which is not computed is refused by name and never
// silently left out.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/contact/effect.hpp"

namespace asperity {

// In the order in which they are planned and reports list them, after the elasticity.
std::span<const Effect* const> known_effects();

// Throws Error{unknown_name} with the nearest name for a name that is not listed, and Error{bad_value} that
// names the effect for a process that is not modelled. Null for the elasticity, which is no effect beside
// others.
const Effect* require_effect(std::string_view name);

// The effects a scene could name that are not in `run`, in their order, the elasticity first.
std::vector<std::string> effects_not_in(std::span<const std::string> run);

}  // namespace asperity
