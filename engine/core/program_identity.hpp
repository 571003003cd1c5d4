// SPDX-License-Identifier: GPL-3.0-or-later
// Identity of the running code. The GNU build ids of program or module and of the numeric library distinguish
// builds of one version, which may round differently. The C library selects functions by processor at start;
// c_library_functions() identifies their rounding. Engine results do not depend on the C library
// (arithmetic/elementary_functions.hpp); `^` and `math` in scripts, and contacts spread over ranks, do.
#pragma once

#include <string>
#include <string_view>

namespace asperity {

// Build ids of the calling object and of the object with this code, hexadecimal; "" without id. The numeric
// library has one build id for all processor levels.
std::string build_identity();

// Vector bytes (16, 32 or 64) and processor level of the loaded numeric code ("x86-64-v3"; "" on other
// architectures).
int vector_bytes();
std::string_view vector_level();

// "glibc 2.36"; "" if unknown.
std::string c_library_version();

// Digest of function values, 32 hexadecimal digits; equal digests mean equal numbers in scripts. The first
// call takes about a millisecond. Thread-safe.
const std::string& c_library_functions();

}  // namespace asperity
