// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/bench_log.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/recording/press_log.hpp"

namespace asperity {

std::string bench_log_text(const SpecimenPair& pair) {
  using Done = SpecimenPair::Done;
  const std::vector<Done>& history = pair.history();
  if (history.empty())
    throw Error(ErrorCode::bad_state, "nothing was done to this contact yet, so there is nothing to log",
                "press it first");
  const auto only = [&](PressBy by) {
    return std::all_of(history.begin(), history.end(), [by](const Done& done) {
      const auto* press = std::get_if<PressRequest>(&done.step);
      return press == nullptr || press->by == by || press->value == 0;
    });
  };
  const bool by_load = only(PressBy::load), as_asked = by_load || only(PressBy::pressure);
  std::vector<ResultColumn> results = {{by_load ? "pressure [Pa]" : "load [N]", {}},
                                       {"approach [m]", {}},
                                       {"area_fraction", {}},
                                       {"peak_pressure [Pa]", {}}};
  std::vector<Protocol::Event> events;
  for (const Done& done : history) {
    Protocol::Event event{done.step, done.time};
    std::vector<std::optional<double>> values(results.size());
    if (auto* press = std::get_if<PressRequest>(&event.step)) {
      if (press->value == 0 && press->preload.empty()) {
        event.step = Protocol::Release{};
      } else if (!as_asked) {
        press->by = PressBy::pressure;
        press->value = done.measured->pressure;
      }
      const Done::Measured& m = *done.measured;
      values = {by_load ? m.pressure : m.load, m.approach, m.area_fraction, m.peak_pressure};
    }
    events.push_back(std::move(event));
    for (std::size_t c = 0; c < results.size(); ++c) results[c].values.push_back(values[c]);
  }
  return press_log_text(Protocol(std::move(events)), results);
}

}  // namespace asperity
