// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces and profiles as native values, and the parts of both classes in separate sources.
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

// Methods that return other surfaces and profiles (surface_operations.cpp).
std::vector<Function> surface_operations();
// a + b, a - b, -a, 2 * a, a / 2.
std::vector<Operator> surface_operators();

// s:registered_to(before) (registration.cpp) and its record types.
Function registered_to_method();
std::vector<const RecordInfo*> registration_types();

// s:areal_parameters{...}, s:bearing(), s:autocorrelation(), s:scale_dependence{...}, s:reliability{...} and
// their record types (areal_parameters.cpp).
std::vector<Function> parameter_methods();
std::vector<const RecordInfo*> parameter_results();
template <>
const Class& class_of<ArealParameters>();
template <>
const Class& class_of<MaterialRatioCurve>();
template <>
const Class& class_of<Autocorrelation>();

// p:profile_parameters{...} and p:primary_parameters{...} (profile_parameters.cpp).
Function profile_parameters_method();
Function primary_parameters_method();
Function profile_bearing_method();
const RecordInfo& profile_parameters_result();
const RecordInfo& primary_parameters_result();

// Unmeasured points (missing_points.cpp).
std::vector<Getter> missing_point_fields_of_surface();
std::vector<Getter> missing_point_fields_of_profile();
std::vector<Function> missing_point_methods_of_surface();
std::vector<Function> missing_point_methods_of_profile();
const RecordInfo& outliers_type(bool surface);
// ", 12 of 4096 points not measured" for print(); "" if complete.
std::string missing_text(std::size_t measured, std::size_t points);

}  // namespace asperity::lua
