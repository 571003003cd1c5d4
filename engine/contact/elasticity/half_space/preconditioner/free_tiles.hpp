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
#include "engine/contact/elasticity/half_space/preconditioner/edge_rows.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/scratch_pool.hpp"

namespace asperity {

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
