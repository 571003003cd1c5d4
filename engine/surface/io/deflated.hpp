// SPDX-License-Identifier: GPL-3.0-or-later
// Gzip files (RFC 1952) and zlib streams (RFC 1950). The output size is bounded before unpacking. Wraps
// zlib.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Greatest expansion of deflate.
constexpr std::uint64_t most_of_deflate = 1032;

// Output limit: 16 MiB, or 128 bytes per byte of the file if larger. Text packs about ten times.
std::uint64_t most_of_gzip(const SourceFile& file);

// The unpacked file, with the extension before ".gz"; none without gzip. Concatenates gzip members. Throws
// Error{bad_file} for a truncated or damaged file or above most_of_gzip(), and Error{out_of_memory}.
std::optional<SourceFile> inside_gzip(const SourceFile& file, Monitor& monitor);

// Exactly `wanted` bytes from a zlib stream. Throws Error{bad_file}, naming the piece as `what`, for damage
// or another size.
Array<char> inflated(const SourceFile& file, std::string_view packed, std::uint64_t wanted,
                     std::string_view what);

}  // namespace asperity
