// SPDX-License-Identifier: GPL-3.0-or-later
// A view of the machine of the process's own: a network without a way out, and a tree of files in which
// there are the folders it was given and nothing else. The kernel grants it to root, and to everybody where
// user namespaces are allowed.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// Why each could not be had; "" where it was.
struct Namespaces {
  std::string user, network, mount;
};
Namespaces enter_namespaces();

// Makes a root that holds the places where they are to be seen, and /dev/null, and goes to the folder `work`
// of it, which is empty where it is no place. The root is put up over the working directory. Needs a mount
// namespace of its own. Returns why it could not, and then the process's files are as they were, or "".
std::string enter_own_root(const std::vector<Place>& places, const std::string& work);

}  // namespace asperity::web
