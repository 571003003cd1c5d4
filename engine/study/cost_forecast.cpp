// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/cost_forecast.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {

constexpr std::array<std::string_view, 3> modelled = {"cells", "cells_factor", "tolerance"};

double model(std::string_view name, double value) {
  if (name == "cells") {
    const double n = std::max(value, 2.0);
    return n * n * elementary::log(n);
  }
  if (name == "cells_factor") return value * value;
  // Plus one for set-up.
  return 1 + std::max(0.0, -elementary::log10(std::max(value, 1e-300)));
}

bool is_modelled(std::string_view name) {
  return std::find(modelled.begin(), modelled.end(), name) != modelled.end();
}

}  // namespace

void CostForecast::learn(std::size_t way, const Knobs& knobs, double seconds) {
  measured_.push_back({way, knobs, std::max(seconds, 0.0)});
}

double CostForecast::relative(const Knobs& knobs) {
  double cost = 1;
  for (const std::string_view name : modelled)
    if (const auto value = number_of(knobs, name)) cost *= model(name, *value);
  return cost;
}

double CostForecast::ratio(const Knobs& knobs, const Measured& reference) const {
  double factor = 1;
  for (const std::string_view name : modelled) {
    const auto wanted = number_of(knobs, name), had = number_of(reference.knobs, name);
    if (wanted && had) factor *= model(name, *wanted) / std::max(model(name, *had), 1e-300);
  }
  for (const Knob& knob : knobs) {
    if (is_modelled(knob.name)) continue;
    const auto wanted = number_of(knobs, knob.name), had = number_of(reference.knobs, knob.name);
    if (!wanted || !had || *wanted == *had || *wanted <= 0 || *had <= 0) continue;
    for (const Measured& other : measured_) {
      const auto before = number_of(other.knobs, knob.name);
      if (other.way != reference.way || !before || *before <= 0 || *before == *had) continue;
      if (relative(other.knobs) != relative(reference.knobs) || other.seconds <= 0) continue;
      constexpr double steepest = 4;
      const double power =
          std::clamp(elementary::log(reference.seconds / other.seconds) / elementary::log(*had / *before),
                     0.0, steepest);
      return factor * elementary::pow(*wanted / *had, power);
    }
  }
  return factor;
}

std::optional<double> CostForecast::seconds(std::optional<std::size_t> way, const Knobs& knobs) const {
  const Measured* best = nullptr;
  std::pair<int, double> best_rank{-1, 0};
  for (const Measured& one : measured_) {
    int shared = way && one.way == *way ? 1000 : 0;
    for (const Knob& knob : knobs)
      shared += std::any_of(one.knobs.begin(), one.knobs.end(),
                            [&](const Knob& own) { return own.name == knob.name; });
    // The most expensive: fixed costs matter least.
    const std::pair<int, double> rank{shared, one.seconds};
    if (rank > best_rank) {
      best = &one;
      best_rank = rank;
    }
  }
  if (best == nullptr) return {};
  return best->seconds * ratio(knobs, *best);
}

}  // namespace asperity
