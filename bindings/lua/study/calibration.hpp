// SPDX-License-Identifier: GPL-3.0-or-later
// lab.calibrate: parameters of a model of the script fitted to the rows of a table, and what it returns.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/study/calibration_report.hpp"

namespace asperity::lua {

template <>
const Class& class_of<CalibrationReport>();

Function calibrate_function();

}  // namespace asperity::lua
