// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/state_class.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/contact/solution.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

using Estimated = DiscretisationError;

std::string describe_error(const Estimated& of) {
  const auto& state = of.state;
  if (!state.companion_grids())
    return "discretisation error: not estimated; give lab.contact accuracy={ estimate=true }";
  std::string text = "discretisation error, estimated from";
  for (const CompanionGrids::Level& level : state.companion_grids()->levels()) {
    const Grid& grid = level.state.geometry().grid();
    text +=
        (&level == state.companion_grids()->levels().data() ? " " : " and ") + cells_text(grid.nx, grid.ny);
  }
  for (const std::string_view name :
       {"approach", "area_fraction", "corrected_area_fraction", "peak_pressure", "mean_gap", "energy"}) {
    const double error = discretisation_estimate(state, name).error;
    const Dimension dimension = find_quantity(name)->dimension;
    const std::string shown =
        dimension == dimension::number ? format_short(error, 3) : format_quantity(error, dimension, 3);
    text += "\n  " + std::string(name) + std::string(26 - name.size(), ' ') + shown;
  }
  return text;
}

const AlgebraicError& bounds(const StateBounds& of) { return of.state.algebraic_error(); }

template <auto end>
double contacts(const StateBounds& of) {
  return static_cast<double>(bounds(of).contact_bracket.*end);
}
template <auto end>
std::optional<double> yielded_share(const StateBounds& of) {
  const AlgebraicError& e = bounds(of);
  if (!e.yielded_bracket) return {};
  return static_cast<double>((*e.yielded_bracket).*end) / static_cast<double>(e.nodes);
}

std::string describe_bounds(const StateBounds& of) {
  const auto& state = of.state;
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
  if (!std::isfinite(e.approach)) text += "\n  inf: no bound, as for bodies that attract each other";
  return text + "\n  nodes in contact  " + std::to_string(e.contact_bracket.low) + " to " +
         std::to_string(e.contact_bracket.high) + " of " + std::to_string(e.nodes);
}

}  // namespace

Class make_class(For<DiscretisationError>) {
  Class c{"DiscretisationError", "a discretisation error",
          "Estimated discretisation errors of a state, in the units of the quantities, from the same press "
          "on half and a quarter of the cells, or on thrice the cells with estimate=\"finer\"; math.huge "
          "if two coarser grids show unlimited growth of a value. Needs accuracy={ estimate=true } or "
          "\"finer\"."};
  c.describe = text_of<describe_error>;
  const Body estimate = method([](const Estimated& of, Call& call) {
    return discretisation_estimate(of.state, call.function_name()).error;
  });
  for (const StateQuantity& quantity : state_quantities())
    if (quantity.cells)
      c.fields.push_back(
          {std::string(quantity.name), "number", estimate_sentence(quantity), quantity.dimension, estimate});
  c.methods = {
      {.name = "extrapolated",
       .body = method([](const Estimated& of, Call& call) {
         return discretisation_estimate(of.state, call.text(1, "name")).extrapolated;
       }),
       .sentence =
           "The value of a quantity with its estimated error taken off, where the sign of the error is known "
           "(area, area_fraction, approach, secant_stiffness, plastic_fraction; of a prescribed approach "
           "load, pressure, separation, mean_gap, energy); as it is elsewhere. With estimate=\"finer\", the "
           "value of the finer grid, its own outline and first touch mended.",
       .parameters = {{"name", "string", "of the quantity"}},
       .returns = "number",
       .example = "st.error.discretisation:extrapolated \"area_fraction\""},
  };
  return c;
}

const RecordType<TriedGrid> tried_grid_type = RecordType<TriedGrid>{
    "TriedGrid",
    "grid that was tried",
    "A grid on which the press was tried for the requested error.",
    {{"cells", [](const TriedGrid& g) { return along_axes(g.nx, g.ny); }, "along x and y"},
     {"tolerance", &TriedGrid::tolerance, "of the solve"},
     {"error", &TriedGrid::error, "greatest relative error among the quantities requested, with its margin"},
     {"of", &TriedGrid::of, "the quantity that has it"},
     {"note", &TriedGrid::note, "why this grid does not count; empty where it does"},
     {"cost", &TriedGrid::cost, cost_type(),
      "transforms in those of this grid"}}}.titled([](const TriedGrid& g) { return cells_text(g.nx, g.ny); });

const RecordType<ChosenAccuracy> chosen_accuracy_type{
    "ChosenAccuracy",
    "chosen accuracy",
    "Cells and tolerance that were chosen for an error, and why, with the precision of the solves.",
    {{"cells", [](const ChosenAccuracy& c) { return along_axes(c.nx, c.ny); }, "along x and y"},
     {"tolerance", &ChosenAccuracy::tolerance, "of the solve"},
     {"precision",
      [](const ChosenAccuracy& c) {
        return c.precision == Accuracy::Precision::single ? "single" : "double";
      },
      "\"single\" or \"double\""},
     {"why_precision", &ChosenAccuracy::why_precision, "in a few words"},
     {"error", &ChosenAccuracy::error,
      "of this state: greatest relative error among the quantities requested, with its margin"},
     {"of", &ChosenAccuracy::of, "the quantity that has it"},
     {"met", &ChosenAccuracy::met, "whether this is at most the requested error"},
     {"reason", &ChosenAccuracy::reason, "why these were chosen, in a sentence"},
     {"text", &ChosenAccuracy::text, "the whole value on one line"},
     {"tried", &ChosenAccuracy::tried, tried_grid_type, "the grids that were tried, one after another"}}};

Value chosen_record(const asperity::State& state) {
  return state.chosen() ? Value(chosen_accuracy_type(*state.chosen())) : Value();
}

Class make_class(For<StateBounds>) {
  Class c{"AlgebraicError", "an algebraic error",
          "Bounds on how far the numbers of a state are from the exact solution on the same grid, in the "
          "units of the quantities; math.huge where nothing can be said, as of bodies that attract each "
          "other. Quantities without a bound are nil: load, pressure and secant_stiffness of a state pressed "
          "by `flatten`, whose other bounds are at the load found, and quantities of an effect that the "
          "scene does not name. The cost of the bounds is no part of the cost of the state."};
  c.describe = text_of<describe_bounds>;
  const Body bound = method(
      [](const StateBounds& of, Call& call) { return find_quantity(call.function_name())->bound(of.state); });
  for (const StateQuantity& quantity : state_quantities())
    if (quantity.bound != nullptr)
      c.fields.push_back(
          {std::string(quantity.name), "number?", bound_sentence(quantity), quantity.dimension, bound});
  using B = StateBounds;
  constexpr auto low = &NodeBracket::low, high = &NodeBracket::high;
  append(c.fields,
         getter<B>("nodes_in_contact_low", "integer", "nodes that are surely in contact",
                   [](const B& of) { return bounds(of).contact_bracket.low; }),
         getter<B>("nodes_in_contact_high", "integer", "those and the nodes that may be",
                   [](const B& of) { return bounds(of).contact_bracket.high; }),
         getter<B>(
             "area_low", "number", "area surely in contact",
             [](const B& of) { return contacts<low>(of) * bounds(of).node_area; }, dimension::area),
         getter<B>(
             "area_high", "number", "that and what may be",
             [](const B& of) { return contacts<high>(of) * bounds(of).node_area; }, dimension::area),
         getter<B>("area_fraction_low", "number", "share of the nodes surely in contact",
                   [](const B& of) { return contacts<low>(of) / static_cast<double>(bounds(of).nodes); }),
         getter<B>("area_fraction_high", "number", "that and the share that may be",
                   [](const B& of) { return contacts<high>(of) / static_cast<double>(bounds(of).nodes); }),
         getter<B>("plastic_fraction_low", "number?",
                   "share of the nodes surely at the cap; nil without plasticity",
                   [](const B& of) { return yielded_share<low>(of); }),
         getter<B>("plastic_fraction_high", "number?", "that and the share that may be",
                   [](const B& of) { return yielded_share<high>(of); }),
         getter<B>("cost", "Cost", "seconds, transforms and bytes of finding these bounds",
                   [](const B& of) { return cost_type()(bounds(of).cost); }));
  return c;
}

Class make_class(For<StateError>) {
  Class c{"StateError", "the error of a state",
          "Errors of a state by source; the sources are never combined. A part is found when it is read."};
  c.describe = from_value([](const StateError& of) -> std::string {
    const auto& state = of.state;
    const DiscretisationError grid{state};
    const StateBounds of_state{state};
    return describe_bounds(of_state) + "\n" + class_of<DiscretisationError>().describe(&grid);
  });
  c.fields = {
      getter<StateError>("algebraic", "AlgebraicError", "bounds against the exact solution on the same grid",
                         [](const StateError& of) {
                           StateBounds found{of.state};
                           found.state.algebraic_error();  // before the contact is closed
                           return object(std::move(found));
                         }),
      getter<StateError>(
          "discretisation", "DiscretisationError",
          "estimates against an ever finer grid; needs accuracy={ estimate=true } or { error= }",
          [](const StateError& of) -> Value { return object(DiscretisationError{of.state}); }),
  };
  return c;
}

}  // namespace asperity::lua
