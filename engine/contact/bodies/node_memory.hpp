// SPDX-License-Identifier: GPL-3.0-or-later
// What earlier events left in the bodies beside their shapes: values of each node, by name, each body's in
// its own frame, so that they are turned, shifted and copied with it. Who keeps one reads it as the nodes of
// the lower body meet it, and raises it after an event.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/grid.hpp"

namespace asperity {

class ContactGeometry;

// Of one thing that is kept. None of a body on which no event has left any.
struct NodeMemory {
  std::shared_ptr<const Field> lower, upper;
  // Off the lattice, after events there: the upper body's as the nodes of the lower one meet it, exact until
  // the bodies are moved.
  std::shared_ptr<const Field> upper_here;

  bool empty() const { return !lower && !upper && !upper_here; }
};

using BodyMemory = std::map<std::string, NodeMemory, std::less<>>;

// Both bodies' values at the nodes of the lower body; none where nothing was left.
struct MetMemory {
  std::shared_ptr<const Field> lower, upper;
};
// `at_first`: of nodes of the upper body that are not there.
MetMemory met(const ContactGeometry& geometry, const NodeMemory& memory, double at_first);

// What is kept once nodes have reached `values`, at the nodes of the lower body: the greater of both. A body
// begins with the value given for it; without one it keeps nothing.
NodeMemory raised(const ContactGeometry& geometry, const NodeMemory& before, const Field& values,
                  std::optional<double> lower_at_first, std::optional<double> upper_at_first);

}  // namespace asperity
