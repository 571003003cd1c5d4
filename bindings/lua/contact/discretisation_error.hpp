// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation part of st.error: estimates from the same press on coarser grids, if requested. Also
// st.chosen, the cells and tolerance chosen for a requested error.
#pragma once

#include "bindings/lua/registry/record_type.hpp"
#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/state.hpp"

namespace asperity::lua {

// st.error.discretisation. The coarser grids are read with the first quantity.
struct DiscretisationError {
  asperity::State state;
};

template <>
const Class& class_of<DiscretisationError>();

const RecordType<ChosenAccuracy>& chosen_accuracy_type();
const RecordType<TriedGrid>& tried_grid_type();

// Cells, tolerance, precision, reason and trials. Nil if no error was requested.
Value chosen_record(const asperity::State& state);

}  // namespace asperity::lua
