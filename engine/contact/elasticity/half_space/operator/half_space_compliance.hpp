// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic half-space as a symmetric operator u = K p in cell units (hx = 1, hy = aspect, E* = 1).
// Periodic: multiplier 2/|q|, 0 for the mean, or that of a layer. Free: convolution with Love's
// coefficients, zero-padded. Periodic sides that are odd along x or have a prime factor above 31 are padded
// too, at twice the cost. No friction, one material.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "engine/contact/scene/boundary.hpp"

namespace asperity {

// K(q) = share · 2/(E*|q|), relative to a half-space.
struct WaveShare {
  // In [0, 1] at x = |q| length: 0 at 0, 1 at infinity. K(q) falls beyond x = 4.
  std::function<double(double x)> share;
  double length = 0;                 // m
  double uniform = 0;                // K(0) E*/length
  std::vector<double> parameters{};  // for digests
};

struct ComplianceMultiplier {
  std::function<double(double x)> share_of{};               // empty: a half-space
  double length = std::numeric_limits<double>::infinity();  // cells along x
  double uniform = 0;                                       // K(0)

  bool shares() const { return share_of != nullptr; }
  // K(q)·q/2; 1 on a half-space. q > 0.
  double share(double q) const { return shares() ? share_of(q * length) : 1; }
  // Over waves from q on.
  double greatest_from(double q) const;
  ComplianceMultiplier on_coarser(double pitch) const;
};

// `hx` in m; `with_mean` includes K(0).
ComplianceMultiplier in_cells(const WaveShare& share, double hx, bool with_mean);

class HalfSpaceCompliance {
 public:
  // nx, ny >= 1; aspect > 0. An application counts 2·weight transforms. `single`: single-precision transforms
  // and multiplier. `multiplier`: periodic only. Memory: 1.25 grids periodic, three free or padded; half in
  // single precision.
  HalfSpaceCompliance(int nx, int ny, double aspect, Boundary boundary, double weight = 1,
                      bool single = false, const ComplianceMultiplier& multiplier = {});
  ~HalfSpaceCompliance();
  HalfSpaceCompliance(HalfSpaceCompliance&&) noexcept;
  HalfSpaceCompliance& operator=(HalfSpaceCompliance&&) noexcept;

  // u = K p, nx·ny values row by row; u may be p. Same bits for any number of threads; powers of two scale
  // exactly. Not thread-safe.
  void apply(std::span<const double> p, std::span<double> u);

  // Single precision: exact to about 1e-6 of the greatest u. `unit`: magnitude of the pressures, within
  // twenty powers of ten; initially 1.
  bool single() const;
  void count_pressures_in(double unit);

  // `source` returns rows of p, `sink` receives rows of u, also stored in `u` unless empty.
  using Source = std::function<const double*(int j, double* scratch)>;
  using Sink = std::function<void(int j, const double* row)>;
  void apply(const Source& source, const Sink& sink, std::span<double> u);
  // Double precision, any p.
  void apply_in_double(const Source& source, const Sink& sink, std::span<double> u);
  // Single precision; p must be near 1.
  void apply_rounded(const Source& source, const Sink& sink, std::span<double> u);

  // p = K⁻¹ u (|q|/2), the mean only if K(0) > 0. `softer` >= 0 is added to K at every wave. Same cost. On
  // the operator's own period: on a free tile Σ u p >= Σ u K⁻¹ u.
  void apply_inverse(std::span<const double> u, std::span<double> p, double softer = 0);

  // Over all waves except an immobile mean. O(n).
  struct Spectrum {
    double least = 0, greatest = 0;     // `least` > 0 in all tests
    double node = 0, inverse_node = 0;  // K_kk, mean of the inverse multiplier
  };
  Spectrum spectrum() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Displacement under a uniformly loaded rectangle 1 × aspect (Love 1929), u(x, y) = 1/(π E*) ∬ dξ dη /
// √((x−ξ)² + (y−η)²), E* = 1. Off the rectangle Love's four logarithms cancel: one closed integral and
// Gauss's rule, or moments. Relative error below 1e-13.
class LoveKernel {
 public:
  explicit LoveKernel(double aspect);  // > 0
  // At (i, j·aspect) from the centre. Even in both. Thread-safe.
  double operator()(double i, double j) const;

 private:
  double far(double x, double y) const;

  double aspect_;
  double far_;  // squared distance
};

}  // namespace asperity
