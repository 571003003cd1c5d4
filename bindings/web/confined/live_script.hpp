// SPDX-License-Identifier: GPL-3.0-or-later
// A script that stays loaded in a confined process and runs again when its knobs move; heavy calls with
// unchanged inputs are answered from memory. Messages are frames (frames.hpp) through a socket; under
// WebAssembly the page asks directly.
//
// Question: {move, knobs, view}, with the shown view ("press-1"; "": the last). Only the newest waiting
// question is answered.
//
// Answer: JSON, then each field of the view in single precision: {move, part, factor, cells, seconds,
// computed, recalled, events, views, view}. `part`: "coarse" (every `cells` times `factor`; the full answer
// follows), "whole", or "outdated" (ended by a newer question). `events` as in event_channel.hpp. After
// os.exit(n) the answer has the results so far, `exit` = n, and for n other than 0 an error event. Live runs
// draw nothing with gnuplot and record nothing; the next run deletes written files.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/web/confined/confined_request.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

struct KnobQuestion {
  std::int64_t move = 0;
  GivenKnobs knobs;
  std::string view;
  std::string map;  // of the view; its numbers come first
};
// Throws Error{bad_file}.
KnobQuestion knob_question(const std::string& text);

// Who moves the knobs.
class KnobAsker {
 public:
  virtual ~KnobAsker() = default;
  // A newer question waits.
  virtual bool newer() = 0;
  // A newer question interrupts the run of `L`, from `makes_way` on; null: no run.
  virtual void watch(lua_State* L, std::chrono::steady_clock::time_point makes_way) = 0;
  // `fields`: of the view, in the answer's order.
  virtual void send(const Json& answer, const std::vector<std::vector<float>>& fields) = 0;
};

// Keeps references. Takes over the standard output of the process. The result answers questions: it calls
// `send` up to three times, with the answer on fewer cells, the whole answer with the map in view, and the
// other maps.
std::function<void(const KnobQuestion&)> live_script(const ConfinedRequest& request, KnobAsker& asker);

// Returns the exit status if the socket is closed or a script cannot be stopped.
int run_as_knobs_move(const ConfinedRequest& request, int socket);

}  // namespace asperity::web
