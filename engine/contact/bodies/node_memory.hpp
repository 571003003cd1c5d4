// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of earlier events besides shapes: named fields of each body in its own frame, moved with the body.
// Their effect reads them at the nodes of the lower body (met) and updates them after an event (raised).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/grid.hpp"

namespace asperity {

class ContactGeometry;

// Null for a body without memory.
struct NodeMemory {
  std::shared_ptr<const Field> lower, upper;
  // After events off the lattice: the upper body's field at the lower body's nodes, exact until the bodies
  // move.
  std::shared_ptr<const Field> upper_here;

  bool empty() const { return !lower && !upper && !upper_here; }
};

using BodyMemory = std::map<std::string, NodeMemory, std::less<>>;

// At the nodes of the lower body; null without memory.
struct MetMemory {
  std::shared_ptr<const Field> lower, upper;
};
// `at_first`: value at nodes without a counterpart.
MetMemory met(const ContactGeometry& geometry, const NodeMemory& memory, double at_first);

// After an event with `values` at the nodes of the lower body: the greater of old and new at each node. A
// body without memory starts from its `at_first`; without `at_first` it stores none.
NodeMemory raised(const ContactGeometry& geometry, const NodeMemory& before, const Field& values,
                  std::optional<double> lower_at_first, std::optional<double> upper_at_first);

}  // namespace asperity
