// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic half-space as an operator: u = K p, the surface displacement under a pressure, in cell
// units (hx = 1, hy = aspect, E* = 1). Periodic: the Fourier multiplier 2/|q|, and 0 for the mean, so
// that only displacement from the mean is given. Free: the sum of Love's coefficients over the loaded
// cells, by a transform padded with zeros; no wrap. Symmetric, positive (periodic: semi-definite).
// Rectangular, odd and prime grids of any aspect; no friction, one material.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/contact/boundary.hpp"

namespace asperity {

class HalfSpaceCompliance {
 public:
  // nx, ny >= 1; aspect > 0. An application counts 2·weight transforms: the cost of one transform of
  // this grid in transforms of the finest. Making one costs less than an application and counts none.
  HalfSpaceCompliance(int nx, int ny, double aspect, Boundary boundary, double weight = 1);
  ~HalfSpaceCompliance();
  HalfSpaceCompliance(HalfSpaceCompliance&&) noexcept;
  HalfSpaceCompliance& operator=(HalfSpaceCompliance&&) noexcept;

  // u = K p, both nx·ny values row by row; u may be p. The same bits for any number of threads, and a
  // pressure times a power of two gives u times the same, bit for bit. Not thread-safe: the work space
  // is its own.
  void apply(std::span<const double> p, std::span<double> u);

  // Periodic only: the pressure of mean 0 whose displacement is u, but for the mean of u: |q|/2. Costs
  // the same. Throws Error{internal} on a free boundary.
  void apply_inverse(std::span<const double> u, std::span<double> p);

  // n log2 n of the transform, padding included.
  double transform_work() const;

  // What an object of this grid holds. Periodic: a quarter of a grid where nx is a multiple of 8, else a
  // grid more. Free: three grids.
  static std::int64_t bytes(int nx, int ny, Boundary boundary);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace asperity
