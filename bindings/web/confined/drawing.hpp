// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of a confined run, which can start no program. The run sends gnuplot's input to the server. The
// server runs gnuplot in a separate confined process that reaches only its fonts, and returns the picture.
// The server treats the input as hostile, because a script may have taken over the run.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bindings/web/confined/confined.hpp"
#include "engine/plot/gnuplot.hpp"

namespace asperity::web {

// In the run: the process at the other end of this socket draws.
void draw_by_server(int socket);

// In the server: reads one request, draws, and answers. Blocks for at most the time limit of a picture.
// Returns false if the other end is closed or sent no valid request. `barriers`: required in the drawing
// process. `given_up`: when true, drawing stops.
bool answer_drawing(int socket, const std::vector<std::string>& barriers, const std::atomic<bool>& given_up);

}  // namespace asperity::web
