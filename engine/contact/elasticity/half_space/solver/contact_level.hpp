// SPDX-License-Identifier: GPL-3.0-or-later
// The contact problem on one of the nested grids, in its cell units: hx = 1, hy = aspect, E* = 1, heights
// divided by the rms of the finest grid, pressures by E*·rms/hx. Contains K and the preconditioner; heights
// are read from the caller's field. Also restriction (node values; linear interpolation between nodes) and
// bilinear prolongation between grids. Sides below 64 cells are not halved.
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

struct LevelShape {
  int nx = 0, ny = 0;
  double aspect = 1;
  Boundary boundary = Boundary::periodic;
  double weight = 1;                  // of a transform, in transforms of the finest grid
  bool single = false;                // single precision for steps; gaps stay double
  ComplianceMultiplier multiplier{};  // periodic tile only

  std::size_t nodes() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
};

class ContactLevel {
 public:
  // heights: any unit, shifted by `height_origin` and multiplied by `height_factor`.
  ContactLevel(const LevelShape& level_shape, std::span<const double> raw_heights, double height_origin,
               double height_factor, PressureLimit pressure_limit, double mean_pressure);

  const LevelShape shape;
  const PressureLimit limit;
  const double mean_pressure;
  HalfSpaceCompliance compliance;
  ContactPreconditioner preconditioner;
  // Pressure per gap of a short wave: orders nodes at the edge of contact.
  const double short_wave_stiffness;
  // Gap per pressure of the most compliant wave except the mean; on a half-space the longest.
  const double greatest_compliance;
  // Called with the residual after each pass; throws to stop the solve.
  std::function<void(double)> report;
  int applications = 0;  // of K
  // Unit of gaps: the rms of the finest grid, unless its heights are flat.
  double length = 1;

  std::size_t nodes() const { return shape.nodes(); }
  double height(std::size_t k) const { return (heights_[k] - origin_) * factor_; }
  // g = −h of n nodes from `first`.
  void unpressed_gap(std::size_t first, std::size_t n, double* g) const;
  // Changes the origin of heights and gaps.
  void count_from(double height_origin) { origin_ = height_origin; }
  // A power of two near the mean pressure.
  double pressure_unit() const { return unit_; }
  double total_load() const { return mean_pressure * static_cast<double>(nodes()); }

  void apply(std::span<const double> p, std::span<double> u) {
    ++applications;
    compliance.apply(p, u);
  }
  // Row by row, see HalfSpaceCompliance; pressures in pressure_unit().
  void apply(const HalfSpaceCompliance::Source& source, const HalfSpaceCompliance::Sink& sink, bool rounded) {
    ++applications;
    if (rounded)
      compliance.apply_rounded(source, sink, {});
    else
      compliance.apply(source, sink, {});
  }
  // Always in double precision; overwrites `work`, one value per node.
  void apply_in_double(const HalfSpaceCompliance::Source& source, const HalfSpaceCompliance::Sink& sink,
                       std::span<double> work) {
    ++applications;
    compliance.apply_in_double(source, sink, work);
  }
  // Whether a uniform pressure moves nothing: on a periodic tile without a compressible layer.
  bool mean_is_immobile() const {
    return shape.boundary == Boundary::periodic && !(shape.multiplier.uniform > 0);
  }
  // The mean pressure if immobile: it can be large enough that p loses precision.
  double immobile_pressure() const { return mean_is_immobile() ? mean_pressure : 0; }
  // g = K p − h, always in double precision.
  void gap(std::span<const double> p, std::span<double> g);
  // The same for p without the immobile pressure. g may be p.
  void gap_beside_mean(std::span<const double> p, std::span<double> g);

 private:
  void gap_beside(std::span<const double> p, double mean, std::span<double> g);

  std::span<const double> heights_;
  double origin_, factor_, unit_;
};

// The next coarser grid, pitches in cells of the finer one; empty if no side can be halved.
struct CoarserGrid {
  LevelShape shape;  // weight not set
  double pitch_x = 2, pitch_y = 2;
};
std::optional<CoarserGrid> coarser(const LevelShape& fine);

// Neighbours along a side of n nodes, and interpolation weight, of `position` in cells.
struct Between {
  int low, high;
  double share;  // weight of `high`
};
Between between(double position, int n, Boundary boundary);

Array<double> restrict_to(const LevelShape& fine, const CoarserGrid& coarse, std::span<const double> field);

// Interpolates from `coarse` to `fine`, times `factor`.
void prolong(const CoarserGrid& coarse, std::span<const double> values, double factor, const LevelShape& fine,
             std::span<double> target);

}  // namespace asperity
