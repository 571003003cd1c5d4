// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

// Factors of cos(iX) cos(jY): minimax fit of S(t) + w(t)² |alias|/2 to |t|/2 with S(0) = 0.
constexpr float s00 = 1.13600f, s10 = -0.53897f, s11 = -0.25386f;
constexpr float s20 = 0.06862f, s21 = 0.01861f, s22 = 0.02134f;

// Up to this aspect the square cell's stencil serves.
constexpr double squareness = 1.15;

constexpr int coarsest = 16;

// Cells. The stencil's waves then have |q| t >= 2.4 and a share >= .75, except on nearly incompressible
// layers.
constexpr double least_thickness = 1.5;
constexpr int halo = 2;

int rows_per_block(int nx) { return std::clamp(32768 / nx, 4, 64); }
std::int64_t block_count(int items, int block) {
  return (static_cast<std::int64_t>(items) + block - 1) / block;
}

// Margins: 0 beyond a free rim, else the other end.
class MarginedRow {
 public:
  MarginedRow(int nx, bool wraps)
      : nx_(nx), wraps_(wraps), values_(static_cast<std::size_t>(nx + 2 * halo)) {}
  float* values() { return values_.data() + halo; }
  void close() {
    if (!wraps_) return;
    for (int i = 1; i <= halo; ++i) {
      values()[-i] = values()[((nx_ - i) % nx_ + nx_) % nx_];
      values()[nx_ - 1 + i] = values()[(i - 1) % nx_];
    }
  }

 private:
  int nx_;
  bool wraps_;
  Array<float> values_;
};

int bottom_period(int n, Boundary boundary) {
  return boundary == Boundary::periodic ? n : good_fourier_length(2 * n);
}

void weigh(const float* __restrict below, const float* __restrict here, const float* __restrict above, int n,
           float* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] = 0.25f * (below[i] + above[i]) + 0.5f * here[i];
}

// (a + b)/4: 2 W up of one coarse row or of the two nearest.
void add_quarters(const float* a, const float* b, int n, float* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] = 0.25f * (a[i] + b[i]);
}
void add_quarter(const float* a, int n, float* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] += 0.25f * a[i];
}

void weigh_every_second(const float* __restrict from, int n, float* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] = 0.25f * (from[2 * i - 1] + from[2 * i + 1]) + 0.5f * from[2 * i];
}

constexpr int lanes = register_vectors::register_lanes<float>;
using Nodes = register_vectors::Of<float>::Vector;
using NodesAnywhere = register_vectors::Of<float>::Anywhere;
using HalfOfNodes = register_vectors::Of<float, lanes / 2>::Vector;
using HalfAnywhere = register_vectors::Of<float, lanes / 2>::Anywhere;

inline __attribute__((always_inline)) void read(const float* from, Nodes& to) {
  to = *reinterpret_cast<const NodesAnywhere*>(from);
}
inline __attribute__((always_inline)) void read(const float* from, float& to) { to = *from; }
inline __attribute__((always_inline)) void put(const Nodes& from, float* to) {
  *reinterpret_cast<NodesAnywhere*>(to) = from;
}
inline __attribute__((always_inline)) void put(const float& from, float* to) { *to = from; }
// Coarse values and, between them, their means.
inline __attribute__((always_inline)) void interpolate(const float* coarse, int i, Nodes& to) {
  const HalfOfNodes even = *reinterpret_cast<const HalfAnywhere*>(coarse + i / 2);
  const HalfOfNodes next = *reinterpret_cast<const HalfAnywhere*>(coarse + i / 2 + 1);
  const HalfOfNodes odd = 0.5f * (even + next);
  register_vectors::shuffle<register_vectors::Interleaved<lanes / 2, 0>>(even, odd, to);
}
inline __attribute__((always_inline)) void interpolate(const float* coarse, int i, float& to) {
  to = i % 2 == 0 ? coarse[i / 2] : 0.5f * (coarse[i / 2] + coarse[i / 2 + 1]);
}

template <class Loop>
inline __attribute__((always_inline)) void each(int n, const Loop& loop) {
  int i = 0;
  for (; i + lanes <= n; i += lanes) loop.template operator()<Nodes>(i);
  for (; i < n; ++i) loop.template operator()<float>(i);
}

struct FiveRows {
  const float *far_below, *below, *here, *above, *far_above;
};

// Own column with the coarse part, ±1, ±2.
void stencil_columns(const FiveRows& five, const float* coarse, int n, float* c0, float* c1, float* c2) {
  each(n, [=, rows = five]<class Value>(int i) {
    Value far_below, below, here, above, far_above, from_coarse;
    read(rows.far_below + i, far_below);
    read(rows.below + i, below);
    read(rows.here + i, here);
    read(rows.above + i, above);
    read(rows.far_above + i, far_above);
    interpolate(coarse, i, from_coarse);
    const Value r1 = below + above, r2 = far_below + far_above;
    put(from_coarse + (s00 * here + 0.5f * s10 * r1 + 0.5f * s20 * r2), c0 + i);
    put(0.5f * s10 * here + 0.25f * s11 * r1 + 0.25f * s21 * r2, c1 + i);
    put(0.5f * s20 * here + 0.25f * s21 * r1 + 0.25f * s22 * r2, c2 + i);
  });
}

void stencil_rows(const float* c0, const float* c1, const float* c2, int n, float* to) {
  each(n, [=]<class Value>(int i) {
    Value centre, before, after, far_before, far_after;
    read(c0 + i, centre);
    read(c1 + i - 1, before);
    read(c1 + i + 1, after);
    read(c2 + i - 2, far_before);
    read(c2 + i + 2, far_after);
    put(centre + (before + after) + (far_before + far_after), to + i);
  });
}

// Up to 32 terms in single precision, sums in double.
double product_of_rows(const float* a, const float* b, int n) {
  constexpr int sums = 16, chunk = 32 * sums, parts = sums / lanes;
  double total = 0;
  int i = 0;
  while (i + sums <= n) {
    Nodes part[parts] = {};
    for (const int end = std::min(i + chunk, n); i + sums <= end; i += sums)
      for (int p = 0; p < parts; ++p) {
        Nodes x, y;
        read(a + i + p * lanes, x);
        read(b + i + p * lanes, y);
        part[p] += x * y;
      }
    for (int l = 0; l < sums; ++l) total += static_cast<double>(part[l / lanes][l % lanes]);
  }
  for (; i < n; ++i) total += static_cast<double>(a[i] * b[i]);
  return total;
}

double work(double nodes) { return nodes * elementary::log2(std::max(nodes, 2.0)); }

}  // namespace

std::vector<HalfOrderPyramid::Level> HalfOrderPyramid::shape(int nx, int ny, double aspect, Boundary boundary,
                                                             const ComplianceMultiplier& multiplier) {
  std::vector<Level> levels{{nx, ny, {}, {}}};
  if (aspect > squareness || aspect * squareness < 1) return levels;
  const bool wraps = boundary == Boundary::periodic;
  double thickness = multiplier.length;
  while (std::min(levels.back().nx, levels.back().ny) > coarsest && thickness >= least_thickness) {
    // A coarse node beyond a free rim feels the last fine node. On odd periodic sides first and last coarse
    // nodes are neighbours.
    const auto half = [wraps](int n) { return wraps ? (n + 1) / 2 : n / 2 + 1; };
    levels.push_back({half(levels.back().nx), half(levels.back().ny), {}, {}});
    thickness /= 2;
  }
  return levels;
}

HalfOrderPyramid::HalfOrderPyramid(int nx, int ny, double aspect, Boundary boundary, double weight,
                                   const ComplianceMultiplier& multiplier)
    : wraps_(boundary == Boundary::periodic),
      weight_(weight),
      transform_share_(1),
      levels_(shape(nx, ny, aspect, boundary, multiplier)),
      zeros_(static_cast<std::size_t>(nx), 0.0f),
      filter_(levels_.back().nx, levels_.back().ny, bottom_period(levels_.back().nx, boundary),
              bottom_period(levels_.back().ny, boundary)) {
  for (Level& level : levels_) {
    const auto nodes = static_cast<std::size_t>(level.nx) * static_cast<std::size_t>(level.ny);
    level.in.resize(nodes);
    level.out.resize(nodes);
  }
  const Level& last = levels_.back();
  const int period_x = bottom_period(last.nx, boundary), period_y = bottom_period(last.ny, boundary);
  transform_share_ = work(static_cast<double>(period_x) * period_y) /
                     work(static_cast<double>(bottom_period(nx, boundary)) * bottom_period(ny, boundary));
  const int bins_x = period_x / 2 + 1, bins_y = period_y / 2 + 1;
  multiplier_.resize(static_cast<std::size_t>(bins_x) * static_cast<std::size_t>(bins_y));
  for (int a = 0; a < bins_x; ++a)
    for (int b = 0; b < bins_y; ++b)
      multiplier_[static_cast<std::size_t>(a) * static_cast<std::size_t>(bins_y) +
                  static_cast<std::size_t>(b)] =
          std::numbers::pi * elementary::hypot(static_cast<double>(a) / period_x, b / (period_y * aspect));
  if (multiplier.shares()) {
    const ComplianceMultiplier there =
        multiplier.on_coarser(std::ldexp(1.0, static_cast<int>(levels_.size()) - 1));
    for (double& half_wave : multiplier_)
      if (half_wave > 0) half_wave /= there.share(2 * half_wave);
  }
  work_.resize(last.in.size());
}

std::int64_t HalfOrderPyramid::bytes(int nx, int ny, double aspect, Boundary boundary,
                                     const ComplianceMultiplier& multiplier) {
  std::int64_t total = 0;
  const auto levels = shape(nx, ny, aspect, boundary, multiplier);
  for (const Level& level : levels)
    total += 2 * static_cast<std::int64_t>(sizeof(float)) * level.nx * level.ny;
  const Level& last = levels.back();
  const int period_x = bottom_period(last.nx, boundary), period_y = bottom_period(last.ny, boundary);
  return total + FourierFilter::bytes(last.nx, last.ny, period_x, period_y) +
         static_cast<std::int64_t>(sizeof(double)) *
             (static_cast<std::int64_t>(last.nx) * last.ny +
              static_cast<std::int64_t>(period_x / 2 + 1) * (period_y / 2 + 1));
}

const float* HalfOrderPyramid::row(const UnsetArray<float>& field, const Level& level, int j) const {
  if (wraps_)
    j = (j + level.ny) % level.ny;
  else if (j < 0 || j >= level.ny)
    return zeros_.data();
  return field.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(level.nx);
}

// coarse.in = every second node of W fine.in.
void HalfOrderPyramid::restrict_to(const Level& fine, Level& coarse) const {
  const int rows = rows_per_block(fine.nx);
  parallel_for(block_count(coarse.ny, rows), [&](std::int64_t block) {
    MarginedRow weighted(fine.nx, wraps_);
    const int first = static_cast<int>(block) * rows;
    for (int j = first; j < std::min(first + rows, coarse.ny); ++j) {
      weigh(row(fine.in, fine, 2 * j - 1), row(fine.in, fine, 2 * j), row(fine.in, fine, 2 * j + 1), fine.nx,
            weighted.values());
      weighted.close();
      weigh_every_second(weighted.values(), coarse.nx, coarse.row_in(j));
    }
  });
}

// fine.out = S fine.in + 2 W up(coarse.out).
void HalfOrderPyramid::add_up(Level& fine, const Level& coarse) {
  const int nx = fine.nx;
  const int rows = rows_per_block(nx);
  const std::int64_t blocks = block_count(fine.ny, rows);
  const bool finest = &fine == &levels_.front();
  // Odd sides: W couples first and last nodes.
  const bool seam_x = wraps_ && nx % 2 != 0, seam_y = wraps_ && fine.ny % 2 != 0;
  Array<std::array<double, 1>> products(finest ? static_cast<std::size_t>(blocks) : 0);
  parallel_for(blocks, [&](std::int64_t block) {
    MarginedRow near_columns(nx, wraps_), far_columns(nx, wraps_), weighted(coarse.nx, wraps_);
    UnsetArray<float> centre(static_cast<std::size_t>(nx));
    const int first = static_cast<int>(block) * rows;
    for (int j = first; j < std::min(first + rows, fine.ny); ++j) {
      const float* const from = row(coarse.out, coarse, j / 2);
      const float* const next = j % 2 == 0 ? from : row(coarse.out, coarse, j / 2 + 1);
      add_quarters(from, next, coarse.nx, weighted.values());
      if (seam_y && j == 0) add_quarter(row(coarse.out, coarse, -1), coarse.nx, weighted.values());
      if (seam_y && j == fine.ny - 1) add_quarter(row(coarse.out, coarse, 0), coarse.nx, weighted.values());
      weighted.close();
      const FiveRows five{row(fine.in, fine, j - 2), row(fine.in, fine, j - 1), row(fine.in, fine, j),
                          row(fine.in, fine, j + 1), row(fine.in, fine, j + 2)};
      stencil_columns(five, weighted.values(), nx, centre.data(), near_columns.values(),
                      far_columns.values());
      if (seam_x) {
        centre[0] += 0.5f * weighted.values()[coarse.nx - 1];
        centre[static_cast<std::size_t>(nx - 1)] += 0.5f * weighted.values()[0];
      }
      near_columns.close();
      far_columns.close();
      stencil_rows(centre.data(), near_columns.values(), far_columns.values(), nx, fine.row_out(j));
      if (finest)
        products[static_cast<std::size_t>(block)][0] += product_of_rows(fine.row_in(j), fine.row_out(j), nx);
    }
  });
  if (finest) product_ = added_up(products)[0];
}

void HalfOrderPyramid::transform_coarsest() {
  Level& last = levels_.back();
  std::copy(last.in.begin(), last.in.end(), work_.begin());
  const auto bins_y = static_cast<std::size_t>(filter_.bins_y());
  filter_.apply(work_, work_, [&](int a, std::span<double> factors) {
    std::copy_n(multiplier_.data() + static_cast<std::size_t>(a) * bins_y, bins_y, factors.begin());
  });
  std::transform(work_.begin(), work_.end(), last.out.begin(),
                 [](double v) { return static_cast<float>(v); });
  constexpr double negligible = 1e-3;
  if (transform_share_ > negligible) cost::count_transforms(2 * weight_ * transform_share_);
}

std::span<const float> HalfOrderPyramid::apply() {
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) restrict_to(levels_[l], levels_[l + 1]);
  transform_coarsest();
  for (std::size_t l = levels_.size() - 1; l-- > 0;) add_up(levels_[l], levels_[l + 1]);
  if (levels_.size() == 1) {
    Level& only = levels_.front();
    product_ = 0;
    for (int j = 0; j < only.ny; ++j) product_ += product_of_rows(only.row_in(j), only.row_out(j), only.nx);
  }
  return levels_.front().out;
}

}  // namespace asperity
