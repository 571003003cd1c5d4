// SPDX-License-Identifier: GPL-3.0-or-later
// The singular value decomposition A = U Σ Vᵀ of a small table with more rows than columns, by one-sided
// Jacobi rotations (Hestenes 1958): small singular values keep their digits, and sums run in one order, so
// that the result is the same bits on every processor. For the normal equations of fits; O(rows × columns²) a
// sweep.
#pragma once

#include <cstddef>
#include <vector>

namespace asperity {

// Columns of equal length.
using TableColumns = std::vector<std::vector<double>>;

struct SingularValues {
  TableColumns u;              // orthonormal columns; zero where the value is 0
  std::vector<double> values;  // descending, not negative
  TableColumns v;              // v[k][j]: component j of the direction of value k
};

// Every entry must be finite.
SingularValues singular_values(TableColumns columns);

}  // namespace asperity
