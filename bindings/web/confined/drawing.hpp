// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of a confined run, which can start no program: it sends what gnuplot is to draw to the server, the
// server has gnuplot draw it in a confined process of its own, with nothing to reach but its fonts, and sends
// the picture back. What arrives at the server is taken for hostile, though the run's own code made it.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bindings/web/confined/confined.hpp"
#include "engine/plot/gnuplot.hpp"

namespace asperity::web {

// In the run: pictures are drawn by who listens at the other end of this socket.
void draw_by_server(int socket);

// In the server: reads one request from the socket, draws, answers. Waits for as long as a picture may take;
// false where the other end is gone or sent what is no request. `barriers` must stand in the drawing process.
// What is being drawn is given up as soon as `given_up` is true.
bool answer_drawing(int socket, const std::vector<std::string>& barriers, const std::atomic<bool>& given_up);

}  // namespace asperity::web
