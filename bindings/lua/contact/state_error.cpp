// SPDX-License-Identifier: GPL-3.0-or-later
// The classes of st.error: the parts of the error, and the bound of each quantity.
#include "bindings/lua/contact/state_error.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/contact/discretisation_error.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/contact/algebraic_error.hpp"
#include "engine/contact/quantities.hpp"

namespace asperity::lua {

namespace {

const AlgebraicError& bounds(const StateBounds& of) { return of.state.algebraic_error(); }

Values bound(Call& call) {
  const std::optional<double> found =
      find_quantity(call.function_name())->bound(call.self<StateBounds>().state);
  return {found ? Value(*found) : Value()};
}

double share(const AlgebraicError& e, std::int64_t nodes) {
  return static_cast<double>(nodes) / static_cast<double>(e.nodes);
}

Value yielded_share(const StateBounds& of, std::int64_t NodeBracket::*end) {
  const AlgebraicError& e = bounds(of);
  return e.yielded_bracket ? Value(share(e, (*e.yielded_bracket).*end)) : Value();
}

std::string describe_bounds(const void* self) {
  const asperity::State& state = static_cast<const StateBounds*>(self)->state;
  const AlgebraicError& e = state.algebraic_error();
  Record record;
  for (const char* name : {"load", "pressure", "approach", "separation", "mean_gap", "energy",
                           "peak_pressure", "area_fraction", "plastic_volume", "plastic_fraction"}) {
    const StateQuantity& quantity = *find_quantity(name);
    if (const auto bound = quantity.bound(state)) record.add(name, *bound, quantity.dimension);
  }
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
  const StateBounds of_state{state};
  return describe_bounds(&of_state) + "\n" + class_of<DiscretisationError>().describe(&grid);
}

}  // namespace

template <>
const Class& class_of<StateBounds>() {
  static const Class type = [] {
    Class c;
    c.name = "AlgebraicError";
    c.article_name = "an algebraic error";
    c.sentence =
        "Bounds on how far the numbers of a state are from the exact solution on the same grid, in the units "
        "of the quantities; math.huge where nothing can be said, as of bodies that attract each other. "
        "Quantities without a bound are nil: load, pressure and secant_stiffness of a state pressed by "
        "`flatten`, whose other bounds are at the load found, and quantities of an effect that the scene "
        "does not name. The cost of the bounds is no part of the cost of the state.";
    c.describe = describe_bounds;
    for (const StateQuantity& quantity : state_quantities())
      if (quantity.bound != nullptr)
        c.fields.push_back(
            {std::string(quantity.name), "number?", bound_sentence(quantity), quantity.dimension, bound});
    const std::vector<Getter> brackets = {
        getter<StateBounds>("contacts_low", "integer", "nodes that are surely in contact",
                            [](const StateBounds& of) { return bounds(of).contact_bracket.low; }),
        getter<StateBounds>("contacts_high", "integer", "those and the nodes that may be",
                            [](const StateBounds& of) { return bounds(of).contact_bracket.high; }),
        getter<StateBounds>(
            "area_low", "number", "area surely in contact",
            [](const StateBounds& of) {
              return static_cast<double>(bounds(of).contact_bracket.low) * bounds(of).node_area;
            },
            dimension::area),
        getter<StateBounds>(
            "area_high", "number", "that and what may be",
            [](const StateBounds& of) {
              return static_cast<double>(bounds(of).contact_bracket.high) * bounds(of).node_area;
            },
            dimension::area),
        getter<StateBounds>(
            "area_fraction_low", "number", "share of the nodes surely in contact",
            [](const StateBounds& of) { return share(bounds(of), bounds(of).contact_bracket.low); }),
        getter<StateBounds>(
            "area_fraction_high", "number", "that and the share that may be",
            [](const StateBounds& of) { return share(bounds(of), bounds(of).contact_bracket.high); }),
        getter<StateBounds>("plastic_fraction_low", "number?",
                            "share of the nodes surely at the cap; nil without plasticity",
                            [](const StateBounds& of) { return yielded_share(of, &NodeBracket::low); }),
        getter<StateBounds>("plastic_fraction_high", "number?", "that and the share that may be",
                            [](const StateBounds& of) { return yielded_share(of, &NodeBracket::high); }),
        getter<StateBounds>("cost", "Cost", "seconds, transforms and bytes of finding these bounds",
                            [](const StateBounds& of) { return cost_type()(bounds(of).cost); }),
    };
    c.fields.insert(c.fields.end(), brackets.begin(), brackets.end());
    return c;
  }();
  return type;
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
        getter<StateError>("algebraic", "AlgebraicError",
                           "bounds against the exact solution on the same grid",
                           [](const StateError& of) {
                             StateBounds found{of.state};
                             found.state.algebraic_error();  // must not wait until the contact is closed
                             return object(std::move(found));
                           }),
        getter<StateError>(
            "discretisation", "DiscretisationError",
            "estimates against an ever finer grid; needs accuracy={ estimate=true } or { error= }",
            [](const StateError& of) { return object(DiscretisationError{of.state}); }),
    };
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
