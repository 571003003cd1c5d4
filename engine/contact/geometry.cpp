// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Rows are grouped so that small grids stay on one thread.
template <class Row>
void for_each_row(const Field& field, Row row) {
  constexpr std::int64_t nodes_per_block = 1 << 16;
  const std::int64_t rows_per_block = std::max<std::int64_t>(1, nodes_per_block / field.nx());
  const std::int64_t blocks = (field.ny() + rows_per_block - 1) / rows_per_block;
  parallel_for(blocks, [&](std::int64_t block) {
    const auto end = static_cast<int>(std::min<std::int64_t>(field.ny(), (block + 1) * rows_per_block));
    for (auto j = static_cast<int>(block * rows_per_block); j < end; ++j) row(j);
  });
}

Field combine(const Field& lower, const Field& upper, const LatticeIsometry& placement) {
  Field sum(lower.nx(), lower.ny());
  for_each_row(sum, [&](int j) {
    for (int i = 0; i < lower.nx(); ++i) {
      const auto node = placement.to_upper(LatticeIsometry::Node{i, j});
      sum(i, j) = lower(i, j) + upper(node.i, node.j);
    }
  });
  return sum;
}

// Off the lattice: NaN marks nodes without an upper body until the lowest of the others is known.
Field combine_turned(const Field& lower, const Field& upper, const Pose& pose, const Grid& grid) {
  Field sum = pose.to_lower(upper, grid);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k] += lower[k];
    if (sum[k] < lowest) lowest = sum[k];
  }
  if (std::isinf(lowest))
    throw Error(ErrorCode::bad_value, "turned and shifted like this, no node of one body lies over the other",
                "turn or shift it less");
  for (double& height : sum.values())
    if (std::isnan(height)) height = lowest;
  return sum;
}

}  // namespace

ContactGeometry::ContactGeometry(const Scene& scene, const Pose& pose, HardnessMemory hardness)
    : lower_(scene.lower),
      upper_(scene.upper),
      boundary_(scene.boundary),
      pose_(pose),
      hardness_(std::move(hardness)) {
  hardness_.upper_here.reset();
  if (const auto* rough = std::get_if<Surface>(&upper_)) {
    combined_ = std::make_shared<const Field>(
        pose_.on_lattice() ? combine(lower_.heights(), rough->heights(), pose_.lattice())
                           : combine_turned(lower_.heights(), rough->heights(), pose_, lower_.grid()));
    range_ = range(combined_->values());
  } else {
    range_ = lower_.height_range();
  }
  if (!std::isfinite(range_.min) || !std::isfinite(range_.max) || !std::isfinite(range_.span()))
    throw Error(ErrorCode::bad_value,
                "the combined heights run from " + format_short(range_.min) + " m to " +
                    format_short(range_.max) + " m",
                "heights this large leave the range of a double; check the unit of the surfaces");
}

ContactGeometry::ContactGeometry(const Scene& scene, const ContactGeometry& before, HardnessMemory hardness,
                                 const Field& yielded)
    : ContactGeometry(before) {
  if (pose_.on_lattice() || upper_is_flat()) {
    *this = ContactGeometry(scene, pose_, std::move(hardness));
    return;
  }
  lower_ = scene.lower;
  upper_ = scene.upper;
  hardness_ = std::move(hardness);
  Field combined = before.combined();
  for (std::size_t k = 0; k < combined.size(); ++k) combined[k] -= yielded[k];
  range_ = range(combined.values());
  combined_ = std::make_shared<const Field>(std::move(combined));
}

const Material* lower_material(const Surface& lower) {
  return lower.material() ? &*lower.material() : nullptr;
}

const Material* upper_material(const UpperBody& upper) {
  if (const auto* flat = std::get_if<Material>(&upper)) return flat;
  const Surface& rough = std::get<Surface>(upper);
  return rough.material() ? &*rough.material() : nullptr;
}

}  // namespace asperity
