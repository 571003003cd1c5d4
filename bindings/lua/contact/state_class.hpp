// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/grid.hpp"

namespace asperity::lua {

// Common to all certificates; adhesive contacts add one.
std::vector<RecordField<Certificate>> certificate_fields();

Class make_class(For<asperity::State>);

// The result of contact:explain (plan.cpp).
Class make_class(For<Plan>);

// st.error; computes its parts on demand.
struct StateError {
  asperity::State state;
};

// st.error.algebraic.
struct StateBounds {
  asperity::State state;
};

Class make_class(For<StateError>);
Class make_class(For<StateBounds>);

// st.error.discretisation: estimates from the same press on coarser grids, read with the first quantity.
struct DiscretisationError {
  asperity::State state;
};

Class make_class(For<DiscretisationError>);

extern const RecordType<ChosenAccuracy> chosen_accuracy_type;
extern const RecordType<TriedGrid> tried_grid_type;

// Cells, tolerance, precision, reason and trials. Nil without a requested error.
Value chosen_record(const asperity::State& state);

}  // namespace asperity::lua
