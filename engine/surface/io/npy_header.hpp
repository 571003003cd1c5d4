// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a file in NumPy's NPY format, for readers of all or of a part of its numbers.
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
  bool swapped() const;     // bytes run the other way than on this machine
};

// Of a file, or of its first 64 KiB and more. Throws Error{bad_file}.
NpyHeader read_npy_header(const SourceFile& file);

// Takes one number of the file out of its bytes.
using NpyNumber = double (*)(const char* at, bool swap);
NpyNumber npy_number(const NpyHeader& header);

}  // namespace asperity
