// SPDX-License-Identifier: GPL-3.0-or-later
// What runs: the identity that the linker stamped on the program or module, and on the numeric library if
// that is apart (the GNU build id, a digest of the machine code), for two builds of one version may round
// differently; and the C library, with how its sines, exponentials and powers round here: it chooses them
// by the processor when the program starts. Results of the engine do not depend on it
// (arithmetic/elementary_functions.hpp); what a script computes itself by `^` and `math`, and contacts
// spread over ranks, do.
#pragma once

#include <string>
#include <string_view>

namespace asperity {

// Build ids of the object that calls and of the one that holds this code, hexadecimal digits; "" where the
// linker stamped none. The numeric library has one build id at every level of processor.
std::string build_identity();

// The loaded numeric code: bytes of a vector (16, 32 or 64), and the level of processor that the code is
// compiled for ("x86-64-v3"; "" on other architectures).
int vector_bytes();
std::string_view vector_level();

// "glibc 2.36"; "" where the library does not say.
std::string c_library_version();

// A digest of values of its functions, 32 hexadecimal digits: equal where scripts find the same numbers. Made
// at the first call, in about a millisecond. Thread-safe.
const std::string& c_library_functions();

}  // namespace asperity
