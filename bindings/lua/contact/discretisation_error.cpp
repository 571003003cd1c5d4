// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/discretisation_error.hpp"

#include "bindings/lua/contact/state_error.hpp"
#include "bindings/lua/registry/record.hpp"
#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

// A field is asked for by its own name.
Values estimate(Call& call) {
  return {discretisation_estimate(call.self<DiscretisationError>().state, call.function_name()).error};
}

Values extrapolated(Call& call) {
  return {discretisation_estimate(call.self<DiscretisationError>().state, call.text(1, "name")).extrapolated};
}

std::string describe_error(const void* self) {
  const auto& state = static_cast<const DiscretisationError*>(self)->state;
  if (!state.other_grids())
    return "discretisation error: not estimated; give lab.contact accuracy={ estimate=true }";
  std::string text = "discretisation error, estimated from";
  for (const OtherGrids::Level& level : state.other_grids()->levels()) {
    const Grid& grid = level.state.geometry().grid();
    text += (&level == state.other_grids()->levels().data() ? " " : " and ") + cells_text(grid.nx, grid.ny);
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

Value chosen_record(const asperity::State& state) {
  if (!state.chosen()) return {};
  const ChosenAccuracy& chosen = *state.chosen();
  Record record;
  record.name = "chosen accuracy";
  record.add("cells", List{{chosen.nx, chosen.ny}})
      .add("tolerance", chosen.tolerance)
      .add("precision", chosen.precision == Accuracy::Precision::single ? "single" : "double")
      .add("why_precision", chosen.why_precision)
      .add("error", chosen.error)
      .add("of", chosen.of)
      .add("met", chosen.met())
      .add("reason", chosen.reason())
      .add("text", chosen.text());
  List tried;
  for (const TriedGrid& grid : chosen.tried) {
    Record entry;
    entry.name = cells_text(grid.nx, grid.ny);
    entry.add("cells", List{{grid.nx, grid.ny}})
        .add("tolerance", grid.tolerance)
        .add("error", grid.error)
        .add("of", grid.of)
        .add("note", grid.note)
        .add("cost", cost_record(grid.cost, "cost"));
    tried.items.emplace_back(std::move(entry));
  }
  record.add("tried", std::move(tried));
  return {std::move(record)};
}

}  // namespace asperity::lua
