// SPDX-License-Identifier: GPL-3.0-or-later
// Every effect of a scene. Effects outside the list are refused by name, never ignored.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/contact/scene/effect.hpp"

namespace asperity {

// In the order of plans and reports, after the elasticity.
std::span<const Effect* const> known_effects();

// Throws Error{unknown_name} with the nearest name, {bad_value} for a process not modelled. Null: elasticity.
const Effect* require_effect(std::string_view name);

// In list order; elasticity first.
std::vector<std::string> effects_not_in(std::span<const std::string> run);

}  // namespace asperity
