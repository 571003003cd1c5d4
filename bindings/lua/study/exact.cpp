// SPDX-License-Identifier: GPL-3.0-or-later
// lab.exact: closed-form answers. A Weierstrass–Mandelbrot height takes a few thousand cosines, all others a
// few operations.
#include <limits>
#include <optional>

#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/surface/surface_keys.hpp"
#include "engine/study/exact/closed_forms.hpp"

namespace asperity::lua {

namespace {

// Exactly one is given.
struct PressedKeys {
  std::optional<double> load, approach;
};
template <class K>
void one_of_load_and_approach(K& keys, Problems& problems) {
  if (keys.load.has_value() == keys.approach.has_value())
    problems.push_back("give `load` or `approach`, one of them");
}
Option<PressedKeys> load_key() {
  return quantity("load", &PressedKeys::load, dimension::force, above(0), "normal force");
}
Option<PressedKeys> approach_key() {
  return quantity("approach", &PressedKeys::approach, dimension::length, above(0), "from first touch");
}

struct HertzKeys : PressedKeys {
  double radius = 0, modulus = 0;
  std::shared_ptr<JunctionLaw> law;
};
const Block<HertzKeys> hertz_block{
    {quantity("radius", &HertzKeys::radius, dimension::length, above(0), "of the paraboloid").required(),
     quantity("modulus", &HertzKeys::modulus, dimension::pressure, above(0), "E* of the two bodies")
         .required(),
     load_key(), approach_key(),
     native<JunctionLaw>("friction", &HertzKeys::law, "Law", "a law, from lab.friction",
                         "adds the friction force and its ratio to the load")},
    one_of_load_and_approach<HertzKeys>};
// A law adds friction force and coefficient.
struct HertzContact : exact::Hertz {
  std::optional<double> force{}, mu{};
};
const RecordType<HertzContact> hertz_type{
    "Hertz",
    "Hertz",
    "A paraboloid on a half-space.",
    {{"load", &HertzContact::load, dimension::force, "normal force"},
     {"approach", &HertzContact::approach, dimension::length, "from first touch"},
     {"contact_radius", &HertzContact::contact_radius, dimension::length, "of the circle of contact"},
     {"area", &HertzContact::area, dimension::area, "of contact"},
     {"peak_pressure", &HertzContact::peak_pressure, dimension::pressure, "in the middle"},
     {"energy", &HertzContact::energy, dimension::energy, "elastic"},
     RecordField<HertzContact>("force", &HertzContact::force, dimension::force,
                               "that slides it; with the key `friction`")
         .where_known(),
     RecordField<HertzContact>("mu", &HertzContact::mu, "that force over the load; with the key `friction`")
         .where_known()}};
Values hertz(Call& call) {
  const HertzKeys keys = call.options(hertz_block);
  HertzContact h{keys.load ? exact::hertz_under_load(keys.radius, keys.modulus, *keys.load)
                           : exact::hertz_at_approach(keys.radius, keys.modulus, *keys.approach)};
  if (keys.law) {
    h.force = exact::friction(h, keys.law->tau0(), keys.law->alpha(),
                              keys.law->tau_max().value_or(std::numeric_limits<double>::infinity()));
    h.mu = *h.force / h.load;
  }
  return {hertz_type(h)};
}

struct WaveKeys {
  double amplitude = 0, wavelength = 0, modulus = 0, pressure = 0;
};
const Block<WaveKeys> wave_block{
    {quantity("amplitude", &WaveKeys::amplitude, dimension::length, above(0),
              "height of a crest above the mean")
         .required(),
     quantity("wavelength", &WaveKeys::wavelength, dimension::length, above(0), "length of a wave")
         .required(),
     quantity("modulus", &WaveKeys::modulus, dimension::pressure, above(0), "E* of the two bodies")
         .required(),
     quantity("pressure", &WaveKeys::pressure, dimension::pressure, above(0), "mean pressure").required()}};

const RecordType<exact::WavyContact> wavy_type{
    "WavyContact",
    "wave",
    "A wavy half-space against a flat.",
    {{"full_pressure", &exact::WavyContact::full_pressure, dimension::pressure,
      "mean pressure from which everything touches"},
     {"area_fraction", &exact::WavyContact::area_fraction, "real contact area over the nominal one"},
     {"peak_pressure", &exact::WavyContact::peak_pressure, dimension::pressure, "greatest pressure"},
     {"mean_gap", &exact::WavyContact::mean_gap, dimension::length, "over the whole tile"},
     {"approach", &exact::WavyContact::approach, dimension::length, "from first touch"},
     {"energy_per_area", &exact::WavyContact::energy_per_area, dimension::energy_per_area,
      "elastic, over the nominal area"}}};
Values one_wave(Call& call) {
  const WaveKeys k = call.options(wave_block);
  return {wavy_type(exact::one_wave(k.amplitude, k.wavelength, k.modulus, k.pressure))};
}
Values crossed_waves(Call& call) {
  const WaveKeys k = call.options(wave_block);
  Record record = wavy_type(exact::crossed_waves(k.amplitude, k.wavelength, k.modulus, k.pressure));
  record.name = "crossed waves";
  return {std::move(record)};
}

struct PerssonKeys {
  double modulus = 0, rms_slope = 0, pressure = 0, hardness = std::numeric_limits<double>::infinity();
};
const Block<PerssonKeys> persson_block{
    {quantity("modulus", &PerssonKeys::modulus, dimension::pressure, above(0), "E* of the two bodies")
         .required(),
     number("rms_slope", &PerssonKeys::rms_slope, above(0), "of the combined heights").required(),
     quantity("pressure", &PerssonKeys::pressure, dimension::pressure, above(0), "mean pressure").required(),
     quantity("hardness", &PerssonKeys::hardness, dimension::pressure, above(0).or_never(),
              "greatest pressure")}};
const RecordType<exact::PerssonArea> persson_type{
    "PerssonArea",
    "Persson",
    "Real contact area by Persson's theory, as shares of the nominal area.",
    {{"area_fraction", [](const exact::PerssonArea& p) { return p.elastic + p.capped; }, "all that touches"},
     {"elastic_fraction", &exact::PerssonArea::elastic, "below the hardness"},
     {"plastic_fraction", &exact::PerssonArea::capped, "at the hardness; 0 without one"}}};
Values persson(Call& call) {
  const PerssonKeys k = call.options(persson_block);
  return {persson_type(exact::persson_area(k.modulus, k.rms_slope, k.pressure, k.hardness))};
}

struct BoxParaboloidKeys : PressedKeys {
  double radius = 0, stiffness = 0;
};
const Block<BoxParaboloidKeys> box_paraboloid_block{
    {quantity("radius", &BoxParaboloidKeys::radius, dimension::length, above(0), "of the paraboloid")
         .required(),
     quantity("stiffness", &BoxParaboloidKeys::stiffness, dimension::stiffness, above(0), "of the elements")
         .required(),
     load_key(), approach_key()},
    one_of_load_and_approach<BoxParaboloidKeys>};
const RecordType<exact::BoxParaboloid> box_paraboloid_type{
    "BoxParaboloid",
    "box paraboloid",
    "A paraboloid on independent box elements.",
    {{"load", &exact::BoxParaboloid::load, dimension::force, "normal force"},
     {"approach", &exact::BoxParaboloid::approach, dimension::length, "from first touch"},
     {"area", &exact::BoxParaboloid::area, dimension::area, "of contact"},
     {"energy", &exact::BoxParaboloid::energy, dimension::energy, "elastic"}}};
Values box_paraboloid(Call& call) {
  const BoxParaboloidKeys keys = call.options(box_paraboloid_block);
  return {box_paraboloid_type(
      keys.load ? exact::box_paraboloid_under_load(keys.radius, keys.stiffness, *keys.load)
                : exact::box_paraboloid_at_approach(keys.radius, keys.stiffness, *keys.approach))};
}

struct HeightKeys : WeierstrassMandelbrotOptions {
  int i = -1, j = -1;
};
const Block<HeightKeys> height_block{
    [] {
      auto keys = weierstrass_mandelbrot_keys<HeightKeys>();
      keys.push_back(
          custom<HeightKeys>(
              "node", "{integer, integer}", "the node, {i, j} from 0",
              [](const Argument& value, const OptionInfo& info, HeightKeys& k, Problems& problems) {
                if (!value.is_table() || value.length() != 2)
                  return detail::wrong_type(value, info, "two whole numbers {i, j}", problems);
                for (int part = 1; part <= 2; ++part)
                  value.element(part, [&](const Argument& index) {
                    if (auto n = detail::read_integer(index, info, between(0, max_cells - 1), problems))
                      (part == 1 ? k.i : k.j) = static_cast<int>(*n);
                  });
              })
              .required());
      return keys;
    }(),
    [](HeightKeys& k, Problems& problems) {
      if (k.i >= k.nx || k.j >= k.ny)
        problems.push_back("`node` is {" + std::to_string(k.i) + ", " + std::to_string(k.j) +
                           "}, outside the " + std::to_string(k.nx) + " x " + std::to_string(k.ny) +
                           " cells");
      if (k.phases == WavePhases::function)
        problems.push_back(
            "`phases` is a function; an exact height has \"golden\" phases, or those of `seed`");
      if (k.band == WaveBand::resolved)
        problems.push_back("`band` is \"resolved\"; an exact height is of all waves");
    }};
Values height(Call& call) {
  const HeightKeys keys = call.options(height_block);
  return {exact::weierstrass_mandelbrot_height(keys, keys.i, keys.j)};
}

}  // namespace

Module exact_module() {
  return {
      .path = "lab.exact",
      .sentence = "Answers in closed form, to hold a computed one against.",
      .functions =
          {{.name = "hertz",
            .body = hertz,
            .sentence =
                "A paraboloid on an elastic half-space (Hertz 1882), frictionless and without adhesion.",
            .options = &hertz_block,
            .returns = "Hertz",
            .example = "print(lab.exact.hertz{ radius=\"1 mm\", modulus=\"70 GPa\", load=\"1 N\" })"},
           {.name = "wave",
            .body = one_wave,
            .sentence = "A wavy half-space h cos(2 pi x / wavelength) on a flat (Westergaard 1939).",
            .options = &wave_block,
            .returns = "WavyContact",
            .example = "print(lab.exact.wave{ amplitude=0.01, wavelength=1, modulus=1, pressure=0.01 })"},
           {.name = "crossed_waves",
            .body = crossed_waves,
            .sentence = "h cos(2 pi x / wavelength) cos(2 pi y / wavelength) on a flat, in full contact "
                        "(Johnson, Greenwood & Higginson 1985).",
            .options = &wave_block,
            .returns = "WavyContact",
            .example =
                "print(lab.exact.crossed_waves{ amplitude=0.01, wavelength=1, modulus=1, pressure=0.05 })"},
           {.name = "persson",
            .body = persson,
            .sentence = "Real contact area of a rough half-space by Persson's theory (2001), with a hardness "
                        "or without: a theory, 25 % below simulations at pressures of 0.01 to 0.04 E*h', h' "
                        "the rms slope, and 20 % at 0.1 E*h'.",
            .options = &persson_block,
            .returns = "PerssonArea",
            .example = "print(lab.exact.persson{ modulus=1, rms_slope=0.1, pressure=0.01 })"},
           {.name = "box_paraboloid",
            .body = box_paraboloid,
            .sentence = "A paraboloid on independent box elements.",
            .options = &box_paraboloid_block,
            .returns = "BoxParaboloid",
            .example = "print(lab.exact.box_paraboloid{ radius=1, stiffness=1, load=1e-3 })"},
           {.name = "weierstrass_mandelbrot",
            .body = height,
            .sentence = "One height of a Weierstrass-Mandelbrot surface to the last digit of a double, "
                        "summed in thousands of bits.",
            .options = &height_block,
            .returns = "number",
            .example = "print(lab.exact.weierstrass_mandelbrot{ cells=150, D=2.5, phases=\"golden\", "
                       "node={75, 40} })",
            .heavy = true}},
      .results = {&hertz_type, &wavy_type, &persson_type, &box_paraboloid_type},
  };
}

}  // namespace asperity::lua
