// SPDX-License-Identifier: GPL-3.0-or-later
// The errors of a state as a script reads them, st.error: parts that are never mixed, each worked out
// when it is first read.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/cost.hpp"

namespace asperity::lua {

// The value of st.error: the state itself, so that its parts are found when they are asked for.
struct StateError {
  asperity::State state;
};

// st.error.algebraic: bounds that are worked out.
struct StateBounds {
  asperity::State state;
};

template <>
const Class& class_of<StateError>();
template <>
const Class& class_of<StateBounds>();

}  // namespace asperity::lua
