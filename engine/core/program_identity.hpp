// SPDX-License-Identifier: GPL-3.0-or-later
// Identity of the running code. GNU build ids distinguish builds of one version. The C library selects
// functions by processor; their rounding affects `^` and `math` in scripts and contacts spread over ranks,
// but not the engine (arithmetic/elementary_functions.hpp).
#pragma once

#include <string>
#include <string_view>

namespace asperity {

// Build ids of the calling object and of this code's object; "" without id. Equal for all processor levels.
std::string build_identity();

// 16, 32 or 64; "x86-64-v3" ("" on other architectures).
int vector_bytes();
std::string_view vector_level();

// "glibc 2.36"; "" if unknown.
std::string c_library_version();

// Digest; equal digests mean equal numbers in scripts. Thread-safe.
const std::string& c_library_functions();

}  // namespace asperity
