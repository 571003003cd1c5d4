// SPDX-License-Identifier: GPL-3.0-or-later
// st.error, the errors of a state: separate parts, each computed on first use.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/cost.hpp"

namespace asperity::lua {

// st.error holds the state, and so computes a part on demand.
struct StateError {
  asperity::State state;
};

// st.error.algebraic.
struct StateBounds {
  asperity::State state;
};

template <>
const Class& class_of<StateError>();
template <>
const Class& class_of<StateBounds>();

}  // namespace asperity::lua
