// SPDX-License-Identifier: GPL-3.0-or-later
// The classes behind st.error: what there is of errors, and the bound of each quantity.
#include "bindings/lua/contact/state_error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/lua/contact/discretisation_error.hpp"
#include "bindings/lua/registry/record.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

const AlgebraicError& bounds(Call& call) { return call.self<AlgebraicError>(); }

template <auto member>
Values bound(Call& call) {
  return {Value(bounds(call).*member)};
}

// Of a quantity whose value a press by `flatten` leaves to the solver.
template <auto member>
Values bound_of_load(Call& call) {
  const auto& found = bounds(call).*member;
  if (!found)
    throw Error(ErrorCode::bad_state,
                quoted(call.function_name()) + " has no algebraic bound in a state pressed by `flatten`",
                "the others are bounds at the load that was found; press by `pressure` or `approach`");
  return {Value(*found)};
}

// Of a quantity that only plasticity gives.
template <auto member>
const auto& plastic(Call& call) {
  const auto& found = bounds(call).*member;
  if (!found)
    throw Error(ErrorCode::bad_state, quoted(call.function_name()) +
                                          " needs the effect `plasticity`, which this scene does not name");
  return *found;
}

template <auto member>
Values plastic_bound(Call& call) {
  return {Value(plastic<member>(call))};
}

double share(const AlgebraicError& e, std::int64_t nodes) {
  return static_cast<double>(nodes) / static_cast<double>(e.nodes);
}

std::string describe_bounds(const void* self) {
  const auto& e = *static_cast<const AlgebraicError*>(self);
  Record record;
  const auto add = [&](const char* name, const Value& value, Dimension dimension = {}) {
    if (!value.is_nil()) record.add(name, value, dimension);
  };
  add("load", e.load, dimension::force);
  add("pressure", e.pressure, dimension::pressure);
  add("approach", e.approach, dimension::length);
  add("separation", e.separation, dimension::length);
  add("mean_gap", e.mean_gap, dimension::length);
  add("energy", e.energy, dimension::energy);
  add("peak_pressure", e.peak_pressure, dimension::pressure);
  add("area_fraction", e.area_fraction);
  add("plastic_volume", e.plastic_volume, dimension::volume);
  add("plastic_fraction", e.plastic_fraction);
  std::string text = "algebraic error, at most";
  for (const Record::Entry& entry : record.entries)
    text += "\n  " + entry.field + std::string(18 - entry.field.size(), ' ') + show(entry);
  if (!std::isfinite(e.approach))
    text += "\n  inf: nothing can be said, as of bodies that attract each other";
  return text + "\n  nodes in contact  " + std::to_string(e.contact_bracket.low) + " to " +
         std::to_string(e.contact_bracket.high) + " of " + std::to_string(e.nodes);
}

std::string describe_errors(const void* self) {
  const auto& state = static_cast<const StateError*>(self)->state;
  const DiscretisationError grid{state};
  return describe_bounds(&state.algebraic_error()) + "\n" + class_of<DiscretisationError>().describe(&grid);
}

const Class& make_bounds_class() {
  using E = AlgebraicError;
  static const Class type = [] {
    Class c;
    c.name = "AlgebraicError";
    c.article_name = "an algebraic error";
    c.sentence =
        "Bounds on how far the numbers of a state are from the exact solution on the same grid, in the units "
        "of "
        "the quantities; math.huge where nothing can be said, as of bodies that attract each other. What "
        "they cost to find is no part of the cost "
        "of "
        "the state.";
    c.describe = describe_bounds;
    c.fields = {
        {"load", "number", "0 but for rounding where the load was prescribed", dimension::force,
         bound_of_load<&E::load>},
        {"pressure", "number", "of the load over the nominal area", dimension::pressure,
         bound_of_load<&E::pressure>},
        {"approach", "number", "of the approach", dimension::length, bound<&E::approach>},
        {"indentation", "number", "of the indentation", {}, bound<&E::indentation>},
        {"separation", "number", "of the separation", dimension::length, bound<&E::separation>},
        {"mean_gap", "number", "of the mean gap", dimension::length, bound<&E::mean_gap>},
        {"energy", "number", "of the elastic energy", dimension::energy, bound<&E::energy>},
        {"peak_pressure", "number", "of the greatest pressure", dimension::pressure,
         bound<&E::peak_pressure>},
        {"secant_stiffness", "number", "of pressure over approach", dimension::stiffness,
         bound_of_load<&E::secant_stiffness>},
        {"contacts", "number", "of the number of nodes in contact", {}, bound<&E::contacts>},
        {"area", "number", "of the real contact area", dimension::area, bound<&E::area>},
        {"area_fraction", "number", "of the area fraction", {}, bound<&E::area_fraction>},
        {"corrected_area_fraction",
         "number",
         "of the corrected area fraction",
         {},
         bound<&E::corrected_area_fraction>},
        {"plastic_volume", "number", "of the plastic volume; needs plasticity", dimension::volume,
         plastic_bound<&E::plastic_volume>},
        {"plastic_fraction",
         "number",
         "of the plastic fraction; needs plasticity",
         {},
         plastic_bound<&E::plastic_fraction>},
        {"contacts_low",
         "integer",
         "nodes that are surely in contact",
         {},
         [](Call& call) -> Values { return {bounds(call).contact_bracket.low}; }},
        {"contacts_high",
         "integer",
         "those and the nodes that may be",
         {},
         [](Call& call) -> Values { return {bounds(call).contact_bracket.high}; }},
        {"area_low", "number", "area surely in contact", dimension::area,
         [](Call& call) -> Values {
           return {static_cast<double>(bounds(call).contact_bracket.low) * bounds(call).node_area};
         }},
        {"area_high", "number", "that and what may be", dimension::area,
         [](Call& call) -> Values {
           return {static_cast<double>(bounds(call).contact_bracket.high) * bounds(call).node_area};
         }},
        {"area_fraction_low",
         "number",
         "share of the nodes surely in contact",
         {},
         [](Call& call) -> Values { return {share(bounds(call), bounds(call).contact_bracket.low)}; }},
        {"area_fraction_high",
         "number",
         "that and the share that may be",
         {},
         [](Call& call) -> Values { return {share(bounds(call), bounds(call).contact_bracket.high)}; }},
        {"plastic_fraction_low",
         "number",
         "share of the nodes surely at the cap; needs plasticity",
         {},
         [](Call& call) -> Values { return {share(bounds(call), plastic<&E::yielded_bracket>(call).low)}; }},
        {"plastic_fraction_high",
         "number",
         "that and the share that may be; needs plasticity",
         {},
         [](Call& call) -> Values { return {share(bounds(call), plastic<&E::yielded_bracket>(call).high)}; }},
        {"cost",
         "table",
         "seconds, transforms and bytes of finding these bounds",
         {},
         [](Call& call) -> Values { return {cost_record(bounds(call).cost, "cost")}; }},
    };
    return c;
  }();
  return type;
}

}  // namespace

template <>
const Class& class_of<AlgebraicError>() {
  return make_bounds_class();
}

template <>
const Class& class_of<StateError>() {
  static const Class type = [] {
    Class c;
    c.name = "StateError";
    c.article_name = "the error of a state";
    c.sentence =
        "How far a state is from exact, in parts that are never mixed. A part is found when it is read.";
    c.describe = describe_errors;
    c.fields = {
        {"algebraic",
         "AlgebraicError",
         "bounds against the exact solution on the same grid",
         {},
         [](Call& call) -> Values { return {object(call.self<StateError>().state.algebraic_error())}; }},
        {"discretisation",
         "DiscretisationError",
         "estimates against an ever finer grid; needs accuracy={ estimate=true } or { error= }",
         {},
         [](Call& call) -> Values { return {object(DiscretisationError{call.self<StateError>().state})}; }},
    };
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
