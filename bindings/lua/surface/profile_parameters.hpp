// SPDX-License-Identifier: GPL-3.0-or-later
// p:profile_parameters{...}: the parameters of ISO 21920-2 of a trace, filtered and cut into sections as ISO
// 21920-3 has it; p:primary_parameters{...}: those of the trace without an L-filter.
#pragma once

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

Function profile_parameters_method();
Function primary_parameters_method();
Function profile_bearing_method();
const RecordInfo& profile_parameters_result();
const RecordInfo& primary_parameters_result();

}  // namespace asperity::lua
