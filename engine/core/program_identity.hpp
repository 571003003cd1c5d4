// SPDX-License-Identifier: GPL-3.0-or-later
// Identity of the running code. GNU build ids distinguish builds of one version, which may round differently.
// The C library selects functions by processor; c_library_functions() identifies their rounding, which
// affects `^` and `math` in scripts and contacts spread over ranks, but not the engine
// (arithmetic/elementary_functions.hpp).
#pragma once

#include <string>
#include <string_view>

namespace asperity {

// Build ids of the calling object and of this code's object, hexadecimal; "" without id. Equal for all
// processor levels of the numeric library.
std::string build_identity();

// The loaded numeric code: vector bytes (16, 32 or 64) and processor level ("x86-64-v3"; "" on other
// architectures).
int vector_bytes();
std::string_view vector_level();

// "glibc 2.36"; "" if unknown.
std::string c_library_version();

// 32 hexadecimal digits; equal digests mean equal numbers in scripts. About a millisecond at the first call.
// Thread-safe.
const std::string& c_library_functions();

}  // namespace asperity
