// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Row blocks: small grids stay on one thread.
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

Field combine_turned(const Field& lower, const Field& upper, const Pose& pose, const Grid& grid) {
  Field sum = pose.to_lower(upper, grid);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += lower[k];
  return sum;
}

// A single bit pattern for missing heights: digests depend on bits.
std::int64_t mark_missing(Field& heights, std::span<const std::uint8_t> uncovered) {
  std::int64_t facing = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (std::isnan(heights[k]) || (!uncovered.empty() && uncovered[k] != 0))
      heights[k] = std::numeric_limits<double>::quiet_NaN();
    else
      ++facing;
  }
  return facing;
}

}  // namespace

ContactGeometry::ContactGeometry(const Scene& scene, const Pose& pose, BodyMemory memory,
                                 std::span<const std::uint8_t> uncovered)
    : lower_(scene.lower),
      upper_(scene.upper),
      boundary_(scene.boundary),
      pose_(pose),
      memory_(std::move(memory)) {
  for (auto& kept : memory_) kept.second.upper_here.reset();
  if (const auto* rough = std::get_if<Surface>(&upper_)) {
    Field sum = pose_.on_lattice() ? combine(lower_.heights(), rough->heights(), pose_.lattice())
                                   : combine_turned(lower_.heights(), rough->heights(), pose_, lower_.grid());
    facing_ = pose_.on_lattice() && uncovered.empty() ? static_cast<std::int64_t>(sum.size())
                                                      : mark_missing(sum, uncovered);
    if (facing_ == 0)
      refuse("turned and shifted like this, no node of one body lies over the other",
             "turn or shift it less");
    combined_ = std::make_shared<const Field>(std::move(sum));
    range_ = overhangs() ? known_range(combined_->values()) : range(combined_->values());
  } else {
    facing_ = static_cast<std::int64_t>(lower_.grid().nodes());
    range_ = lower_.height_range();
  }
  const double squares = range_.span() * range_.span() * static_cast<double>(facing_);
  if (!std::isfinite(range_.min) || !std::isfinite(range_.max) || !std::isfinite(squares))
    refuse("the combined heights run from " + format_short(range_.min) + " m to " + format_short(range_.max) +
               " m",
           "heights this large leave the range of a double; check the unit of the surfaces");
}

ContactGeometry::ContactGeometry(const Scene& scene, const ContactGeometry& before, BodyMemory memory,
                                 const std::optional<Field>& yielded)
    : ContactGeometry(before) {
  if (!yielded) {
    memory_ = std::move(memory);
    return;
  }
  if (pose_.on_lattice() || upper_is_flat()) {
    *this = ContactGeometry(scene, pose_, std::move(memory));
    first_touch_ = before.first_touch();
    return;
  }
  first_touch_ = before.first_touch();
  lower_ = scene.lower;
  upper_ = scene.upper;
  memory_ = std::move(memory);
  Field combined = before.combined();
  for (std::size_t k = 0; k < combined.size(); ++k) combined[k] -= (*yielded)[k];
  range_ = known_range(combined.values());
  combined_ = std::make_shared<const Field>(std::move(combined));
}

const NodeMemory& ContactGeometry::kept(std::string_view name) const {
  static const NodeMemory none;
  const auto known = memory_.find(name);
  return known == memory_.end() ? none : known->second;
}

Array<double> ContactGeometry::facing_heights() const {
  Array<double> heights;
  heights.reserve(static_cast<std::size_t>(facing_));
  std::copy_if(combined().values().begin(), combined().values().end(), std::back_inserter(heights),
               [](double h) { return !std::isnan(h); });
  return heights;
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
