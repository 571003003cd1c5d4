// SPDX-License-Identifier: GPL-3.0-or-later
// The descents on one grid: the fields they work on, the rules by which one gives a direction up, the stages
// one after the other, each from the feasible pressures of the one before, and the chain of them under a load
// and at a given offset.
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

  UnsetArray<double> pressure;               // p: feasible between stages
  UnsetArray<double> gap;                    // K p − h
  UnsetArray<double> image;                  // what K makes of a direction, times a power of two
  UnsetArray<double> old_pressure, old_gap;  // of the pass before; made when first needed
  Array<std::uint8_t> free, old_free;        // nodes the present pass may move

  void remember_pass() {
    old_pressure = pressure;
    old_gap = gap;
  }
  // The means of this pass and that one; exact, for the gap is linear in p.
  void average_passes() {
    for_nodes(pressure.size(), [p = pressure.data(), g = gap.data(), old_p = old_pressure.data(),
                                old_g = old_gap.data()](std::size_t k) {
      p[k] = 0.5 * (p[k] + old_p[k]);
      g[k] = 0.5 * (g[k] + old_g[k]);
    });
  }
};

// The rules of a descent that settles which nodes are free, the same alone and over ranks.
namespace descent_rules {

inline constexpr double richardson_step = 0.65;  // of the preconditioner, where a pass settles
inline constexpr int passes_without_gain = 4;
inline constexpr int most_renewals = 50;

// What the residuals of its passes say: whether it still gains, and whether a few nodes go back and forth
// between two passes, which are averaged then.
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
  // At the end of a pass; what it remembers is averaged with the next where that goes back, too.
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
  static constexpr double slow = 0.7;  // a pass that leaves more than this of the best residual is slow
  static constexpr double jump = 10;   // a pass whose residual is so many times the one before has gone back
  static constexpr int slow_passes = 2, jumps_in_a_cycle = 2;
  static constexpr double none = std::numeric_limits<double>::infinity();

  // Now, or with so many passes more like the last.
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
  std::string stage;  // the last that a chain went through
};

// active_set_descent.cpp: from fields.pressure, feasible. Whether it converged (residual < tolerance);
// pressures are feasible where it did not. `exact`: pressures that converged are feasible, too, and their gap
// is computed afresh.
bool active_set_descent(ContactLevel& level, DescentFields& fields, double tolerance, int most_applications,
                        bool exact);

// The last resort and the shaker: spectral projected gradients (Birgin, Martínez & Raydan 2000, SIAM J.
// Optim. 10, 1196), alternating Barzilai–Borwein steps, exact projection on bounds and load, nonmonotone
// over a window. Feasible throughout and convergent in theory; slow. From fields.pressure, feasible. Whether
// it converged (residual < tolerance, fresh gap) within the applications given.
bool spectral_gradient(ContactLevel& level, DescentFields& fields, double tolerance, int most_applications);

enum class ChainEffort {
  start,  // of a finer grid: pressures may end outside their bounds, with gaps as the steps left them
  brief,  // an answer, or none without the last resort
  quick,  // at an offset: the same, its gap computed afresh
  less,   // at an offset: an answer, with fewer passes downhill
  full    // an answer, down to thousands of projected gradients
};

// Under a mean pressure: the stages in turn, the quick one first and the one that is sure in theory last,
// until one converges.
DescentEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort);

// offset_descent.cpp: at a given offset. From fields.pressure, and from fields.gap, K p − h of them, where
// `gap_known`; without it the pressures are feasible (zero will do). Ends with feasible pressures and, if
// converged, a gap that is computed afresh (full), as the steps left it (brief), or that of pressures before
// they were settled (start). The residual is measured by level.length. Where all of a periodic tile would
// touch without yielding no pressure has the gap: does not converge then.
DescentEnd run_offset_chain(ContactLevel& level, DescentFields& fields, double offset, double tolerance,
                            ChainEffort effort, bool gap_known);

}  // namespace asperity
