// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/discretisation_error.hpp"

#include <array>

#include "bindings/lua/contact/state_error.hpp"
#include "bindings/lua/registry/record.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

Values estimate(Call& call) {
  return {discretisation_estimate(call.self<DiscretisationError>().state, call.function_name()).error};
}

Values extrapolated(Call& call) {
  return {discretisation_estimate(call.self<DiscretisationError>().state, call.text(1, "name")).extrapolated};
}

std::string describe_error(const void* self) {
  const auto& state = static_cast<const DiscretisationError*>(self)->state;
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

}  // namespace

template <>
const Class& class_of<DiscretisationError>() {
  static const Class type = [] {
    Class c;
    c.name = "DiscretisationError";
    c.article_name = "a discretisation error";
    c.sentence =
        "How far the numbers of a state are from those of an ever finer grid: estimates in the units of the "
        "quantities, from the same press on half and a quarter of the cells, or on thrice the cells with "
        "estimate=\"finer\"; math.huge where two coarser grids show that a value grows without end. Needs "
        "accuracy={ estimate=true } or \"finer\".";
    c.describe = describe_error;
    for (const StateQuantity& quantity : state_quantities())
      if (quantity.cells)
        c.fields.push_back({std::string(quantity.name), "number", estimate_sentence(quantity),
                            quantity.dimension, estimate});
    c.methods = {
        {.name = "extrapolated",
         .body = extrapolated,
         .sentence =
             "The value of a quantity with its estimated error taken off, where the sign of the error "
             "is known (area, area_fraction, approach, secant_stiffness, plastic_fraction; of a prescribed "
             "approach load, pressure, separation, mean_gap, energy); as it is elsewhere. With "
             "estimate=\"finer\", the value of the finer grid, its own outline and first touch mended.",
         .parameters = {{"name", "string", "of the quantity"}},
         .returns = "number",
         .example = "st.error.discretisation:extrapolated \"area_fraction\""},
    };
    return c;
  }();
  return type;
}

const RecordType<TriedGrid>& tried_grid_type() {
  using G = TriedGrid;
  static const RecordType<G> type =
      RecordType<G>{
          "TriedGrid",
          "grid that was tried",
          "A grid on which the press was tried for the requested error.",
          {{"cells",
            [](const G& g) {
              return std::array{g.nx, g.ny};
            },
            "along x and y"},
           {"tolerance", &G::tolerance, "of the solve"},
           {"error", &G::error, "greatest relative error among the quantities requested, with its margin"},
           {"of", &G::of, "the quantity that has it"},
           {"note", &G::note, "why this grid does not count; empty where it does"},
           {"cost", &G::cost, cost_type(), "transforms in those of this grid"}}}
          .titled([](const G& g) { return cells_text(g.nx, g.ny); });
  return type;
}

const RecordType<ChosenAccuracy>& chosen_accuracy_type() {
  using C = ChosenAccuracy;
  static const RecordType<C> type{
      "ChosenAccuracy",
      "chosen accuracy",
      "Cells and tolerance that were chosen for an error, and why, with the precision of the solves.",
      {{"cells",
        [](const C& c) {
          return std::array{c.nx, c.ny};
        },
        "along x and y"},
       {"tolerance", &C::tolerance, "of the solve"},
       {"precision",
        [](const C& c) { return c.precision == Accuracy::Precision::single ? "single" : "double"; },
        "\"single\" or \"double\""},
       {"why_precision", &C::why_precision, "in a few words"},
       {"error", &C::error,
        "of this state: greatest relative error among the quantities requested, with its margin"},
       {"of", &C::of, "the quantity that has it"},
       {"met", &C::met, "whether this is at most the requested error"},
       {"reason", &C::reason, "why these were chosen, in a sentence"},
       {"text", &C::text, "all of it on one line"},
       {"tried", &C::tried, tried_grid_type(), "the grids that were tried, one after another"}}};
  return type;
}

Value chosen_record(const asperity::State& state) {
  return state.chosen() ? Value(chosen_accuracy_type()(*state.chosen())) : Value();
}

}  // namespace asperity::lua
