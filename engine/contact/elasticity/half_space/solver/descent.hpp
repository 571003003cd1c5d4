// SPDX-License-Identifier: GPL-3.0-or-later
// The descents on one grid: the fields they work on, the rules by which one gives a direction up, the stages
// one after the other, each from the feasible pressures of the one before, and the chain of them under a load
// and at a given offset.
#pragma once

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
};

// When a descent that settles which nodes are free gives a direction up: the same alone and over ranks.
namespace descent_rules {

inline constexpr double richardson_step = 0.65;  // of the preconditioner, where a pass settles
inline constexpr int passes_without_gain = 4;
inline constexpr double slow = 0.7;  // a pass that leaves more than this of the best residual is slow
inline constexpr int slow_passes = 2;
inline constexpr double jump = 10;  // a pass whose residual is so many times the one before has gone back
inline constexpr int jumps_in_a_cycle = 2;
inline constexpr int most_renewals = 50;

}  // namespace descent_rules

struct StageEnd {
  bool converged = false;
  double residual = std::numeric_limits<double>::infinity();
  double best = std::numeric_limits<double>::infinity();
};

// active_set_descent.cpp: from fields.pressure, feasible. Ends converged (residual < tolerance) or with
// feasible pressures. `exact`: pressures that converged are feasible, too, and their gap is computed afresh.
StageEnd active_set_descent(ContactLevel& level, DescentFields& fields, double tolerance,
                            int most_applications, bool exact);

// The last resort and the shaker: spectral projected gradients (Birgin, Martínez & Raydan 2000, SIAM J.
// Optim. 10, 1196), alternating Barzilai–Borwein steps, exact projection on bounds and load, nonmonotone
// over a window. Feasible throughout and convergent in theory; slow. From fields.pressure, feasible. Ends
// converged (residual < tolerance, fresh gap) or after the applications given.
StageEnd spectral_gradient(ContactLevel& level, DescentFields& fields, double tolerance,
                           int most_applications);

struct ChainEnd {
  StageEnd stage;
  std::string name;
};

enum class ChainEffort {
  start,  // of a finer grid: pressures may end outside their bounds, with gaps as the steps left them
  brief,  // an answer, or none without the last resort
  full    // an answer, down to thousands of projected gradients
};

// Under a mean pressure: the stages in turn, the quick one first and the one that is sure in theory last,
// until one converges.
ChainEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort);

// offset_descent.cpp: at a given offset. From fields.pressure, and from fields.gap, K p − h of them, where
// `gap_known`; without it the pressures are feasible (zero will do). Ends with feasible pressures and, if
// converged, a gap that is computed afresh (full), as the steps left it (brief), or that of pressures before
// they were settled (start). The residual is measured by level.length. Where all of a periodic tile would
// touch without yielding no pressure has the gap: does not converge then.
ChainEnd run_offset_chain(ContactLevel& level, DescentFields& fields, double offset, double tolerance,
                          ChainEffort effort, bool gap_known);

}  // namespace asperity
