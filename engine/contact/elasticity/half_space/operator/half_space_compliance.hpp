// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic half-space as an operator: u = K p, the surface displacement under a pressure, in cell
// units (hx = 1, hy = aspect, E* = 1). Periodic: the Fourier multiplier 2/|q|, and 0 for the mean, so
// that only displacement from the mean is given; or that of a layer on a rigid base, ComplianceMultiplier.
// Free: the sum of Love's coefficients over the loaded cells, by a transform padded with zeros; no wrap. A
// periodic side that is odd along x or has a prime factor above 31 is padded too, with the kernel of the
// tile. This doubles the cost; a transform of the side itself would cost six times as much. Symmetric,
// positive (periodic: semi-definite). Rectangular, odd and prime grids of any aspect; no friction, one
// material. Also both kernels by themselves, the multiplier of a wave and Love's coefficient of a cell.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "engine/contact/boundary.hpp"

namespace asperity {

// What a periodic tile makes of one wave of pressure: K(q) = 2/(E*|q|) of a half-space, and a share of that
// of what lies in its place, told by the model of elasticity that knows it (WaveShare). Operators and
// preconditioners ask once for each wave of a grid, in cell units (hx = 1, E* = 1), and keep what they need.
struct WaveShare {
  // In [0, 1] at x = |q| length, 0 at 0; goes to 1 as x grows, and past x = 4 K(q) falls.
  std::function<double(double x)> share;
  double length = 0;                 // m
  double uniform = 0;                // K(0) E*/length; 0: a mean pressure moves nothing
  std::vector<double> parameters{};  // by which it differs from others, for digests
};

struct ComplianceMultiplier {
  std::function<double(double x)> share_of{};               // none: a half-space
  double length = std::numeric_limits<double>::infinity();  // of a WaveShare, in cells along x
  double uniform = 0;                                       // K(0); 0: a mean pressure moves nothing

  bool shares() const { return share_of != nullptr; }
  // K(q)·q/2, 1 of a half-space. q > 0.
  double share(double q) const { return shares() ? share_of(q * length) : 1; }
  // The greatest K of waves from q on: that of q, but where short waves meet what is softer to them.
  double greatest_from(double q) const;
  // On a grid whose cells are `pitch` times as wide.
  ComplianceMultiplier on_coarser(double pitch) const;
};

// On cells `hx` m wide. `with_mean`: with its K(0).
ComplianceMultiplier in_cells(const WaveShare& share, double hx, bool with_mean);

class HalfSpaceCompliance {
 public:
  // nx, ny >= 1; aspect > 0. An application counts 2·weight transforms: the cost of one transform of
  // this grid in transforms of the finest. Making one costs less than an application and counts none.
  // `single`: transforms and multiplier in single precision; fields stay double. `multiplier`: of a periodic
  // tile; half-spaces unless one is given. An object holds a grid and a quarter on a periodic tile, three
  // grids on a free or padded one; in single precision about half of that.
  HalfSpaceCompliance(int nx, int ny, double aspect, Boundary boundary, double weight = 1,
                      bool single = false, const ComplianceMultiplier& multiplier = {});
  ~HalfSpaceCompliance();
  HalfSpaceCompliance(HalfSpaceCompliance&&) noexcept;
  HalfSpaceCompliance& operator=(HalfSpaceCompliance&&) noexcept;

  // u = K p, both nx·ny values row by row; u may be p. The same bits for any number of threads, and a
  // pressure times a power of two gives u times the same, bit for bit. Not thread-safe: the work space
  // is its own.
  void apply(std::span<const double> p, std::span<double> u);

  // Whether transforms are in single precision. u is then K p to some 1e-6 of the greatest u. `unit` is about
  // the size of the pressures, to within twenty powers of ten; 1 at first.
  bool single() const;
  void count_pressures_in(double unit);

  // The same row by row, as FourierLaneFilter::apply: `source` gives rows of p, `sink` takes rows of u,
  // which are kept in `u` unless it is empty. In single precision rows of p must be near 1.
  using Source = std::function<const double*(int j, double* scratch)>;
  using Sink = std::function<void(int j, const double* row)>;
  void apply(const Source& source, const Sink& sink, std::span<double> u);
  // In double precision all the same, of any p.
  void apply_in_double(const Source& source, const Sink& sink, std::span<double> u);
  // In single precision all the same; rows of p must be near 1.
  void apply_rounded(const Source& source, const Sink& sink, std::span<double> u);

  // Periodic only: the pressure of mean 0 whose displacement is u, but for the mean of u: |q|/2. Where the
  // mean moves the tile, with that. Costs the same. Throws Error{internal} on a free boundary. `softer` >= 0
  // is added to K at every wave, as by a row of springs.
  void apply_inverse(std::span<const double> u, std::span<double> p, double softer = 0);

  // The inverse of the operator on its own period: as apply_inverse where the tile is periodic; on a free
  // boundary that of the padded one, p of it giving Σ u p no less than Σ u K⁻¹ u. Costs the same.
  void apply_period_inverse(std::span<const double> u, std::span<double> p, double softer = 0);

  // What the multiplier says of every node alike; of a periodic tile whose mean moves nothing, without
  // it. O(n).
  struct Spectrum {
    double least = 0, greatest = 0;     // of the multiplier; `least` > 0 wherever it was ever looked at
    double node = 0, inverse_node = 0;  // its mean over all waves, K_kk, and the mean of its inverse
  };
  Spectrum spectrum() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The displacement of an elastic half-space under a uniformly loaded rectangle (Love 1929):
// u(x, y) = 1/(π E*) ∬ dξ dη / √((x−ξ)² + (y−η)²), here with E* = 1 and a rectangle of 1 × aspect.
// The textbook form is a difference of four logarithms that cancels away from the rectangle, so it is
// used on the rectangle only; elsewhere one integral is done in closed form without cancellation and
// the other by Gauss's rule, and far away moments of the rectangle are enough. The relative error is
// below 1e-13 at any distance. No anisotropy, no shear.
class LoveKernel {
 public:
  // The rectangle is 1 wide along x and `aspect` > 0 along y.
  explicit LoveKernel(double aspect);
  // Displacement under a unit pressure at (i, j·aspect) from the centre of the rectangle: between
  // nodes i and j are integers. Even in both. Thread-safe.
  double operator()(double i, double j) const;

 private:
  double far(double x, double y) const;

  double aspect_;
  double far_;  // square of the distance beyond which moments are used
};

}  // namespace asperity
