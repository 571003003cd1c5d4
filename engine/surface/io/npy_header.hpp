// SPDX-License-Identifier: GPL-3.0-or-later
// Header of an NPY file (NumPy).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/files/source_file.hpp"

namespace asperity {

struct NpyHeader {
  char order = '|';  // '<' or '>' or '|'
  char kind = 'f';   // f, i, u
  std::size_t width = 8;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::size_t data_at = 0;  // bytes from the beginning of the file
  bool swapped() const;     // byte order differs from this machine's
};

// `file` may hold only the first 64 KiB. Throws Error{bad_file}.
NpyHeader read_npy_header(const SourceFile& file);

// Converts the bytes of one number.
using NpyNumber = double (*)(const char* at, bool swap);
NpyNumber npy_number(const NpyHeader& header);

}  // namespace asperity
