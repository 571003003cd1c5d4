// SPDX-License-Identifier: GPL-3.0-or-later
// The options table of lab.contact: bodies, boundary, effects and accuracy, read into a Scene.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/row_block.hpp"
#include "engine/contact/scene.hpp"

namespace asperity::lua {

// Every problem of the table in one Error.
Scene read_scene(Call& call);
// Of a dry run whose bodies are placeholders: throws what read_scene or the contact would for the scene,
// as far as the bodies are known.
void look_at_scene(const Call& call);
// The keys of a table of effects, in order; a problem, with this hint, for each that is no text.
std::vector<std::string> effects_named(const Argument& value, const std::string& hint, Problems& problems);
// The keys of an effect's own table.
const RowBlock& effect_block(const Effect& effect);
// The keys, for the registry.
const BlockInfo& scene_keys();

}  // namespace asperity::lua
