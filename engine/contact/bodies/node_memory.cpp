// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/node_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/contact/bodies/geometry.hpp"

namespace asperity {

namespace {

std::shared_ptr<const Field> raised_field(const std::shared_ptr<const Field>& before, double at_first,
                                          const Field& values) {
  Field result = before ? *before : Field(values.nx(), values.ny(), at_first);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = std::max(result[k], values[k]);
  return std::make_shared<const Field>(std::move(result));
}

}  // namespace

MetMemory met(const ContactGeometry& geometry, const NodeMemory& memory, double at_first) {
  MetMemory here{memory.lower, memory.upper_here};
  if (memory.upper_here || !memory.upper) return here;
  Field seen = geometry.pose().to_lower(*memory.upper, geometry.grid());
  // No contact where the turned upper body has no node.
  for (double& value : seen.values())
    if (std::isnan(value)) value = at_first;
  here.upper = std::make_shared<const Field>(std::move(seen));
  return here;
}

NodeMemory raised(const ContactGeometry& geometry, const NodeMemory& before, const Field& values,
                  std::optional<double> lower_at_first, std::optional<double> upper_at_first) {
  NodeMemory after = before;
  if (lower_at_first) after.lower = raised_field(before.lower, *lower_at_first, values);
  if (upper_at_first && !geometry.upper_is_flat()) {
    const Pose& pose = geometry.pose();
    after.upper = raised_field(before.upper, *upper_at_first, pose.to_upper(values, geometry.grid()));
    if (!pose.on_lattice())
      after.upper_here = raised_field(met(geometry, before, *upper_at_first).upper, *upper_at_first, values);
  }
  return after;
}

}  // namespace asperity
