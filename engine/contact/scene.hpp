// SPDX-License-Identifier: GPL-3.0-or-later
// What a script asked of a contact: two bodies, the boundary, the elastic model and the accuracy.
// A scene is plain data; plan.hpp turns it into the terms, operators and buffers it needs. Nothing
// is switched on silently: an effect that is not a member of the scene is not computed.
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "engine/surface/surface.hpp"

namespace asperity {

// Whether contact regions, displacements and shifts go round the rim of the tile.
enum class Boundary { free, periodic };
std::string_view name(Boundary boundary);

// The upper body: a rough one facing down, or a flat of this material (rigid_material() for a rigid
// counter-body).
using UpperBody = std::variant<Surface, Material>;

// Independent elements over the nodes: pressure = stiffness · shortening.
struct BoxOptions {
  // Pa/m; by default E*/(peak-to-valley of the combined heights as placed).
  std::optional<double> stiffness;
};

using Elasticity = std::variant<BoxOptions>;

struct Accuracy {
  enum class OnFailure { error, best };
  enum class Precision { double_, single };
  double tolerance = 1e-6;  // greatest relative entry of the certificate, in [1e-15, 1)
  Precision precision = Precision::double_;
  OnFailure on_failure = OnFailure::error;
};

struct Scene {
  Surface lower;  // rough side up
  UpperBody upper;
  Boundary boundary = Boundary::free;
  Elasticity elasticity = BoxOptions{};
  Accuracy accuracy;
};

// Throws Error for the first thing that does not fit: cells or size of the two bodies, `stiffness`,
// `tolerance`, `precision`, a property of the flat counter-body out of range.
void check(const Scene& scene);

}  // namespace asperity
