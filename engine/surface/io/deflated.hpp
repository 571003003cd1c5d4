// SPDX-License-Identifier: GPL-3.0-or-later
// Gzip files (RFC 1952). The output size is bounded before unpacking. Wraps zlib.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Output limit: 16 MiB, or 128 bytes per byte of the file if larger.
std::uint64_t most_of_gzip(const SourceFile& file);

// The unpacked file, with the extension before ".gz"; none without gzip. Throws Error{bad_file} for damage or
// above most_of_gzip(), and Error{out_of_memory}.
std::optional<SourceFile> inside_gzip(const SourceFile& file, Monitor& monitor);

}  // namespace asperity
