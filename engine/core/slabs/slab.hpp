// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a grid on one process, in blocks of ⌈ny/K⌉ as FFTW's MPI transforms; the last ones shorter or
// empty.
#pragma once

#include <algorithm>
#include <cstddef>

namespace asperity {

struct Slab {
  int nx = 0, ny = 0;  // of the whole grid
  int rank = 0, ranks = 1;

  int block() const { return (ny + ranks - 1) / ranks; }
  int first_of(int r) const { return std::min(r * block(), ny); }
  int rows_of(int r) const { return first_of(r + 1) - first_of(r); }
  int owner(int row) const { return row / block(); }
  int first() const { return first_of(rank); }
  int rows() const { return rows_of(rank); }
  std::size_t width() const { return static_cast<std::size_t>(nx); }
  std::size_t nodes() const { return width() * static_cast<std::size_t>(rows()); }  // of this process
  double all_nodes() const { return static_cast<double>(nx) * static_cast<double>(ny); }
  bool operator==(const Slab&) const = default;
};

}  // namespace asperity
