// SPDX-License-Identifier: GPL-3.0-or-later
// An approximate inverse of the half-space's compliance restricted to the free nodes of a contact:
// z = Extᵀ (|q|/2) Ext r on the free set, in cell units. Ext carries r past the edge of the set, so that no
// jump is paid for there: as a field that is smooth from one contact to the next (SmoothExtension) all over
// the grid, and what r differs from that by a few sweeps far, each making the nodes of one colour of a
// chessboard, off the set, the mean of their four neighbours, of two on a line of nodes; on a periodic side
// of an odd number of nodes, where two of one colour meet, sweeps do not wrap. |q|/2 is HalfOrderPyramid's.
// On cells much longer than wide, it is LineExtension that carries r on instead. On a layer 1/K takes the
// place of |q|/2; on a thin one, which hardly hands a pressure on, nothing is carried past the edge.
// Symmetric, positive semi-definite on the free set; single precision inside. No projection of the mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "engine/contact/boundary.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"

namespace asperity {

class ContactPreconditioner {
 public:
  // nx, ny >= 1; aspect > 0; sweeps >= 0. `weight` is the cost of one transform of this grid in
  // transforms of the finest; counted only as far as the pyramid has to transform. An object holds two grids
  // at most, four on a periodic tile one of whose lengths has a large prime factor.
  ContactPreconditioner(int nx, int ny, double aspect, Boundary boundary, double weight = 1, int sweeps = 4,
                        const ComplianceMultiplier& multiplier = {});
  ~ContactPreconditioner();
  ContactPreconditioner(ContactPreconditioner&&) noexcept;
  ContactPreconditioner& operator=(ContactPreconditioner&&) noexcept;

  // The nodes where free[k] != 0; none at first. O(n), a fraction of an application.
  void set_free(std::span<const std::uint8_t> free);

  // z = M r; r is read on the free set only, z is 0 off it and may be r. r times a power of two gives z
  // times the same, bit for bit. The same bits for any number of threads. Not thread-safe.
  void apply(std::span<const double> r, std::span<double> z);

  // r = offset + factor · values, nx·ny of them.
  struct Residual {
    const double* values;
    double factor = 1, offset = 0;
  };
  // Taken on the way: values += length · more.
  struct Step {
    double* values = nullptr;
    double length = 0;
    const double* more = nullptr;
  };
  // The same in two halves. The first, after a step of the values of r if there is one, gives r·z, …
  double spread(const Residual& r, const Step& step);
  // … the second z less a smooth field, which passes by in stretches of a row: `keep` takes `factor` times
  // the values, 0 off the free set, or null for no free node there, with the number of the tile,
  // 0 … tiles(): the stretches of a tile come in their order on one thread. …
  using Keep = std::function<void(std::size_t tile, std::size_t first, std::size_t n, const float* values,
                                  double factor)>;
  void gather(const Keep& keep);
  // … And then that field, to be added on the free set: `factor` times its row j, …
  SmoothRow<double> smooth(int j, double factor) const;
  // … and its sum over the free set, to the last digits.
  double smooth_sum() const;
  std::size_t tiles() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace asperity
