// SPDX-License-Identifier: GPL-3.0-or-later
// Header of an NPY file (NumPy).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

struct NpyHeader {
  NumberType type;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::size_t data_at = 0;  // bytes from the beginning of the file
};

// `file` may hold only the first 64 KiB. Throws Error{bad_file}.
NpyHeader read_npy_header(const SourceFile& file);

// Version 1, doubles. `shape`: "ny, nx", or "n," for a trace.
std::string npy_header(const std::string& shape);

}  // namespace asperity
