// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene needs and nothing more: the operator, the terms, the buffers and the expected
// transforms, worked out before anything is solved. A solver reads its numbers from here and knows
// no effect by name. The plan explains itself: explain() and any table made of it render this struct.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/gap_term.hpp"
#include "engine/contact/planned_yield.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

class Json;

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

// Half-spaces: u = K p, the multiplier 2/(E*|q|) of a periodic tile or the Love kernel of a free one; or what
// lies in their place on a periodic tile, whose multiplier is a share of that.
struct HalfSpaceOperator {
  double modulus = 0;                // E*, Pa
  double lower_share = 1;            // of the elastic displacement that the lower body takes, 0 … 1
  std::optional<WaveShare> share{};  // none: a half-space
};

using PlannedOperator = std::variant<BoxOperator, HalfSpaceOperator>;

struct Plan {
  std::string title;   // tile and boundary
  double overlap = 1;  // share of the tile on which the bodies face each other
  std::string solver;
  const ElasticModel* model = nullptr;  // of elasticity
  PlannedOperator elasticity;
  std::optional<PlannedYield> yield;  // none where no effect limits the pressure
  std::vector<GapTerm> attraction;    // of the gap; a term of no work is left out of the solve
  std::vector<PlannedTerm> terms;
  std::vector<std::string> warnings;  // of a grid that is too coarse for a term
  std::vector<PlannedBuffer> buffers;
  std::int64_t bytes_to_flatten = 0;  // beyond those, while a press by `flatten` seeks its approach
  double transforms = 0;              // expected for a press, equivalents of the finest grid
  std::string press{};                // which press that is of and how it is known; empty: none was named
  double seconds = 0;                 // expected for the first press, a rough guess
  Accuracy accuracy;
  std::string choice;    // of cells and tolerance for an error that was asked for; empty: none
  std::string estimate;  // what is solved beside it for the discretisation error; empty: nothing
  Effects effects;       // of the scene, with what their defaults come to here
  std::vector<std::string> effects_run;
  std::vector<std::string> effects_off;

  // Whether bodies attract each other at all, so that they may be pulled.
  bool attracts() const;
  std::int64_t bytes_kept() const;
  std::int64_t bytes_peak() const;   // with the momentary ones
  std::int64_t bytes_grown() const;  // of those, what goes with the nodes
  std::string text() const;          // several lines, each ended
};

// The plan of a press by flattening: what that holds beyond the others is among its buffers.
void hold_flattening(Plan& plan);

// Throws Error that names effect and body when an effect lacks a property of a material, or a default
// cannot be formed (a flat has no peak-to-valley to set the stiffness by). O(1).
Plan make_plan(const Scene& scene, const ContactGeometry& geometry);

// The plan of the scene of `before` for bodies that have yielded since, or on other cells: what a default
// took from the bodies as placed (boxes as stiff as E*/peak-to-valley) stays as it was.
Plan make_plan_like(const Plan& before, const Scene& scene, const ContactGeometry& geometry);

// What text() says, as JSON.
Json to_json(const Plan& plan);

}  // namespace asperity
