// SPDX-License-Identifier: GPL-3.0-or-later
// A regular grid of cells and a field of doubles on it. Index i runs along x, j along y, both from
// 0; node (i, j) stands at (i·hx, j·hy) with hx = size_x / nx. A field is stored row by row: one row
// is one y, so value (i, j) is at j·nx + i.
#pragma once

#include <cstddef>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

struct Grid {
  int nx = 0, ny = 0;             // cells
  double size_x = 0, size_y = 0;  // m

  double hx() const { return size_x / nx; }
  double hy() const { return size_y / ny; }
  double cell_area() const { return hx() * hy(); }
  double area() const { return size_x * size_y; }
  std::size_t nodes() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  bool operator==(const Grid&) const = default;
};

// The greatest number of cells a side.
inline constexpr int max_cells = 65536;

// A grid whose numbers make sense. Throws Error{bad_value} naming `cells` or `size` otherwise:
// 1 <= nx, ny <= max_cells; sizes finite and so far above zero that cells have a width.
Grid make_grid(double nx, double ny, double size_x, double size_y);

// Values on a grid; copying copies the numbers.
class Field {
 public:
  Field() = default;
  // Every value starts as `value`.
  Field(int nx, int ny, double value = 0.0)
      : nx_(nx), ny_(ny), values_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), value) {}
  // Takes over nx·ny values. Throws Error{internal} if they are not as many.
  Field(int nx, int ny, UnsetArray<double>&& values);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }

  double operator()(int i, int j) const { return values_[index(i, j)]; }
  double& operator()(int i, int j) { return values_[index(i, j)]; }
  double operator[](std::size_t k) const { return values_[k]; }
  double& operator[](std::size_t k) { return values_[k]; }

  std::span<const double> row(int j) const { return {data() + index(0, j), static_cast<std::size_t>(nx_)}; }
  std::span<double> row(int j) { return {data() + index(0, j), static_cast<std::size_t>(nx_)}; }
  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }
  const double* data() const { return values_.data(); }
  double* data() { return values_.data(); }

 private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i);
  }
  int nx_ = 0, ny_ = 0;
  UnsetArray<double> values_;
};

// Sum in fixed blocks of 1024 added pairwise: the same bits for any number of threads, and an error
// that grows with log n.
double block_sum(std::span<const double> values);
// The median of one value or more, of two in the middle the upper one. O(n); reorders them.
double upper_median(std::span<double> values);
double mean(std::span<const double> values);
struct Range {
  double min = 0, max = 0;
  double span() const { return max - min; }
};
// {0, 0} for no values.
Range range(std::span<const double> values);

// The same of a field that is missing (NaN) where there is nothing to measure: over the values that are
// there, and to the bit mean and range where all are.
std::size_t known_count(std::span<const double> values);
double known_mean(std::span<const double> values);
Range known_range(std::span<const double> values);

// The value at node (i, j), by numbers that came from a script and may be anything. Throws Error{bad_value}
// unless both are whole numbers inside the field.
double node_value(const Field& field, double i, double j);

}  // namespace asperity
