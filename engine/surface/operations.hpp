// SPDX-License-Identifier: GPL-3.0-or-later
// What can be made of a surface: other heights, another place, another grid, lines through it. All
// are pure functions that return new values. Levelling and filtering are metrology's.
#pragma once

#include "engine/surface/operations/heights.hpp"
#include "engine/surface/operations/missing_points.hpp"
#include "engine/surface/operations/placement.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "engine/surface/operations/sections.hpp"
