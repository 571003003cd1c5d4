// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/scene/press_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/contact/scene/effect.hpp"
#include "engine/core/require.hpp"

namespace asperity {

std::string_view name(PressBy by) {
  constexpr std::array<std::string_view, 5> names{"pressure", "load", "approach", "indentation", "flatten"};
  return names[static_cast<std::size_t>(by)];
}

namespace {
std::string value_text(const PressRequest& request) {
  const char* unit = request.by == PressBy::pressure   ? " Pa"
                     : request.by == PressBy::load     ? " N"
                     : request.by == PressBy::approach ? " m"
                                                       : "";
  return quoted(name(request.by)) + " is " + format_short(request.value) + unit;
}
}  // namespace

void check_numbers(const PressRequest& request) {
  if (!std::isfinite(request.value)) refuse(value_text(request), "give a finite value; one below zero pulls");
  if (request.by == PressBy::flatten && !(request.value >= 0 && request.value <= 1))
    refuse("`flatten` is " + format_short(request.value),
           "it is a fraction of the peak-to-valley: give a number from 0 to 1");
  for (const double turn : request.preload)
    if (!std::isfinite(turn)) refuse("`preload` is " + format_short(turn), "give a finite value");
  if (request.dwell && !(*request.dwell >= 0))
    refuse("`dwell` is " + format_short(*request.dwell) + " s", "give a time from zero up");
}

void check(const PressRequest& request, bool attracts) {
  if (!attracts && !(request.value >= 0 && std::isfinite(request.value)))
    refuse(value_text(request), "give a finite value from zero up: nothing attracts the bodies");
  if (attracts && request.by == PressBy::flatten)
    refuse("`flatten` of bodies that attract each other is not computed",
           "press by `pressure`, `load`, `approach` or `indentation`");
  check_numbers(request);
  const std::vector<double>& turns = request.preload;
  if (!turns.empty() && !attracts)
    refuse("`preload` is given, and nothing attracts the bodies",
           "name " + effects_that(Effect::Acts::adds_term) + ", or leave `preload` out");
  if (turns.size() == 1 && turns.front() < request.value)
    refuse("`preload` is " + format_short(turns.front()) + ", below the " + quoted(name(request.by)) +
               " of " + format_short(request.value),
           "give a greater `preload`: bodies are drawn back from it");
}

void check_fraction(const PressRequest& request, double peak_to_valley) {
  if ((request.by == PressBy::indentation || request.by == PressBy::flatten) && !(peak_to_valley > 0))
    refuse(quoted(name(request.by)) +
               " is a fraction of a peak-to-valley that is zero: all combined heights are equal",
           "give `pressure`, `load` or `approach`");
}

std::vector<double> turns_before(std::span<const double> visited, double value) {
  std::vector<double> turns;
  for (bool highest = true; !visited.empty(); highest = !highest) {
    // Last of equal values: turns between are erased.
    const auto turn = highest ? std::max_element(visited.rbegin(), visited.rend())
                              : std::min_element(visited.rbegin(), visited.rend());
    if (highest ? value >= *turn : value <= *turn) break;
    turns.push_back(*turn);
    visited = visited.last(static_cast<std::size_t>(turn - visited.rbegin()));
  }
  return turns;
}

}  // namespace asperity
