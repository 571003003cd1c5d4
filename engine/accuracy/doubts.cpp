// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/accuracy/doubts.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/bodies/geometry.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// By forward differences between neighbours, never across the rim, where the bodies face each other.
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

// 1/E*; nothing where a material does not say.
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

}  // namespace

std::vector<std::string> doubts(const State& state) {
  const ContactGeometry& geometry = state.geometry();
  std::vector<std::string> sentences;
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

std::string described(const State& state) {
  std::string of_the_cells = state.closed() ? std::string() : discretisation_text(state);
  if (state.chosen() && !state.closed())
    of_the_cells += "; " + state.chosen()->values_text() + "; " + state.chosen()->text();
  std::string text = state.text(of_the_cells);
  if (state.closed()) return text;
  for (const std::string& sentence : doubts(state)) text += "\n  warning: " + sentence;
  return text;
}

}  // namespace asperity
