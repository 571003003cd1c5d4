// SPDX-License-Identifier: GPL-3.0-or-later
// The sweeps are done tile by tile with a margin as wide as there are sweeps, so that a tile needs
// nothing of its neighbours and stays in the cache, and in it only on the groups of eight nodes of one colour
// that are near the edge of the free set. A sweep makes the nodes of one colour of a chessboard, off the free
// set, the mean of their four neighbours, which all are of the other. Its transpose passes what a node holds
// on to its neighbours, a quarter to each: what a node has passed on by then is v = D (y + N v), taken colour
// by colour in the opposite order, where N adds up the four neighbours and D is 1/4 off the free set and 0
// on it. On a line of nodes there are two neighbours, and halves.
#include "engine/contact/elasticity/half_space/contact_preconditioner.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/contact/elasticity/half_space/edge_rows.hpp"
#include "engine/contact/elasticity/half_space/half_order_pyramid.hpp"
#include "engine/contact/elasticity/half_space/smooth_extension.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/scratch_pool.hpp"

namespace asperity {

namespace {

using namespace edge_rows;

constexpr int tile_width = 256, tile_height = 64;
}  // namespace

class ContactPreconditioner::Parts {
 public:
  Parts(int nx, int ny, double aspect, Boundary boundary, int sweeps, double weight);
  void set_free(std::span<const std::uint8_t> free);
  double spread(const Residual& r);
  void gather(const Keep& keep);
  void smooth(std::size_t first, std::size_t n, double factor, double* values) const;
  double smooth_sum() const { return grow_ * rest_sum_; }
  void add_smooth(std::span<double> z) const;
  std::size_t tiles() const { return tiles_.size(); }
  std::size_t nodes() const { return free_.size(); }

 private:
  // Those near the edge of the free set, in order of their distance.
  struct Groups {
    Array<Group> starts;
    Array<std::uint32_t> reached;  // how many of them are within 0, 1, … steps
    std::span<const Group> within(int steps) const {
      return std::span(starts.data(), reached[static_cast<std::size_t>(steps)]);
    }
  };
  struct Tile {
    int x, y, width, height;
    SmoothExtension::Sums free_hats, hats;  // of the free nodes, and of what is passed on
    bool stale = true;                      // the marks of the tile or its margin are new
    bool holds_free = false;                // a free node in the tile
    bool reaches_free = false;              // or in its margin
    bool swept = false;                     // or one that is not
    // By colour, and by even and odd columns.
    Groups groups[2][2] = {};
  };
  // A tile with its margin, and a row more on either side.
  struct Patch {
    Array<float> given, now;
    // One bit a node: free, on the grid but not free, within some steps of free.
    Array<std::uint64_t> free, bound, near, nearer, found;
    Array<float> row;  // of it
    float sums[2 * tile_width];
    Patch(std::size_t nodes, std::size_t words, std::size_t width)
        : given(nodes),
          now(nodes),
          free(words),
          bound(words),
          near(words),
          nearer(words),
          found(words),
          row(width) {}
  };

  int patch_height(const Tile& tile) const { return tile.height + 2 * sweeps_; }
  std::size_t patch_row(int j) const { return static_cast<std::size_t>(j + 1) * 2 * half(); }
  // Where row j of the tile itself begins in its patch.
  std::size_t core_row(int j) const { return patch_row(j + sweeps_) + static_cast<std::size_t>(margin_ / 2); }
  std::size_t half() const { return static_cast<std::size_t>(half_); }
  // Of row j of the patch, counted over the whole grid: nodes of one colour have an even sum of rows and
  // columns.
  int parity(const Tile& tile, int j) const { return (tile.y + sweeps_ + j) % 2; }
  ScratchPool<Patch>::Loan borrow() {
    return patches_.borrow([this] {
      const int rows = tile_height + 2 * sweeps_;
      return std::make_unique<Patch>(patch_row(rows + 1) + group,
                                     static_cast<std::size_t>(rows) * row_words(),
                                     static_cast<std::size_t>(tile_width + 2 * margin_));
    });
  }
  template <class Run>
  void each_run(const Tile& tile, int j, const Run& run) const;
  void find_groups(Tile& tile);
  std::size_t row_words() const {
    return static_cast<std::size_t>((tile_width + 2 * margin_ + bits - 1) / bits);
  }
  template <class Put>
  void load(Patch& patch, const Tile& tile, const Put& put) const;
  void extend(const Tile& tile, const Residual& scaled);
  void gather_back(std::size_t number, Patch& patch, std::span<const float> y, const Keep& keep);
  double greatest(const Residual& r) const;
  template <class Add>
  void add_up_hats(const Add& add, Array<double>& total);
  template <class Real>
  void divide(const Array<double>& sums, Array<Real>& field) const;
  std::size_t node(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i);
  }

  int nx_, ny_;
  bool wraps_x_, wraps_y_;
  int sweeps_, margin_;
  int half_;     // from the even columns of a row of a patch to the odd ones
  float share_;  // of a neighbour in the mean of them
  HalfOrderPyramid pyramid_;
  SmoothExtension smooth_;
  Array<double> free_hats_, sums_;  // sums of hats over the free set, and of what is passed on
  Array<float> level_;              // of the residual, at the hats' points,
  Array<double> rest_;              // and of what is gathered
  double rest_sum_ = 0;             // of the field of rest_ over the free set
  std::span<const float> spread_;   // B Ext r/grow_; empty where r is 0
  double grow_ = 1;                 // a power of two
  Array<std::uint8_t> free_;
  std::vector<Tile> tiles_;
  ScratchPool<Patch> patches_;
};

ContactPreconditioner::Parts::Parts(int nx, int ny, double aspect, Boundary boundary, int sweeps,
                                    double weight)
    : nx_(nx),
      ny_(ny),
      // Where a period is odd, two nodes of one colour meet: nothing is carried on there.
      wraps_x_(boundary == Boundary::periodic && nx % 2 == 0),
      wraps_y_(boundary == Boundary::periodic && ny % 2 == 0),
      sweeps_(sweeps),
      margin_((sweeps + columns) / columns * columns),
      half_(tile_width / 2 + margin_ + group),
      share_(nx == 1 || ny == 1 ? 0.5f : 0.25f),
      pyramid_(nx, ny, aspect, boundary, weight),
      smooth_(nx, ny, boundary),
      free_hats_(smooth_.size()),
      sums_(smooth_.size()),
      level_(smooth_.size()),
      rest_(smooth_.size()),
      free_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0) {
  for (int y = 0; y < ny; y += tile_height)
    for (int x = 0; x < nx; x += tile_width) {
      const int width = std::min(tile_width, nx - x), height = std::min(tile_height, ny - y);
      const SmoothExtension::Sums sums(smooth_, x, y, width, height);
      tiles_.push_back({x, y, width, height, sums, sums});
    }
}

// Calls run(column, node, length) for the stretches of row j of a patch that lie on the grid.
template <class Run>
void ContactPreconditioner::Parts::each_run(const Tile& tile, int j, const Run& run) const {
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

// Calls put(place of the row, column, node, length) for the stretches of a patch that lie on the grid; what
// lies beyond is 0. So are the rows on either side of the patch, which sweeping back just reaches: no tile
// writes the first of them, but in the last a taller tile may have been before. What an earlier tile left
// beside the patch is farther off than there are sweeps.
template <class Put>
void ContactPreconditioner::Parts::load(Patch& patch, const Tile& tile, const Put& put) const {
  const int height = patch_height(tile);
  for (int j = 0; j < height; ++j) {
    const std::size_t place = patch_row(j);
    if (!wraps_x_ || !wraps_y_) std::fill_n(patch.now.data() + place, 2 * half(), 0.0f);
    each_run(tile, j, [&](std::size_t column, std::size_t from, std::size_t length) {
      put(place, column, from, length);
    });
  }
  std::fill_n(patch.now.data() + patch_row(height), 2 * half(), 0.0f);
}

void ContactPreconditioner::Parts::find_groups(Tile& tile) {
  const auto patch = borrow();
  const int rows = patch_height(tile);
  const std::size_t row_words = this->row_words(), words = static_cast<std::size_t>(rows) * row_words;
  const auto clear = [&](Array<std::uint64_t>& field) { std::fill_n(field.begin(), words, 0); };
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
    for (Groups& groups : of_colour) {
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
        Array<Group>& starts = tile.groups[(parity(tile, j) + odd) % 2][odd].starts;
        std::uint64_t rest = fresh & even_columns << odd;
        while (rest != 0) {
          const int lane = std::countr_zero(rest) / columns * columns;
          const std::uint64_t whole = (even_columns << odd) & std::uint64_t{0xffff} << lane;
          patch->found[w] |= whole;
          rest &= ~whole;
          const std::size_t column = w % row_words * bits + static_cast<std::size_t>(lane);
          starts.push_back(group_of(patch_row(j) + static_cast<std::size_t>(odd) * half() + column / 2,
                                    static_cast<std::size_t>(lane + odd), patch->bound[w]));
        }
      }
    }
    for (auto& of_colour : tile.groups)
      for (Groups& groups : of_colour)
        groups.reached.push_back(static_cast<std::uint32_t>(groups.starts.size()));
  }
}

void ContactPreconditioner::Parts::set_free(std::span<const std::uint8_t> free) {
  if (free.size() != free_.size()) throw Error(ErrorCode::internal, "a free set of another grid");
  const auto count = static_cast<std::int64_t>(tiles_.size());
  // Late in a solve few tiles see a new mark.
  parallel_for(count, [&](std::int64_t k) {
    Tile& tile = tiles_[static_cast<std::size_t>(k)];
    for (int j = 0; j < patch_height(tile) && !tile.stale; ++j)
      each_run(tile, j, [&](std::size_t, std::size_t from, std::size_t length) {
        tile.stale = tile.stale || differ(free.data() + from, free_.data() + from, length);
      });
  });
  parallel_for(count, [&](std::int64_t k) {
    const Tile& tile = tiles_[static_cast<std::size_t>(k)];
    if (!tile.stale) return;
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t from = node(tile.x, j);
      copy_marks(free.data() + from, static_cast<std::size_t>(tile.width), free_.data() + from);
    }
  });
  parallel_for(count, [&](std::int64_t k) {
    Tile& tile = tiles_[static_cast<std::size_t>(k)];
    if (!tile.stale) return;
    tile.stale = false;
    find_groups(tile);
    std::array<double, 2 * tile_width> sums;
    tile.free_hats.clear();
    for (int j = tile.y; j < tile.y + tile.height && tile.holds_free; ++j) {
      tile.free_hats.add<std::uint8_t, double>(j, free_.data() + node(tile.x, j), sums);
    }
    tile.free_hats.finish<double>(sums);
  });
  std::fill(free_hats_.begin(), free_hats_.end(), 0.0);
  for (const Tile& tile : tiles_) tile.free_hats.add_to(free_hats_);
}

// total = the sums over the hats of what add(tile, patch) gives to each tile's own.
template <class Add>
void ContactPreconditioner::Parts::add_up_hats(const Add& add, Array<double>& total) {
  parallel_for(static_cast<std::int64_t>(tiles_.size()), [&](std::int64_t k) {
    Tile& tile = tiles_[static_cast<std::size_t>(k)];
    const auto patch = borrow();
    tile.hats.clear();
    add(static_cast<std::size_t>(k), *patch);
    tile.hats.finish<float>(patch->sums);
  });
  std::fill(total.begin(), total.end(), 0.0);
  for (const Tile& tile : tiles_) tile.hats.add_to(total);
}

template <class Real>
void ContactPreconditioner::Parts::divide(const Array<double>& sums, Array<Real>& field) const {
  for (std::size_t k = 0; k < sums.size(); ++k)
    field[k] = static_cast<Real>(sums[k] / smooth_.divisor(k, free_hats_[k]));
}

void ContactPreconditioner::Parts::extend(const Tile& tile, const Residual& r) {
  const auto width = static_cast<std::size_t>(tile.width);
  float* const extended = pyramid_.input().data();
  if (tile.reaches_free && !tile.swept) {
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t k = node(tile.x, j);
      convert(r.values + k, r.factor, r.offset, width, extended + k);
      keep_free(free_.data() + k, width, extended + k);
    }
    return;
  }
  if (!tile.reaches_free) {
    for (int j = tile.y; j < tile.y + tile.height; ++j)
      smooth_.row<float>(level_, j, tile.x, tile.width, 1, extended + node(tile.x, j));
    return;
  }
  const auto patch = borrow();
  const auto nx = static_cast<std::size_t>(nx_);
  load(*patch, tile, [&](std::size_t row, std::size_t column, std::size_t from, std::size_t length) {
    smooth_.row<float>(level_, static_cast<int>(from / nx), static_cast<int>(from % nx),
                       static_cast<int>(length), 1, patch->row.data());
    start_free(free_.data() + from, r.values + from, r.factor, r.offset, patch->row.data(), length, column,
               half(), patch->now.data() + row);
  });
  // Nothing is farther from the free set than there have been sweeps.
  for (int s = 1; s <= sweeps_; ++s)
    for (const int odd : {0, 1})
      sweep_groups(tile.groups[s % 2][odd].within(s), odd != 0, half_, share_, patch->now.data());
  for (int j = 0; j < tile.height; ++j) {
    smooth_.row<float>(level_, tile.y + j, tile.x, tile.width, 1, patch->row.data());
    merge(patch->now.data() + core_row(j), half_, patch->row.data(), width,
          extended + node(tile.x, tile.y + j));
  }
}

// z = (y + N v) on the free set, v being what has been passed on off it, less the smooth field that is yet to
// come; what that is made from goes to the hats.
void ContactPreconditioner::Parts::gather_back(std::size_t number, Patch& patch, std::span<const float> y,
                                               const Keep& keep) {
  Tile& tile = tiles_[number];
  const auto width = static_cast<std::size_t>(tile.width);
  if (!tile.holds_free) {
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t k = node(tile.x, j);
      tile.hats.add<float, float>(j, y.data() + k, patch.sums);
      keep(number, k, width, nullptr, 0);
    }
    return;
  }
  if (tile.swept) {
    load(patch, tile, [&](std::size_t row, std::size_t column, std::size_t from, std::size_t length) {
      start_bound(y.data() + from, length, column, half(), patch.given.data() + row, patch.now.data() + row);
    });
    // Nothing matters that is farther from the free set than there are sweeps to come.
    for (int s = sweeps_; s >= 1; --s)
      for (const int odd : {0, 1})
        sweep_back_groups(tile.groups[s % 2][odd].within(s), odd != 0, half_, share_, patch.given.data(),
                          patch.now.data());
  }
  float sum[tile_width];
  for (int j = 0; j < tile.height; ++j) {
    const std::size_t k = node(tile.x, tile.y + j);
    if (tile.swept) {
      add_neighbours(free_.data() + k, y.data() + k, patch.now.data() + core_row(j), half_, width, sum);
    } else {
      std::copy_n(y.data() + k, width, sum);
      keep_free(free_.data() + k, width, sum);
    }
    subtract(y.data() + k, sum, width, patch.row.data());
    tile.hats.add<float, float>(tile.y + j, patch.row.data(), patch.sums);
    keep(number, k, width, sum, grow_);
  }
}

// Roughly: of every sixteenth row, and of all only if that finds nothing.
double ContactPreconditioner::Parts::greatest(const Residual& r) const {
  const auto width = static_cast<std::size_t>(nx_);
  for (const int step : {16, 1}) {
    double most = 0;
    for (int j = 0; j < ny_; j += step) {
      const std::uint8_t* const free = free_.data() + node(0, j);
      const double* const values = r.values + node(0, j);
      for (std::size_t i = 0; i < width; ++i) {
        const double value = std::abs(r.offset + r.factor * values[i]), counted = free[i] != 0 ? value : 0.0;
        most = counted > most ? counted : most;
      }
    }
    if (most > 0) return most;
  }
  return 0;
}

double ContactPreconditioner::Parts::spread(const Residual& r) {
  // Single precision has little range: near 1, and by a power of two, which rounds nothing.
  const double most = greatest(r);
  spread_ = {};
  if (!(most > 0)) return 0;
  const int exponent = std::clamp(std::ilogb(most), -1000, 1000);
  const double shrink = std::ldexp(1.0, -exponent);
  grow_ = std::ldexp(1.0, exponent);
  const Residual near_one{r.values, r.factor * shrink, r.offset * shrink};
  const auto pass_on_residual = [&](std::size_t number, Patch& patch) {
    Tile& tile = tiles_[number];
    const auto width = static_cast<std::size_t>(tile.width);
    for (int j = tile.y; j < tile.y + tile.height && tile.holds_free; ++j) {
      const std::size_t k = node(tile.x, j);
      convert(near_one.values + k, near_one.factor, near_one.offset, width, patch.row.data());
      keep_free(free_.data() + k, width, patch.row.data());
      tile.hats.add<float, float>(j, patch.row.data(), patch.sums);
    }
  };
  add_up_hats(pass_on_residual, sums_);
  divide(sums_, level_);
  parallel_for(static_cast<std::int64_t>(tiles_.size()),
               [&](std::int64_t k) { extend(tiles_[static_cast<std::size_t>(k)], near_one); });
  spread_ = pyramid_.apply();
  // Ext is the transpose of what gathers: r·z = Ext r·B Ext r.
  return pyramid_.product() * grow_ * grow_;
}

void ContactPreconditioner::Parts::gather(const Keep& keep) {
  if (spread_.empty()) {
    for (int j = 0; j < ny_; ++j) keep(0, node(0, j), static_cast<std::size_t>(nx_), nullptr, 0);
    std::fill(rest_.begin(), rest_.end(), 0.0);
    rest_sum_ = 0;
    return;
  }
  // With Ext = L (1 − C) + C, L being the sweeps and C the smooth field, Extᵀ y = Lᵀ y + Cᵀ (y − Lᵀ y).
  add_up_hats([&](std::size_t number, Patch& patch) { gather_back(number, patch, spread_, keep); }, sums_);
  divide(sums_, rest_);
  rest_sum_ = 0;
  for (std::size_t k = 0; k < rest_.size(); ++k) rest_sum_ += rest_[k] * free_hats_[k];
}

void ContactPreconditioner::Parts::smooth(std::size_t first, std::size_t n, double factor,
                                          double* values) const {
  const auto nx = static_cast<std::size_t>(nx_);
  smooth_.row<double>(rest_, static_cast<int>(first / nx), static_cast<int>(first % nx), static_cast<int>(n),
                      factor * grow_, values);
}

void ContactPreconditioner::Parts::add_smooth(std::span<double> z) const {
  const auto nx = static_cast<std::size_t>(nx_);
  parallel_for(ny_, [&](std::int64_t j) {
    double values[tile_width];
    const std::size_t begin = node(0, static_cast<int>(j));
    for (std::size_t at = 0; at < nx; at += tile_width) {
      const std::size_t n = std::min<std::size_t>(tile_width, nx - at);
      smooth(begin + at, n, 1, values);
      add_free(free_.data() + begin + at, values, n, z.data() + begin + at);
    }
  });
}

ContactPreconditioner::ContactPreconditioner(int nx, int ny, double aspect, Boundary boundary, double weight,
                                             int sweeps)
    : parts_(std::make_unique<Parts>(nx, ny, aspect, boundary, sweeps, weight)) {}

ContactPreconditioner::~ContactPreconditioner() = default;
ContactPreconditioner::ContactPreconditioner(ContactPreconditioner&&) noexcept = default;
ContactPreconditioner& ContactPreconditioner::operator=(ContactPreconditioner&&) noexcept = default;

void ContactPreconditioner::set_free(std::span<const std::uint8_t> free) { parts_->set_free(free); }

void ContactPreconditioner::apply(std::span<const double> r, std::span<double> z) {
  if (r.size() != parts_->nodes() || z.size() != parts_->nodes())
    throw Error(ErrorCode::internal, "a preconditioner of another grid's values");
  parts_->spread(Residual{r.data()});
  parts_->gather([&](std::size_t, std::size_t first, std::size_t n, const float* values, double factor) {
    if (values)
      convert(values, factor, n, z.data() + first);
    else
      std::fill_n(z.data() + first, n, 0.0);
  });
  parts_->add_smooth(z);
}

double ContactPreconditioner::spread(const Residual& r) { return parts_->spread(r); }
void ContactPreconditioner::smooth(std::size_t first, std::size_t n, double factor, double* values) const {
  parts_->smooth(first, n, factor, values);
}
double ContactPreconditioner::smooth_sum() const { return parts_->smooth_sum(); }
void ContactPreconditioner::gather(const Keep& keep) { parts_->gather(keep); }

std::size_t ContactPreconditioner::tiles() const { return parts_->tiles(); }

std::int64_t ContactPreconditioner::bytes(int nx, int ny, double aspect, Boundary boundary) {
  // The free set, the groups of eight nodes with their margins', and a patch a thread.
  constexpr std::int64_t patch = 12 * (tile_width + 64) * (tile_height + 32);
  return HalfOrderPyramid::bytes(nx, ny, aspect, boundary) + 2 * static_cast<std::int64_t>(nx) * ny +
         patch * thread_count();
}

}  // namespace asperity
