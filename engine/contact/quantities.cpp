// SPDX-License-Identifier: GPL-3.0-or-later
// The orders, and the share of the outline, are those with which the estimate was within a factor of three of
// the true error most often over some 160 scenes (spheres, waves, self-affine, blasted; free, periodic,
// capped) on 128² and 256² cells against 1024² and exact answers. Margins and growths are those that were
// best on 150 such scenes of other seeds than tests/accuracy.
#include "engine/contact/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/core/constants.hpp"

namespace asperity {

namespace {

template <auto member>
double value(const State& state) {
  return static_cast<double>((state.*member)());
}
template <auto member>
std::optional<double> bound(const State& state) {
  return state.algebraic_error().*member;
}

double by_rise(const State&, double rise) { return rise; }
// Of a load for the approach: d pressure / d approach, per area of the tile or in all.
double pressure_by_rise(const State& state, double rise) {
  const double stiffness = state.stiffness();  // infinite of a full contact
  return std::isfinite(stiffness) ? -stiffness * rise : 0;
}
double load_by_rise(const State& state, double rise) {
  return pressure_by_rise(state, rise) * state.grid().area();
}
double energy_by_rise(const State& state, double rise) { return -state.load() * rise; }

using S = State;
using E = AlgebraicError;
using Kind = CellError::Kind;

const StateQuantity quantities[] = {
    {.name = "load",
     .called = "the load",
     .sentence = "force on the whole tile",
     .dimension = dimension::force,
     .value = value<&S::load>,
     .bound = bound<&E::load>,
     .bound_remark = "; 0 but for rounding where it was prescribed",
     .cells = CellError{1.5, 2, 1.2, 2, Kind::grid, load_by_rise, "; 0 where it was prescribed"}},
    {.name = "pressure",
     .called = "the load over the nominal area",
     .sentence = "load over the nominal area",
     .dimension = dimension::pressure,
     .value = value<&S::pressure>,
     .bound = bound<&E::pressure>,
     .cells = CellError{1.5, 2, 1.2, 2, Kind::grid, pressure_by_rise}},
    {.name = "attraction",
     .sentence = "force by which the bodies attract each other; the contacts carry load and this",
     .dimension = dimension::force,
     .value = value<&S::attraction>},
    {.name = "approach",
     .called = "the approach",
     .sentence = "from first touch of the bodies as they are now; after yielding that is the touch of the "
                 "worn faces, and `separation` is what one event compares with the next",
     .dimension = dimension::length,
     .value = value<&S::approach>,
     .bound = bound<&E::approach>,
     .cells = CellError{2, 2.5, 1, 1.5, Kind::approach, nullptr,
                        "; most of it is the highest peak between the nodes"}},
    {.name = "indentation",
     .called = "the indentation",
     .sentence = "approach over the peak-to-valley of the combined heights; flats have none: an error. The "
                 "key `flatten` counts another thing, the share by which the peak-to-valley under load has "
                 "fallen",
     .value = value<&S::indentation>,
     .bound = bound<&E::indentation>,
     .cells = CellError{1, 2, 1.2, 2}},
    {.name = "flatten",
     .called = "the flattening",
     .sentence = "share of that peak-to-valley pressed away",
     .value = value<&S::flatten>,
     .cells = CellError{1, 2, 1.2, 2}},
    {.name = "overlap_fraction",
     .sentence = "share of the tile on which the bodies face each other: 1 unless, on a free boundary, the "
                 "upper body is turned so that it does not cover the lower one. `pressure` and fractions are "
                 "of the whole tile",
     .value = value<&S::overlap_fraction>},
    {.name = "area",
     .called = "the real contact area",
     .sentence = "real contact area",
     .dimension = dimension::area,
     .value = value<&S::area>,
     .bound = bound<&E::area>,
     .cells = CellError{1.5, 1.25, 1, 1.25, Kind::raw_area}},
    {.name = "area_fraction",
     .called = "the area fraction",
     .sentence = "nodes in contact over all nodes",
     .value = value<&S::area_fraction>,
     .bound = bound<&E::area_fraction>,
     .cells = CellError{1.5, 1.25, 1, 1.25, Kind::raw_area, nullptr, "; most of it is its stepped outline"}},
    {.name = "corrected_area_fraction",
     .called = "the corrected area fraction",
     .sentence = "area fraction less the excess of its stepped outline",
     .value = value<&S::corrected_area_fraction>,
     .bound = bound<&E::corrected_area_fraction>,
     .cells = CellError{1.5, 2.25, 1, 1.5, Kind::corrected}},
    {.name = "contacts",
     .called = "the number of nodes in contact",
     .sentence = "nodes in contact",
     .value = value<&S::contacts>,
     .count = true,
     .bound = bound<&E::contacts>},
    {.name = "spots",
     .sentence = "regions of contact joined by an edge",
     .value = value<&S::spots>,
     .count = true},
    {.name = "spots8",
     .sentence = "regions of contact joined by an edge or a corner",
     .value = value<&S::spots8>,
     .count = true},
    {.name = "peak_pressure",
     .called = "the greatest pressure",
     .sentence = "greatest pressure",
     .dimension = dimension::pressure,
     .value = value<&S::peak_pressure>,
     .bound = bound<&E::peak_pressure>,
     .cells = CellError{1, 3, 1.5, 3, Kind::peak}},
    {.name = "separation",
     .called = "the separation",
     .sentence = "of the mean planes of the bodies where they face each other, undeformed, as they stand "
                 "under this load",
     .dimension = dimension::length,
     .value = value<&S::separation>,
     .bound = bound<&E::separation>,
     .cells = CellError{2, 3, 1.2, 1.6, Kind::grid, by_rise}},
    {.name = "mean_gap",
     .called = "the mean gap",
     .sentence = "mean of the gap, 0 in contact, over the part of the tile where the bodies face each other",
     .dimension = dimension::length,
     .value = value<&S::mean_gap>,
     .bound = bound<&E::mean_gap>,
     .cells = CellError{2, 3.5, 1.2, 1.6, Kind::grid, by_rise}},
    {.name = "stiffness",
     .called = "the stiffness",
     .sentence =
         "d pressure / d approach at this contact set; math.huge where all of a periodic half-space touches",
     .dimension = dimension::stiffness,
     .value = value<&S::stiffness>,
     .cells = CellError{1.5, 3, 0.95, 2.75, Kind::grid, nullptr, ", which is solved for on each grid"}},
    {.name = "secant_stiffness",
     .called = "pressure over approach",
     .sentence = "pressure over approach; math.huge of flats that carry a load and come no nearer",
     .dimension = dimension::stiffness,
     .value = value<&S::secant_stiffness>,
     .bound = bound<&E::secant_stiffness>,
     .cells = CellError{1.5, 3, 0.95, 2.75}},
    {.name = "energy",
     .called = "the elastic energy",
     .sentence = "elastic energy in the tile",
     .dimension = dimension::energy,
     .value = value<&S::energy>,
     .bound = bound<&E::energy>,
     .cells = CellError{2, 3, 1.2, 1.5, Kind::grid, energy_by_rise}},
    {.name = "plastic_volume",
     .called = "the plastic volume",
     .sentence = "volume this press took from both bodies",
     .dimension = dimension::volume,
     .value = value<&S::plastic_volume>,
     .effect = "plasticity",
     .bound = bound<&E::plastic_volume>,
     .cells = CellError{1.5, 2, 1, 1.5}},
    {.name = "plastic_fraction",
     .called = "the plastic fraction",
     .sentence = "share of the tile at the cap",
     .value = value<&S::plastic_fraction>,
     .effect = "plasticity",
     .bound = bound<&E::plastic_fraction>,
     .cells = CellError{1, 1.25, 1.2, 1.5, Kind::steady}},
};

std::string error_sentence(const StateQuantity& quantity, std::string_view remark) {
  std::string sentence = "of " + std::string(quantity.called);
  if (!quantity.effect.empty()) sentence += "; needs " + std::string(quantity.effect);
  return sentence + std::string(remark);
}

}  // namespace

std::span<const StateQuantity> state_quantities() { return quantities; }

const StateQuantity* find_quantity(std::string_view name) {
  const auto* found = std::ranges::find(quantities, name, &StateQuantity::name);
  return found == std::end(quantities) ? nullptr : found;
}

std::string bound_sentence(const StateQuantity& quantity) {
  return error_sentence(quantity, quantity.bound_remark);
}
std::string estimate_sentence(const StateQuantity& quantity) {
  return error_sentence(quantity, quantity.cells ? quantity.cells->remark : "");
}

}  // namespace asperity
