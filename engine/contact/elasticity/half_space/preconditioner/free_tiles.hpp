// SPDX-License-Identifier: GPL-3.0-or-later
// The free set in tiles with margins as wide as the number of sweeps, and the groups of eight nodes that
// sweeps change: of one chessboard colour, not free, near the edge. A patch is a tile with its margin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/contact/scene/boundary.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// Loops on disjoint arrays, without bounds checks. Sweeps alternate between the chessboard colours, in place.
// A patch row stores odd columns `half` values after even ones: neighbours of eight nodes are contiguous.
namespace edge_rows {

constexpr int group = 8;  // nodes of one colour in a sweep
constexpr int columns = 2 * group;
constexpr int bits = 64;

// Sets bit place + k if byte k is 1; bytes are 0 or 1.
void pack(const std::uint8_t* bytes, std::size_t n, std::size_t place, std::uint64_t* words);
bool differ(const std::uint8_t* a, const std::uint8_t* b, std::size_t n);
void copy_marks(const std::uint8_t* from, std::size_t n, std::uint8_t* to);
// From `place` to place + n.
void fill_bits(std::size_t place, std::size_t n, std::uint64_t* words);
// To the four neighbours.
void widen(Array<std::uint64_t>& field, int rows, std::size_t row_words, Array<std::uint64_t>& work);

void add_times(double factor, const double* from, std::size_t n, double* to);
void convert(const double* from, double factor, double offset, std::size_t n, float* to);
void convert(const float* from, double scale, std::size_t n, double* to);
void add_free(const std::uint8_t* free, const SmoothRow<double>& from, std::size_t n, double* to);
void fill(const SmoothRow<float>& from, std::size_t n, float* to);

void add_marks(const std::uint8_t* free, std::size_t n, const SmoothExtension::Sums::Row<double>& to);
void add_residual(const std::uint8_t* free, const double* values, double slope, double offset, std::size_t n,
                  const SmoothExtension::Sums::Row<float>& to);
void add_difference(const float* a, const float* b, std::size_t n,
                    const SmoothExtension::Sums::Row<float>& to);
void add_values(const float* values, std::size_t n, const SmoothExtension::Sums::Row<float>& to);

// Forward start: now = offset + slope · values − less on the free set, else 0.
void start_free(const std::uint8_t* free, const double* values, double slope, double offset,
                const SmoothRow<float>& less, std::size_t n, std::size_t place, std::size_t half, float* now);
// Transposed start: given = values, now = 0.
void start_bound(const float* values, std::size_t n, std::size_t place, std::size_t half, float* given,
                 float* now);

// Place of eight nodes in a patch (below 2^24), a bit for each bound node.
using Group = std::uint32_t;
constexpr int start_bits = 24;
// Every second of sixteen marks from bit `lane`.
Group group_of(std::size_t start, std::size_t lane, std::uint64_t marks);

// now = share · sum of the four neighbours, off the free set. Rows are 2·half apart.
void sweep_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share, float* now);
// now = share · (given + sum of the four neighbours), 0 on the free set.
void sweep_back_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share,
                       const float* given, float* now);
// Restores the column order and adds `more`.
void merge(const float* row, std::ptrdiff_t half, const SmoothRow<float>& more, std::size_t n, float* to);
// to = values + the four neighbours if free, else 0.
void add_neighbours(const std::uint8_t* free, const float* values, const float* row, std::ptrdiff_t half,
                    std::size_t n, float* to);

}  // namespace edge_rows

struct FreeTile {
  // By distance from the free set.
  struct Groups {
    Array<edge_rows::Group> starts;
    Array<std::uint32_t> reached;  // count within 0, 1, … steps
    std::span<const edge_rows::Group> within(int steps) const {
      return std::span(starts.data(), reached[static_cast<std::size_t>(steps)]);
    }
  };
  int x, y, width, height;
  bool stale = true;          // the patch changed
  bool holds_free = false;    // a free node in the tile
  bool reaches_free = false;  // a free node in the patch
  bool swept = false;         // a node of the patch is not free
  Groups groups[2][2] = {};   // by colour and column parity
};

class FreeTiles {
 public:
  static constexpr int width = 512, height = 32;

  // Initially no node is free.
  FreeTiles(int nx, int ny, Boundary boundary, int sweeps);

  // Free: free[k] != 0. Calls renewed(tile) for each changed patch, multithreaded.
  void set(std::span<const std::uint8_t> free, const std::function<void(std::size_t tile)>& renewed);

  std::size_t count() const { return tiles_.size(); }
  const FreeTile& operator[](std::size_t tile) const { return tiles_[tile]; }
  std::size_t nodes() const { return free_.size(); }
  std::size_t node(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i);
  }
  const std::uint8_t* marks(std::size_t k) const { return free_.data() + k; }

  int sweeps() const { return sweeps_; }
  bool bounded() const { return !wraps_x_ || !wraps_y_; }
  int patch_height(const FreeTile& tile) const { return tile.height + 2 * sweeps_; }
  std::size_t patch_width() const { return static_cast<std::size_t>(width + 2 * margin_); }
  // From even to odd columns.
  std::ptrdiff_t half() const { return width / 2 + margin_ + edge_rows::group; }
  std::size_t row_places() const { return 2 * static_cast<std::size_t>(half()); }
  // Start of row j of the patch (an extra row on either side), of the tile.
  std::size_t patch_row(int j) const { return static_cast<std::size_t>(j + 1) * row_places(); }
  std::size_t core_row(int j) const { return patch_row(j + sweeps_) + static_cast<std::size_t>(margin_ / 2); }
  std::size_t patch_places() const { return patch_row(height + 2 * sweeps_ + 1) + edge_rows::group; }

  // Calls run(column, node, length) for row j on the grid.
  template <class Run>
  void each_run(const FreeTile& tile, int j, const Run& run) const;

 private:
  struct Bits {
    Array<std::uint64_t> free, bound, near, nearer, found;
    explicit Bits(std::size_t words) : free(words), bound(words), near(words), nearer(words), found(words) {}
  };
  void find_groups(FreeTile& tile);
  std::size_t row_words() const {
    return (patch_width() + edge_rows::bits - 1) / static_cast<std::size_t>(edge_rows::bits);
  }

  int nx_, ny_;
  bool wraps_x_, wraps_y_;
  int sweeps_, margin_;
  Array<std::uint8_t> free_;
  std::vector<FreeTile> tiles_;
  ScratchPool<Bits> bits_;
};

template <class Run>
void FreeTiles::each_run(const FreeTile& tile, int j, const Run& run) const {
  int y = tile.y - sweeps_ + j;
  if (wraps_y_)
    y = (y % ny_ + ny_) % ny_;
  else if (y < 0 || y >= ny_)
    return;
  int x = tile.x - margin_;
  const int end = tile.x + tile.width + margin_;
  std::size_t column = 0;
  while (x < end) {
    if (!wraps_x_ && x < 0) {
      column += static_cast<std::size_t>(-x);
      x = 0;
    }
    const int i = wraps_x_ ? (x % nx_ + nx_) % nx_ : x;
    if (i >= nx_) return;
    const int length = std::min(end - x, nx_ - i);
    run(column, node(i, y), static_cast<std::size_t>(length));
    column += static_cast<std::size_t>(length);
    x += length;
  }
}

}  // namespace asperity
