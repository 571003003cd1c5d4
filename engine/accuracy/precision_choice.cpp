// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/accuracy/precision_choice.hpp"

#include <variant>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"

namespace asperity {

PrecisionChoice choose_precision(const Scene& scene, const Grid& grid) {
  using Precision = Accuracy::Precision;
  if (scene.accuracy.precision_named) return {scene.accuracy.precision, "as named"};
  if (scene.elasticity.is<BoxOptions>()) return {Precision::double_, "boxes are solved in no other"};
  if (!HalfSpaceCompliance::single_possible(grid.nx, grid.ny, scene.boundary))
    return {Precision::double_, "there is no other on cells like these"};
  return {Precision::double_, "single saves no time"};
}

}  // namespace asperity
