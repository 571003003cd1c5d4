// SPDX-License-Identifier: GPL-3.0-or-later
// The process's own view of the machine: a network without a way out, and a tree of files with only the given
// folders. The kernel grants this to root, and to every user if user namespaces are allowed.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// The reason of each failure; "" on success.
struct Namespaces {
  std::string user, network, mount;
};
Namespaces enter_namespaces();

// Mounts a root with the places, as seen by the script, and /dev/null over the working directory, and changes
// to its folder `work`, which is empty unless it is a place. Needs an own mount namespace. Returns "", or the
// reason of a failure; the process then sees its files as before.
std::string enter_own_root(const std::vector<Place>& places, const std::string& work);

}  // namespace asperity::web
