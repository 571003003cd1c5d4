// SPDX-License-Identifier: GPL-3.0-or-later
// Descents on one grid: fields, stopping rules, stages and chains of stages, under a load and at an offset.
// Each stage starts from the feasible pressures of the one before.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

struct DescentFields {
  explicit DescentFields(std::size_t nodes)
      : pressure(nodes), gap(nodes), image(nodes), free(nodes), old_free(nodes) {}

  UnsetArray<double> pressure;               // feasible between stages
  UnsetArray<double> gap;                    // K p − h
  UnsetArray<double> image;                  // K·direction times a power of two
  UnsetArray<double> old_pressure, old_gap;  // previous pass; allocated on first use
  Array<std::uint8_t> free, old_free;

  void remember_pass() {
    old_pressure = pressure;
    old_gap = gap;
  }
  // Exact: the gap is linear in p.
  void average_passes() {
    for_nodes(pressure.size(), [p = pressure.data(), g = gap.data(), old_p = old_pressure.data(),
                                old_g = old_gap.data()](std::size_t k) {
      p[k] = 0.5 * (p[k] + old_p[k]);
      g[k] = 0.5 * (g[k] + old_g[k]);
    });
  }
};

// Shared by the serial and the distributed descent.
namespace descent_rules {

inline constexpr double richardson_step = 0.65;  // of the preconditioner
inline constexpr int passes_without_gain = 4;
inline constexpr int most_renewals = 50;

// Whether a descent still gains, and whether a few nodes alternate between two passes.
class Watch {
 public:
  void take(double residual) {
    without_gain_ = residual < 0.9 * best_ ? 0 : without_gain_ + 1;
    if (without_gain_ == 0) best_ = residual;
    slow_ones_ = residual > slow * least_ ? slow_ones_ + 1 : 0;
    least_ = std::min(least_, residual);
    if (residual > jump * before_) ++jumps_;
    before_ = residual;
  }
  int without_gain() const { return without_gain_; }

  enum class Advice { go_on, remember_pass, average_passes };
  // If the next pass also reverses, its result is averaged with the stored one.
  Advice advice() {
    if (remembers_ && goes_back(0)) {
      slow_ones_ = jumps_ = 0;
      remembers_ = false;
      return Advice::average_passes;
    }
    remembers_ = goes_back(1);
    return remembers_ ? Advice::remember_pass : Advice::go_on;
  }

 private:
  static constexpr double slow = 0.7;  // of the best residual
  static constexpr double jump = 10;   // of the residual before
  static constexpr int slow_passes = 2, jumps_in_a_cycle = 2;
  static constexpr double none = std::numeric_limits<double>::infinity();

  // Now, or after `more` such passes.
  bool goes_back(int more) const {
    return slow_ones_ + more >= slow_passes || jumps_ + more >= jumps_in_a_cycle;
  }
  double best_ = none, least_ = none, before_ = none;
  int without_gain_ = 0, slow_ones_ = 0, jumps_ = 0;
  bool remembers_ = false;
};

}  // namespace descent_rules

struct DescentEnd {
  bool converged = false;
  std::string stage;
};

// From feasible pressures. Returns whether residual < tolerance; if not, pressures are feasible. `exact`:
// converged pressures are feasible too, with a fresh gap.
bool active_set_descent(ContactLevel& level, DescentFields& fields, double tolerance, int most_applications,
                        bool exact);

// Spectral projected gradients (Birgin, Martínez & Raydan 2000, SIAM J. Optim. 10, 1196): alternating
// Barzilai–Borwein steps, exact projection, nonmonotone over a window. Slow, feasible, convergent in theory:
// last resort, and shaker of the free set. Returns whether residual < tolerance, gap fresh.
bool spectral_gradient(ContactLevel& level, DescentFields& fields, double tolerance, int most_applications);

enum class ChainEffort {
  start,  // start of a finer grid: pressures may leave their bounds
  brief,  // without the last resort
  quick,  // at an offset: the same with a fresh gap
  less,   // at an offset: fewer downhill passes
  full    // up to thousands of projected gradients
};

// Stages in turn until one converges, the quick one first.
DescentEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort);

// offset_descent.cpp. `gap_known`: fields.gap is K p − h and pressures may be infeasible. Ends with feasible
// pressures and, if converged, a fresh (full), updated (brief) or unsettled (start) gap. The residual is
// relative to level.length. Elastic full contact of a periodic tile does not converge.
DescentEnd run_offset_chain(ContactLevel& level, DescentFields& fields, double offset, double tolerance,
                            ChainEffort effort, bool gap_known);

}  // namespace asperity
