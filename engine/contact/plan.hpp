// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene needs and nothing more: the operator, the terms, the buffers and the expected
// transforms, worked out before anything is solved. A solver reads its numbers from here and knows
// no effect by name. The plan explains itself: explain() and any table made of it render this struct.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/carried_load.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

// A term of the convex problem, or its operator, and the effect that brought it.
struct PlannedTerm {
  std::string effect;    // catalogue name
  std::string sentence;  // what it is here, with its numbers
};

struct PlannedBuffer {
  std::string name;
  std::int64_t bytes = 0;
  bool kept = true;   // for as long as the bodies lie like this, or only for a moment
  bool grows = true;  // in proportion to the nodes
};

// Box elements: u = p / stiffness, node by node; of rigid bodies with an infinite stiffness.
struct BoxOperator {
  double stiffness = 0;           // Pa/m
  double reference_pressure = 0;  // Pa; loads far below it are refused
  double lower_share = 1;         // of the shortening that the lower body takes, 0 … 1
};

// Half-spaces: u = K p, the multiplier 2/(E*|q|) of a periodic tile or the Love kernel of a free one; or a
// layer in their place, whose multiplier has a share of that.
struct HalfSpaceOperator {
  double modulus = 0;      // E*, Pa
  double lower_share = 1;  // of the elastic displacement that the lower body takes, 0 … 1
  std::optional<ElasticLayer> layer{};
};

using PlannedOperator = std::variant<BoxOperator, HalfSpaceOperator>;

// What limits the pressure and who gives way. A body that takes no share of what yields has infinite
// hardness here.
struct PlannedYield {
  double lower_hardness = 0, upper_hardness = 0;  // Pa, at the reference dwell, before any event
  double hardening = 0;                           // K_h, Pa/m; infinite: the pressure is capped
  // E of the lower body over that of the upper one; 1 where one of them is not known or nothing is elastic.
  double modulus_ratio = 1;
  std::optional<CreepOptions> creep{};
  // By the bodies as they lie now: of none of it does anything yield again.
  std::vector<CarriedLoad> carried{};

  double hardness() const { return std::min(lower_hardness, upper_hardness); }
  bool limits() const { return std::isfinite(hardness()); }  // whether anything can yield
  bool hardens() const { return limits() && std::isfinite(hardening); }
};

// The share of the plastic approach that the lower of two bodies takes,
//   s = 1/(1 + exp(1.5 (ρ² − ρ⁻²)) E_lower/E_upper),  ρ = H_lower/H_upper:
// ½ each of like bodies, .25 of a body 1.2 times as hard as the other, .06 of one 1.5 times and .004 of one
// twice as hard, which hardly yields at the pressure that the softer one limits. What J2 plasticity below the
// surface gives, within .03 between loads, of bodies of one Poisson's ratio; of equal hardness and unlike E
// it is exact: the strains go as 1/E. All or nothing where the other body's hardness is infinite.
double lower_plastic_share(double lower_hardness, double upper_hardness, double modulus_ratio = 1);

struct Plan {
  std::string title;   // tile and boundary
  double overlap = 1;  // share of the tile on which the bodies face each other
  std::string solver;
  PlannedOperator elasticity;
  std::optional<PlannedYield> yield;  // none without the effect `plasticity`
  std::vector<GapTerm> attraction;    // of the gap; a term of no work is left out of the solve
  std::vector<PlannedTerm> terms;
  std::vector<std::string> warnings;  // of a grid that is too coarse for a term
  std::vector<PlannedBuffer> buffers;
  std::int64_t bytes_to_flatten = 0;  // beyond those, while a press by `flatten` seeks its approach
  double transforms = 0;              // expected for a press, equivalents of the finest grid
  std::string press{};                // which press that is of and how it is known; empty: none was named
  double seconds = 0;                 // expected for the first press, a rough guess
  Accuracy accuracy;
  std::string choice;      // of cells, tolerance and precision for an error that was asked for; empty: none
  std::string estimate;    // what is solved beside it for the discretisation error; empty: nothing
  SlidingEffects sliding;  // of a contact pulled sideways, their defaults filled in
  std::vector<std::string> effects_run;
  std::vector<std::string> effects_off;

  // Whether bodies attract each other at all, so that they may be pulled.
  bool attracts() const;
  std::int64_t bytes_kept() const;
  std::int64_t bytes_peak() const;   // with the momentary ones
  std::int64_t bytes_grown() const;  // of those, what goes with the nodes
  std::string text() const;          // several lines, each ended
};

// Throws Error that names effect and body when an effect lacks a property of a material, or a default
// cannot be formed (a flat has no peak-to-valley to set the stiffness by). O(1).
Plan make_plan(const Scene& scene, const ContactGeometry& geometry);

// The plan of the scene of `before` for bodies that have yielded since, or on other cells: what a default
// took from the bodies as placed (boxes as stiff as E*/peak-to-valley) stays as it was.
Plan make_plan_like(const Plan& before, const Scene& scene, const ContactGeometry& geometry);

}  // namespace asperity
