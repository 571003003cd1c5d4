// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/preconditioner/free_tiles.hpp"

#include <bit>
#include <cstring>

#include "engine/core/arithmetic/register_vectors.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace edge_rows {

namespace {

// Results do not depend on the register width.
constexpr int node_lanes = std::min(group, register_vectors::register_lanes<float>);
constexpr int node_pairs = 2 * node_lanes;  // columns of as many even and odd nodes
using NodeVector = register_vectors::Of<float, node_lanes>::Vector;
using NodeVectorAnywhere = register_vectors::Of<float, node_lanes>::Anywhere;
using MarkVector = register_vectors::Of<std::int32_t, node_lanes>::Vector;
using DoubleVector = register_vectors::Of<double>::Vector;
typedef std::uint16_t BytePairs __attribute__((vector_size(2 * node_lanes), aligned(1), may_alias));
using register_vectors::interleave;
using register_vectors::separate;

// Vectors are passed by reference or pointer only.
inline __attribute__((always_inline)) const NodeVectorAnywhere* nodes_at(const float* at) {
  return reinterpret_cast<const NodeVectorAnywhere*>(at);
}
inline __attribute__((always_inline)) NodeVectorAnywhere* nodes_at(float* at) {
  return reinterpret_cast<NodeVectorAnywhere*>(at);
}
template <class Vector>
inline __attribute__((always_inline)) void along(const double* at, double slope, double offset, Vector& to) {
  DoubleVector low, high;
  register_vectors::read(at, low);
  low = offset + slope * low;
  if constexpr (sizeof(DoubleVector) == 2 * sizeof(Vector)) {
    to = __builtin_convertvector(low, Vector);
  } else {
    register_vectors::read(at + node_lanes / 2, high);
    high = offset + slope * high;
    register_vectors::narrow(low, high, to);
  }
}

// Nonzero for nonzero bytes, even and odd.
inline __attribute__((always_inline)) void read_marks(const std::uint8_t* bytes, MarkVector& even,
                                                      MarkVector& odd) {
  using Words = register_vectors::Of<std::uint16_t, node_lanes>::Vector;
  const Words both = *reinterpret_cast<const BytePairs*>(bytes);
  constexpr bool little = std::endian::native == std::endian::little;
  const Words low = both & 0xff, high = both >> 8;
  even = __builtin_convertvector(little ? low : high, MarkVector);
  odd = __builtin_convertvector(little ? high : low, MarkVector);
}

// Nonzero for nonzero bytes; one instruction per step.
inline __attribute__((always_inline)) void read_marks(const std::uint8_t* bytes, MarkVector& marks) {
  using Words = register_vectors::Of<std::uint16_t, node_lanes>::Vector;
  using Bytes = register_vectors::Of<std::uint8_t, node_lanes>::Anywhere;
  marks = __builtin_convertvector(__builtin_convertvector(*reinterpret_cast<const Bytes*>(bytes), Words),
                                  MarkVector);
}

inline __attribute__((always_inline)) void nodes_of(const SmoothRow<float>& row, std::size_t k,
                                                    NodeVector& to) {
  to = row.low_share * *nodes_at(row.low + k) + row.high_share * *nodes_at(row.high + k);
}
inline float at(const SmoothRow<float>& row, std::size_t k) {
  return row.low_share * row.low[k] + row.high_share * row.high[k];
}

inline std::size_t start_of(Group one) { return one & ((Group{1} << start_bits) - 1); }
// Nonzero where sweeps change nodes.
inline __attribute__((always_inline)) void read_bound(Group one, int first, MarkVector& bound) {
  MarkVector bits_of;
  for (int l = 0; l < node_lanes; ++l) bits_of[l] = 1 << l;
  bound = static_cast<std::int32_t>(one >> (start_bits + first)) & bits_of;
}

template <bool odd>
inline __attribute__((always_inline)) void add_up(const float* here, std::ptrdiff_t half, NodeVector& sum) {
  const float* const neighbours = here + (odd ? -half : half - 1);
  sum = (*nodes_at(neighbours) + *nodes_at(neighbours + 1)) +
        (*nodes_at(here - 2 * half) + *nodes_at(here + 2 * half));
}

template <bool odd>
void sweep(std::span<const Group> groups, std::ptrdiff_t half, float share, float* now) {
  for (const Group one : groups)
    for (int first = 0; first < group; first += node_lanes) {
      float* const at = now + start_of(one) + first;
      NodeVector sum;
      add_up<odd>(at, half, sum);
      MarkVector bound;
      read_bound(one, first, bound);
      const NodeVector here = *nodes_at(at);
      *nodes_at(at) = bound != 0 ? share * sum : here;
    }
}

template <bool odd>
void sweep_back(std::span<const Group> groups, std::ptrdiff_t half, float share,
                const float* __restrict given, float* now) {
  for (const Group one : groups)
    for (int first = 0; first < group; first += node_lanes) {
      const std::size_t at = start_of(one) + static_cast<std::size_t>(first);
      NodeVector sum;
      add_up<odd>(now + at, half, sum);
      MarkVector bound;
      read_bound(one, first, bound);
      const NodeVector none = {};
      *nodes_at(now + at) = bound != 0 ? share * (*nodes_at(given + at) + sum) : none;
    }
}

}  // namespace

void pack(const std::uint8_t* bytes, std::size_t n, std::size_t place, std::uint64_t* words) {
  std::size_t k = 0;
  if (place % 8 == 0) {
    for (; k + 8 <= n; k += 8) {
      std::uint64_t eight;
      std::memcpy(&eight, bytes + k, sizeof eight);
      if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
      // Lowest bits of the bytes, in the highest byte.
      const std::uint64_t packed = (eight * 0x0102040810204080u) >> 56;
      words[(place + k) / bits] |= packed << ((place + k) % bits);
    }
  }
  for (; k < n; ++k)
    words[(place + k) / bits] |= static_cast<std::uint64_t>(bytes[k]) << ((place + k) % bits);
}

bool differ(const std::uint8_t* a, const std::uint8_t* b, std::size_t n) {
  std::uint8_t any = 0;
  for (std::size_t k = 0; k < n; ++k) any |= static_cast<std::uint8_t>((a[k] != 0) != (b[k] != 0));
  return any != 0;
}

void fill_bits(std::size_t place, std::size_t n, std::uint64_t* words) {
  while (n > 0) {
    const std::size_t within = place % bits, length = std::min(n, bits - within);
    words[place / bits] |= (~std::uint64_t{0} >> (bits - length)) << within;
    place += length;
    n -= length;
  }
}

void widen(Array<std::uint64_t>& field, int rows, std::size_t row_words, Array<std::uint64_t>& work) {
  const std::size_t words = static_cast<std::size_t>(rows) * row_words;
  for (std::size_t first = 0; first < words; first += row_words)
    for (std::size_t k = 0; k < row_words; ++k) {
      const std::size_t w = first + k;
      std::uint64_t word = field[w] | field[w] << 1 | field[w] >> 1;
      if (k > 0) word |= field[w - 1] >> (bits - 1);
      if (k + 1 < row_words) word |= field[w + 1] << (bits - 1);
      if (first > 0) word |= field[w - row_words];
      if (w + row_words < words) word |= field[w + row_words];
      work[w] = word;
    }
  std::swap(field, work);
}

void copy_marks(const std::uint8_t* __restrict from, std::size_t n, std::uint8_t* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) to[k] = from[k] != 0 ? 1 : 0;
}

void add_times(double factor, const double* __restrict from, std::size_t n, double* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) to[k] += factor * from[k];
}

void convert(const double* __restrict from, double factor, double offset, std::size_t n,
             float* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) to[k] = static_cast<float>(offset + factor * from[k]);
}

void convert(const float* __restrict from, double scale, std::size_t n, double* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) to[k] = static_cast<double>(from[k]) * scale;
}

void add_free(const std::uint8_t* __restrict free, const SmoothRow<double>& from, std::size_t n,
              double* __restrict to) {
  const SmoothRow<double> row = from;
  for (std::size_t k = 0; k < n; ++k) {
    const double value = row.low_share * row.low[k] + row.high_share * row.high[k];
    to[k] += free[k] != 0 ? value : 0.0;
  }
}

void fill(const SmoothRow<float>& from, std::size_t n, float* __restrict to) {
  const SmoothRow<float> row = from;
  for (std::size_t k = 0; k < n; ++k) to[k] = row.low_share * row.low[k] + row.high_share * row.high[k];
}

void add_marks(const std::uint8_t* __restrict free, std::size_t n,
               const SmoothExtension::Sums::Row<double>& to) {
  double* __restrict low = to.low, * __restrict high = to.high;
  const double low_share = to.low_share, high_share = to.high_share;
  for (std::size_t k = 0; k < n; ++k) {
    const double value = free[k];
    low[k] += low_share * value;
    high[k] += high_share * value;
  }
}

void add_residual(const std::uint8_t* free, const double* values, double slope, double offset, std::size_t n,
                  const SmoothExtension::Sums::Row<float>& sums) {
  const SmoothExtension::Sums::Row<float> to = sums;
  std::size_t k = 0;
  for (; k + node_lanes <= n; k += node_lanes) {
    const NodeVector none = {};
    NodeVector all;
    along(values + k, slope, offset, all);
    MarkVector marks;
    read_marks(free + k, marks);
    const NodeVector value = marks != 0 ? all : none;
    *nodes_at(to.low + k) += to.low_share * value;
    *nodes_at(to.high + k) += to.high_share * value;
  }
  for (; k < n; ++k) {
    const float value = free[k] != 0 ? static_cast<float>(offset + slope * values[k]) : 0.0f;
    to.low[k] += to.low_share * value;
    to.high[k] += to.high_share * value;
  }
}

void add_difference(const float* __restrict a, const float* __restrict b, std::size_t n,
                    const SmoothExtension::Sums::Row<float>& to) {
  float* __restrict low = to.low, * __restrict high = to.high;
  const float low_share = to.low_share, high_share = to.high_share;
  for (std::size_t k = 0; k < n; ++k) {
    const float value = a[k] - b[k];
    low[k] += low_share * value;
    high[k] += high_share * value;
  }
}

void add_values(const float* __restrict values, std::size_t n, const SmoothExtension::Sums::Row<float>& to) {
  float* __restrict low = to.low, * __restrict high = to.high;
  const float low_share = to.low_share, high_share = to.high_share;
  for (std::size_t k = 0; k < n; ++k) {
    low[k] += low_share * values[k];
    high[k] += high_share * values[k];
  }
}

inline std::size_t split(std::size_t column, std::size_t half) { return column % 2 * half + column / 2; }

void start_free(const std::uint8_t* __restrict free, const double* __restrict values, double slope,
                double offset, const SmoothRow<float>& smooth, std::size_t n, std::size_t place,
                std::size_t half, float* __restrict now) {
  const SmoothRow<float> less = smooth;
  std::size_t k = 0;
  const auto one = [&] {
    now[split(place + k, half)] =
        free[k] != 0 ? static_cast<float>(offset + slope * values[k]) - at(less, k) : 0.0f;
    ++k;
  };
  while (k < n && (place + k) % node_pairs != 0) one();
  for (; k + node_pairs <= n; k += node_pairs) {
    NodeVector low, high, smooth_low, smooth_high;
    nodes_of(less, k, smooth_low);
    nodes_of(less, k + node_lanes, smooth_high);
    along(values + k, slope, offset, low);
    along(values + k + node_lanes, slope, offset, high);
    low -= smooth_low;
    high -= smooth_high;
    NodeVector even, odd;
    separate(low, high, even, odd);
    MarkVector free_even, free_odd;
    read_marks(free + k, free_even, free_odd);
    const NodeVector none = {};
    float* const to = now + (place + k) / 2;
    *nodes_at(to) = free_even != 0 ? even : none;
    *nodes_at(to + half) = free_odd != 0 ? odd : none;
  }
  while (k < n) one();
}

void start_bound(const float* __restrict values, std::size_t n, std::size_t place, std::size_t half,
                 float* __restrict given, float* __restrict now) {
  std::size_t k = 0;
  const auto one = [&] {
    const std::size_t at = split(place + k, half);
    given[at] = values[k];
    now[at] = 0;
    ++k;
  };
  while (k < n && (place + k) % node_pairs != 0) one();
  for (; k + node_pairs <= n; k += node_pairs) {
    const std::size_t to = (place + k) / 2;
    NodeVector even, odd;
    const NodeVector low = *nodes_at(values + k), high = *nodes_at(values + k + node_lanes);
    separate(low, high, even, odd);
    const NodeVector none = {};
    *nodes_at(given + to) = even;
    *nodes_at(given + to + half) = odd;
    *nodes_at(now + to) = *nodes_at(now + to + half) = none;
  }
  while (k < n) one();
}

Group group_of(std::size_t start, std::size_t lane, std::uint64_t marks) {
  // Compacts the even bits.
  std::uint64_t bound = marks >> lane & 0x5555;
  bound = (bound | bound >> 1) & 0x3333;
  bound = (bound | bound >> 2) & 0x0f0f;
  bound = (bound | bound >> 4) & 0x00ff;
  return static_cast<Group>(start) | static_cast<Group>(bound << start_bits);
}

void sweep_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share, float* now) {
  odd ? sweep<true>(groups, half, share, now) : sweep<false>(groups, half, share, now);
}

void sweep_back_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share,
                       const float* given, float* now) {
  odd ? sweep_back<true>(groups, half, share, given, now)
      : sweep_back<false>(groups, half, share, given, now);
}

void merge(const float* __restrict row, std::ptrdiff_t half, const SmoothRow<float>& smooth, std::size_t n,
           float* __restrict to) {
  const SmoothRow<float> more = smooth;
  std::size_t k = 0;
  for (; k + node_pairs <= n; k += node_pairs) {
    const NodeVector even = *nodes_at(row + k / 2), odd = *nodes_at(row + half + k / 2);
    NodeVector low, high, smooth_low, smooth_high;
    interleave(even, odd, low, high);
    nodes_of(more, k, smooth_low);
    nodes_of(more, k + node_lanes, smooth_high);
    *nodes_at(to + k) = low + smooth_low;
    *nodes_at(to + k + node_lanes) = high + smooth_high;
  }
  for (; k < n; ++k) to[k] = row[split(k, static_cast<std::size_t>(half))] + at(more, k);
}

void add_neighbours(const std::uint8_t* __restrict free, const float* __restrict values,
                    const float* __restrict row, std::ptrdiff_t half, std::size_t n, float* __restrict to) {
  std::size_t k = 0;
  for (; k + node_pairs <= n; k += node_pairs) {
    NodeVector even, odd, even_value, odd_value;
    add_up<false>(row + k / 2, half, even);
    add_up<true>(row + half + k / 2, half, odd);
    const NodeVector low_value = *nodes_at(values + k), high_value = *nodes_at(values + k + node_lanes);
    separate(low_value, high_value, even_value, odd_value);
    MarkVector free_even, free_odd;
    read_marks(free + k, free_even, free_odd);
    const NodeVector none = {};
    even += even_value;
    odd += odd_value;
    even = free_even != 0 ? even : none;
    odd = free_odd != 0 ? odd : none;
    NodeVector low, high;
    interleave(even, odd, low, high);
    *nodes_at(to + k) = low;
    *nodes_at(to + k + node_lanes) = high;
  }
  for (; k < n; ++k) {
    const float* const here = row + split(k, static_cast<std::size_t>(half));
    const float* const neighbours = here + (k % 2 != 0 ? -half : half - 1);
    const float sum = values[k] + ((neighbours[0] + neighbours[1]) + (here[-2 * half] + here[2 * half]));
    to[k] = free[k] != 0 ? sum : 0.0f;
  }
}

}  // namespace edge_rows

using namespace edge_rows;

FreeTiles::FreeTiles(int nx, int ny, Boundary boundary, int sweeps)
    : nx_(nx),
      ny_(ny),
      // On odd periods two nodes of one colour meet: no wrap.
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
  // Chessboard parity on the whole grid.
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
