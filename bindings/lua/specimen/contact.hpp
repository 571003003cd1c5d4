// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/friction/partial_slip.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

Class make_class(For<SpecimenPair>);

// Options of c:press, c:place and c:shift, also in protocol events.
struct PressKeys : PressRequest {
  int given = 0;  // given controls; exactly one
};
extern const Block<PressKeys> press_block;
// The presses of c:press or c:sweep; empty for other functions and values unknown in a dry run. Throws as the
// call.
std::vector<PressRequest> requests_of(const Call& call, const Function& function);
// By an iterator; the same line as for c:press.
void record_press(const Session& session, const std::shared_ptr<SpecimenPair>& pair,
                  const PressRequest& request, const asperity::State& state);
struct PlaceKeys {
  std::uint64_t seed = 1;
};
extern const Block<PlaceKeys> place_block;
struct ShiftKeys {
  double x = 0, y = 0;
};
extern const Block<ShiftKeys> shift_block;

Function contact_function();

// Partial slip under a tangential force below sliding.
Function shear_method();
Class make_class(For<PartialSlip>);

// One Error reports all problems.
Scene read_scene(Call& call);
// In a dry run with placeholders: throws errors of read_scene and contact, as far as known.
void look_at_scene(const Call& call);
// In order. Keys without text become problems with this hint.
std::vector<std::string> effects_named(const Argument& value, const std::string& hint, Problems& problems);
const RowBlock& effect_block(const Effect& effect);
const BlockInfo& scene_keys();

}  // namespace asperity::lua
