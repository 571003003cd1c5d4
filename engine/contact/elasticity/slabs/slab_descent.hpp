// SPDX-License-Identifier: GPL-3.0-or-later
// Descents of a contact in slabs, as half_space/active_set_descent.cpp and half_space/descent.hpp. Decisions
// follow sums over all processes: all processes decide alike.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

// Approximate inverse of the compliance on the free nodes: z = Extᵀ (|q|/2) Ext r, as
// contact_preconditioner.hpp, with exact |q|/2. Ext: eight Jacobi sweeps past the edge of the set, row by
// row: one pass through the cache.
class SlabPreconditioner {
 public:
  explicit SlabPreconditioner(SlabLevel& level);

  void set_free(std::span<const std::uint8_t> free);

  // z = M r; values()[k] is undefined off the free nodes.
  template <class Read>
  void apply(Read read) {
    level_.each(
        [this, read, to = own()](std::size_t k) { to[k] = mask_[offset() + k] != 0 ? read(k) : 0.0; });
    exchange_rim(field_);
    level_.team.work([&] { sweep(false); });
    level_.apply_inverse([from = own()](std::size_t k) { return from[k]; },
                         [to = own()](std::size_t k, double z) { to[k] = z; });
    exchange_rim(field_);
    level_.team.work([&] { sweep(true); });
  }
  const double* values() const { return field_.data() + offset(); }

 private:
  static constexpr int sweeps = 8;
  std::size_t offset() const { return static_cast<std::size_t>(sweeps) * level_.slab.width(); }
  double* own() { return field_.data() + offset(); }
  template <class Number>
  void exchange_rim(Array<Number>& field);
  void sweep(bool adjoint);

  SlabLevel& level_;
  RowExchange rim_;
  // Own rows, with `sweeps` rows of the neighbours on each side.
  Array<double> field_;
  Array<std::uint8_t> mask_;
  Array<double> before_, fresh_;  // a row before and after a sweep
};

// 34 bytes a node; 16 more while a cycle is broken.
struct SlabFields : DescentFields {
  SlabFields(Team& team, std::size_t nodes);
  UnsetArray<double> direction;
};

// Starts from fields.pressure, feasible.
DescentEnd run_chain(SlabLevel& level, SlabFields& fields, double tolerance, ChainEffort effort);

}  // namespace asperity
