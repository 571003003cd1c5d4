// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of a confined run, which can start no program. The run sends gnuplot's input to the server; the
// server runs gnuplot in another confined process and returns the picture. The input counts as hostile,
// because the script may have taken over the run.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bindings/web/confined/confined.hpp"
#include "engine/plot/gnuplot.hpp"

namespace asperity::web {

// In the run: draws through the socket.
void draw_by_server(int socket);

// In the server: answers one request; blocks for at most a picture's time limit. False if the other end is
// closed or the request is invalid. `barriers`: required for drawing. `given_up`: stops drawing when true.
bool answer_drawing(int socket, const std::vector<std::string>& barriers, const std::atomic<bool>& given_up);

}  // namespace asperity::web
