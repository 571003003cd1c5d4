// SPDX-License-Identifier: GPL-3.0-or-later
// Output of quantities.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

struct Kind {
  Dimension dimension;
  std::string_view name, example, si_unit;
  std::vector<DisplayUnit> display;  // smallest first; empty: only the SI unit
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {dimension::number, "a plain number", "0.5", "", {}},
      {dimension::length,
       "a length",
       "250 um",
       "m",
       {{"pm", 1e-12}, {"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3}, {"m", 1}, {"km", 1e3}}},
      {dimension::area,
       "an area",
       "1 mm^2",
       "m^2",
       {{"nm^2", 1e-18}, {"um^2", 1e-12}, {"mm^2", 1e-6}, {"m^2", 1}}},
      {dimension::volume,
       "a volume",
       "20 um^3",
       "m^3",
       {{"nm^3", 1e-27}, {"um^3", 1e-18}, {"mm^3", 1e-9}, {"m^3", 1}}},
      {dimension::mass,
       "a mass",
       "4.3 g",
       "kg",
       {{"ug", 1e-9}, {"mg", 1e-6}, {"g", 1e-3}, {"kg", 1}, {"t", 1e3}}},
      {dimension::time, "a time", "10 min", "s", {{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}}},
      {dimension::angle, "an angle", "37 deg", "rad", {{"deg", std::numbers::pi / 180}}},
      {dimension::force,
       "a force",
       "5 N",
       "N",
       {{"pN", 1e-12}, {"nN", 1e-9}, {"uN", 1e-6}, {"mN", 1e-3}, {"N", 1}, {"kN", 1e3}, {"MN", 1e6}}},
      {dimension::pressure,
       "a pressure",
       "152.78 MPa",
       "Pa",
       {{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}}},
      {dimension::stiffness,
       "a stiffness per area",
       "80 MPa/um",
       "Pa/m",
       {{"Pa/m", 1}, {"kPa/m", 1e3}, {"MPa/m", 1e6}, {"GPa/m", 1e9}, {"MPa/um", 1e12}, {"GPa/um", 1e15}}},
      {dimension::energy,
       "an energy",
       "1 nJ",
       "J",
       {{"fJ", 1e-15}, {"pJ", 1e-12}, {"nJ", 1e-9}, {"uJ", 1e-6}, {"mJ", 1e-3}, {"J", 1}, {"kJ", 1e3}}},
      {dimension::energy_per_area,
       "an energy per area",
       "50 mJ/m^2",
       "J/m^2",
       {{"uJ/m^2", 1e-6}, {"mJ/m^2", 1e-3}, {"J/m^2", 1}, {"kJ/m^2", 1e3}}},
      {dimension::density, "a density", "2830 kg/m^3", "kg/m^3", {{"kg/m^3", 1}}},
      {dimension::speed,
       "a speed",
       "50 um/s",
       "m/s",
       {{"nm/s", 1e-9}, {"um/s", 1e-6}, {"mm/s", 1e-3}, {"m/s", 1}}},
      {dimension::acceleration, "an acceleration", "9.81 m/s^2", "m/s^2", {{"m/s^2", 1}}},
      {dimension::frequency, "a frequency", "200 Hz", "Hz", {{"Hz", 1}, {"kHz", 1e3}, {"MHz", 1e6}}},
  };
  return all;
}

const Kind* find(Dimension dimension) {
  for (const Kind& kind : kinds())
    if (kind.dimension == dimension) return &kind;
  return nullptr;
}

DisplayUnit display_unit_for(double magnitude, Dimension dimension, int digits) {
  const Kind* kind = find(dimension);
  if (kind == nullptr || kind->display.empty() || !std::isfinite(magnitude)) return {si_unit(dimension), 1};
  const std::vector<DisplayUnit>& units = kind->display;
  if (magnitude == 0) {
    const auto si =
        std::find_if(units.begin(), units.end(), [](const DisplayUnit& u) { return u.factor == 1; });
    return si == units.end() ? units.front() : *si;
  }
  DisplayUnit best = units.front();
  // 1000 of one unit, as printed, becomes 1 of the next.
  const double prints_as_one = 1 - 0.5 * elementary::pow(10.0, -digits);
  for (const DisplayUnit& unit : units)
    if (magnitude >= unit.factor * prints_as_one) best = unit;
  return best;
}

}  // namespace

std::string describe(Dimension dimension) {
  if (const Kind* kind = find(dimension)) return std::string(kind->name);
  return "a quantity in " + si_unit(dimension);
}

std::optional<Dimension> dimension_named(std::string_view name) {
  for (const Kind& kind : kinds())
    if (kind.name.substr(kind.name.find(' ') + 1) == name) return kind.dimension;
  return {};
}

std::vector<std::string> dimension_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name.substr(kind.name.find(' ') + 1));
  return names;
}

std::string example_quantity(Dimension dimension) {
  if (const Kind* kind = find(dimension)) return std::string(kind->example);
  return "1 " + si_unit(dimension);
}

std::string si_unit(Dimension dimension) {
  if (const Kind* kind = find(dimension)) return std::string(kind->si_unit);
  std::string text;
  for (const auto& [symbol, power] : {std::pair{"kg", dimension.mass}, std::pair{"m", dimension.length},
                                      std::pair{"s", dimension.time}, std::pair{"rad", dimension.angle}}) {
    if (power == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(symbol);
    if (power != 1) text += "^" + std::to_string(power);
  }
  return text;
}

std::vector<std::string> usual_units(Dimension dimension) {
  std::vector<std::string> names;
  if (const Kind* kind = find(dimension))
    for (const DisplayUnit& unit : kind->display) names.push_back(unit.name);
  if (names.empty() && !si_unit(dimension).empty()) names.push_back(si_unit(dimension));
  // Accepted, but never printed.
  if (dimension == dimension::time) names.insert(names.end(), {"min", "h"});
  if (dimension == dimension::angle) names.push_back("rad");
  return names;
}

std::string format_quantity(double value, Dimension dimension, int digits) {
  const DisplayUnit unit = display_unit_for(std::abs(value), dimension, digits);
  const std::string number = format_short(value / unit.factor, digits);
  return unit.name.empty() ? number : number + " " + unit.name;
}

DisplayUnit display_unit(double largest_magnitude, Dimension dimension) {
  constexpr int axis_digits = 6;
  return display_unit_for(std::abs(largest_magnitude), dimension, axis_digits);
}

}  // namespace asperity
