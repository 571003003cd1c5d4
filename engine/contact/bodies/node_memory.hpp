// SPDX-License-Identifier: GPL-3.0-or-later
// What earlier events left on the bodies beside their shapes: fields by name, one of each body in that body's
// own frame, so that a field is turned, shifted and copied with its body. The effect that keeps a field reads
// it at the nodes of the lower body (met) and raises it after an event (raised).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/grid.hpp"

namespace asperity {

class ContactGeometry;

// The fields of one name; null for a body on which no event has left one.
struct NodeMemory {
  std::shared_ptr<const Field> lower, upper;
  // After events off the lattice: the field of the upper body at the nodes of the lower one, exact until the
  // bodies are moved.
  std::shared_ptr<const Field> upper_here;

  bool empty() const { return !lower && !upper && !upper_here; }
};

using BodyMemory = std::map<std::string, NodeMemory, std::less<>>;

// The fields of both bodies at the nodes of the lower body; null where no event has left one.
struct MetMemory {
  std::shared_ptr<const Field> lower, upper;
};
// `at_first`: the value at nodes over which no node of the upper body lies.
MetMemory met(const ContactGeometry& geometry, const NodeMemory& memory, double at_first);

// The memory after an event that gave `values` at the nodes of the lower body: at each node the greater of
// the value before and the new one. A body without memory begins with the value given for it; a body for
// which none is given keeps no memory.
NodeMemory raised(const ContactGeometry& geometry, const NodeMemory& before, const Field& values,
                  std::optional<double> lower_at_first, std::optional<double> upper_at_first);

}  // namespace asperity
