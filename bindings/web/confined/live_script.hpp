// SPDX-License-Identifier: GPL-3.0-or-later
// A script that stays loaded in a confined process and is run again whenever its knobs move, with every heavy
// call whose inputs are unchanged taken from memory. It is asked through a socket and answers through it, in
// frames (frames.hpp). A question is {move, knobs, view}: the number of the move, what the knobs are set to
// by name, and the view that is looked at ("press-1"; "" the last). Of the questions that wait only the
// newest is answered. An answer is JSON, and after it the numbers of each field of the view in single
// precision: {move, part, factor, cells, seconds, computed, recalled, events, views, view}. `part` is
// "coarse" where every `cells` of the script was multiplied by `factor`, after which the whole answer
// follows; "whole"; or "outdated" where a newer question ended the run. `events` are those of a run
// (event_channel.hpp). A script that ends itself by os.exit(n) is answered with what it found until then and
// `exit`, n; where n is not 0, an error among the events says so. Its process stays, and the next move runs
// the script again. What does not show is left out: no picture is drawn by gnuplot, nothing is recorded, and
// what the script writes is gone with the next run.
#pragma once

#include "bindings/web/confined/confined.hpp"

namespace asperity::web {

// Until the other end of the socket is closed, or a script cannot be stopped. The exit status of the process.
int run_as_knobs_move(const ConfinedRequest& request, int socket);

}  // namespace asperity::web
