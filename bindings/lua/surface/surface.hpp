// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces and profiles as native values of the language, and the parts of the two classes that have a source
// of their own.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "engine/metrology/parameters/areal_parameters.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Surface>();
template <>
const Class& class_of<Profile>();

const Module& surface_module();
const Module& profile_module();

// Methods of a surface that make other surfaces and profiles of it (surface_operations.cpp).
std::vector<Function> surface_operations();
// a + b, a - b, -a, 2 * a, a / 2.
std::vector<Operator> surface_operators();

// s:registered_to(before) (registration.cpp), with the record that it gives and those within it.
Function registered_to_method();
std::vector<const RecordInfo*> registration_types();

// s:areal_parameters{...}, and what goes with it: s:bearing(), s:autocorrelation(), s:scale_dependence{...}
// and s:reliability{...} (areal_parameters.cpp); and the types of the records that they give.
std::vector<Function> parameter_methods();
std::vector<const RecordInfo*> parameter_results();
template <>
const Class& class_of<ArealParameters>();
template <>
const Class& class_of<MaterialRatioCurve>();
template <>
const Class& class_of<Autocorrelation>();

// p:profile_parameters{...}: the parameters of ISO 21920-2 of a trace, filtered and cut into sections as ISO
// 21920-3 has it; p:primary_parameters{...}: those of the trace without an L-filter (profile_parameters.cpp).
Function profile_parameters_method();
Function primary_parameters_method();
Function profile_bearing_method();
const RecordInfo& profile_parameters_result();
const RecordInfo& primary_parameters_result();

// What surfaces and profiles have for points that were not measured (missing_points.cpp): how many were,
// which, more of them by a mask, a function or a rule for outliers, and heights in their place; and the types
// of the records that they give.
std::vector<Getter> missing_point_fields_of_surface();
std::vector<Getter> missing_point_fields_of_profile();
std::vector<Function> missing_point_methods_of_surface();
std::vector<Function> missing_point_methods_of_profile();
const RecordInfo& outliers_type(bool surface);
// ", 12 of 4096 points not measured" for print(); "" where every point was.
std::string missing_text(std::size_t measured, std::size_t points);

}  // namespace asperity::lua
