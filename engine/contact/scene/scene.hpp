// SPDX-License-Identifier: GPL-3.0-or-later
// A contact as defined by a script. Plain data; plan.hpp turns it into operators, terms and buffers. An
// effect not named is not computed.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/contact/scene/boundary.hpp"
#include "engine/contact/scene/effect.hpp"
#include "engine/contact/scene/elastic_model.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// A rough body facing down, or a flat (rigid_material(): a rigid counter-body).
using UpperBody = std::variant<Surface, Material>;

// Instead of cells and tolerance.
struct AskedError {
  double error = 0;             // in [1e-6, 1)
  std::vector<std::string> of;  // state quantities; at least one
  // Cells a side, memory of a solve, seconds of all grids.
  int most_cells = 65536;
  double most_bytes = 4.0 * (std::int64_t{1} << 30), most_seconds = 600;
};

struct Accuracy {
  enum class OnFailure { error, best };
  enum class Precision { double_, single };
  double tolerance = 1e-6;  // greatest entry of the certificate, in [1e-15, 1)
  Precision precision = Precision::double_;
  bool precision_named = false;  // by the script: not chosen
  OnFailure on_failure = OnFailure::error;
  // Companion grid for the discretisation error.
  enum class Estimate { none, coarser, finer };
  Estimate estimate = Estimate::none;
  // Chooses cells and tolerance (accuracy/accuracy_choice.hpp); solvers do not read this.
  std::optional<AskedError> asked{};
  bool chosen = false;  // cells and tolerance were chosen
};

struct Scene {
  Surface lower;  // rough side up
  UpperBody upper;
  Boundary boundary = Boundary::free;
  Elasticity elasticity{};
  Accuracy accuracy{};
  Effects effects{};
};

// Throws Error{bad_value} naming both grids if they differ.
void check_tiles(const Grid& lower, const Grid& upper);

// Throws Error for the first conflict of grids, options, properties or required effects.
void check(const Scene& scene);

}  // namespace asperity
