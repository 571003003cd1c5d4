// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/state_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/gap_term.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Forward differences at facing nodes, not across the rim.
double combined_rms_slope(const ContactGeometry& geometry) {
  const Field& z = geometry.combined();
  const Grid& grid = geometry.grid();
  double squares = 0, nodes = 0;
  for (int j = 0; j + 1 < grid.ny; ++j)
    for (int i = 0; i + 1 < grid.nx; ++i) {
      const double along = (z(i + 1, j) - z(i, j)) / grid.hx(), up = (z(i, j + 1) - z(i, j)) / grid.hy();
      if (!std::isfinite(along) || !std::isfinite(up)) continue;
      squares += along * along + up * up;
      ++nodes;
    }
  return nodes > 0 ? std::sqrt(squares / nodes) : 0;
}

// 1/E*; none if a material lacks moduli.
std::optional<double> contact_compliance(const ContactGeometry& geometry) {
  double sum = 0;
  for (const Material* material : {lower_material(geometry.lower()), upper_material(geometry.upper())}) {
    if (material == nullptr) return {};
    if (material->rigid) continue;
    if (!material->young || !material->poisson) return {};
    sum += (1 - *material->poisson * *material->poisson) / *material->young;
  }
  return sum;
}

struct SofterBody {
  const char* name = "";
  double hardness = std::numeric_limits<double>::infinity();
};

SofterBody softer_body(const ContactGeometry& geometry) {
  SofterBody softer;
  const auto look = [&](const char* name, const Material* material) {
    if (material != nullptr && !material->rigid && material->hardness &&
        *material->hardness < softer.hardness)
      softer = {name, *material->hardness};
  };
  look("lower", lower_material(geometry.lower()));
  look("upper", upper_material(geometry.upper()));
  return softer;
}

// Warning; empty without one, and for flats.
std::string cut_off_at_the_rim(const State& state) {
  const ContactGeometry& geometry = state.geometry();
  const Grid& grid = state.grid();
  if (!state.moves_every_node() || geometry.boundary() != Boundary::free || !(geometry.peak_to_valley() > 0))
    return {};
  const auto contact = state.field("contact");
  const auto gap = state.attraction_terms().empty() ? contact : state.field("gap");
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; i += j == 0 || j == grid.ny - 1 ? 1 : std::max(grid.nx - 1, 1)) {
      if ((*contact)(i, j) > 0) return "the contact reaches the rim of the free tile, where the bodies end";
      if (!std::isnan((*gap)(i, j))) least = std::min(least, std::max((*gap)(i, j), 0.0));
    }
  constexpr double noticeable = 0.01;  // of the traction at touch
  for (const GapTerm& term : state.attraction_terms())
    if (const double share = term.traction(least) / term.greatest(); share > noticeable)
      return quoted(term.effect) + " reaches the rim of the free tile, where the bodies end, with " +
             format_short(100 * share, 2) +
             " % of its greatest traction; take a larger tile or a shorter range";
  return {};
}

}  // namespace

bool rests_on_few_nodes(const State& state) {
  constexpr std::int64_t few = 30;
  return state.moves_every_node() && state.contacts() > 0 && state.contacts() < few &&
         state.contacts() < state.geometry().facing();
}

std::vector<std::string> state_limits(const State& state) {
  const ContactGeometry& geometry = state.geometry();
  std::vector<std::string> sentences;
  if (rests_on_few_nodes(state))
    sentences.push_back(
        "only " + std::to_string(state.contacts()) +
        (state.contacts() == 1 ? " node touches" : " nodes touch") +
        ", so the result depends on the cells: press harder, or take finer cells on a smaller tile");
  if (std::string cut = cut_off_at_the_rim(state); !cut.empty()) sentences.push_back(std::move(cut));
  if (state.load() <= 0) return sentences;
  constexpr double steep = 1;
  if (const double slope = combined_rms_slope(geometry); slope > steep)
    sentences.push_back("the combined heights have an rms slope of " + format_short(slope, 3) +
                        ", and the theory is of slopes well under 1");
  constexpr double large = 0.5;
  if (const auto compliance = contact_compliance(geometry); compliance && *compliance > 0)
    if (const double times = state.pressure() * *compliance; times > large)
      sentences.push_back("the mean pressure is " + format_short(times, 3) +
                          " times the contact modulus, and the theory is of small strains");
  if (!state.yields()) {
    const SofterBody softer = softer_body(geometry);
    constexpr double rounding = 1e-9;
    if (const double times = state.peak_pressure() / softer.hardness; times > 1 + rounding)
      sentences.push_back("the peak pressure is " + format_short(times, 3) + " times the hardness of the " +
                          softer.name + " body, " + format_quantity(softer.hardness, dimension::pressure) +
                          ": it would yield, and this scene does not name " +
                          effects_that(Effect::Acts::bounds_pressure));
  }
  return sentences;
}

}  // namespace asperity
