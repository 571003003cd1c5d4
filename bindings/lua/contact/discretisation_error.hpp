// SPDX-License-Identifier: GPL-3.0-or-later
// The part of st.error that grids leave: estimates from the same press on coarser ones, where the script
// asked for them; and st.chosen, what was chosen for an error that it asked for.
#pragma once

#include "bindings/lua/registry/record_type.hpp"
#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/state.hpp"

namespace asperity::lua {

// The value of st.error.discretisation: the state, whose coarser grids are read when a quantity is.
struct DiscretisationError {
  asperity::State state;
};

template <>
const Class& class_of<DiscretisationError>();

const RecordType<ChosenAccuracy>& chosen_accuracy_type();
const RecordType<TriedGrid>& tried_grid_type();

// The record of cells, tolerance, precision, reason and all that was tried; nil where nothing was asked for.
Value chosen_record(const asperity::State& state);

}  // namespace asperity::lua
