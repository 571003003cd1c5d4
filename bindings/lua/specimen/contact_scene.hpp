// SPDX-License-Identifier: GPL-3.0-or-later
// Options of lab.contact as a Scene: bodies, boundary, effects and accuracy.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/row_block.hpp"
#include "engine/contact/scene/scene.hpp"

namespace asperity::lua {

// One Error reports all problems.
Scene read_scene(Call& call);
// In a dry run with placeholder bodies: throws the errors of read_scene and of the contact, as far as known.
void look_at_scene(const Call& call);
// In order. Keys that are no text become problems with this hint.
std::vector<std::string> effects_named(const Argument& value, const std::string& hint, Problems& problems);
const RowBlock& effect_block(const Effect& effect);
const BlockInfo& scene_keys();

}  // namespace asperity::lua
