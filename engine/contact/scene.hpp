// SPDX-License-Identifier: GPL-3.0-or-later
// What a script asked of a contact: two bodies, the boundary, the elastic model and the accuracy.
// A scene is plain data; plan.hpp turns it into the terms, operators and buffers it needs. Nothing
// is switched on silently: an effect that the scene does not name is not computed.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/contact/boundary.hpp"
#include "engine/contact/effect.hpp"
#include "engine/contact/elastic_model.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The upper body: a rough one facing down, or a flat of this material (rigid_material() for a rigid
// counter-body).
using UpperBody = std::variant<Surface, Material>;

// The relative error that a script asks for instead of cells and a tolerance.
struct AskedError {
  double error = 0;             // in [1e-6, 1)
  std::vector<std::string> of;  // quantities by their names in a state; at least one
  // Limits of the grids that may be tried: cells a side, memory of a solve, expected seconds of all grids.
  int most_cells = 65536;
  double most_bytes = 4.0 * (std::int64_t{1} << 30), most_seconds = 600;
};

struct Accuracy {
  enum class OnFailure { error, best };
  enum class Precision { double_, single };
  double tolerance = 1e-6;  // greatest relative entry of the certificate, in [1e-15, 1)
  Precision precision = Precision::double_;
  bool precision_named = false;  // by the script: it is not chosen where an error is asked for
  OnFailure on_failure = OnFailure::error;
  // The other cells on which each press is solved as well, for an estimate of the error of the grid.
  enum class Estimate { none, coarser, finer };
  Estimate estimate = Estimate::none;
  // Choose cells and tolerance for this error (accuracy/accuracy_choice.hpp); a solver does not
  // read it.
  std::optional<AskedError> asked{};
  bool chosen = false;  // cells and tolerance are those that were chosen for it
};

struct Scene {
  Surface lower;  // rough side up
  UpperBody upper;
  Boundary boundary = Boundary::free;
  Elasticity elasticity{};
  Accuracy accuracy{};
  Effects effects{};
};

// Throws Error{bad_value} that names both where bodies of these grids differ in cells or size.
void check_tiles(const Grid& lower, const Grid& upper);

// Throws Error for the first thing that does not fit: cells or size of the two bodies, `stiffness`,
// `tolerance`, `precision`, `estimate`, `error` and `of`, a property of the flat counter-body out of range,
// an option of an effect out of range, or an effect that needs another one.
void check(const Scene& scene);

}  // namespace asperity
