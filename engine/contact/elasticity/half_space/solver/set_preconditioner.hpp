// SPDX-License-Identifier: GPL-3.0-or-later
// The preconditioner of a pass: on the elastic free nodes the restricted |q|/2, on the yielding ones what one
// node by itself would do, with the change of load taken from those that balance it. Where yielding is
// soft beside the longest wave's compliance the two are kept apart; where it is stiff the yielding nodes
// stay in the restricted |q|/2, scaled down.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/free_set.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

template <class Limit>
class SetPreconditioner {
 public:
  SetPreconditioner(ContactLevel& level, const Limit& limit) : level_(level) {
    if constexpr (Limit::hardens) {
      slope_ = limit.yielding_slope();
      apart_ = slope_ > stiff_slope;
      scale_ = std::sqrt(1 / (1 + slope_ / Limit::own_compliance));
    }
  }

  void set_free(std::span<const std::uint8_t> free) {
    if constexpr (Limit::hardens) {
      mask_.resize(free.size());
      for_nodes(free.size(), [&](std::size_t k) {
        mask_[k] = free[k] == elastic || (free[k] == yielding && !apart_) ? 1 : 0;
      });
      level_.preconditioner.set_free(mask_);
    } else {
      level_.preconditioner.set_free(free);
    }
  }

  // Whether yielding nodes are left to themselves.
  bool apart() const { return apart_; }

  // z = M r in place, without the balance of the load.
  void apply(std::span<const std::uint8_t> free, std::span<double> z) {
    if constexpr (Limit::hardens) {
      if (apart_) {
        kept_.resize(z.size());
        const double factor = 1 / (slope_ + Limit::own_compliance);
        for_nodes(z.size(), [&](std::size_t k) { kept_[k] = free[k] == yielding ? z[k] * factor : 0.0; });
        level_.preconditioner.apply(z, z);
        for_nodes(z.size(), [&](std::size_t k) {
          if (free[k] == yielding) z[k] = kept_[k];
        });
      } else {
        const auto scale = [&](std::size_t k) {
          if (free[k] == yielding) z[k] *= scale_;
        };
        for_nodes(z.size(), scale);
        level_.preconditioner.apply(z, z);
        for_nodes(z.size(), scale);
      }
    } else {
      level_.preconditioner.apply(z, z);
    }
  }

 private:
  // dw/dp in cell units; measured: below it the scaled |q|/2 takes fewer steps, above it the two apart.
  static constexpr double stiff_slope = 3;

  ContactLevel& level_;
  double slope_ = 0, scale_ = 1;
  bool apart_ = true;
  Array<std::uint8_t> mask_;
  Array<double> kept_;
};

}  // namespace asperity
