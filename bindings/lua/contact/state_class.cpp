// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/state_class.hpp"

#include <algorithm>

#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/accuracy/companion_grids.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/contact/regions.hpp"
#include "engine/surface/io/hdf5_surface.hpp"

namespace asperity::lua {

namespace {

using Contacting = asperity::State;

Values quantity_value(Call& call) {
  const StateQuantity& quantity = *find_quantity(call.function_name());
  const double value = quantity.of(call.self<Contacting>());
  return {quantity.count ? Value(static_cast<std::int64_t>(value)) : Value(value)};
}

const RecordType<StateCost> state_cost_type{
    "StateCost",
    "cost",
    "Computing cost of a press.",
    {{"seconds", [](const StateCost& c) { return c.total.seconds; }, dimension::time, "by the clock"},
     {"transforms", [](const StateCost& c) { return c.total.transforms; },
      "Fourier transforms, in equivalents of the finest grid"},
     {"bytes", [](const StateCost& c) { return c.total.bytes; },
      "greatest memory beyond the memory held before"},
     {"by_effect", "table<string, Cost>", [](const StateCost& c) { return cost_by_effect(c.by_effect); },
      "the parts of the effects that ran, and of the estimate of errors"}}};

const RecordType<Certificate> certificate_type{
    "Certificate", "certificate", "Violations of the contact conditions, each relative.", [] {
      std::vector<RecordField<Certificate>> fields = certificate_fields();
      fields.emplace_back("attraction", &Certificate::attraction,
                          "greatest distance of the attraction from its law, over its greatest; 0 without "
                          "attraction across the gap");
      return fields;
    }()};

Dimension field_dimension(const std::string& name) {
  if (name == "pressure") return dimension::pressure;
  return name == "contact" ? dimension::number : dimension::length;
}

Values field(Call& call) {
  const Contacting& state = call.self<Contacting>();
  const std::string name = call.text(1, "name", joined(asperity::State::field_names()));
  return {object(NamedField{name, state.grid(), state.field(name), field_dimension(name)})};
}

const Block<HistogramOptions> histogram_block{
    {integer("bins", &HistogramOptions::bins, between(1, 100000), "number of bins"),
     flag("log", &HistogramOptions::log, "bins of equal ratio instead of equal width")}};

const RecordType<Histogram> distribution_type{
    "Distribution",
    "distribution",
    "Distribution of pressures, gaps or spot areas, in SI units.",
    {{"edges", &Histogram::edges, "of the bins, ascending: one more than there are bins"},
     {"counts", &Histogram::counts, "values in each bin; the last bin holds its upper edge too"},
     {"density", &Histogram::density, "probability density in each bin, which integrates to 1"},
     {"values", &Histogram::values, "how many were counted"},
     {"mean", &Histogram::mean, "of the values"}}};

struct PathKeys {
  PathDirection along = PathDirection::x;
};
const Block<PathKeys> path_block{
    {choice("along", &PathKeys::along, {{"x", PathDirection::x}, {"y", PathDirection::y}},
            "the direction of the path")
         .defaults_to("\"x\"")}};

struct StateFileKeys {
  std::vector<std::string> fields;
};
const Block<StateFileKeys> state_file_block{{custom<StateFileKeys>(
    "fields", "string[]", "which fields to write; without it all the state has",
    [](const Argument& value, const OptionInfo& info, StateFileKeys& o, Problems& problems) {
      if (!value.is_table() || value.length() == 0)
        return detail::wrong_type(value, info, "a list of names such as {\"pressure\", \"gap\"}", problems);
      value.elements([&](const Argument& part) {
        if (!part.is_text()) return detail::wrong_type(part, info, "the name of a field", problems);
        const std::string name(part.text());
        if (std::find(o.fields.begin(), o.fields.end(), name) == o.fields.end()) o.fields.push_back(name);
      });
    })}};
Values write_state(Call& call) {
  const StateFileKeys keys = call.options(state_file_block, 2);
  const std::string name = call.text(1, "path");
  const std::string path = writable_path(call, name);
  if (has_xdmf_beside(path)) writable_path(call, xdmf_path(name).string());
  write_state(call.self<Contacting>(), path, keys.fields);
  return {path};
}

// One line with the discretisation error, then one line per limit. A closed state has one line.
std::string describe_state(const Contacting& state) {
  if (state.closed()) return state.text();
  std::string of_the_cells = discretisation_text(state);
  if (state.chosen()) of_the_cells += "; " + state.chosen()->values_text() + "; " + state.chosen()->text();
  std::string text = state.text(of_the_cells);
  for (const std::string& sentence : state_limits(state)) text += "\n  warning: " + sentence;
  return text;
}

}  // namespace

std::vector<RecordField<Certificate>> certificate_fields() {
  using C = Certificate;
  return {{"penetration", &C::penetration,
           "greatest overlap of the bodies where the pressure is below its cap, over the rms height of both"},
          {"tension", &C::tension, "greatest tension, over the mean pressure"},
          {"complementarity", &C::complementarity,
           "gap under the pressures, in the mean weighted with them, over that rms height"},
          {"load", &C::load, "distance of the mean pressure from the requested one, over the latter"},
          {"cap", &C::cap, "greatest excess of the pressure over its cap, over the cap; 0 without one"}};
}

// data table
Class make_class(For<asperity::State>) {
  using S = Contacting;
  Class c{"State", "a state",
          "A contact under load: an immutable value whose fields are computed when they are first read."};
  c.drawing =
      "upper body     -----+-------------------------  at first touch of the unworn bodies\n"
      "                    | displacement    +-------  at first touch of the worn bodies\n"
      "                    |                 | approach\n"
      "               -----+---+-------------+-------  under this load\n"
      "                        | separation\n"
      "lower body     ~~~~~~~~~+~~~~~~~~~~~~~~~~~~~~~  mean plane, with all that has yielded\n";
  c.describe = text_of<describe_state>;
  c.native_bytes = from_value(
      [](const Contacting& state) { return static_cast<std::size_t>(bytes_held_with_other_grids(state)); });
  c.digest = text_of<&Contacting::digest>;
  c.enter = [](const void* self, Ledger& ledger) {
    ledger.add_effects(static_cast<const Contacting*>(self)->cost().by_effect);
  };
  c.equal = have_one_digest<Contacting>;
  for (const StateQuantity& quantity : state_quantities())
    c.fields.push_back({std::string(quantity.name), quantity.count ? "integer" : "number",
                        std::string(quantity.sentence) +
                            (quantity.effect.empty() ? "" : "; needs " + std::string(quantity.effect)),
                        quantity.dimension, quantity_value});
  append(c.fields,
         getter<S>("preload", "number[]",
                   "the branch of bodies that attract each other: values of the prescribed quantity gone to "
                   "in turn before this one; empty where they were brought together from apart",
                   [](const S& of) { return of.preload(); }),
         getter<&S::iterations>("iterations", "integer", "of the solver; 0 for a closed form"),
         getter<&S::residual>("residual", "number", "greatest entry of the certificate"),
         getter<S>("certificate", "Certificate",
                   "violations of the contact conditions, each relative; for bodies that attract each other "
                   "these bound tractions and not lengths: gaps and approaches may be off by more",
                   [](const S& of) { return certificate_type(of.certificate()); }),
         getter<&S::converged>("converged", "boolean",
                               "whether every entry of the certificate is within the tolerance"),
         getter<S>("solver", "string", "the method of the solution", [](const S& of) { return of.solver(); }),
         getter<S>("warnings", "string[]",
                   "doubts about the model: few nodes in contact, a contact at the rim of a free tile, steep "
                   "slopes, pressures near the modulus or above the hardness",
                   [](const S& of) { return state_limits(of); }),
         getter<&S::effects_run>("effects_run", "string[]", "effects that were computed"),
         getter<&S::effects_off>("effects_off", "string[]", "effects that the scene does not name"),
         getter<S>("error", "StateError", "how far these numbers are from exact",
                   [](const S& of) { return object(StateError{of}); }),
         getter<S>("chosen", "ChosenAccuracy?",
                   "cells and tolerance that were chosen for accuracy={ error= }, and why; nil otherwise",
                   [](const S& of) { return chosen_record(of); }),
         getter<S>("cost", "StateCost", "seconds, transforms, bytes, and by effect",
                   [](const S& of) { return state_cost_type(of.cost()); }),
         getter<&S::digest>("digest", "string", "of pressures and approach"));
  c.methods = {
      {.name = "spot_areas",
       .body = method([](const Contacting& state) { return state.spot_areas(); }),
       .sentence = "Areas of the contact regions in m^2, largest first.",
       .returns = "number[]",
       .example = "local areas = st:spot_areas()"},
      {.name = "open_path",
       .body = method([](const Contacting& state, Call& call) {
         return state.open_path(call.options(path_block).along);
       }),
       .sentence = "Whether the nodes without contact join one side of the tile to the other by edges, so "
                   "that a fluid gets through. Across the path a periodic tile continues. Rough faces lose "
                   "the path at 35 to 60 % of the area.",
       .options = optional(path_block),
       .returns = "boolean",
       .example = "print(st:open_path{ along=\"y\" })"},
      {.name = "field",
       .body = field,
       .sentence = "A field over the tile: pressure, gap, contact, displacement, or the plastic part of the "
                   "approach. Lower nodes without a counterpart have no pressure, and a missing gap (nan).",
       .parameters = {{"name", "\"pressure\"|\"gap\"|\"contact\"|\"displacement\"|\"plastic\"", "which"}},
       .returns = "Field",
       .example = "st:field \"pressure\":picture \"pressure.png\""},
      {.name = "deformed",
       .body =
           method([](const Contacting& state, Call& call) { return state.deformed(call.text(1, "body")); }),
       .sentence = "A body under load, in its own frame.",
       .parameters = {{"body", "\"lower\"|\"upper\"", "which"}},
       .returns = "Surface",
       .example = "local flattened = st:deformed \"lower\""},
      {.name = "write",
       .body = write_state,
       .sentence = "Writes the fields as maps of shape (ny, nx) into one HDF5 file, with load, approach, "
                   "area, certificate and digest as attributes, and an .xdmf file for ParaView.",
       .parameters = {{"path", "string", "an .h5 under the run directory"}},
       .options = optional(state_file_block),
       .returns = "string",
       .example = "st:write(\"state.h5\", { fields={\"pressure\", \"gap\"} })",
       .heavy = true},
      {.name = "distribution",
       .body = method([](const Contacting& state, Call& call) {
         const HistogramOptions options = call.options(histogram_block, 2);
         return distribution_type(state.distribution(call.text(1, "name"), options));
       }),
       .sentence = "Probability density of the pressures in contact, of the open gaps or of the spot areas.",
       .parameters = {{"name", "\"pressure\"|\"gap\"|\"spot_area\"", "of what"}},
       .options = optional(histogram_block),
       .returns = "Distribution",
       .example = "local d = st:distribution(\"pressure\", { bins=40 })"},
  };
  c.results = {&certificate_type, &chosen_accuracy_type, &tried_grid_type,
               &state_cost_type,  &cost_type(),          &distribution_type};
  return c;
}

}  // namespace asperity::lua
