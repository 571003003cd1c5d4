// SPDX-License-Identifier: GPL-3.0-or-later
// Places in a text as a browser counts them, in units of UTF-16, and as this program does, in bytes of UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace asperity::web {

// The byte at which that unit begins, or the one its character begins at; the end for what lies beyond it.
std::size_t byte_of_unit(std::string_view text, std::size_t unit);
// How many units stand before that byte.
std::size_t unit_of_byte(std::string_view text, std::size_t byte);

}  // namespace asperity::web
