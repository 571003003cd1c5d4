// SPDX-License-Identifier: GPL-3.0-or-later
// A script that stays loaded in a confined process and runs again when its knobs move; heavy calls with
// unchanged inputs are answered from memory. Messages are frames (frames.hpp) through a socket.
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

#include "bindings/web/confined/confined_request.hpp"

namespace asperity::web {

// Returns the exit status if the socket is closed or a script cannot be stopped.
int run_as_knobs_move(const ConfinedRequest& request, int socket);

}  // namespace asperity::web
