// SPDX-License-Identifier: GPL-3.0-or-later
// The contact problem on one of the nested grids, in its own cell units: hx = 1, hy = aspect, E* = 1,
// heights divided by the rms of the finest grid, pressures by E*·rms/hx. Holds the operator and
// its preconditioner on the free nodes; the descents read the heights from the caller's field, so that none
// are copied. And the way between nested grids, whose sides are not halved below 32 cells: down, heights at
// the nodes of a coarser grid, injected where its nodes are nodes of the finer one, interpolated linearly
// otherwise; up, a field interpolated bilinearly, round the rim on a periodic tile.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "engine/contact/boundary.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"
#include "engine/contact/yield_law.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// What a level is made of; all plain data.
struct LevelShape {
  int nx = 0, ny = 0;
  double aspect = 1;
  Boundary boundary = Boundary::periodic;
  double weight = 1;    // of one transform, in transforms of the finest grid
  bool single = false;  // what steps change is computed in single precision, gaps of pressures in double
  ComplianceMultiplier multiplier{};  // of a periodic tile

  std::size_t nodes() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
};

class ContactLevel {
 public:
  // heights: any unit, `height_origin` is taken off and the rest multiplied by `height_factor`.
  ContactLevel(const LevelShape& level_shape, std::span<const double> raw_heights, double height_origin,
               double height_factor, PressureLimit pressure_limit, double mean_pressure);

  const LevelShape shape;
  const PressureLimit limit;
  const double mean_pressure;
  HalfSpaceCompliance compliance;
  ContactPreconditioner preconditioner;
  // Pressure per gap of a short wave: orders nodes that leave or enter the contact.
  const double short_wave_stiffness;
  // Gap per pressure of the wave that gives way most, but for the mean: on a half-space the longest.
  const double greatest_compliance;
  // Told the residual after each pass; throws to stop the solve.
  std::function<void(double)> report;
  int applications = 0;  // of K so far
  // What gaps are measured by: the rms of the finest grid, unless its heights are flat.
  double length = 1;

  std::size_t nodes() const { return shape.nodes(); }
  double height(std::size_t k) const { return (heights_[k] - origin_) * factor_; }
  // g = −h of n nodes from `first`, the gap where nothing presses.
  void unpressed_gap(std::size_t first, std::size_t n, double* g) const;
  // Heights, and with them gaps, are counted from `height_origin` from now on.
  void count_from(double height_origin) { origin_ = height_origin; }
  // A power of two, about the mean pressure.
  double pressure_unit() const { return unit_; }
  double total_load() const { return mean_pressure * static_cast<double>(nodes()); }

  void apply(std::span<const double> p, std::span<double> u) {
    ++applications;
    compliance.apply(p, u);
  }
  // Row by row, as HalfSpaceCompliance::apply or apply_rounded, of pressures in pressure_unit().
  void apply(const HalfSpaceCompliance::Source& source, const HalfSpaceCompliance::Sink& sink, bool rounded) {
    ++applications;
    if (rounded)
      compliance.apply_rounded(source, sink, {});
    else
      compliance.apply(source, sink, {});
  }
  // In double precision always; `work`, of as many values as there are nodes, is overwritten.
  void apply_in_double(const HalfSpaceCompliance::Source& source, const HalfSpaceCompliance::Sink& sink,
                       std::span<double> work) {
    ++applications;
    compliance.apply_in_double(source, sink, work);
  }
  // Whether the mean pressure moves nothing: on a periodic tile, unless it compresses a layer.
  bool mean_is_immobile() const {
    return shape.boundary == Boundary::periodic && !(shape.multiplier.uniform > 0);
  }
  // It may be so large then that beside it p has lost digits.
  double immobile_pressure() const { return mean_is_immobile() ? mean_pressure : 0; }
  // g = K p − h, in double precision always: …
  void gap(std::span<const double> p, std::span<double> g);
  // … the same of a p from which it has been taken already. g may be p.
  void gap_beside_mean(std::span<const double> p, std::span<double> g);

 private:
  void gap_beside(std::span<const double> p, double mean, std::span<double> g);

  std::span<const double> heights_;
  double origin_, factor_, unit_;
};

// The next coarser grid with its pitches in cells of the finer one; none where no side can be halved.
struct CoarserGrid {
  LevelShape shape;  // weight not set
  double pitch_x = 2, pitch_y = 2;
};
std::optional<CoarserGrid> coarser(const LevelShape& fine);

// Where a node of one grid, at `position` in cells of the other, stands between two of its n nodes along a
// side.
struct Between {
  int low, high;
  double share;  // of `high`
};
Between between(double position, int n, Boundary boundary);

Array<double> restrict_to(const LevelShape& fine, const CoarserGrid& coarse, std::span<const double> field);

// values on `coarse` -> `target` on `fine`, times `factor`.
void prolong(const CoarserGrid& coarse, std::span<const double> values, double factor, const LevelShape& fine,
             std::span<double> target);

}  // namespace asperity
