// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/require.hpp"

namespace asperity {

namespace {

// A single bit pattern: digests depend on bits.
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

std::shared_ptr<const Field> raised_field(const std::shared_ptr<const Field>& before, double at_first,
                                          const Field& values) {
  Field result = before ? *before : Field(values.nx(), values.ny(), at_first);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = std::max(result[k], values[k]);
  return std::make_shared<const Field>(std::move(result));
}

// (1−ν²)/E, 1/Pa; none if the material lacks moduli.
std::optional<double> compliance(const Material* material) {
  if (material == nullptr) return {};
  if (!material->rigid && !(material->young && material->poisson)) return {};
  return 1.0 / plane_strain_modulus(*material);
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
    Field sum = pose_.to_lower(rough->heights(), lower_.grid());
    const Field& lower = lower_.heights();
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += lower[k];
    facing_ = pose_.on_lattice() && uncovered.empty() ? static_cast<std::int64_t>(sum.size())
                                                      : mark_missing(sum, uncovered);
    if (facing_ == 0)
      refuse("after this turn and shift, no node of one body faces the other", "turn or shift it less");
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

MetMemory met(const ContactGeometry& geometry, const NodeMemory& memory, double at_first) {
  MetMemory here{memory.lower, memory.upper_here};
  if (memory.upper_here || !memory.upper) return here;
  Field seen = geometry.pose().to_lower(*memory.upper, geometry.grid());
  // Nodes without a counterpart do not touch.
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

double contact_modulus(const ContactGeometry& geometry, const std::string& needs, const std::string& purpose,
                       const std::string& otherwise) {
  const std::string also = otherwise.empty() ? "" : ", or " + otherwise;
  const auto needed = [&](const Material* material, const std::string& body, bool is_flat) {
    const std::string wants = needs + " of the " + body + " body" + (purpose.empty() ? "" : " " + purpose) +
                              " (effect `elasticity`)";
    if (material == nullptr)
      refuse_state(wants + ", which has no material", "give `material=` to the surface" + also);
    if (const std::optional<double> known = compliance(material)) return *known;
    const std::string called = material->name.empty() ? std::string("its material") : quoted(material->name);
    refuse_state(wants + "; " + called + " has no " + quoted(material->young ? "poisson" : "young"),
                 "give it in lab.material{...}" + also + (is_flat ? ", or press with lab.rigid" : ""));
  };
  const double sum = needed(lower_material(geometry.lower()), "lower", false) +
                     needed(upper_material(geometry.upper()), "upper", geometry.upper_is_flat());
  if (!(sum > 0))
    refuse_state("both bodies are rigid, so there is no contact modulus E* (effect `elasticity`)",
                 "give one body an elastic material" + also);
  return 1.0 / sum;
}

std::optional<double> contact_compliance(const ContactGeometry& geometry) {
  const auto lower = compliance(lower_material(geometry.lower()));
  const auto upper = compliance(upper_material(geometry.upper()));
  return lower && upper ? std::optional(*lower + *upper) : std::nullopt;
}

double lower_elastic_share(const ContactGeometry& geometry) {
  const auto lower = compliance(lower_material(geometry.lower()));
  const auto upper = compliance(upper_material(geometry.upper()));
  if (upper && *upper == 0) return 1;
  if (lower && *lower == 0) return 0;
  if (lower && upper) return *lower / (*lower + *upper);
  return geometry.upper_is_flat() ? 1 : 0.5;
}

}  // namespace asperity
