// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "bindings/lua/registry/registry.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/specimen/tilt_trials.hpp"

namespace asperity::lua {

struct TiltStage {
  std::shared_ptr<SpecimenPair> contact;
  std::shared_ptr<const JunctionLaw> law;
  TiltTrialOptions options;
};

Class make_class(For<TiltStage>);

Function tilt_stage_function();

}  // namespace asperity::lua
