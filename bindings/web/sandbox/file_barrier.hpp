// SPDX-License-Identifier: GPL-3.0-or-later
// Landlock: which files a process may still open, by their place in the tree. Linux 5.13 and later, where
// it is switched on; needs no rights.
#pragma once

#include <string>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// Shuts every file but those of the places, or of the working directory where there are none, and what a
// drawing needs besides. Returns why it could not,
// or "" and the version of the kernel's interface. No new rights must have been given up before.
std::string confine_files(const Confinement& confinement, int& version);

}  // namespace asperity::web
