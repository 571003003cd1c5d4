// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity --confined`: the child of `asperity serve` and `asperity run --confined`. It reads a request from
// standard input, confines itself (sandbox/confinement.hpp), and then runs or checks a script, runs a command
// or gnuplot, or tries the barriers.
#pragma once

namespace asperity::web {

// Returns the exit status. main() must call this first.
int confined_main();

}  // namespace asperity::web
