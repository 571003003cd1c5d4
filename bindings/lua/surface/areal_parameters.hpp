// SPDX-License-Identifier: GPL-3.0-or-later
// s:areal_parameters{...}, and what goes with it: s:bearing(), s:autocorrelation(), s:scale_dependence{...}
// and s:reliability{...}.
#pragma once

#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "engine/metrology/parameters/areal_parameters.hpp"

namespace asperity::lua {

template <>
const Class& class_of<ArealParameters>();
template <>
const Class& class_of<MaterialRatioCurve>();
template <>
const Class& class_of<Autocorrelation>();

// Methods of a surface.
std::vector<Function> parameter_methods();
// The types of the records that they give.
std::vector<const RecordInfo*> parameter_results();

}  // namespace asperity::lua
