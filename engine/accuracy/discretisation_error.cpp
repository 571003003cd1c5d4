// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of the quantities are in contact/quantities.cpp. The shares below were tuned on the same scenes.
#include "engine/accuracy/discretisation_error.hpp"

#include "engine/accuracy/finer_heights.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

using Kind = CellError::Kind;

const StateQuantity& quantity_of(std::string_view name) { return *find_quantity(name); }

// Error of a corrected area, as a share of the correction.
constexpr double share_of_outline = 0.1;
// Weight of differences next to an error by outline or first touch: at weight 1, they exceed three times the
// error in a quarter and a sixth of the scenes.
constexpr double share_beside_outline = 0.5, share_beside_touch = 0.3;
// In outline corrections: excess of the true area, and its scatter.
constexpr double share_of_finer_outline = 0.08, doubt_of_outline = 0.02;

double lacks_by_touch(const State& state, const StateQuantity& quantity) {
  if (quantity.cells->lacks == nullptr) return 0;
  const double rise =
      rise_between_nodes(state.geometry().combined(), state.geometry().boundary() == Boundary::periodic);
  return quantity.cells->lacks(state, rise);
}

struct Differences {
  double error = 0, correction = 0;  // `correction`: 0 for differences of opposite sign
  bool diverges = false;             // steps grow
};

Differences differences(const State& state, const StateQuantity& quantity, double order,
                        bool mended = false) {
  const auto levels = state.companion_grids()->levels();
  const auto of = [&](const State& grid) {
    return quantity.of(grid) + (mended ? lacks_by_touch(grid, quantity) : 0.0);
  };
  const double fine = of(state), half = of(levels[0].state);
  if (levels.size() == 1) {
    // A single difference may be small by accident.
    const double growth = elementary::pow(levels[0].ratio, order - 0.5) - 1;
    return {std::abs(fine - half) / growth};
  }
  const double quarter = of(levels[1].state);
  const double r = elementary::pow(levels[0].ratio, order), s = elementary::pow(levels[1].ratio, order);
  const double first = (fine - half) / (r - 1), second = (half - quarter) / ((s - 1) * r);
  if (!std::isfinite(first) || !std::isfinite(second))
    return {fine == half && half == quarter ? 0.0 : infinity};
  constexpr double noticeable = 0.01;
  const double step = fine - half, step_before = half - quarter;
  return {std::max(std::abs(first), std::abs(second)), first * second > 0 ? first : 0.0,
          step * step_before > 0 && std::abs(step) >= std::abs(step_before) &&
              std::abs(step) > noticeable * std::abs(fine)};
}

// Exact on every grid.
bool is_prescribed(std::string_view quantity, PressBy by) {
  if (by == PressBy::pressure || by == PressBy::load) return quantity == "pressure" || quantity == "load";
  return quantity == name(by);
}

double area_unit(const State& state, const StateQuantity& quantity) {
  return quantity.dimension == dimension::area ? state.geometry().grid().area() : 1.0;
}

// The error of the finer grid is a fraction of the state's.
void estimate_by_finer(const State& state, const StateQuantity& quantity, bool by_approach, bool wraps,
                       DiscretisationEstimate& result) {
  const CellError& cells = *quantity.cells;
  const State& finer = state.companion_grids()->levels().front().state;
  const double value = result.value;
  result.margin = cells.finer_margin;
  double better = quantity.of(finer);
  const bool areas = cells.kind == Kind::raw_area || cells.kind == Kind::corrected;
  if (areas) {
    const double outline = finer.area_fraction() - finer.corrected_area_fraction();
    better =
        area_unit(state, quantity) * (finer.corrected_area_fraction() + share_of_finer_outline * outline);
  }
  if (cells.kind == Kind::approach && !by_approach)
    better += rise_between_nodes(finer.geometry().combined(), wraps);
  if (state.companion_grids()->request().by == PressBy::approach) better += lacks_by_touch(finer, quantity);
  if (better == value) return;  // also if infinite
  result.error = cells.growth * std::abs(value - better);
  if (cells.kind == Kind::corrected)
    result.error = elementary::hypot(result.error, doubt_of_outline * (state.area_fraction() - value));
  if (cells.kind == Kind::peak)
    result.error = std::max(result.error, rise_between_nodes(*state.field("pressure"), wraps));
  result.extrapolated = better;
}

// With margin: the random error for 19 scenes in 20. A small step may be chance, so the previous step counts
// too.
double error_within_outline(const State& state) {
  constexpr double of_doubt = 1.2, of_a_step = 0.7, of_the_step_before = 0.15;
  const double area = state.corrected_area_fraction();
  if (area <= 0) return state.area_fraction() == 0 ? 0.0 : infinity;
  double error = of_doubt * state.outline()->doubt, share = of_a_step, finer = area;
  for (const CompanionGrids::Level& level : state.companion_grids()->levels()) {
    const double coarser = level.state.corrected_area_fraction();
    const double least = std::min(finer, coarser);
    error = std::max(error, share * std::abs(finer - coarser) / (least > 0 ? least : finer));
    finer = coarser;
    share = of_the_step_before;
  }
  return error * area;
}

void estimate_by_coarser(const State& state, const StateQuantity& quantity, bool by_approach, bool wraps,
                         DiscretisationEstimate& result) {
  const CellError& cells = *quantity.cells;
  if (state.companion_grids()->request().by == PressBy::approach && lacks_by_touch(state, quantity) != 0) {
    const double lacks = lacks_by_touch(state, quantity);
    constexpr double order = 2;
    result.error = std::abs(lacks) + share_beside_touch * differences(state, quantity, order, true).error;
    result.extrapolated += lacks;
    return;
  }
  // At a prescribed approach, errors follow the top.
  const Differences d = differences(state, quantity, by_approach ? std::min(cells.order, 1.0) : cells.order);
  switch (cells.kind) {
    case Kind::steady:
      result.extrapolated += d.correction;
      [[fallthrough]];
    case Kind::grid:
      result.error = d.error;
      break;
    case Kind::raw_area: {
      const double area = area_unit(state, quantity);
      const double corrected = area * state.corrected_area_fraction();
      const double rest = differences(state, quantity_of("corrected_area_fraction"), cells.order).error;
      result.error = std::max(std::abs(result.value - corrected), area * rest);
      result.extrapolated = corrected;
      break;
    }
    case Kind::corrected:
      result.error = state.outline()
                         ? error_within_outline(state) / result.margin
                         : std::max(share_beside_outline * d.error,
                                    share_of_outline * std::abs(state.area_fraction() - result.value));
      break;
    case Kind::approach: {
      if (by_approach) {
        result.error = d.error;
        break;
      }
      const Differences rest = differences(state, quantity_of("separation"), cells.order);
      const double rise = rise_between_nodes(state.geometry().combined(), wraps);
      result.error = rise + share_beside_touch * rest.error;
      result.extrapolated += rise;
      break;
    }
    case Kind::peak:
      result.error = d.diverges ? infinity : d.error;
      if (d.error > 0)
        result.error = std::max(result.error, rise_between_nodes(*state.field("pressure"), wraps));
      break;
  }
}

void check(const AskedError& asked, const Effects& named) {
  require(asked.error >= 1e-6 && asked.error < 1, "error", asked.error, "",
          "it is relative: give a number from 1e-6 to below 1, such as 0.01 for 1 %");
  if (asked.of.empty()) refuse("`of` names no quantity", "give one, such as \"corrected_area_fraction\"");
  const std::span<const std::string> known = estimated_quantities();
  for (const std::string& quantity : asked.of) {
    if (std::ranges::find(known, quantity) == known.end())
      refuse_name(
          "`of` names " + quoted(quantity) + ", whose error is not estimated" + did_you_mean(quantity, known),
          "give one of " + joined(known, " and "));
    if (const std::string effect(quantity_of(quantity).effect); !effect.empty() && !named.names(effect))
      refuse("`of` names " + quoted(quantity) + ", which needs the effect " + quoted(effect) +
                 ", and this scene names no such effect",
             "name " + quoted(effect) + ", or request the error of another quantity");
  }
}

}  // namespace

double DiscretisationEstimate::relative() const {
  if (error == 0) return 0;
  return value == 0 ? infinity : error / std::abs(value);
}

std::span<const std::string> estimated_quantities() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const StateQuantity& quantity : state_quantities())
      if (quantity.cells) all.emplace_back(quantity.name);
    return all;
  }();
  return names;
}

void check_accuracy(const Scene& scene) {
  const Accuracy& accuracy = scene.accuracy;
  const Grid& grid = scene.lower.grid();
  if (accuracy.estimate == Accuracy::Estimate::finer && accuracy.asked)
    refuse("`estimate` = \"finer\" and `error` are both given",
           "`error` compares with the coarser grids that it has tried: leave one of the two out");
  if (accuracy.estimate == Accuracy::Estimate::finer) finer_grid(grid);
  if (accuracy.estimate == Accuracy::Estimate::coarser || accuracy.asked) check_estimate(grid);
  if (accuracy.asked) check(*accuracy.asked, scene.effects);
}

DiscretisationEstimate discretisation_estimate(const State& state, std::string_view name) {
  const StateQuantity* const found = find_quantity(name);
  if (found == nullptr || !found->cells)
    refuse_name("no discretisation error of " + quoted(name) + " is estimated" +
                    did_you_mean(name, estimated_quantities()),
                "there is one of " + joined(estimated_quantities()));
  const CellError& cells = *found->cells;
  if (!state.companion_grids())
    refuse_state("the discretisation error of " + quoted(name) + " was not estimated in this press",
                 "give lab.contact accuracy={ estimate=true }, which solves coarser grids as well");
  if (is_prescribed(name, state.companion_grids()->request().by) || state.load() == 0) {
    const double value = found->of(state);
    return {value, 0, value, cells.margin};
  }
  const PressBy by = state.companion_grids()->request().by;
  const bool by_approach = by == PressBy::approach || by == PressBy::indentation;
  const auto wraps = state.geometry().boundary() == Boundary::periodic;
  DiscretisationEstimate result;
  if (found->name == "secant_stiffness" && std::isinf(state.secant_stiffness()))
    return {state.secant_stiffness(), 0, state.secant_stiffness(), cells.margin};
  if (found->name == "secant_stiffness" && state.companion_grids()->request().by != PressBy::flatten &&
      state.companion_grids()->request().by != PressBy::indentation) {
    // From pressure or approach, whichever is free.
    const auto part = discretisation_estimate(state, by_approach ? "pressure" : "approach");
    result.value = result.extrapolated = state.secant_stiffness();
    result.error = result.value * part.relative();
    result.margin = part.margin;
    if (part.value > 0 && part.extrapolated > 0)
      result.extrapolated *= by_approach ? part.extrapolated / part.value : part.value / part.extrapolated;
    return result;
  }
  result.margin = cells.margin;
  result.value = found->of(state);
  result.extrapolated = result.value;
  const auto estimate = state.companion_grids()->finer() ? estimate_by_finer : estimate_by_coarser;
  estimate(state, *found, by_approach, wraps, result);
  return result;
}

std::string discretisation_text(const State& state) {
  if (!state.companion_grids()) return {};
  const auto error = [&](const char* name) { return discretisation_estimate(state, name).error; };
  std::string text = "error of the grid, estimated: approach " +
                     format_quantity(error("approach"), dimension::length, 2) + ", area fraction " +
                     format_short(error("area_fraction"), 2) + " (corrected " +
                     format_short(error("corrected_area_fraction"), 2) + "), energy " +
                     format_quantity(error("energy"), dimension::energy, 2);
  if (state.yields())
    text += ", plastic volume " + format_quantity(error("plastic_volume"), dimension::volume, 2);
  return text;
}

double rise_between_nodes(const Field& field, bool wraps) {
  const auto values = field.values();
  // NaN is below every number.
  const auto below = [](double a, double b) { return std::isnan(a) ? !std::isnan(b) : a < b; };
  const auto top = static_cast<std::size_t>(std::ranges::max_element(values, below) - values.begin());
  const int nx = field.nx(), ny = field.ny();
  const int i = static_cast<int>(top % static_cast<std::size_t>(nx));
  const int j = static_cast<int>(top / static_cast<std::size_t>(nx));
  const double peak = values[top];
  const auto inside = [&](int k, int n) { return n >= 3 && (wraps || (k > 0 && k + 1 < n)); };
  const auto at = [&](int a, int b) { return field((i + a + nx) % nx, (j + b + ny) % ny); };
  // Missing heights form a rim too.
  const double lowest = wraps ? -infinity : known_range(values).min;
  const bool along_x = inside(i, nx) && at(-1, 0) > lowest && at(1, 0) > lowest;
  const bool along_y = inside(j, ny) && at(0, -1) > lowest && at(0, 1) > lowest;
  const auto slope_and_bend = [&](double before, double after) {
    return std::pair{0.5 * (after - before), before - 2 * peak + after};
  };
  const auto rise = [](double slope, double bend) { return bend < 0 ? -0.5 * slope * slope / bend : 0.0; };
  const auto [gx, kx] = along_x ? slope_and_bend(at(-1, 0), at(1, 0)) : std::pair{0.0, 0.0};
  const auto [gy, ky] = along_y ? slope_and_bend(at(0, -1), at(0, 1)) : std::pair{0.0, 0.0};
  const double separate = rise(gx, kx) + rise(gy, ky);
  if (!along_x || !along_y) return separate;
  const double cross = 0.25 * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1));
  const double determinant = kx * ky - cross * cross;
  // For a diagonal ridge, parabolas along the axes.
  if (!(determinant > 0.1 * kx * ky && kx < 0)) return separate;
  const double whole = -0.5 * (gx * gx * ky - 2 * gx * gy * cross + gy * gy * kx) / determinant;
  return std::min(std::max(whole, 0.0), 2 * separate);
}

}  // namespace asperity
