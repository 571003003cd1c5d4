// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic half-space as a symmetric operator u = K p in cell units (hx = 1, hy = aspect, E* = 1).
// Periodic: Fourier multiplier 2/|q|, 0 for the mean, or that of a layer (semi-definite). Free: convolution
// with Love's coefficients, padded with zeros. Periodic sides that are odd along x or have a prime factor
// above 31 are padded with the tile's own kernel: twice the cost instead of six times. Any grid and aspect;
// no friction, one material.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "engine/contact/boundary.hpp"

namespace asperity {

// Compliance of one wave relative to a half-space: K(q) = share · 2/(E*|q|).
struct WaveShare {
  // In [0, 1] at x = |q| length; 0 at 0, 1 at infinity. K(q) falls beyond x = 4.
  std::function<double(double x)> share;
  double length = 0;                 // m
  double uniform = 0;                // K(0) E*/length; 0: the mean pressure moves nothing
  std::vector<double> parameters{};  // identify the share in digests
};

struct ComplianceMultiplier {
  std::function<double(double x)> share_of{};               // empty: a half-space
  double length = std::numeric_limits<double>::infinity();  // of a WaveShare, in cells along x
  double uniform = 0;                                       // K(0)

  bool shares() const { return share_of != nullptr; }
  // K(q)·q/2; 1 on a half-space. q > 0.
  double share(double q) const { return shares() ? share_of(q * length) : 1; }
  // Greatest K of waves from q on.
  double greatest_from(double q) const;
  // On cells `pitch` times as wide.
  ComplianceMultiplier on_coarser(double pitch) const;
};

// On cells `hx` m wide; `with_mean` includes K(0).
ComplianceMultiplier in_cells(const WaveShare& share, double hx, bool with_mean);

class HalfSpaceCompliance {
 public:
  // nx, ny >= 1; aspect > 0. An application counts 2·weight transforms; construction counts none. `single`:
  // transforms and multiplier in single precision, fields in double. `multiplier`: periodic tile only.
  // Memory: 1.25 grids on a periodic tile, three on a free or padded one; about half in single precision.
  HalfSpaceCompliance(int nx, int ny, double aspect, Boundary boundary, double weight = 1,
                      bool single = false, const ComplianceMultiplier& multiplier = {});
  ~HalfSpaceCompliance();
  HalfSpaceCompliance(HalfSpaceCompliance&&) noexcept;
  HalfSpaceCompliance& operator=(HalfSpaceCompliance&&) noexcept;

  // u = K p, nx·ny values row by row; u may be p. Same bits for any number of threads; scaling p by a power
  // of two scales u exactly. Not thread-safe.
  void apply(std::span<const double> p, std::span<double> u);

  // Single precision: u is K p to about 1e-6 of the greatest u. `unit`: magnitude of the pressures to within
  // twenty powers of ten; initially 1.
  bool single() const;
  void count_pressures_in(double unit);

  // Row by row: `source` returns rows of p, `sink` receives rows of u, also stored in `u` unless empty. In
  // single precision rows of p must be near 1.
  using Source = std::function<const double*(int j, double* scratch)>;
  using Sink = std::function<void(int j, const double* row)>;
  void apply(const Source& source, const Sink& sink, std::span<double> u);
  // Always in double precision, for any p.
  void apply_in_double(const Source& source, const Sink& sink, std::span<double> u);
  // Always in single precision; rows of p must be near 1.
  void apply_rounded(const Source& source, const Sink& sink, std::span<double> u);

  // Periodic only: K⁻¹ u without the mean (with it if K(0) > 0): |q|/2. `softer` >= 0 is added to K at every
  // wave, like a layer of springs. Same cost. Throws Error{internal} on a free boundary.
  void apply_inverse(std::span<const double> u, std::span<double> p, double softer = 0);

  // K⁻¹ on the operator's own period. Free boundary: of the padded operator, which gives Σ u p >= Σ u K⁻¹ u.
  // Same cost.
  void apply_period_inverse(std::span<const double> u, std::span<double> p, double softer = 0);

  // Of the multiplier over all waves, without the mean if it moves nothing. O(n).
  struct Spectrum {
    double least = 0, greatest = 0;     // `least` > 0 in all tests
    double node = 0, inverse_node = 0;  // K_kk, mean of the inverse multiplier
  };
  Spectrum spectrum() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Displacement of an elastic half-space under a uniformly loaded rectangle (Love 1929), u(x, y) = 1/(π E*) ∬
// dξ dη / √((x−ξ)² + (y−η)²), E* = 1, rectangle 1 × aspect. Love's four logarithms cancel away from the
// rectangle and are used on it only; elsewhere one integral is closed, the other Gauss's rule; far away
// moments suffice. Relative error below 1e-13.
class LoveKernel {
 public:
  // 1 wide along x, `aspect` > 0 along y.
  explicit LoveKernel(double aspect);
  // Displacement per unit pressure at (i, j·aspect) from the centre. Even in i and j. Thread-safe.
  double operator()(double i, double j) const;

 private:
  double far(double x, double y) const;

  double aspect_;
  double far_;  // squared distance from which moments are used
};

}  // namespace asperity
