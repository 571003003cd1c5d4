// SPDX-License-Identifier: GPL-3.0-or-later
// What surfaces and profiles have for points that were not measured: how many were, which, more of them by a
// mask, a function or a rule for outliers, and heights in their place.
#pragma once

#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

std::vector<Getter> missing_point_fields_of_surface();
std::vector<Getter> missing_point_fields_of_profile();
std::vector<Function> missing_point_methods_of_surface();
std::vector<Function> missing_point_methods_of_profile();
// Types of the records that they give.
const RecordInfo& outliers_type(bool surface);

// ", 12 of 4096 points not measured" for print(); "" where every point was.
std::string missing_text(std::size_t measured, std::size_t points);

}  // namespace asperity::lua
