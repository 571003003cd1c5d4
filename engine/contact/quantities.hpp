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

// Measured discretisation error of a value; used by accuracy/discretisation_error.hpp.
struct CellError {
  enum class Kind {
    grid,       // two differences at `order`, random sign: not extrapolated
    steady,     // two differences, constant sign: extrapolated
    raw_area,   // counted cells: error of the outline
    corrected,  // error after the outline correction
    approach,   // first touch between nodes, rest as `separation`
    peak,       // peak between nodes, rest as `grid`; no limit at corners and steps
  };
  double order;
  double margin;  // factor on the estimate that covers 19 of 20 scenes, measured
  // Error over the last step to a finer grid; further steps mostly have the same sign.
  double growth;
  double finer_margin;  // as `margin`, from a finer grid
  Kind kind = Kind::grid;
  // Missing part of the value if the first touch is higher by `rise`, m, between nodes, under a prescribed
  // approach; null: unknown.
  double (*lacks)(const State& state, double rise) = nullptr;
  std::string_view remark{};  // appended to the estimate's sentence
};

struct StateQuantity {
  std::string_view name;
  std::string_view called{};  // in errors: "the elastic energy"
  std::string_view sentence;
  Dimension dimension{};
  // Throws Error{bad_state} if the state has none (closed, flats).
  double (*value)(const State& state);
  std::string_view effect{};  // from Effect::quantities; empty: every state
  bool count = false;         // an integer
  // Against the exact solution on the same grid; none if the solver chose the load or without the effect.
  // Null: unknown.
  std::optional<double> (*bound)(const State& state) = nullptr;
  std::string_view bound_remark{};   // appended to the bound's sentence
  std::optional<CellError> cells{};  // none: no estimate

  // Throws Error{bad_state} without a value, naming a missing effect.
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

// In the order of the reference; effects last.
std::span<const StateQuantity> state_quantities();
// Null if unknown.
const StateQuantity* find_quantity(std::string_view name);

// "of the approach; most of it is ...": sentences of a bound and an estimate.
std::string bound_sentence(const StateQuantity& quantity);
std::string estimate_sentence(const StateQuantity& quantity);

}  // namespace asperity
