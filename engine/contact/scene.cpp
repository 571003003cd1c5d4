// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/contact/elasticity/layer/layer_plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string tile(const Grid& g) {
  return std::to_string(g.nx) + " x " + std::to_string(g.ny) + " cells on " +
         format_quantity(g.size_x, dimension::length, 6) + " x " +
         format_quantity(g.size_y, dimension::length, 6);
}

// Sizes that differ by the rounding of a product (3 · 50 against 150) are the same size.
bool same_length(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(a, b); }

void check_positive(double value, std::string_view key, const std::string& unit, bool never,
                    const char* hint) {
  if (!(value > 0) || (!never && !std::isfinite(value)))
    throw Error(ErrorCode::bad_value, quoted(key) + " is " + format_short(value) + " " + unit, hint);
}

void check(const PlasticityOptions& options) {
  if (options.hardness)
    check_positive(*options.hardness, "hardness", "Pa", true,
                   "give a pressure above zero, such as \"1.1 GPa\"");
  check_positive(
      options.hardening, "hardening", "Pa/m", true,
      "give a value above zero, such as \"80 MPa/um\"; math.huge, the default, leaves hardening out");
}

void check(const CreepOptions& options) {
  if (!(options.rate >= 0 && std::isfinite(options.rate)))
    throw Error(ErrorCode::bad_value, "`rate` is " + format_short(options.rate),
                "give a finite number from zero up; 0.02 is usual");
  check_positive(options.onset, "onset", "s", false, "give a time above zero, such as \"1 s\"");
  check_positive(options.reference, "reference", "s", false, "give a time above zero, such as \"10 min\"");
}

void check(const AdhesionOptions& options) {
  if (!(options.work >= 0 && std::isfinite(options.work)))
    throw Error(ErrorCode::bad_value, "`work` of the adhesion is " + format_short(options.work) + " J/m^2",
                "give a finite value from zero up, such as \"50 mJ/m^2\"");
  check_positive(options.range, "range", "m", false,
                 "give the length over which the attraction falls, such as \"1 nm\"");
}

void check(const CapillarityOptions& options) {
  if (options.pressure.has_value() == options.humidity.has_value())
    throw Error(
        ErrorCode::bad_value,
        std::string("`capillarity` names ") +
            (options.pressure ? "both `pressure` and `humidity`" : "neither `pressure` nor `humidity`"),
        "give the one that is known: the humidity sets the pressure");
  if (options.pressure && !(*options.pressure >= 0 && std::isfinite(*options.pressure)))
    throw Error(ErrorCode::bad_value,
                "`pressure` of the liquid is " + format_short(*options.pressure) + " Pa",
                "it is how far the liquid is below the air: give a finite value from zero up");
  if (options.humidity && !(*options.humidity >= 0 && *options.humidity < 1))
    throw Error(ErrorCode::bad_value, "`humidity` is " + format_short(*options.humidity),
                "it is relative: give a number from 0 to below 1; at 1 the liquid floods every gap");
  check_positive(options.surface_tension, "surface_tension", "N/m", false, "water has \"72.8 mN/m\"");
  check_positive(options.temperature, "temperature", "K", false, "give kelvins, such as \"293 K\"");
  check_positive(options.molar_volume, "molar_volume", "m^3/mol", false, "water has 1.8e-5");
  if (!(options.contact_angle >= 0 && options.contact_angle < std::numbers::pi / 2))
    throw Error(ErrorCode::bad_value,
                "`contact_angle` is " + format_short(options.contact_angle * 180 / std::numbers::pi) + " deg",
                "give an angle from 0 to below 90 deg: a liquid that does not wet does not attract");
}

// What is not computed beside an attraction across the gap.
void check_attraction(const Scene& scene, const std::string& effect) {
  const auto refuse = [&](const std::string& beside, const char* hint) {
    throw Error(ErrorCode::bad_value, quoted(effect) + " is not computed " + beside + " by this version",
                hint);
  };
  if (!std::holds_alternative<HalfSpaceOptions>(scene.elasticity))
    refuse("on box elements", "name elasticity=\"half_space\" beside it");
  if (scene.plasticity) refuse("together with `plasticity`", "leave one of both out");
  if (scene.sliding.tangential) refuse("together with `tangential`", "leave one of both out");
  if (scene.accuracy.precision == Accuracy::Precision::single)
    refuse("with `precision` \"single\"", "leave `precision` out");
  if (scene.accuracy.estimate != Accuracy::Estimate::none || scene.accuracy.asked)
    refuse("with an estimate of the error of the grid", "leave `estimate` and `error` out, give `tolerance`");
}

}  // namespace

std::string_view name(Boundary boundary) { return boundary == Boundary::periodic ? "periodic" : "free"; }

void check_tiles(const Grid& lower, const Grid& upper) {
  if (lower.nx == upper.nx && lower.ny == upper.ny && same_length(lower.size_x, upper.size_x) &&
      same_length(lower.size_y, upper.size_y))
    return;
  throw Error(ErrorCode::bad_value, "the lower body has " + tile(lower) + ", the upper body " + tile(upper),
              "both need the same `cells` and `size`: bring one to the other with `:resampled{cells=}` or "
              "`:cropped{...}`");
}

void check(const Scene& scene) {
  const Grid& grid = scene.lower.grid();
  if (!std::isnormal(grid.cell_area()) || !std::isnormal(grid.area()))
    throw Error(ErrorCode::bad_value,
                "the lower body is " + format_short(grid.size_x) + " m by " + format_short(grid.size_y) +
                    " m, an area beyond the range of a double",
                "check the unit of `size`");
  if (const auto* rough = std::get_if<Surface>(&scene.upper)) check_tiles(scene.lower.grid(), rough->grid());
  if (const auto* flat = std::get_if<Material>(&scene.upper)) check(*flat);
  const double tolerance = scene.accuracy.tolerance;
  if (!(tolerance >= 1e-15 && tolerance < 1))
    throw Error(ErrorCode::bad_value, "`tolerance` is " + format_short(tolerance),
                "give a number from 1e-15 to below 1");
  const bool single = scene.accuracy.precision == Accuracy::Precision::single;
  if (const auto* box = std::get_if<BoxOptions>(&scene.elasticity)) {
    if (box->stiffness && !(*box->stiffness > 0 && std::isfinite(*box->stiffness)))
      throw Error(ErrorCode::bad_value, "`stiffness` is " + format_short(*box->stiffness) + " Pa/m",
                  "give a finite value above zero, such as \"80 MPa/um\"");
    if (single)
      throw Error(ErrorCode::bad_value, "`precision` is \"single\" for box elements",
                  "their solution is a closed form in double precision; leave `precision` out");
  }
  if (const auto* layer = std::get_if<LayerOptions>(&scene.elasticity)) check_layer(*layer, scene);
  if (std::holds_alternative<RigidOptions>(scene.elasticity)) {
    if (single)
      throw Error(ErrorCode::bad_value, "`precision` is \"single\" for rigid bodies",
                  "their solution is a closed form in double precision; leave `precision` out");
    if (!scene.plasticity)
      throw Error(
          ErrorCode::bad_value,
          "rigid bodies carry a load only where they yield, and this scene does not name `plasticity`",
          "name `plasticity` beside elasticity=\"rigid\", or name another elasticity");
  }
  if (scene.plasticity) check(*scene.plasticity);
  if (scene.creep) {
    check(*scene.creep);
    if (!scene.plasticity)
      throw Error(ErrorCode::bad_value,
                  "`creep` softens the hardness that the effect `plasticity` limits pressure by",
                  "name `plasticity` beside it, or leave `creep` out");
  }
  // Without strength it is part of no solve, whatever else is in the scene.
  if (scene.adhesion) {
    check(*scene.adhesion);
    if (scene.adhesion->work > 0) check_attraction(scene, "adhesion");
  }
  if (scene.capillarity) {
    check(*scene.capillarity);
    if (scene.capillarity->pressure.value_or(1) > 0 && scene.capillarity->humidity.value_or(1) > 0)
      check_attraction(scene, "capillarity");
  }
  check(scene.sliding);
  if (scene.sliding.tangential && scene.plasticity)
    throw Error(ErrorCode::bad_value,
                "`tangential` is the difference of two elastic contacts, which `plasticity` does not leave",
                "copy the pressed bodies into a contact without `plasticity`, or leave one of both out");
}

double softening(const CreepOptions& creep, std::optional<double> dwell) {
  const auto growth = [&](double time) { return 1 + creep.rate * elementary::log1p(time / creep.onset); };
  return dwell ? growth(creep.reference) / growth(*dwell) : 1.0;
}

}  // namespace asperity
