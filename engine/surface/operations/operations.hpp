// SPDX-License-Identifier: GPL-3.0-or-later
// All operations are pure functions. Levelling and filtering: engine/metrology.
#pragma once

#include "engine/surface/operations/heights.hpp"
#include "engine/surface/operations/missing_points.hpp"
#include "engine/surface/operations/placement.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "engine/surface/operations/sections.hpp"
