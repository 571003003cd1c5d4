// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/preconditioner/free_tiles.hpp"

#include <bit>
#include <memory>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

using namespace edge_rows;

FreeTiles::FreeTiles(int nx, int ny, Boundary boundary, int sweeps)
    : nx_(nx),
      ny_(ny),
      // Where a period is odd, two nodes of one colour meet: nothing is carried on there.
      wraps_x_(boundary == Boundary::periodic && nx % 2 == 0),
      wraps_y_(boundary == Boundary::periodic && ny % 2 == 0),
      sweeps_(sweeps),
      margin_((sweeps + columns) / columns * columns),
      free_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0) {
  for (int y = 0; y < ny; y += height)
    for (int x = 0; x < nx; x += width)
      tiles_.push_back({x, y, std::min(width, nx - x), std::min(height, ny - y)});
}

void FreeTiles::set(std::span<const std::uint8_t> free,
                    const std::function<void(std::size_t tile)>& renewed) {
  if (free.size() != free_.size()) throw Error(ErrorCode::internal, "a free set of another grid");
  const auto count = static_cast<std::int64_t>(tiles_.size());
  // Late in a solve few tiles see a new mark.
  parallel_for(count, [&](std::int64_t k) {
    FreeTile& tile = tiles_[static_cast<std::size_t>(k)];
    for (int j = 0; j < patch_height(tile) && !tile.stale; ++j)
      each_run(tile, j, [&](std::size_t, std::size_t from, std::size_t length) {
        tile.stale = tile.stale || differ(free.data() + from, free_.data() + from, length);
      });
  });
  parallel_for(count, [&](std::int64_t k) {
    const FreeTile& tile = tiles_[static_cast<std::size_t>(k)];
    if (!tile.stale) return;
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t from = node(tile.x, j);
      copy_marks(free.data() + from, static_cast<std::size_t>(tile.width), free_.data() + from);
    }
  });
  parallel_for(count, [&](std::int64_t k) {
    FreeTile& tile = tiles_[static_cast<std::size_t>(k)];
    if (!tile.stale) return;
    tile.stale = false;
    find_groups(tile);
    renewed(static_cast<std::size_t>(k));
  });
}

void FreeTiles::find_groups(FreeTile& tile) {
  const int rows = patch_height(tile);
  const std::size_t row_words = this->row_words(), words = static_cast<std::size_t>(rows) * row_words;
  const auto patch = bits_.borrow(
      [&] { return std::make_unique<Bits>(static_cast<std::size_t>(height + 2 * sweeps_) * row_words); });
  const auto clear = [&](Array<std::uint64_t>& field) { std::fill_n(field.begin(), words, 0); };
  // Of row j of the patch, counted over the whole grid: nodes of one colour have an even sum of rows and
  // columns.
  const auto parity = [&](int j) { return (tile.y + sweeps_ + j) % 2; };
  clear(patch->free);
  clear(patch->bound);
  clear(patch->found);
  for (int j = 0; j < rows; ++j) {
    const std::size_t start = static_cast<std::size_t>(j) * row_words;
    each_run(tile, j, [&](std::size_t column, std::size_t from, std::size_t length) {
      pack(free_.data() + from, length, column, patch->free.data() + start);
      fill_bits(column, length, patch->bound.data() + start);
    });
    for (std::size_t w = start; w < start + row_words; ++w) patch->bound[w] &= ~patch->free[w];
  }
  const auto any = [&](int first, int last) {
    return std::any_of(patch->free.begin() + first * static_cast<std::ptrdiff_t>(row_words),
                       patch->free.begin() + last * static_cast<std::ptrdiff_t>(row_words),
                       [](std::uint64_t word) { return word != 0; });
  };
  tile.holds_free = any(sweeps_, sweeps_ + tile.height);
  tile.reaches_free = any(0, rows);
  tile.swept = std::any_of(patch->bound.begin(), patch->bound.begin() + static_cast<std::ptrdiff_t>(words),
                           [](std::uint64_t word) { return word != 0; });
  for (auto& of_colour : tile.groups)
    for (FreeTile::Groups& groups : of_colour) {
      groups.starts.clear();
      groups.reached.assign(1, 0);
    }
  if (!tile.reaches_free) return;
  std::copy_n(patch->free.begin(), words, patch->near.begin());
  for (int step = 1; step <= sweeps_; ++step) {
    widen(patch->near, rows, row_words, patch->nearer);
    for (std::size_t w = 0; w < words; ++w) {
      const std::uint64_t fresh = patch->near[w] & patch->bound[w] & ~patch->found[w];
      if (fresh == 0) continue;
      const int j = static_cast<int>(w / row_words);
      for (const int odd : {0, 1}) {
        constexpr std::uint64_t even_columns = 0x5555555555555555u;
        Array<Group>& starts = tile.groups[(parity(j) + odd) % 2][odd].starts;
        std::uint64_t rest = fresh & even_columns << odd;
        while (rest != 0) {
          const int lane = std::countr_zero(rest) / columns * columns;
          const std::uint64_t whole = (even_columns << odd) & std::uint64_t{0xffff} << lane;
          patch->found[w] |= whole;
          rest &= ~whole;
          const std::size_t column = w % row_words * bits + static_cast<std::size_t>(lane);
          starts.push_back(group_of(patch_row(j) + static_cast<std::size_t>(odd * half()) + column / 2,
                                    static_cast<std::size_t>(lane + odd), patch->bound[w]));
        }
      }
    }
    for (auto& of_colour : tile.groups)
      for (FreeTile::Groups& groups : of_colour)
        groups.reached.push_back(static_cast<std::uint32_t>(groups.starts.size()));
  }
}

}  // namespace asperity
