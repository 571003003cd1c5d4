// SPDX-License-Identifier: GPL-3.0-or-later
// s:registered_to(before) and its record.
#include "engine/metrology/registration/registration.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/surface.hpp"

namespace asperity::lua {

namespace {

const Block<RegistrationOptions>& registration_block() {
  using O = RegistrationOptions;
  static const Block<O> block{
      "registered_to",
      {Option<O>(quantity("angle", &O::angle, dimension::angle, at_least(0),
                          "greatest turn that is looked for, to either side; from half a turn on the whole "
                          "circle, which takes some ten times as long as a few degrees"))
           .defaults_to("\"360 deg\""),
       quantity("at_most", &O::at_most, dimension::length, above(0),
                "greatest `shift` that is looked for; without it whatever leaves a tenth of the maps on top "
                "of each other")}};
  return block;
}

struct PlanarShift {
  double x, y;  // m
};
const RecordType<PlanarShift>& registration_shift_type() {
  static const RecordType<PlanarShift> type{"RegistrationShift",
                                            "shift",
                                            "A shift in the plane, or its standard uncertainty.",
                                            {{"x", &PlanarShift::x, dimension::length, "along x"},
                                             {"y", &PlanarShift::y, dimension::length, "along y"}}};
  return type;
}

struct PlanarTilt {
  double x, y;
};
const RecordType<PlanarTilt>& registration_tilt_type() {
  static const RecordType<PlanarTilt> type{
      "RegistrationTilt",
      "tilt",
      "Slopes of one map above another, or their standard uncertainties.",
      {{"x", &PlanarTilt::x, "slope along x"}, {"y", &PlanarTilt::y, "slope along y"}}};
  return type;
}

const RecordType<RegistrationUncertainty>& registration_uncertainty_type() {
  using U = RegistrationUncertainty;
  static const RecordType<U> type{
      "RegistrationUncertainty",
      "standard uncertainties",
      "Standard uncertainties of a registration, from leaving out one of 4 x 4 tiles of the map at a time.",
      {{"shift",
        [](const U& u) {
          return PlanarShift{u.shift_x, u.shift_y};
        },
        registration_shift_type(), "of the shift"},
       {"angle", &U::angle, dimension::angle, "of the turn"},
       {"tilt",
        [](const U& u) {
          return PlanarTilt{u.tilt_x, u.tilt_y};
        },
        registration_tilt_type(), "of the slopes"},
       {"lift", &U::lift, dimension::length,
        "of the height; the pull of wear shallower than the noise is not in it"}}};
  return type;
}

const RecordType<Registration>& registration_type() {
  using R = Registration;
  static const RecordType<R> type{
      "Registration",
      "registration",
      "Where a map measured after lies on one measured before: turned counter-clockwise by `angle` about the "
      "centre of its nodes, then moved by `shift`, both maps' first nodes having lain on each other.",
      {{"surface", "Surface", [](const R& r) -> Value { return object(r.surface); },
        "the map after, on the cells of the map before, less `tilt` and `lift`: not measured where the map "
        "after does not reach or one of the nodes around was not measured; between its nodes a cubic spline"},
       {"shift",
        [](const R& r) {
          return PlanarShift{r.shift_x, r.shift_y};
        },
        registration_shift_type(), "from the map after to that before, of the centre of the map after"},
       {"angle", &R::angle, dimension::angle,
        "from the map after to that before, counter-clockwise, from -pi to pi"},
       {"tilt",
        [](const R& r) {
          return PlanarTilt{r.tilt_x, r.tilt_y};
        },
        registration_tilt_type(), "slopes of the map after above that before, along the latter's axes"},
       {"lift", &R::lift, dimension::length,
        "height of the map after above that before, at the centre of the map after, where neither is worn"},
       {"u", &R::u, registration_uncertainty_type(), "their standard uncertainties"},
       {"scale", &R::scale, "of lengths and heights: 1, neither is ever stretched"},
       {"residual", &R::residual, dimension::length,
        "how well unworn ground agrees: 1.4826 times the median of the differences above zero, both maps "
        "smoothed by one cell"},
       {"overlap", &R::overlap, "share of the map before's measured nodes where `surface` is measured"},
       {"explained", &R::explained,
        "share of the variance of the heights that the placement explains, where they are not worn"},
       {"second_best", &R::second_best,
        "the same of the best placement elsewhere, on coarser maps; near to `explained` it is a warning"}}};
  return type;
}

Values register_to(Call& call) {
  const Surface& before = call.object<Surface>(1, "before");
  const RegistrationOptions options = call.options(registration_block(), 2);
  return {registration_type()(registered(call.self<Surface>(), before, options, call.session().monitor()))};
}

}  // namespace

std::vector<const RecordInfo*> registration_types() {
  return {&registration_type(), &registration_uncertainty_type(), &registration_shift_type(),
          &registration_tilt_type()};
}

Function registered_to_method() {
  return {
      .name = "registered_to",
      .body = register_to,
      .sentence =
          "Laid on a map of the same ground measured before: shift, turn and tilt are found through wear, "
          "noise and holes, and nothing is stretched. Wear takes height away: what stands lower than before "
          "does not pull. Cells and sizes of the two may differ. An error where the maps cannot tell: too "
          "little overlap, other ground, ground that repeats itself or has no features in some direction.",
      .parameters = {{"before", "Surface", "what it is laid on"}},
      .options = &registration_block(),
      .options_optional = true,
      .returns = "Registration",
      .example = "local worn = s:registered_to(s, { angle=\"5 deg\" }).surface",
      .heavy = true};
}

}  // namespace asperity::lua
