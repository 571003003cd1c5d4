// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of a state, one row each: language fields, reference, estimates and the choice of an
// accuracy read the rows. A new quantity is a row, here or with its effect, and a test.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/contact/state.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

// Discretisation error of a value (accuracy/discretisation_error.hpp).
struct CellError {
  enum class Kind {
    grid,       // two differences at `order`, random sign: not extrapolated
    steady,     // two differences, constant sign: extrapolated
    raw_area,   // counted cells: error of the outline
    corrected,  // after outline correction
    approach,   // first touch between nodes, rest as `separation`
    peak,       // peak between nodes, rest as `grid`; no limit at corners and steps
  };
  double order;
  double margin;  // factor that covers 19 of 20 scenes, measured
  // Error over the last step to a finer grid; further steps mostly have its sign.
  double growth;
  double finer_margin;  // as `margin`, from a finer grid
  Kind kind = Kind::grid;
  // Missing part of the value if first touch is higher by `rise`, m, between nodes, under a prescribed
  // approach; null: unknown.
  double (*lacks)(const State& state, double rise) = nullptr;
  std::string_view remark{};  // appended to the estimate
};

struct StateQuantity {
  std::string_view name;
  std::string_view called{};  // in errors: "the elastic energy"
  std::string_view sentence;
  Dimension dimension{};
  // Throws Error{bad_state} without a value (closed, flats).
  double (*value)(const State& state);
  std::string_view effect{};  // of Effect::quantities; empty: every state
  bool count = false;         // an integer
  // Against the exact solution on the same grid; none if the solver chose the load or without the effect.
  // Null: unknown.
  std::optional<double> (*bound)(const State& state) = nullptr;
  std::string_view bound_remark{};   // appended to the bound
  std::optional<CellError> cells{};  // none: no estimate

  // Throws Error{bad_state} naming a missing effect.
  double of(const State& state) const;
};

template <auto member>
double quantity_value(const State& state) {
  return static_cast<double>((state.*member)());
}
template <auto member>
std::optional<double> quantity_bound(const State& state) {
  return state.algebraic_error().*member;
}

// As in the reference; effects last.
std::span<const StateQuantity> state_quantities();
// Null if unknown.
const StateQuantity* find_quantity(std::string_view name);

// "of the approach; most of it is ...".
std::string bound_sentence(const StateQuantity& quantity);
std::string estimate_sentence(const StateQuantity& quantity);

}  // namespace asperity
