// SPDX-License-Identifier: GPL-3.0-or-later
// Orders and outline shares: estimates most often within a factor of three of the true error, over about 160
// scenes (spheres, waves, self-affine, blasted; free, periodic, capped) on 128² and 256² cells against 1024²
// and exact answers. Margins and growths: best on 150 such scenes with seeds other than tests/accuracy.
#include "engine/contact/quantities.hpp"

#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

double by_rise(const State&, double rise) { return rise; }
// d pressure / d approach times the rise.
double pressure_by_rise(const State& state, double rise) {
  const double stiffness = state.stiffness();  // infinite at full contact
  return std::isfinite(stiffness) ? -stiffness * rise : 0;
}
double load_by_rise(const State& state, double rise) {
  return pressure_by_rise(state, rise) * state.grid().area();
}
double energy_by_rise(const State& state, double rise) { return -state.load() * rise; }

using S = State;
using E = AlgebraicError;
using Kind = CellError::Kind;

const StateQuantity of_every_state[] = {
    {.name = "load",
     .called = "the load",
     .sentence = "force on the whole tile",
     .dimension = dimension::force,
     .value = quantity_value<&S::load>,
     .bound = quantity_bound<&E::load>,
     .bound_remark = "; 0 but for rounding where it was prescribed",
     .cells = CellError{1.5, 2, 1.2, 2, Kind::grid, load_by_rise, "; 0 where it was prescribed"}},
    {.name = "pressure",
     .called = "the load over the nominal area",
     .sentence = "load over the nominal area",
     .dimension = dimension::pressure,
     .value = quantity_value<&S::pressure>,
     .bound = quantity_bound<&E::pressure>,
     .cells = CellError{1.5, 2, 1.2, 2, Kind::grid, pressure_by_rise}},
    {.name = "attraction",
     .sentence = "force by which the bodies attract each other; the contacts carry load and this",
     .dimension = dimension::force,
     .value = quantity_value<&S::attraction>},
    {.name = "approach",
     .called = "the approach",
     .sentence = "from first touch of the bodies before this press; after yielding this is the touch of the "
                 "worn faces. Compare events by `displacement`",
     .dimension = dimension::length,
     .value = quantity_value<&S::approach>,
     .bound = quantity_bound<&E::approach>,
     .cells = CellError{2, 2.5, 1, 1.5, Kind::approach, nullptr,
                        "; most of it is the highest peak between the nodes"}},
    {.name = "displacement",
     .called = "the displacement",
     .sentence = "travel since first touch of the unworn bodies, as a testing machine records it: `approach` "
                 "and the loss of height in earlier events",
     .dimension = dimension::length,
     .value = quantity_value<&S::displacement>,
     .bound = quantity_bound<&E::approach>,
     .bound_remark = ", of this press alone"},
    {.name = "indentation",
     .called = "the indentation",
     .sentence = "approach over the peak-to-valley of the combined heights; flats have none: an error. The "
                 "key `flatten` counts another thing, the share by which the peak-to-valley under load has "
                 "fallen",
     .value = quantity_value<&S::indentation>,
     .bound = quantity_bound<&E::indentation>,
     .cells = CellError{1, 2, 1.2, 2}},
    {.name = "flatten",
     .called = "the flattening",
     .sentence = "share of that peak-to-valley pressed away",
     .value = quantity_value<&S::flatten>,
     .cells = CellError{1, 2, 1.2, 2}},
    {.name = "overlap_fraction",
     .sentence = "share of the tile on which the bodies face each other: 1 unless, on a free boundary, the "
                 "upper body is turned so that it does not cover the lower one. `pressure` and fractions are "
                 "of the whole tile",
     .value = quantity_value<&S::overlap_fraction>},
    {.name = "area",
     .called = "the real contact area",
     .sentence = "real contact area",
     .dimension = dimension::area,
     .value = quantity_value<&S::area>,
     .bound = quantity_bound<&E::area>,
     .cells = CellError{1.5, 1.25, 1, 1.25, Kind::raw_area}},
    {.name = "area_fraction",
     .called = "the area fraction",
     .sentence = "nodes in contact over all nodes",
     .value = quantity_value<&S::area_fraction>,
     .bound = quantity_bound<&E::area_fraction>,
     .cells = CellError{1.5, 1.25, 1, 1.25, Kind::raw_area, nullptr, "; most of it is its stepped outline"}},
    {.name = "corrected_area_fraction",
     .called = "the corrected area fraction",
     .sentence = "area fraction less the excess of its stepped outline; of half-spaces pressed with "
                 "accuracy={ error= }, the share of the tile within an outline between the nodes",
     .value = quantity_value<&S::corrected_area_fraction>,
     .bound = quantity_bound<&E::corrected_area_fraction>,
     .cells = CellError{1.5, 2.25, 1, 1.5, Kind::corrected}},
    {.name = "nodes_in_contact",
     .called = "the number of nodes in contact",
     .sentence = "nodes in contact",
     .value = quantity_value<&S::contacts>,
     .count = true,
     .bound = quantity_bound<&E::contacts>},
    {.name = "spots",
     .sentence = "regions of contact joined by an edge",
     .value = quantity_value<&S::spots>,
     .count = true},
    {.name = "spots8",
     .sentence = "regions of contact joined by an edge or a corner",
     .value = quantity_value<&S::spots8>,
     .count = true},
    {.name = "peak_pressure",
     .called = "the greatest pressure",
     .sentence = "greatest pressure",
     .dimension = dimension::pressure,
     .value = quantity_value<&S::peak_pressure>,
     .bound = quantity_bound<&E::peak_pressure>,
     .cells = CellError{1, 3, 1.5, 3, Kind::peak}},
    {.name = "separation",
     .called = "the separation",
     .sentence =
         "of the mean planes of the bodies where they face each other, without elastic deformation and "
         "with all that has yielded, under this load too",
     .dimension = dimension::length,
     .value = quantity_value<&S::separation>,
     .bound = quantity_bound<&E::separation>,
     .cells = CellError{2, 3, 1.2, 1.6, Kind::grid, by_rise}},
    {.name = "mean_gap",
     .called = "the mean gap",
     .sentence = "mean of the gap, 0 in contact, over the part of the tile where the bodies face each other",
     .dimension = dimension::length,
     .value = quantity_value<&S::mean_gap>,
     .bound = quantity_bound<&E::mean_gap>,
     .cells = CellError{2, 3.5, 1.2, 1.6, Kind::grid, by_rise}},
    {.name = "stiffness",
     .called = "the stiffness",
     .sentence =
         "d pressure / d approach at this contact set; math.huge where all of a periodic half-space touches",
     .dimension = dimension::stiffness,
     .value = quantity_value<&S::stiffness>,
     .cells = CellError{1.5, 3, 0.95, 2.75, Kind::grid, nullptr, ", which is solved for on each grid"}},
    {.name = "secant_stiffness",
     .called = "pressure over approach",
     .sentence = "pressure over approach; math.huge of flats that carry a load and come no nearer",
     .dimension = dimension::stiffness,
     .value = quantity_value<&S::secant_stiffness>,
     .bound = quantity_bound<&E::secant_stiffness>,
     .cells = CellError{1.5, 3, 0.95, 2.75}},
    {.name = "energy",
     .called = "the elastic energy",
     .sentence = "elastic energy in the tile",
     .dimension = dimension::energy,
     .value = quantity_value<&S::energy>,
     .bound = quantity_bound<&E::energy>,
     .cells = CellError{2, 3, 1.2, 1.5, Kind::grid, energy_by_rise}},
};

std::string error_sentence(const StateQuantity& quantity, std::string_view remark) {
  std::string sentence = "of " + std::string(quantity.called);
  if (!quantity.effect.empty()) sentence += "; needs " + std::string(quantity.effect);
  return sentence + std::string(remark);
}

}  // namespace

double StateQuantity::of(const State& state) const {
  if (!effect.empty() && !state.effects().names(effect)) refuse_without(quoted(name), quoted(effect));
  return value(state);
}

std::span<const StateQuantity> state_quantities() {
  static const std::vector<StateQuantity> quantities = [] {
    std::vector<StateQuantity> all(std::begin(of_every_state), std::end(of_every_state));
    for (const Effect* effect : known_effects()) {
      if (effect->quantities == nullptr) continue;
      for (StateQuantity quantity : effect->quantities()) {
        quantity.effect = effect->name;
        all.push_back(quantity);
      }
    }
    return all;
  }();
  return quantities;
}

const StateQuantity* find_quantity(std::string_view name) {
  const auto all = state_quantities();
  const auto found = std::ranges::find(all, name, &StateQuantity::name);
  return found == all.end() ? nullptr : &*found;
}

std::string bound_sentence(const StateQuantity& quantity) {
  return error_sentence(quantity, quantity.bound_remark);
}
std::string estimate_sentence(const StateQuantity& quantity) {
  return error_sentence(quantity, quantity.cells ? quantity.cells->remark : "");
}

}  // namespace asperity
