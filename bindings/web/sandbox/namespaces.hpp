// SPDX-License-Identifier: GPL-3.0-or-later
// Namespaces: no network, and a file tree with the given folders only. For root, and for all users if user
// namespaces are allowed.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

// Reasons of failures; "" on success.
struct Namespaces {
  std::string user, network, mount;
};
Namespaces enter_namespaces();

// Mounts a root with the places and /dev/null over the working directory and enters its folder `work`, which
// is empty unless a place. Needs an own mount namespace. Returns "", or the reason of a failure with the
// files unchanged.
std::string enter_own_root(const std::vector<Place>& places, const std::string& work);

}  // namespace asperity::web
