// SPDX-License-Identifier: GPL-3.0-or-later
// A script that stays loaded in a confined process and runs again whenever its knobs move. Every heavy call
// with unchanged inputs is answered from memory. Questions and answers pass through a socket in frames
// (frames.hpp).
// A question is {move, knobs, view}: number of the move, knob values by name, and the displayed view
// ("press-1"; "": the last). Only the newest waiting question is answered.
// An answer is JSON, followed by the numbers of each field of the view in single precision: {move, part,
// factor, cells, seconds, computed, recalled, events, views, view}. `part` is "coarse" if every `cells` of
// the script was multiplied by `factor` (the full answer follows), "whole", or "outdated" if a newer question
// ended the run. `events` are a run's events (event_channel.hpp).
// After os.exit(n) the answer has the results so far and `exit`, n; for n other than 0 the events include an
// error. The process continues, and the next move runs the script again. Live runs draw no pictures with
// gnuplot and record nothing; the next run deletes all written files.
#pragma once

#include "bindings/web/confined/confined.hpp"

namespace asperity::web {

// Returns the exit status when the socket is closed or a script cannot be stopped.
int run_as_knobs_move(const ConfinedRequest& request, int socket);

}  // namespace asperity::web
