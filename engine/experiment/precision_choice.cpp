// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/precision_choice.hpp"

#include <string>
#include <variant>

#include "engine/contact/elasticity/half_space/half_space_compliance.hpp"
#include "engine/core/text.hpp"

namespace asperity {

PrecisionChoice choose_precision(const Scene& scene, const Grid& grid, double tolerance) {
  using Precision = Accuracy::Precision;
  if (scene.accuracy.precision_named) return {scene.accuracy.precision, "as named"};
  if (std::holds_alternative<BoxOptions>(scene.elasticity))
    return {Precision::double_, "boxes are solved in no other"};
  if (!HalfSpaceCompliance::single_possible(grid.nx, grid.ny, scene.boundary))
    return {Precision::double_, "there is no other on cells like these"};
  if (std::int64_t{grid.nx} * grid.ny < fewest_nodes_for_single)
    return {Precision::double_, "single saves no time worth it on fewer than " +
                                    std::to_string(fewest_nodes_for_single) + " nodes"};
  if (tolerance < tightest_tolerance_for_single)
    return {Precision::double_,
            "single takes more steps to tolerances below " + format_short(tightest_tolerance_for_single)};
  return {Precision::single, "less time on so many nodes, and as many steps to this tolerance"};
}

}  // namespace asperity
