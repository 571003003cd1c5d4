// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of a picture, shared by surfaces and by the fields of a state.
#pragma once

#include "bindings/lua/registry/options.hpp"
#include "engine/plot/picture.hpp"

namespace asperity::lua {

const Block<PictureOptions>& picture_block();

}  // namespace asperity::lua
