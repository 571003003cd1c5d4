// SPDX-License-Identifier: GPL-3.0-or-later
// The operator |q|/2 of a grid, in cell units, without a Fourier transform of it: a five by five stencil
// of sum zero takes the short waves and a coarser grid the long ones, B a = S a + 2 W up(B(down(W a))),
// W being full weighting, down every second node and up its transpose; only the coarsest grid is
// transformed. Within 0.7 … 1.3 of |q|/2 for every wave, symmetric, and 0 for a constant on a periodic
// grid. Single precision. On a free boundary the field is 0 beyond the rim. On an odd periodic side the
// coarse grid is one fine cell longer than the side; waves across this seam are less accurate. A grid whose
// cells are far from square is transformed as it is: exact, but at a higher cost. On a layer 1/K in place of
// |q|/2, the mean left out: grids are halved as long as their stencil meets waves that know nothing of its
// base, and under a layer of less than one and a half cells the grid is transformed as it is.
#pragma once

#include <span>
#include <vector>

#include "engine/contact/boundary.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

class HalfOrderPyramid {
 public:
  // `weight`: the cost of one transform of this grid in transforms of the finest.
  HalfOrderPyramid(int nx, int ny, double aspect, Boundary boundary, double weight = 1,
                   const ComplianceMultiplier& multiplier = {});

  // The field to work on, nx·ny values row by row; kept by apply().
  std::span<float> input() { return levels_.front().in; }
  // B a of a = input(); valid until the next call. The same bits for any number of threads.
  std::span<const float> apply();
  // a·B a of the last call.
  double product() const { return product_; }

  // Share of one transform pair of this grid that a call spends on transforms: 1 where there is no
  // coarser grid. Counted where it is more than a thousandth.
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
  Array<float> zeros_;         // a row beyond the rim
  FourierFilter filter_;
  Array<double> multiplier_, work_;
};

}  // namespace asperity
