// SPDX-License-Identifier: GPL-3.0-or-later
// Fields and methods of a state (a contact under load). Fields are computed on first use.
#include "bindings/lua/contact/state_class.hpp"

#include <algorithm>

#include "bindings/lua/contact/discretisation_error.hpp"
#include "bindings/lua/contact/state_error.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/accuracy/companion_grids.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/contact/state_file.hpp"
#include "engine/contact/state_limits.hpp"
#include "engine/surface/io/xdmf.hpp"

namespace asperity::lua {

namespace {

using Contacting = asperity::State;

Values quantity_value(Call& call) {
  const StateQuantity& quantity = *find_quantity(call.function_name());
  const double value = quantity.of(call.self<Contacting>());
  return {quantity.count ? Value(static_cast<std::int64_t>(value)) : Value(value)};
}

const RecordType<StateCost>& state_cost_type() {
  using C = StateCost;
  static const RecordType<C> type{
      "StateCost",
      "cost",
      "What a press took to compute.",
      {{"seconds", [](const C& c) { return c.total.seconds; }, dimension::time, "by the clock"},
       {"transforms", [](const C& c) { return c.total.transforms; },
        "Fourier transforms, in equivalents of the finest grid"},
       {"bytes", [](const C& c) { return c.total.bytes; }, "greatest memory beyond what was held before"},
       {"by_effect", "table<string, Cost>", [](const C& c) { return cost_by_effect(c.by_effect); },
        "the parts of the effects that ran, and of the estimate of errors"}}};
  return type;
}

const RecordType<Certificate>& certificate_type() {
  static const RecordType<Certificate> type{
      "Certificate", "certificate", "How far the contact conditions are from being met, each relative.", [] {
        std::vector<RecordField<Certificate>> fields = certificate_fields();
        fields.emplace_back("attraction", &Certificate::attraction,
                            "greatest distance of the attraction from its law, over its greatest; 0 without "
                            "attraction across the gap");
        return fields;
      }()};
  return type;
}

Value state_numbers(const std::vector<double>& values) {
  return Value::Numbers(std::make_shared<const Array<double>>(values.begin(), values.end()));
}

Values spot_areas(Call& call) { return {state_numbers(call.self<Contacting>().spot_areas())}; }

Dimension field_dimension(const std::string& name) {
  if (name == "pressure") return dimension::pressure;
  return name == "contact" ? dimension::number : dimension::length;
}

Values field(Call& call) {
  const Contacting& state = call.self<Contacting>();
  const std::string name = call.text(1, "name");
  return {object(NamedField{name, state.grid(), state.field(name), field_dimension(name)})};
}

Values deformed(Call& call) { return {object(call.self<Contacting>().deformed(call.text(1, "body")))}; }

const Block<HistogramOptions>& histogram_block() {
  using O = HistogramOptions;
  static const Block<O> block{"distribution",
                              {integer("bins", &O::bins, between(1, 100000), "number of bins"),
                               flag("log", &O::log, "bins of equal ratio instead of equal width")}};
  return block;
}

const RecordType<Histogram>& distribution_type() {
  using H = Histogram;
  static const RecordType<H> type{
      "Distribution",
      "distribution",
      "How pressures, gaps or spot areas are distributed, in the SI unit of these.",
      {{"edges", &H::edges, "of the bins, ascending: one more than there are bins"},
       {"counts", &H::counts, "values in each bin; the last bin holds its upper edge too"},
       {"density", &H::density, "probability density in each bin, which integrates to 1"},
       {"values", &H::values, "how many were counted"},
       {"mean", &H::mean, "of the values"}}};
  return type;
}
Values distribution(Call& call) {
  const HistogramOptions options = call.options(histogram_block(), 2);
  return {distribution_type()(call.self<Contacting>().distribution(call.text(1, "name"), options))};
}

struct StateFileKeys {
  std::vector<std::string> fields;
};
const Block<StateFileKeys>& state_file_block() {
  using O = StateFileKeys;
  static const Block<O> block{
      "write",
      {custom<O>("fields", "string[]", "which fields to write; without it all the state has",
                 [](const Argument& value, const OptionInfo& info, O& o, Problems& problems) {
                   if (!value.is_table() || value.length() == 0)
                     return detail::wrong_type(value, info, "a list of names such as {\"pressure\", \"gap\"}",
                                               problems);
                   for (int k = 1; k <= value.length(); ++k)
                     value.element(k, [&](const Argument& part) {
                       if (!part.is_text())
                         return detail::wrong_type(part, info, "the name of a field", problems);
                       const std::string name(part.text());
                       if (std::find(o.fields.begin(), o.fields.end(), name) == o.fields.end())
                         o.fields.push_back(name);
                     });
                 })}};
  return block;
}
Values write_state(Call& call) {
  const StateFileKeys keys = call.options(state_file_block(), 2);
  const std::string name = call.text(1, "path");
  const std::string path = writable_path(call, name);
  if (has_xdmf_beside(path)) writable_path(call, xdmf_path(name).string());
  write_state(call.self<Contacting>(), path, keys.fields);
  return {path};
}

// One line with the discretisation error, then one line per limit. A closed state has one line.
std::string describe_state(const void* self) {
  const auto& state = *static_cast<const Contacting*>(self);
  if (state.closed()) return state.text();
  std::string of_the_cells = discretisation_text(state);
  if (state.chosen()) of_the_cells += "; " + state.chosen()->values_text() + "; " + state.chosen()->text();
  std::string text = state.text(of_the_cells);
  for (const std::string& sentence : state_limits(state)) text += "\n  warning: " + sentence;
  return text;
}
std::size_t state_bytes(const void* self) {
  return static_cast<std::size_t>(bytes_held_with_other_grids(*static_cast<const Contacting*>(self)));
}

}  // namespace

std::vector<RecordField<Certificate>> certificate_fields() {
  using C = Certificate;
  return {{"penetration", &C::penetration,
           "greatest overlap of the bodies where the pressure is below its cap, over the rms height of both"},
          {"tension", &C::tension, "greatest tension, over the mean pressure"},
          {"complementarity", &C::complementarity,
           "gap under the pressures, in the mean weighted with them, over that rms height"},
          {"load", &C::load, "distance of the mean pressure from the one asked for, over it"},
          {"cap", &C::cap, "greatest excess of the pressure over its cap, over the cap; 0 without one"}};
}

// data table
template <>
const Class& class_of<asperity::State>() {
  using S = Contacting;
  static const Class type = [] {
    Class c;
    c.name = "State";
    c.article_name = "a state";
    c.sentence =
        "A contact under load: an immutable value whose fields are computed when they are first read.";
    c.drawing =
        "upper body     -----+-------------------------  at first touch of the unworn bodies\n"
        "                    | displacement    +-------  at first touch of the worn bodies\n"
        "                    |                 | approach\n"
        "               -----+---+-------------+-------  under this load\n"
        "                        | separation\n"
        "lower body     ~~~~~~~~~+~~~~~~~~~~~~~~~~~~~~~  mean plane, with all that has yielded\n";
    c.describe = describe_state;
    c.native_bytes = state_bytes;
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
    const std::vector<Getter> others = {
        getter<S>("preload", "number[]",
                  "the branch of bodies that attract each other: values of the prescribed quantity gone to "
                  "in turn before this one; empty where they were brought together from apart",
                  [](const S& of) { return state_numbers(of.preload()); }),
        getter<&S::iterations>("iterations", "integer", "of the solver; 0 for a closed form"),
        getter<&S::residual>("residual", "number", "greatest entry of the certificate"),
        getter<S>(
            "certificate", "Certificate",
            "how far the contact conditions are from being met, each relative; where the bodies attract each "
            "other these bound tractions and not lengths: gaps and approaches may be off by more",
            [](const S& of) { return certificate_type()(of.certificate()); }),
        getter<&S::converged>("converged", "boolean",
                              "whether every entry of the certificate is within the tolerance"),
        getter<S>("solver", "string", "what found the solution",
                  [](const S& of) { return std::string(of.solver()); }),
        getter<S>(
            "warnings", "string[]",
            "where these numbers say little of real bodies: few nodes in contact, a contact at the rim of "
            "a free tile, steep slopes, pressures near the modulus or above the hardness",
            [](const S& of) { return text_list(state_limits(of)); }),
        getter<S>("effects_run", "string[]", "effects that were computed",
                  [](const S& of) { return text_list(of.effects_run()); }),
        getter<S>("effects_off", "string[]", "effects that the scene does not name",
                  [](const S& of) { return text_list(of.effects_off()); }),
        getter<S>("error", "StateError", "how far these numbers are from exact",
                  [](const S& of) { return object(StateError{of}); }),
        getter<S>("chosen", "ChosenAccuracy?",
                  "cells and tolerance that were chosen for accuracy={ error= }, and why; nil otherwise",
                  [](const S& of) { return chosen_record(of); }),
        getter<S>("cost", "StateCost", "seconds, transforms, bytes, and by effect",
                  [](const S& of) { return state_cost_type()(of.cost()); }),
        getter<&S::digest>("digest", "string", "of pressures and approach"),
    };
    c.fields.insert(c.fields.end(), others.begin(), others.end());
    c.methods = {
        {.name = "spot_areas",
         .body = spot_areas,
         .sentence = "Areas of the contact regions in m^2, largest first.",
         .returns = "number[]",
         .example = "local areas = st:spot_areas()"},
        {.name = "field",
         .body = field,
         .sentence = "A field over the tile: pressure, gap, contact, displacement, or the plastic part of "
                     "the approach. Where nothing faces the lower body there is no pressure, and the gap is "
                     "missing (nan).",
         .parameters = {{"name", "\"pressure\"|\"gap\"|\"contact\"|\"displacement\"|\"plastic\"", "which"}},
         .returns = "Field",
         .example = "st:field \"pressure\":picture \"pressure.png\""},
        {.name = "deformed",
         .body = deformed,
         .sentence = "A body under load, in its own frame.",
         .parameters = {{"body", "\"lower\"|\"upper\"", "which"}},
         .returns = "Surface",
         .example = "local flattened = st:deformed \"lower\""},
        {.name = "write",
         .body = write_state,
         .sentence = "Writes the fields as maps of shape (ny, nx) into one HDF5 file, with load, approach, "
                     "area, certificate and digest as its attributes, and an .xdmf beside it for ParaView.",
         .parameters = {{"path", "string", "an .h5 under the run directory"}},
         .options = &state_file_block(),
         .options_optional = true,
         .returns = "string",
         .example = "st:write(\"state.h5\", { fields={\"pressure\", \"gap\"} })",
         .heavy = true},
        {.name = "distribution",
         .body = distribution,
         .sentence =
             "Probability density of the pressures in contact, of the open gaps or of the spot areas.",
         .parameters = {{"name", "\"pressure\"|\"gap\"|\"spot_area\"", "of what"}},
         .options = &histogram_block(),
         .options_optional = true,
         .returns = "Distribution",
         .example = "local d = st:distribution(\"pressure\", { bins=40 })"},
    };
    c.results = {&certificate_type(), &chosen_accuracy_type(), &tried_grid_type(), &state_cost_type(),
                 &cost_type(),        &distribution_type()};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
