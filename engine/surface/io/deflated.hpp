// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes packed with deflate: a file inside gzip (RFC 1952), and a piece of a file inside zlib (RFC 1950).
// What comes out is bounded before it is unpacked. Wraps zlib.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Deflate makes at most 1032 bytes of one.
constexpr std::uint64_t most_of_deflate = 1032;

// The most that unpacking a gzip file gives: 16 MiB, or 128 bytes for each of the file where that is more.
// Text packs some ten times; a file that packs better is not one of measured heights.
std::uint64_t most_of_gzip(const SourceFile& file);

// What a file packed with gzip holds, under the same name, with the ending before ".gz"; none for any other
// file. Several pieces one after another are one. Throws Error{bad_file} for a file that is cut short,
// damaged or unpacks to more than most_of_gzip(), Error{out_of_memory}.
std::optional<SourceFile> inside_gzip(const SourceFile& file, Monitor& monitor);

// Exactly `wanted` bytes out of a zlib stream. Throws Error{bad_file}, naming the piece as `what`, where the
// stream is damaged, holds another number of bytes, or could not hold so many.
Array<char> inflated(const SourceFile& file, std::string_view packed, std::uint64_t wanted,
                     std::string_view what);

}  // namespace asperity
