// SPDX-License-Identifier: GPL-3.0-or-later
// The options table of lab.contact: bodies, boundary, effects and accuracy, read into a Scene.
#pragma once

#include "bindings/lua/registry.hpp"
#include "engine/contact/scene.hpp"

namespace asperity::lua {

// Every problem of the table in one Error.
Scene read_scene(Call& call);
// The keys, for the registry.
const BlockInfo& scene_keys();

}  // namespace asperity::lua
