// SPDX-License-Identifier: GPL-3.0-or-later
// A regular grid and a field of doubles. Node (i, j), i along x, j along y, both from 0, is at (i·hx, j·hy),
// hx = size_x / nx. Value (i, j) has the index j·nx + i.
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

inline constexpr int max_cells = 65536;

// Throws Error{bad_value} naming `cells` or `size` unless 1 <= nx, ny <= max_cells and sizes are finite with
// a positive cell width.
Grid make_grid(double nx, double ny, double size_x, double size_y);

class Field {
 public:
  Field() = default;
  Field(int nx, int ny, double value = 0.0)
      : nx_(nx), ny_(ny), values_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), value) {}
  // Throws Error{internal} unless there are nx·ny values.
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

// Pairwise sum of fixed blocks of 1024; the error grows with log n.
double block_sum(std::span<const double> values);
// The upper of two middle values. Needs at least one value. O(n); reorders.
double upper_median(std::span<double> values);
double mean(std::span<const double> values);
struct Range {
  double min = 0, max = 0;
  double span() const { return max - min; }
};
// {0, 0} without values.
Range range(std::span<const double> values);

// Ignore NaN. Equal to mean and range to the bit if no value is missing.
std::size_t known_count(std::span<const double> values);
double known_mean(std::span<const double> values);
Range known_range(std::span<const double> values);

// Throws Error{bad_value} unless i and j are integers inside the field.
double node_value(const Field& field, double i, double j);

}  // namespace asperity
