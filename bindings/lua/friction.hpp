// SPDX-License-Identifier: GPL-3.0-or-later
// lab.friction and lab.tilt_stage.
#pragma once

#include "bindings/lua/registry.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/specimen/tilt_trials.hpp"

namespace asperity::lua {

// A stage set up: which contact, which law, which weight.
struct TiltStage {
  std::shared_ptr<SpecimenPair> contact;
  std::shared_ptr<const JunctionLaw> law;
  TiltTrialOptions options;
};

template <>
const Class& class_of<JunctionLaw>();
template <>
const Class& class_of<TiltStage>();

Function friction_function();
Function tilt_stage_function();

}  // namespace asperity::lua
