// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of a state, each told once: name, dimension and sentence, its value, the effect it needs,
// its algebraic bound, and how the error of the cells goes with the width of a cell. The fields of states and
// of their errors in the language, the reference, the estimates and the choice of an accuracy read these rows
// and know no quantity beside them. A new one is a row, here or with the effect that gives it, and a test.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/contact/state.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

// How a value errs by the width of a cell, as measured; what is made of it is in
// accuracy/discretisation_error.hpp.
struct CellError {
  enum class Kind {
    grid,       // two differences, at the order; their sign is chance, so nothing is taken off
    steady,     // the same, with a sign that is kept from grid to grid: what remains is taken off
    raw_area,   // nodes counted as whole cells: wrong by their outline
    corrected,  // by what the correction of the outline leaves
    approach,   // first touch between the nodes, and the rest as `separation`
    peak,       // the peak between the nodes, and the rest as `grid`; at a corner or a step there is no limit
  };
  double order;
  double margin;  // times the estimate that covers the true error in 19 of 20 scenes, as measured
  // Of the step to a finer grid into the error: what is left below it has mostly the same sign.
  double growth;
  double finer_margin;  // as `margin`, of the estimate from a finer grid
  Kind kind = Kind::grid;
  // What the value lacks where the first touch, from which a prescribed approach counts, is between the nodes
  // and higher by `rise`, m; null: nothing is known.
  double (*lacks)(const State& state, double rise) = nullptr;
  std::string_view remark{};  // at the end of the estimate's sentence
};

struct StateQuantity {
  std::string_view name;
  std::string_view called{};  // in the sentences of its errors: "the elastic energy"
  std::string_view sentence;  // what it is
  Dimension dimension{};
  // Throws Error{bad_state} where the state has none: of a state that was closed, of flats.
  double (*value)(const State& state);
  std::string_view effect{};  // that gives it (Effect::quantities); empty: every state has it
  bool count = false;         // a whole number
  // Against the exact solution on the same grid; none of a state whose load is left to the solver, or without
  // the effect. Null: no bound is known of any state.
  std::optional<double> (*bound)(const State& state) = nullptr;
  std::string_view bound_remark{};   // at the end of the bound's sentence
  std::optional<CellError> cells{};  // none: not estimated

  // The value; throws Error{bad_state} where it has none, naming the effect that the scene does not name.
  double of(const State& state) const;
};

// A row's value and bound of members.
template <auto member>
double quantity_value(const State& state) {
  return static_cast<double>((state.*member)());
}
template <auto member>
std::optional<double> quantity_bound(const State& state) {
  return state.algebraic_error().*member;
}

// In the order of the reference, those of effects last.
std::span<const StateQuantity> state_quantities();
// Null where there is none of the name.
const StateQuantity* find_quantity(std::string_view name);

// "of the approach; most of it is ..."; the sentences of a bound and of an estimate.
std::string bound_sentence(const StateQuantity& quantity);
std::string estimate_sentence(const StateQuantity& quantity);

}  // namespace asperity
