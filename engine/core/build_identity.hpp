// SPDX-License-Identifier: GPL-3.0-or-later
// Which build of the program runs: the identity that the linker stamped on the object which holds this code
// (the GNU build id, a digest of its machine code). Two builds of one version may round differently.
#pragma once

#include <string>

namespace asperity {

// Hexadecimal digits; "" where the linker stamped none.
std::string build_identity();

}  // namespace asperity
