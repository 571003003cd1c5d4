// SPDX-License-Identifier: GPL-3.0-or-later
// What a script asked of a contact: two bodies, the boundary, the elastic model and the accuracy.
// A scene is plain data; plan.hpp turns it into the terms, operators and buffers it needs. Nothing
// is switched on silently: an effect that is not a member of the scene is not computed.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/contact/boundary.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/contact/gap_term.hpp"
#include "engine/contact/sliding.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The upper body: a rough one facing down, or a flat of this material (rigid_material() for a rigid
// counter-body).
using UpperBody = std::variant<Surface, Material>;

// Independent elements over the nodes: pressure = stiffness · shortening.
struct BoxOptions {
  // Pa/m; by default E*/(peak-to-valley of the combined heights as placed).
  std::optional<double> stiffness;
};

// Elastic half-spaces: every pressure moves every node.
struct HalfSpaceOptions {};

// No elastic deformation: a node gives way only by yielding, so the scene names `plasticity` beside it.
struct RigidOptions {};

using Elasticity = std::variant<BoxOptions, HalfSpaceOptions, LayerOptions, RigidOptions>;

// Whether every pressure moves every node, so that a press is solved by iterations.
inline bool moves_every_node(const Elasticity& elasticity) {
  return std::holds_alternative<HalfSpaceOptions>(elasticity) ||
         std::holds_alternative<LayerOptions>(elasticity);
}

// Pressure is limited by hardness, and what yields stays flattened. The volume that yields is removed,
// not redistributed.
struct PlasticityOptions {
  // Pa, of both bodies; by default each body's own. Infinite: never yields.
  std::optional<double> hardness;
  // K_h, Pa/m: a node that yields by w carries its hardness and K_h·w, and is as hard afterwards. Infinite:
  // none named, the pressure never passes the hardness.
  double hardening = std::numeric_limits<double>::infinity();
};

// The hardness falls as the load dwells: H(t) = H (1 + b ln(1 + t_ref/t_c)) / (1 + b ln(1 + t/t_c)).
struct CreepOptions {
  double rate = 0.02;      // b
  double onset = 1;        // t_c, s
  double reference = 600;  // t_ref, s: the dwell at which the hardness is the stated one
};
// The surfaces attract each other across the gap: w/ρ e^(−g/ρ), or Dugdale's constant w/ρ up to a gap of ρ.
struct AdhesionOptions {
  double work = 0;   // w, J/m²
  double range = 0;  // ρ, m
  GapLaw model = GapLaw::exponential;
};

// Liquid bridges gaps up to the height 2 r cos θ of a meniscus and pulls with the constant pressure p = γ/r.
// Either the pressure is given, or the humidity, which sets the radius r = γ V_m/(R T |ln humidity|)
// (Kelvin).
struct CapillarityOptions {
  std::optional<double> pressure{};  // Pa
  std::optional<double> humidity{};  // relative, 0 … 1
  double surface_tension = 0.0728;   // γ, N/m; water at 20 °C
  double contact_angle = 0;          // θ, rad
  double temperature = 293.15;       // T, K
  double molar_volume = 1.8e-5;      // V_m, m³/mol
};

// H(t)/H; a press that names no dwell lasts t_ref.
double softening(const CreepOptions& creep, std::optional<double> dwell);

// The relative error that a script asks for instead of cells and a tolerance.
struct AskedError {
  double error = 0;             // in [1e-6, 1)
  std::vector<std::string> of;  // quantities by their names in a state; at least one
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
  // Choose cells, tolerance and precision for this error (accuracy/accuracy_choice.hpp); a solver does not
  // read it.
  std::optional<AskedError> asked{};
  bool chosen = false;  // cells, tolerance and precision are those that were chosen for it
};

struct Scene {
  Surface lower;  // rough side up
  UpperBody upper;
  Boundary boundary = Boundary::free;
  Elasticity elasticity = BoxOptions{};
  Accuracy accuracy{};
  std::optional<PlasticityOptions> plasticity{};
  std::optional<CreepOptions> creep{};
  std::optional<AdhesionOptions> adhesion{};
  std::optional<CapillarityOptions> capillarity{};
  SlidingEffects sliding{};
};

// Throws Error{bad_value} that names both where bodies of these grids differ in cells or size.
void check_tiles(const Grid& lower, const Grid& upper);

// Throws Error for the first thing that does not fit: cells or size of the two bodies, `stiffness`,
// `tolerance`, `precision`, `estimate`, `error` and `of`, a property of the flat counter-body out of range,
// an option of an effect out of range, or an effect that needs another one.
void check(const Scene& scene);

}  // namespace asperity
