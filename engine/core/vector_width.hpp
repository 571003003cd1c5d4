// SPDX-License-Identifier: GPL-3.0-or-later
// The vectors of the numeric code that was loaded. Packages hold this code once for each level of processor.
#pragma once

#include <string_view>

namespace asperity {

int vector_bytes();               // width of a vector: 16, 32 or 64
std::string_view vector_level();  // "x86-64-v3": the highest level compiled for; "" on other architectures

}  // namespace asperity
