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
#include <optional>
#include <span>
#include <vector>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/free_tiles.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/contact/scene/boundary.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

class ContactPreconditioner {
 public:
  // nx, ny >= 1; aspect > 0; sweeps >= 0. `weight`: of a transform, relative to the finest grid. Memory: two
  // grids, four on a periodic tile with a large prime factor.
  ContactPreconditioner(int nx, int ny, double aspect, Boundary boundary, double weight = 1, int sweeps = 4,
                        const ComplianceMultiplier& multiplier = {});

  // Free: free[k] != 0; initially none. O(n).
  void set_free(std::span<const std::uint8_t> free);

  // z = M r; reads r on the free set, z = 0 elsewhere; z may be r. Powers of two scale exactly. Same bits for
  // any number of threads. Not thread-safe.
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
  // apply() in halves: spread() takes `step` and returns r·z.
  double spread(const Residual& r, const Step& step);
  // gather() returns z without a smooth field: `keep` receives parts of rows with their tile (0 … tiles()),
  // to be multiplied by `factor`, 0 off the free set, null without free nodes. Parts of a tile arrive in
  // order on one thread.
  using Keep = std::function<void(std::size_t tile, std::size_t first, std::size_t n, const float* values,
                                  double factor)>;
  void gather(const Keep& keep);
  // `factor` times row j, for the free set.
  SmoothRow<double> smooth(int j, double factor) const { return rest_.row(j, 0, factor * grow_); }
  // Over the free set.
  double smooth_sum() const { return grow_ * rest_sum_; }
  std::size_t tiles() const { return tiles_.count(); }

 private:
  struct Patch {
    Array<float> given, now;
    float sums[2 * FreeTiles::width];
    explicit Patch(std::size_t places) : given(places), now(places) {}
  };
  struct Hats {
    SmoothExtension::Sums free, passed;
  };

  std::size_t node(int i, int j) const { return tiles_.node(i, j); }
  ScratchPool<Patch>::Loan borrow() {
    return patches_.borrow([this] { return std::make_unique<Patch>(tiles_.patch_places()); });
  }
  template <class Put>
  void load(Patch& patch, const FreeTile& tile, const Put& put) const;
  void extend(const FreeTile& tile, const Residual& scaled);
  void gather_back(std::size_t number, Patch& patch, std::span<const float> y, const Keep& keep);
  double spread_along_lines(const Residual& scaled, const Step& step);
  void gather_along_lines(const Keep& keep);
  void add_smooth(std::span<double> z) const;
  void no_smooth_field();
  double greatest(const Residual& r, const Step& step) const;
  template <class Add>
  void add_up_hats(const Add& add, Array<double>& total);
  void divide(Array<double>& sums) const;

  int nx_, ny_;
  float share_;  // weight of a neighbour
  HalfOrderPyramid pyramid_;
  SmoothExtension smooth_;
  Array<double> free_hats_, sums_;       // over the free set, of distributed values
  SmoothExtension::Field<float> level_;  // of the residual
  SmoothExtension::Field<double> rest_;  // of the result
  double rest_sum_ = 0;                  // of rest_ over the free set
  std::span<const float> spread_;        // B Ext r/grow_; empty if r = 0
  double grow_ = 1;                      // a power of two
  FreeTiles tiles_;
  bool tiled_;                          // sweeps and smooth fields
  std::optional<LineExtension> lines_;  // on long cells
  UnsetArray<float> gathered_;
  std::vector<Hats> hats_;
  ScratchPool<Patch> patches_;
};

}  // namespace asperity
