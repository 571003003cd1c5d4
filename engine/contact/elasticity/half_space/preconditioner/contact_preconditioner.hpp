// SPDX-License-Identifier: GPL-3.0-or-later
// Approximate inverse of the compliance on the free nodes, in cell units: z = Extᵀ (|q|/2) Ext r. |q|/2
// makes jumps expensive, so Ext extends r beyond the edge of the free set: the smooth part by
// SmoothExtension, the rest by sweeps. A sweep sets nodes of one chessboard colour, off the set, to the mean
// of their four neighbours (two on a line of nodes; no wrap on odd periodic sides). Long cells:
// LineExtension. Layers: 1/K instead of |q|/2, on thin layers without extension. Symmetric, positive
// semi-definite on the free set; single precision; the mean is not projected out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/contact/scene/boundary.hpp"

namespace asperity {

class ContactPreconditioner {
 public:
  // nx, ny >= 1; aspect > 0; sweeps >= 0. `weight`: of a transform, in transforms of the finest grid.
  // Memory: two grids, four on a periodic tile whose side has a large prime factor.
  ContactPreconditioner(int nx, int ny, double aspect, Boundary boundary, double weight = 1, int sweeps = 4,
                        const ComplianceMultiplier& multiplier = {});
  ~ContactPreconditioner();
  ContactPreconditioner(ContactPreconditioner&&) noexcept;
  ContactPreconditioner& operator=(ContactPreconditioner&&) noexcept;

  // Free: free[k] != 0; initially none. O(n).
  void set_free(std::span<const std::uint8_t> free);

  // z = M r; reads r on the free set, z = 0 elsewhere; z may be r. Scaling r by a power of two scales z
  // exactly. Same bits for any number of threads. Not thread-safe.
  void apply(std::span<const double> r, std::span<double> z);

  // r = offset + factor · values (nx·ny).
  struct Residual {
    const double* values;
    double factor = 1, offset = 0;
  };
  // In the same pass: values += length · more.
  struct Step {
    double* values = nullptr;
    double length = 0;
    const double* more = nullptr;
  };
  // apply() in two halves: spread() takes `step` and returns r·z.
  double spread(const Residual& r, const Step& step);
  // gather() returns z without a smooth field: `keep` receives parts of rows with their tile (0 … tiles()),
  // values to be multiplied by `factor`, 0 off the free set, null without free nodes. Parts of a tile arrive
  // in order on one thread.
  using Keep = std::function<void(std::size_t tile, std::size_t first, std::size_t n, const float* values,
                                  double factor)>;
  void gather(const Keep& keep);
  // `factor` times row j, to be added on the free set.
  SmoothRow<double> smooth(int j, double factor) const;
  // Over the free set.
  double smooth_sum() const;
  std::size_t tiles() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace asperity
