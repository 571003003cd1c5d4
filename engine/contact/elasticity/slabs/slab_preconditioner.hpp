// SPDX-License-Identifier: GPL-3.0-or-later
// Approximate inverse of the compliance on the free nodes of a contact in slabs: z = Extᵀ (|q|/2) Ext r, as
// half_space/contact_preconditioner.hpp, with exact |q|/2. Ext extends r past the edge of the set by eight
// Jacobi sweeps (mean of four neighbours), row by row: the field passes through the cache once.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

class SlabPreconditioner {
 public:
  explicit SlabPreconditioner(SlabLevel& level);

  void set_free(std::span<const std::uint8_t> free);

  // z = M r on the free nodes; values()[k] is undefined elsewhere.
  template <class Read>
  void apply(Read read) {
    level_.each(
        [this, read, to = own()](std::size_t k) { to[k] = mask_[offset() + k] != 0 ? read(k) : 0.0; });
    exchange_rim();
    level_.team.work([&] { sweep(false); });
    level_.apply_inverse([from = own()](std::size_t k) { return from[k]; },
                         [to = own()](std::size_t k, double z) { to[k] = z; });
    exchange_rim();
    level_.team.work([&] { sweep(true); });
  }
  const double* values() const { return field_.data() + offset(); }

 private:
  static constexpr int sweeps = 8;
  std::size_t offset() const { return static_cast<std::size_t>(sweeps) * level_.shape.slab.width(); }
  double* own() { return field_.data() + offset(); }
  void exchange_rim();
  void sweep(bool adjoint);

  SlabLevel& level_;
  RowExchange rim_;
  // Rows of this process, with `sweeps` rows of the neighbours on each side.
  Array<double> field_;
  Array<std::uint8_t> mask_;
  Array<double> before_, fresh_;  // a row before and after a sweep
};

}  // namespace asperity
