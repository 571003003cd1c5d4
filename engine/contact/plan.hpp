// SPDX-License-Identifier: GPL-3.0-or-later
// Operator, terms, buffers and expected transforms of a scene, computed before any solve. Solvers read the
// plan and name no effect.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/gap_term.hpp"
#include "engine/contact/planned_yield.hpp"
#include "engine/contact/scene/scene.hpp"

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
  bool kept = true;   // as long as the placement
  bool grows = true;  // in proportion to the nodes
};

struct Plan {
  std::string title;   // tile and boundary
  double overlap = 1;  // share of the tile with facing bodies
  std::string solver;
  std::shared_ptr<const ElasticOperator> elasticity;
  std::optional<PlannedYield> yield;  // none without a limit
  std::vector<GapTerm> attraction;    // the solve skips terms without work
  std::vector<PlannedTerm> terms;
  std::vector<std::string> warnings;  // cells too coarse for a term
  std::vector<PlannedBuffer> buffers;
  std::int64_t bytes_to_flatten = 0;  // additional, during a press by `flatten`
  double transforms = 0;              // per press, on the finest grid
  std::string press{};                // press of `transforms` and its source; empty: none
  double seconds = 0;                 // first press, rough
  Accuracy accuracy;
  std::string choice;    // reason for cells and tolerance; empty: none requested
  std::string estimate;  // companion solves; empty: none
  Effects effects;       // with completed options
  std::vector<std::string> effects_run;
  std::vector<std::string> effects_off;

  // If so, bodies may be pulled.
  bool attracts() const;
  // Of buffers with `which`; null: of all.
  std::int64_t bytes_of(bool PlannedBuffer::*which) const;
  std::int64_t bytes_kept() const { return bytes_of(&PlannedBuffer::kept); }
  std::int64_t bytes_peak() const { return bytes_of(nullptr); }  // with temporary buffers
  std::int64_t bytes_grown() const { return bytes_of(&PlannedBuffer::grows); }
  std::string text() const;  // each line terminated
};

// For a press by `flatten`.
void hold_flattening(Plan& plan);

// Throws Error naming effect and body for a missing property or impossible default. O(1).
Plan make_plan(const Scene& scene, const ContactGeometry& geometry);

// `before` for bodies that yielded or have other cells, with the same operator.
Plan make_plan_like(const Plan& before, const Scene& scene, const ContactGeometry& geometry);

// As text().
Json to_json(const Plan& plan);

}  // namespace asperity
