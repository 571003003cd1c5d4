// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration/registration.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/surface.hpp"

namespace asperity::lua {

namespace {

const Block<RegistrationOptions> registration_block{
    {quantity("angle", &RegistrationOptions::angle, dimension::angle, at_least(0),
              "greatest turn that is looked for, to either side; from half a turn on the whole circle, "
              "which takes some ten times as long as a few degrees")
         .defaults_to("\"360 deg\""),
     quantity("at_most", &RegistrationOptions::at_most, dimension::length, above(0),
              "greatest `shift` that is looked for; without it whatever leaves a tenth of the maps on top of "
              "each other")}};

struct PlanarShift {
  PlanarShift(double along_x, double along_y) : x(along_x), y(along_y) {}
  double x, y;  // m
};
const RecordType<PlanarShift> registration_shift_type{"RegistrationShift",
                                                      "shift",
                                                      "A shift in the plane, or its standard uncertainty.",
                                                      {{"x", &PlanarShift::x, dimension::length, "along x"},
                                                       {"y", &PlanarShift::y, dimension::length, "along y"}}};

struct PlanarTilt {
  PlanarTilt(double along_x, double along_y) : x(along_x), y(along_y) {}
  double x, y;
};
const RecordType<PlanarTilt> registration_tilt_type{
    "RegistrationTilt",
    "tilt",
    "Slopes of a map above another, or their standard uncertainties.",
    {{"x", &PlanarTilt::x, "slope along x"}, {"y", &PlanarTilt::y, "slope along y"}}};

const RecordType<RegistrationUncertainty> registration_uncertainty_type{
    "RegistrationUncertainty",
    "standard uncertainties",
    "Standard uncertainties of a registration, from leaving out one of 4 x 4 tiles of the map at a time.",
    {{"shift", [](const RegistrationUncertainty& u) { return PlanarShift(u.shift_x, u.shift_y); },
      registration_shift_type, "of the shift"},
     {"angle", &RegistrationUncertainty::angle, dimension::angle, "of the turn"},
     {"tilt", [](const RegistrationUncertainty& u) { return PlanarTilt(u.tilt_x, u.tilt_y); },
      registration_tilt_type, "of the slopes"},
     {"lift", &RegistrationUncertainty::lift, dimension::length,
      "of the height; the pull of wear shallower than the noise is not in it"}}};

const RecordType<Registration> registration_type{
    "Registration",
    "registration",
    "Position of a later map on an earlier map: the first nodes coincide, then the later map is turned "
    "counter-clockwise by `angle` about the centre of its nodes and moved by `shift`.",
    {{"surface", "Surface", [](const Registration& r) -> Value { return object(r.surface); },
      "the map after, on the cells of the map before, less `tilt` and `lift`: not measured where the map "
      "after does not reach or one of the nodes around was not measured; between its nodes a cubic spline"},
     {"shift", [](const Registration& r) { return PlanarShift(r.shift_x, r.shift_y); },
      registration_shift_type, "from the map after to that before, of the centre of the map after"},
     {"angle", &Registration::angle, dimension::angle,
      "from the map after to that before, counter-clockwise, from -pi to pi"},
     {"tilt", [](const Registration& r) { return PlanarTilt(r.tilt_x, r.tilt_y); }, registration_tilt_type,
      "slopes of the map after above that before, along the latter's axes"},
     {"lift", &Registration::lift, dimension::length,
      "height of the map after above that before, at the centre of the map after, where neither is worn"},
     {"u", &Registration::u, registration_uncertainty_type, "their standard uncertainties"},
     {"scale", &Registration::scale, "of lengths and heights: 1, neither is ever stretched"},
     {"residual", &Registration::residual, dimension::length,
      "agreement on unworn surface: 1.4826 times the median of the differences above zero, both maps "
      "smoothed by one cell"},
     {"overlap", &Registration::overlap,
      "share of the map before's measured nodes where `surface` is measured"},
     {"explained", &Registration::explained,
      "share of the variance of the heights that the placement explains, where they are not worn"},
     {"second_best", &Registration::second_best,
      "the same of the best placement elsewhere, on coarser maps; near to `explained` it is a warning"}}};

}  // namespace

std::vector<const RecordInfo*> registration_types() {
  return {&registration_type, &registration_uncertainty_type, &registration_shift_type,
          &registration_tilt_type};
}

Function registered_to_method() {
  return {
      .name = "registered_to",
      .body = [](Call& call) -> Values {
        const Surface& before = call.object<Surface>(1, "before");
        const RegistrationOptions options = call.options(registration_block, 2);
        return {
            registration_type(registered(call.self<Surface>(), before, options, call.session().monitor()))};
      },
      .sentence =
          "Registered to an earlier map of the same surface: shift, turn and tilt are found through wear, "
          "noise and holes, and nothing is stretched. Wear removes height: points lower than before do not "
          "pull. Cells and sizes of the two may differ. An error where the maps cannot tell: too little "
          "overlap, other ground, ground that repeats itself or has no features in some direction.",
      .parameters = {{"before", "Surface", "the earlier map"}},
      .options = optional(registration_block),
      .returns = "Registration",
      .example = "local worn = s:registered_to(s, { angle=\"5 deg\" }).surface",
      .heavy = true};
}

}  // namespace asperity::lua
