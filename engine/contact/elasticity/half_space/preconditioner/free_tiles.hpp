// SPDX-License-Identifier: GPL-3.0-or-later
// The free set of a contact, cut into tiles that have margins as wide as there are sweeps, and in every tile
// the groups of eight nodes that sweeps change: of one colour of a chessboard, off the set and near its edge.
// A patch is a tile with its margin as it is laid out for sweeping, in each of its rows the even columns
// before the odd ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/contact/boundary.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/scratch_pool.hpp"

namespace asperity {

// The loops over rows of the contact preconditioner, apart so that each is plain arithmetic on arrays
// that do not overlap: marks of the free set as bits and their distance, conversion between single and
// double, and the sweeps next to the free set's edge. Sweeps take the two colours of a chessboard by turns,
// in place: a row is kept as its even columns and then, `half` values further on, its odd ones, so that the
// neighbours of eight nodes of one colour lie side by side. No bounds are checked.
namespace edge_rows {

constexpr int group = 8;            // nodes of one colour that are swept together
constexpr int columns = 2 * group;  // that they are spread over
constexpr int bits = 64;            // of a word of marks

// Sets bit place + k for each of `n` bytes, which are 0 or 1, that is 1.
void pack(const std::uint8_t* bytes, std::size_t n, std::size_t place, std::uint64_t* words);
// Whether one of two bytes, but not the other, is 0 anywhere.
bool differ(const std::uint8_t* a, const std::uint8_t* b, std::size_t n);
// 1 where a byte is not 0.
void copy_marks(const std::uint8_t* from, std::size_t n, std::uint8_t* to);
// Sets the bits from `place` to place + n.
void fill_bits(std::size_t place, std::size_t n, std::uint64_t* words);
// Every bit of `rows` rows also to the four places beside it; `work` is as large as the field.
void widen(Array<std::uint64_t>& field, int rows, std::size_t row_words, Array<std::uint64_t>& work);

// to += factor · from.
void add_times(double factor, const double* from, std::size_t n, double* to);
// to = offset + factor · from.
void convert(const double* from, double factor, double offset, std::size_t n, float* to);
void convert(const float* from, double scale, std::size_t n, double* to);
// to += the smooth row where free.
void add_free(const std::uint8_t* free, const SmoothRow<double>& from, std::size_t n, double* to);
// to = the smooth row.
void fill(const SmoothRow<float>& from, std::size_t n, float* to);

// What sums over hats take of a row: marks; offset + slope · values where free; a − b.
void add_marks(const std::uint8_t* free, std::size_t n, const SmoothExtension::Sums::Row<double>& to);
void add_residual(const std::uint8_t* free, const double* values, double slope, double offset, std::size_t n,
                  const SmoothExtension::Sums::Row<float>& to);
void add_difference(const float* a, const float* b, std::size_t n,
                    const SmoothExtension::Sums::Row<float>& to);
void add_values(const float* values, std::size_t n, const SmoothExtension::Sums::Row<float>& to);

// What sweeps over a row of a patch start from, columns `place` and on of it: offset + slope · values − less
// on the free set, else 0, as now, …
void start_free(const std::uint8_t* free, const double* values, double slope, double offset,
                const SmoothRow<float>& less, std::size_t n, std::size_t place, std::size_t half, float* now);
// … or the values as given and 0 as now.
void start_bound(const float* values, std::size_t n, std::size_t place, std::size_t half, float* given,
                 float* now);

// Where eight nodes of one colour begin in a patch, which has less than 2^24 places, and above that a bit for
// each that is not free.
using Group = std::uint32_t;
constexpr int start_bits = 24;
// Of every second of sixteen marks, from bit `lane` on.
Group group_of(std::size_t start, std::size_t lane, std::uint64_t marks);

// now = share · the sum of its four neighbours off the free set, on groups of the even or of the odd columns,
// rows being 2·half apart.
void sweep_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share, float* now);
// now = share · (given + the sum of its four neighbours) off the free set, 0 on it.
void sweep_back_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share,
                       const float* given, float* now);
// The columns of a row of a patch in their order again, and `more` added.
void merge(const float* row, std::ptrdiff_t half, const SmoothRow<float>& more, std::size_t n, float* to);
// to = values + the four neighbours of the columns of a row where free, else 0.
void add_neighbours(const std::uint8_t* free, const float* values, const float* row, std::ptrdiff_t half,
                    std::size_t n, float* to);

}  // namespace edge_rows

struct FreeTile {
  // In order of their distance from the free set.
  struct Groups {
    Array<edge_rows::Group> starts;
    Array<std::uint32_t> reached;  // how many of them are within 0, 1, … steps
    std::span<const edge_rows::Group> within(int steps) const {
      return std::span(starts.data(), reached[static_cast<std::size_t>(steps)]);
    }
  };
  int x, y, width, height;
  bool stale = true;          // the marks of the tile or its margin are new
  bool holds_free = false;    // a free node in the tile
  bool reaches_free = false;  // or in its margin
  bool swept = false;         // or one that is not
  Groups groups[2][2] = {};   // by colour, and by even and odd columns
};

class FreeTiles {
 public:
  static constexpr int width = 512, height = 32;

  // nx, ny >= 1; sweeps >= 0. Nothing is free at first.
  FreeTiles(int nx, int ny, Boundary boundary, int sweeps);

  // The nodes where free[k] != 0, of as many as there are; calls renewed(tile) for each tile in whose patch
  // that is new, from several threads.
  void set(std::span<const std::uint8_t> free, const std::function<void(std::size_t tile)>& renewed);

  std::size_t count() const { return tiles_.size(); }
  const FreeTile& operator[](std::size_t tile) const { return tiles_[tile]; }
  std::size_t nodes() const { return free_.size(); }
  std::size_t node(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i);
  }
  // 1 from node k on where free, else 0.
  const std::uint8_t* marks(std::size_t k) const { return free_.data() + k; }

  int sweeps() const { return sweeps_; }
  // Whether a patch may reach beyond the grid.
  bool bounded() const { return !wraps_x_ || !wraps_y_; }
  int patch_height(const FreeTile& tile) const { return tile.height + 2 * sweeps_; }
  std::size_t patch_width() const { return static_cast<std::size_t>(width + 2 * margin_); }
  // From the even columns of a row of a patch to the odd ones.
  std::ptrdiff_t half() const { return width / 2 + margin_ + edge_rows::group; }
  std::size_t row_places() const { return 2 * static_cast<std::size_t>(half()); }
  // Where row j of a patch begins, there being a row more on either side, and where row j of its tile does.
  std::size_t patch_row(int j) const { return static_cast<std::size_t>(j + 1) * row_places(); }
  std::size_t core_row(int j) const { return patch_row(j + sweeps_) + static_cast<std::size_t>(margin_ / 2); }
  std::size_t patch_places() const { return patch_row(height + 2 * sweeps_ + 1) + edge_rows::group; }

  // Calls run(column, node, length) for the stretches of row j of a patch that lie on the grid.
  template <class Run>
  void each_run(const FreeTile& tile, int j, const Run& run) const;

 private:
  // One bit a node of a patch: free, on the grid but not free, within some steps of free.
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
