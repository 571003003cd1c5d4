// SPDX-License-Identifier: GPL-3.0-or-later
// Operator, terms, buffers and expected transforms of a scene, computed before any solve. Solvers read the
// plan and name no effect.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/gap_term.hpp"
#include "engine/contact/planned_yield.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/contact/wave_share.hpp"

namespace asperity {

class Json;

// A term of the convex problem, or its operator.
struct PlannedTerm {
  std::string effect;    // catalogue name
  std::string sentence;  // with its numbers
};

struct PlannedBuffer {
  std::string name;
  std::int64_t bytes = 0;
  bool kept = true;   // as long as the placement; otherwise temporary
  bool grows = true;  // in proportion to the nodes
};

// u = p / stiffness at each node; infinite stiffness: rigid.
struct BoxOperator {
  double stiffness = 0;           // Pa/m
  double reference_pressure = 0;  // Pa; much smaller loads are refused
  double lower_share = 1;         // of the shortening, 0 … 1
};

// u = K p: multiplier 2/(E*|q|) or a share of it on a periodic tile, Love kernel on a free tile.
struct HalfSpaceOperator {
  double modulus = 0;                // E*, Pa
  double lower_share = 1;            // of the elastic displacement, 0 … 1
  std::optional<WaveShare> share{};  // none: a half-space
};

using PlannedOperator = std::variant<BoxOperator, HalfSpaceOperator>;

struct Plan {
  std::string title;   // tile and boundary
  double overlap = 1;  // share of the tile where the bodies face each other
  std::string solver;
  const ElasticModel* model = nullptr;  // of elasticity
  PlannedOperator elasticity;
  std::optional<PlannedYield> yield;  // none without a limit
  std::vector<GapTerm> attraction;    // terms without work are skipped in the solve
  std::vector<PlannedTerm> terms;
  std::vector<std::string> warnings;  // cells too coarse for a term
  std::vector<PlannedBuffer> buffers;
  std::int64_t bytes_to_flatten = 0;  // additional, during a press by `flatten`
  double transforms = 0;              // per press, in transforms of the finest grid
  std::string press{};                // the press of `transforms` and its source; empty: none
  double seconds = 0;                 // first press, rough
  Accuracy accuracy;
  std::string choice;    // reason for cells and tolerance of a requested error; empty: none
  std::string estimate;  // companion solves for the discretisation error; empty: none
  Effects effects;       // with completed options
  std::vector<std::string> effects_run;
  std::vector<std::string> effects_off;

  // If so, bodies may be pulled.
  bool attracts() const;
  // Of buffers with `which`; null: of all.
  std::int64_t bytes_of(bool PlannedBuffer::*which) const;
  std::int64_t bytes_kept() const { return bytes_of(&PlannedBuffer::kept); }
  std::int64_t bytes_peak() const { return bytes_of(nullptr); }                 // with temporary buffers
  std::int64_t bytes_grown() const { return bytes_of(&PlannedBuffer::grows); }  // in proportion to the nodes
  std::string text() const;                                                     // lines, each terminated
};

// Adds the buffers of a press by `flatten`.
void hold_flattening(Plan& plan);

// Throws Error naming effect and body for a missing material property or an impossible default. O(1).
Plan make_plan(const Scene& scene, const ContactGeometry& geometry);

// The plan `before` for bodies that yielded since or have other cells. Defaults from the placed bodies
// (E*/peak-to-valley) keep their values.
Plan make_plan_like(const Plan& before, const Scene& scene, const ContactGeometry& geometry);

// The content of text().
Json to_json(const Plan& plan);

}  // namespace asperity
