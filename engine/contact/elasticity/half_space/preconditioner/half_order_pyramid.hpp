// SPDX-License-Identifier: GPL-3.0-or-later
// |q|/2 in cell units without a Fourier transform of the grid: a 5 × 5 stencil of sum zero for short waves,
// a coarser grid for long ones, B a = S a + 2 W up(B(down(W a))), W full weighting, down every second node,
// up its transpose. Only the coarsest grid is transformed. Within 0.7 … 1.3 of |q|/2 for every wave;
// symmetric; 0 for a periodic constant; single precision. A free field is 0 beyond the rim. Odd periodic
// sides are less accurate across the seam. Cells far from square: one exact, more expensive transform.
// Layers: 1/K without the mean, grids halved down to 1.5 cells of thickness.
#pragma once

#include <span>
#include <vector>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/scene/boundary.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

class HalfOrderPyramid {
 public:
  // `weight` as in ContactPreconditioner.
  HalfOrderPyramid(int nx, int ny, double aspect, Boundary boundary, double weight = 1,
                   const ComplianceMultiplier& multiplier = {});

  // nx·ny values row by row; apply() preserves it.
  std::span<float> input() { return levels_.front().in; }
  // Valid until the next call; same bits for any number of threads.
  std::span<const float> apply();
  // a·B a of the last call.
  double product() const { return product_; }

  // Relative to a transform pair on this grid. Counted above a thousandth.
  double transform_share() const { return transform_share_; }

  static std::int64_t bytes(int nx, int ny, double aspect, Boundary boundary,
                            const ComplianceMultiplier& multiplier = {});

 private:
  struct Level {
    int nx, ny;
    UnsetArray<float> in, out;
    float* row_in(int j) { return in.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(nx); }
    float* row_out(int j) { return out.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(nx); }
  };
  static std::vector<Level> shape(int nx, int ny, double aspect, Boundary boundary,
                                  const ComplianceMultiplier& multiplier);
  const float* row(const UnsetArray<float>& field, const Level& level, int j) const;
  void restrict_to(const Level& fine, Level& coarse) const;
  void add_up(Level& fine, const Level& coarse);
  void transform_coarsest();

  bool wraps_;
  double weight_, transform_share_, product_ = 0;
  std::vector<Level> levels_;  // finest first
  Array<float> zeros_;         // beyond the rim
  FourierFilter filter_;
  Array<double> multiplier_, work_;
};

}  // namespace asperity
