// SPDX-License-Identifier: GPL-3.0-or-later
// A view of the machine of the process's own: a network without a way out, and a tree of files in which
// there is its working directory and nothing else. The kernel grants it to root, and to everybody where user
// namespaces are allowed.
#pragma once

#include <string>

namespace asperity::web {

// Why each could not be had; "" where it was.
struct Namespaces {
  std::string user, network, mount;
};
Namespaces enter_namespaces();

// Makes a root that holds the working directory as /run, and /dev/null. Needs a mount namespace of its own.
// Returns why it could not, and then everything is as it was, or "".
std::string enter_own_root();

}  // namespace asperity::web
