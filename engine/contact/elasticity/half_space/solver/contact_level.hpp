// SPDX-License-Identifier: GPL-3.0-or-later
// The contact problem on one nested grid, in its cell units: hx = 1, hy = aspect, E* = 1, heights divided by
// the rms of the finest grid, pressures by E*·rms/hx. Also restriction (node values; linear between nodes)
// and bilinear prolongation. Sides below 2·least_side cells are not halved.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"
#include "engine/contact/scene/boundary.hpp"
#include "engine/contact/yield_law.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

struct LevelShape {
  int nx = 0, ny = 0;
  double aspect = 1;
  Boundary boundary = Boundary::periodic;
  double weight = 1;    // of a transform, relative to the finest grid
  bool single = false;  // for steps; gaps stay double
  ComplianceMultiplier multiplier{};

  std::size_t nodes() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
};

class ContactLevel : public AllNodes {
 public:
  // Heights: (raw_heights − height_origin) · height_factor.
  ContactLevel(const LevelShape& level_shape, std::span<const double> raw_heights, double height_origin,
               double height_factor, PressureLimit pressure_limit, double mean_pressure);

  const LevelShape shape;
  const PressureLimit limit;
  const double mean_pressure;
  HalfSpaceCompliance compliance;
  ContactPreconditioner preconditioner;
  // Pressure per gap of a short wave, at the contact edge.
  const double short_wave_stiffness;
  // Gap per pressure of the most compliant wave but the mean.
  const double greatest_compliance;
  static constexpr bool resolves_shifts = true;  // find_load_shift's by_excess
  // Receives each pass's residual; throws to stop.
  std::function<void(double)> report;
  int applications = 0;
  // Unit of gaps: rms of the finest grid, unless flat.
  double length = 1;

  void report_pass(double residual) const {
    if (report) report(residual);
  }
  // g = −h of n nodes from `first`.
  void unpressed_gap(std::size_t first, std::size_t n, double* g) const;
  void count_from(double height_origin) { origin_ = height_origin; }
  // A power of two near the mean pressure.
  double pressure_unit() const { return unit_; }
  double total_load() const { return mean_pressure * all_nodes(); }

  void apply(std::span<const double> p, std::span<double> u) {
    ++applications;
    compliance.apply(p, u);
  }
  // As HalfSpaceCompliance; pressures in pressure_unit().
  void apply(const HalfSpaceCompliance::Source& source, const HalfSpaceCompliance::Sink& sink, bool rounded) {
    ++applications;
    if (rounded)
      compliance.apply_rounded(source, sink, {});
    else
      compliance.apply(source, sink, {});
  }
  // Overwrites `work`, a value per node.
  void apply_in_double(const HalfSpaceCompliance::Source& source, const HalfSpaceCompliance::Sink& sink,
                       std::span<double> work) {
    ++applications;
    compliance.apply_in_double(source, sink, work);
  }
  bool mean_is_immobile() const {
    return shape.boundary == Boundary::periodic && !(shape.multiplier.uniform > 0);
  }
  // Can be so large that p loses precision.
  double immobile_pressure() const { return mean_is_immobile() ? mean_pressure : 0; }
  // g = K p − h, always double.
  void gap(std::span<const double> p, std::span<double> g) { gap_beside(immobile_pressure(), p, g); }
  // For p without immobile pressure. g may be p.
  void gap_beside_mean(std::span<const double> p, std::span<double> g) { gap_beside(0, p, g); }
  // K⁻¹ h without the mean, on a periodic tile.
  void inverse_of_heights(std::span<double> p) {
    for_nodes(nodes(), [&](std::size_t k) { p[k] = (heights_[k] - origin_) * factor_; });
    compliance.apply_inverse(p, p);
  }

 private:
  void gap_beside(double mean, std::span<const double> p, std::span<double> g);

  std::span<const double> heights_;
  double origin_, factor_, unit_;
};

// Least side of a coarser grid, in cells.
inline constexpr int least_side = 32;

// Pitches in finer cells; empty if no side can be halved.
struct CoarserGrid {
  LevelShape shape;  // weight not set
  double pitch_x = 2, pitch_y = 2;
};
std::optional<CoarserGrid> coarser(const LevelShape& fine);

// Linear interpolation at `position` (cells) among n nodes.
struct Between {
  int low, high;
  double share;  // weight of `high`
};
Between between(double position, int n, Boundary boundary);

Array<double> restrict_to(const LevelShape& fine, const CoarserGrid& coarse, std::span<const double> field);

void prolong(const CoarserGrid& coarse, std::span<const double> values, double factor, const LevelShape& fine,
             std::span<double> target);

}  // namespace asperity
