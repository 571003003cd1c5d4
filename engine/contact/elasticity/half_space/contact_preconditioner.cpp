// SPDX-License-Identifier: GPL-3.0-or-later
// The sweeps are done tile by tile with a margin as wide as there are sweeps, so that a tile needs
// nothing of its neighbours and stays in the cache, and in it only on the groups of eight nodes that
// are near the edge of the free set. Both Ext and its transpose are Horner's rule for Σ (D N)^s: N adds
// up the four neighbours, D is 1/4 off the free set and 0 on it.
#include "engine/contact/elasticity/half_space/contact_preconditioner.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/contact/elasticity/half_space/edge_rows.hpp"
#include "engine/contact/elasticity/half_space/half_order_pyramid.hpp"
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
  void apply(const Read& read, const Keep& keep);
  std::size_t tiles() const { return tiles_.size(); }
  std::size_t nodes() const { return free_.size(); }

 private:
  struct Tile {
    int x, y, width, height;
    bool holds_free = false;       // a free node in the tile
    bool reaches_free = false;     // or in its margin
    Array<std::uint32_t> groups;   // those near the edge of the free set, in order of their distance
    Array<std::uint32_t> reached;  // how many of them are within 0, 1, … steps
  };
  // A tile with its margin, and a row more on either side that is always 0.
  struct Patch {
    Array<float> given, factor, now, next;
    // One bit a node: free, on the grid but not free, within some steps of free.
    Array<std::uint64_t> free, bound, near, nearer, found;
    Patch(std::size_t nodes, std::size_t words)
        : given(nodes),
          factor(nodes),
          now(nodes),
          next(nodes),
          free(words),
          bound(words),
          near(words),
          nearer(words),
          found(words) {}
  };

  int patch_height(const Tile& tile) const { return tile.height + 2 * sweeps_; }
  std::size_t patch_row(int j) const {
    return static_cast<std::size_t>(j + 1) * static_cast<std::size_t>(stride_);
  }
  // Where row j of the tile itself begins in its patch.
  std::size_t core_row(int j) const {
    return patch_row(j + sweeps_) + static_cast<std::size_t>(group + margin_);
  }
  ScratchPool<Patch>::Loan borrow() {
    return patches_.borrow([this] {
      const std::size_t nodes = patch_row(tile_height + 2 * sweeps_ + 1) + group;
      return std::make_unique<Patch>(nodes, nodes / bits);
    });
  }
  template <class Run>
  void each_run(const Tile& tile, int j, const Run& run) const;
  void find_groups(Tile& tile);
  template <class Steps>
  void sweep(Patch& patch, const Tile& tile, int sweeps, const Steps& steps) const;
  template <class Put>
  void load(Patch& patch, const Tile& tile, const Put& put) const;
  void extend(const Tile& tile, const Read& read, double scale);
  void gather_back(std::size_t number, std::span<const float> y, double scale, const Keep& keep);
  double greatest(const Read& read) const;
  std::size_t node(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i);
  }

  int nx_, ny_;
  bool wraps_;
  int sweeps_, margin_, stride_;
  HalfOrderPyramid pyramid_;
  Array<std::uint8_t> free_;
  std::vector<Tile> tiles_;
  ScratchPool<Patch> patches_;
};

ContactPreconditioner::Parts::Parts(int nx, int ny, double aspect, Boundary boundary, int sweeps,
                                    double weight)
    : nx_(nx),
      ny_(ny),
      wraps_(boundary == Boundary::periodic),
      sweeps_(sweeps),
      margin_((sweeps + group - 1) / group * group),
      stride_((tile_width + 2 * margin_ + 2 * group + bits - 1) / bits * bits),
      pyramid_(nx, ny, aspect, boundary, weight),
      free_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0) {
  for (int y = 0; y < ny; y += tile_height)
    for (int x = 0; x < nx; x += tile_width)
      tiles_.push_back(
          {x, y, std::min(tile_width, nx - x), std::min(tile_height, ny - y), false, false, {}, {0}});
}

// Calls run(place in the patch, node, length) for the stretches of row j of a patch that lie on the grid.
template <class Run>
void ContactPreconditioner::Parts::each_run(const Tile& tile, int j, const Run& run) const {
  int y = tile.y - sweeps_ + j;
  if (wraps_)
    y = (y % ny_ + ny_) % ny_;
  else if (y < 0 || y >= ny_)
    return;
  int x = tile.x - margin_;
  const int end = tile.x + tile.width + margin_;
  std::size_t place = patch_row(j) + group;
  while (x < end) {
    if (!wraps_ && x < 0) {
      place += static_cast<std::size_t>(-x);
      x = 0;
    }
    const int i = wraps_ ? (x % nx_ + nx_) % nx_ : x;
    if (!wraps_ && i >= nx_) return;
    const int length = std::min(end - x, nx_ - i);
    run(place, node(i, y), static_cast<std::size_t>(length));
    place += static_cast<std::size_t>(length);
    x += length;
  }
}

// Calls put(place, node, length) for the stretches of a patch that lie on the grid; what lies beyond a
// free rim is 0. What an earlier tile left around the patch is too far off to reach the tile.
template <class Put>
void ContactPreconditioner::Parts::load(Patch& patch, const Tile& tile, const Put& put) const {
  for (int j = 0; j < patch_height(tile); ++j) {
    if (!wraps_)
      for (Array<float>* field : {&patch.given, &patch.factor, &patch.now, &patch.next})
        std::fill_n(field->data() + patch_row(j), stride_, 0.0f);
    each_run(tile, j, put);
  }
}

void ContactPreconditioner::Parts::find_groups(Tile& tile) {
  const auto patch = borrow();
  const int rows = patch_height(tile);
  const auto row_words = static_cast<std::size_t>(stride_ / bits);
  const std::size_t words = static_cast<std::size_t>(rows) * row_words;
  const auto clear = [&](Array<std::uint64_t>& field) { std::fill_n(field.begin(), words, 0); };
  clear(patch->free);
  clear(patch->bound);
  clear(patch->found);
  for (int j = 0; j < rows; ++j) {
    const std::size_t start = static_cast<std::size_t>(j) * row_words;
    each_run(tile, j, [&](std::size_t place, std::size_t from, std::size_t length) {
      const std::size_t column = place - patch_row(j);
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
  tile.groups.clear();
  tile.reached.assign(1, 0);
  if (!tile.reaches_free) return;
  std::copy_n(patch->free.begin(), words, patch->near.begin());
  for (int step = 1; step <= sweeps_; ++step) {
    widen(patch->near, rows, row_words, patch->nearer);
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t fresh = patch->near[w] & patch->bound[w] & ~patch->found[w];
      while (fresh != 0) {
        const int lane = std::countr_zero(fresh) / group * group;
        const std::uint64_t whole = std::uint64_t{0xff} << lane;
        patch->found[w] |= whole;
        fresh &= ~whole;
        tile.groups.push_back(
            static_cast<std::uint32_t>(patch_row(static_cast<int>(w / row_words)) + w % row_words * bits) +
            static_cast<std::uint32_t>(lane));
      }
    }
    tile.reached.push_back(static_cast<std::uint32_t>(tile.groups.size()));
  }
}

void ContactPreconditioner::Parts::set_free(std::span<const std::uint8_t> free) {
  if (free.size() != free_.size()) throw Error(ErrorCode::internal, "a free set of another grid");
  std::transform(free.begin(), free.end(), free_.begin(),
                 [](std::uint8_t value) { return static_cast<std::uint8_t>(value != 0); });
  const std::span<float> extended = pyramid_.input();
  parallel_for(static_cast<std::int64_t>(tiles_.size()), [&](std::int64_t k) {
    Tile& tile = tiles_[static_cast<std::size_t>(k)];
    find_groups(tile);
    // extend() leaves such a tile alone.
    if (!tile.reaches_free)
      for (int j = tile.y; j < tile.y + tile.height; ++j)
        std::fill_n(extended.begin() + static_cast<std::ptrdiff_t>(node(tile.x, j)), tile.width, 0.0f);
  });
}

// now = Σ_{s <= sweeps} (D N)^s given, from now = next = given; the s-th sweep on the groups within steps(s)
// of the free set.
template <class Steps>
void ContactPreconditioner::Parts::sweep(Patch& patch, const Tile& tile, int sweeps,
                                         const Steps& steps) const {
  for (int s = 1; s <= sweeps; ++s) {
    const std::span groups(tile.groups.data(), tile.reached[static_cast<std::size_t>(steps(s))]);
    sweep_groups(groups, stride_, patch.given.data(), patch.factor.data(), patch.now.data(),
                 patch.next.data());
    std::swap(patch.now, patch.next);
  }
}

void ContactPreconditioner::Parts::extend(const Tile& tile, const Read& read, double scale) {
  if (!tile.reaches_free) return;
  constexpr std::size_t most = tile_width + 2 * 64;
  double values[most];  // of a run
  const auto convert_run = [&](std::size_t from, std::size_t length, float* to) {
    for (std::size_t done = 0; done < length; done += most) {
      const std::size_t part = std::min(most, length - done);
      read(from + done, part, values);
      convert(values, scale, part, to + done);
    }
  };
  const auto width = static_cast<std::size_t>(tile.width);
  float* const extended = pyramid_.input().data();
  if (tile.groups.empty()) {
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t k = node(tile.x, j);
      convert_run(k, width, extended + k);
      keep_free(free_.data() + k, width, extended + k);
    }
    return;
  }
  const auto patch = borrow();
  load(*patch, tile, [&](std::size_t place, std::size_t from, std::size_t length) {
    float* const given = patch->given.data() + place;
    convert_run(from, length, given);
    start_free(free_.data() + from, length, given, patch->factor.data() + place, patch->now.data() + place,
               patch->next.data() + place);
  });
  // Nothing is farther from the free set than there have been sweeps.
  sweep(*patch, tile, sweeps_, [](int s) { return s; });
  for (int j = 0; j < tile.height; ++j)
    std::copy_n(patch->now.data() + core_row(j), width, extended + node(tile.x, tile.y + j));
}

// z = (y + N v) on the free set, v = Σ_{s < sweeps} (D N)^s D y.
void ContactPreconditioner::Parts::gather_back(std::size_t number, std::span<const float> y, double scale,
                                               const Keep& keep) {
  const Tile& tile = tiles_[number];
  const auto width = static_cast<std::size_t>(tile.width);
  if (!tile.holds_free) {
    for (int j = tile.y; j < tile.y + tile.height; ++j) keep(number, node(tile.x, j), width, nullptr, 0);
    return;
  }
  const auto patch = borrow();
  const bool swept = !tile.groups.empty();
  if (swept) {
    load(*patch, tile, [&](std::size_t place, std::size_t from, std::size_t length) {
      start_bound(free_.data() + from, y.data() + from, length, patch->given.data() + place,
                  patch->factor.data() + place, patch->now.data() + place, patch->next.data() + place);
    });
    // Nothing matters that is farther from the free set than there are sweeps to come, and the sum.
    sweep(*patch, tile, sweeps_ - 1, [this](int s) { return sweeps_ - s; });
  }
  for (int j = 0; j < tile.height; ++j) {
    const std::size_t k = node(tile.x, tile.y + j);
    float* const sum = patch->next.data();
    if (swept)
      add_neighbours(y.data() + k, patch->now.data() + core_row(j), stride_, width, sum);
    else
      std::copy_n(y.data() + k, width, sum);
    keep_free(free_.data() + k, width, sum);
    keep(number, k, width, sum, scale);
  }
}

// Roughly: of every sixteenth row, and of all only if that finds nothing.
double ContactPreconditioner::Parts::greatest(const Read& read) const {
  Array<double> row(static_cast<std::size_t>(nx_));
  for (const int step : {16, 1}) {
    double most = 0;
    for (int j = 0; j < ny_; j += step) {
      const std::uint8_t* const free = free_.data() + node(0, j);
      read(node(0, j), row.size(), row.data());
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double value = free[i] != 0 ? std::abs(row[i]) : 0.0;
        most = value > most ? value : most;
      }
    }
    if (most > 0) return most;
  }
  return 0;
}

void ContactPreconditioner::Parts::apply(const Read& read, const Keep& keep) {
  // Single precision has little range: near 1, and by a power of two, which rounds nothing.
  const double most = greatest(read);
  const auto width = static_cast<std::size_t>(nx_);
  if (!(most > 0)) {
    for (int j = 0; j < ny_; ++j) keep(0, node(0, j), width, nullptr, 0);
    return;
  }
  const int exponent = std::clamp(std::ilogb(most), -1000, 1000);
  const auto count = static_cast<std::int64_t>(tiles_.size());
  const double shrink = std::ldexp(1.0, -exponent), grow = std::ldexp(1.0, exponent);
  parallel_for(count, [&](std::int64_t k) { extend(tiles_[static_cast<std::size_t>(k)], read, shrink); });
  const std::span<const float> y = pyramid_.apply();
  parallel_for(count, [&](std::int64_t k) { gather_back(static_cast<std::size_t>(k), y, grow, keep); });
}

ContactPreconditioner::ContactPreconditioner(int nx, int ny, double aspect, Boundary boundary, int sweeps,
                                             double weight)
    : parts_(std::make_unique<Parts>(nx, ny, aspect, boundary, sweeps, weight)) {}

ContactPreconditioner::~ContactPreconditioner() = default;
ContactPreconditioner::ContactPreconditioner(ContactPreconditioner&&) noexcept = default;
ContactPreconditioner& ContactPreconditioner::operator=(ContactPreconditioner&&) noexcept = default;

void ContactPreconditioner::set_free(std::span<const std::uint8_t> free) { parts_->set_free(free); }

void ContactPreconditioner::apply(std::span<const double> r, std::span<double> z) {
  if (r.size() != parts_->nodes() || z.size() != parts_->nodes())
    throw Error(ErrorCode::internal, "a preconditioner of another grid's values");
  parts_->apply([&](std::size_t first, std::size_t n, double* to) { std::copy_n(r.data() + first, n, to); },
                [&](std::size_t, std::size_t first, std::size_t n, const float* values, double factor) {
                  if (values)
                    convert(values, factor, n, z.data() + first);
                  else
                    std::fill_n(z.data() + first, n, 0.0);
                });
}

void ContactPreconditioner::apply(const Read& read, const Keep& keep) { parts_->apply(read, keep); }

std::size_t ContactPreconditioner::tiles() const { return parts_->tiles(); }

std::int64_t ContactPreconditioner::bytes(int nx, int ny, double aspect, Boundary boundary) {
  // The free set, the groups of eight nodes with their margins', and a patch a thread.
  constexpr std::int64_t patch = 20 * (tile_width + 64) * (tile_height + 32);
  return HalfOrderPyramid::bytes(nx, ny, aspect, boundary) + 2 * static_cast<std::int64_t>(nx) * ny +
         patch * thread_count();
}

}  // namespace asperity
