// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of a periodic half-space on one of the nested grids, in slabs of rows over a team of processes:
// minimise ½ p·Kp − h·p over 0 <= p <= H with a given mean of p, K = 2/|q| and 0 for the mean. Cell units of
// half_space/contact_level.hpp: hx = 1, hy = aspect, E* = 1, heights over the rms. All processes call every
// non-const member together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <span>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/slabs/row_exchange.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity {

// `gather`: sums, then minima, over own nodes.
template <std::size_t sums, std::size_t minima, class Gather>
std::array<double, sums + minima> over_slabs(Team& team, const Gather& gather) {
  std::array<double, sums + minima> own{};
  std::fill(own.begin() + sums, own.end(), std::numeric_limits<double>::infinity());
  team.work([&] { own = gather(); });
  return team.reduce<sums, minima>(own);
}

class SlabLevel {
 public:
  // Cell units: (heights − origin)·factor; `cap` may be infinite.
  SlabLevel(Team& level_team, const LevelShape& level_shape, std::span<const double> heights, double origin,
            double factor, double cap, double mean_pressure);

  Team& team;
  const LevelShape shape;
  const Slab slab;
  const double cap, mean_pressure;
  static constexpr bool resolves_shifts = false;
  double length = 1;     // unit of gaps in the residual
  int applications = 0;  // of K
  const double short_wave_stiffness;
  // Called after each pass; may throw.
  std::function<void(double)> report;

  // As AllNodes; nodes() are those of this process.
  std::size_t nodes() const { return slab.nodes(); }
  double all_nodes() const { return slab.all_nodes(); }
  template <std::size_t sums, std::size_t minima = 0, class Term>
  std::array<double, sums + minima> over(Term term) {
    return over_slabs<sums, minima>(team, [&] { return over_nodes<sums, minima>(nodes(), term); });
  }
  template <std::size_t sums, std::size_t minima = 0, class Term>
  std::array<double, sums + minima> in_lanes(Term term) {
    return over_slabs<sums, minima>(team, [&] { return over_lanes<sums, minima>(nodes(), term); });
  }
  template <class Body>
  void each(Body body) {
    work([&] { for_nodes(nodes(), body); });
  }
  template <class Body>
  void work(const Body& body) {
    team.work(body);
  }
  void agree() { team.agree(); }
  double first_number(double own);

  double total_load() const { return mean_pressure * all_nodes(); }
  void count_from(double origin) { origin_ = origin; }
  void report_pass(double residual) {
    work([&] {
      if (report) report(residual);
    });
  }

  // u = K p: `source(k)` returns p, `sink(k, u)` receives u, at own nodes.
  template <class Source, class Sink>
  void apply(Source source, Sink sink) {
    ++applications;
    filter(source, sink, [](double q) { return 2 / q; });
  }
  // p = |q|/2 u.
  template <class Source, class Sink>
  void apply_inverse(Source source, Sink sink) {
    filter(source, sink, [](double q) { return 0.5 * q; });
  }
  void apply(std::span<const double> p, std::span<double> u) {
    apply([p](std::size_t k) { return p[k]; }, [u](std::size_t k, double value) { u[k] = value; });
  }
  // The mean moves nothing.
  void gap(std::span<const double> p, std::span<double> g) {
    apply([p](std::size_t k) { return p[k]; }, [this, g](std::size_t k, double u) { g[k] = u - height(k); });
  }
  void gap_beside_mean(std::span<const double> p, std::span<double> g) { gap(p, g); }
  void inverse_of_heights(std::span<double> p) {
    apply_inverse([this](std::size_t k) { return height(k); },
                  [p](std::size_t k, double value) { p[k] = value; });
  }

 private:
  double height(std::size_t k) const { return (heights_[k] - origin_) * factor_; }
  template <class Source, class Sink, class Factor>
  void filter(Source source, Sink sink, Factor factor) {
    const int rows = slab.rows(), nx = slab.nx;
    team.work([&] {
      parallel_for(rows, [&](std::int64_t j) {
        double* const row = fourier_->row(static_cast<int>(j));
        const std::size_t begin = static_cast<std::size_t>(j) * slab.width();
        for (int i = 0; i < nx; ++i) row[i] = source(begin + static_cast<std::size_t>(i));
      });
    });
    fourier_->forward();
    team.work([&] { multiply(factor); });
    fourier_->inverse();
    team.work([&] {
      parallel_for(rows, [&](std::int64_t j) {
        const double* const row = fourier_->row(static_cast<int>(j));
        const std::size_t begin = static_cast<std::size_t>(j) * slab.width();
        for (int i = 0; i < nx; ++i) sink(begin + static_cast<std::size_t>(i), row[i]);
      });
    });
    cost::count_transforms(2 * shape.weight);
  }

  template <class Factor>
  void multiply(Factor factor) {
    const double per_x = 2 * std::numbers::pi / slab.nx,
                 per_y = 2 * std::numbers::pi / (slab.ny * shape.aspect);
    const double norm = 1 / slab.all_nodes();
    const int first = fourier_->first_wave(), waves = fourier_->waves();
    const auto wave = [&](int a, int b) {
      const double qx = per_x * a, qy = per_y * std::min(b, slab.ny - b);
      fourier_->bin(a, b) *= a == 0 && b == 0 ? 0.0 : norm * factor(std::sqrt(qx * qx + qy * qy));
    };
    if (fourier_->along_b_is_faster())
      parallel_for(waves, [&](std::int64_t a) {
        for (int b = 0; b < slab.ny; ++b) wave(first + static_cast<int>(a), b);
      });
    else
      parallel_for(slab.ny, [&](std::int64_t b) {
        for (int a = first; a < first + waves; ++a) wave(a, static_cast<int>(b));
      });
  }

  std::span<const double> heights_;
  double origin_, factor_;
  std::unique_ptr<SlabFourier> fourier_;
};

// Both in slabs of one team.
Array<double> restrict_slabs(Team& team, const Slab& fine, const CoarserGrid& coarse,
                             std::span<const double> field);

// target = factor · values, interpolated.
void prolong_slabs(Team& team, const CoarserGrid& coarse, std::span<const double> values, double factor,
                   const Slab& fine, std::span<double> target);

// Over all processes.
inline ContactQuality contact_quality(SlabLevel& level, std::span<const double> p,
                                      std::span<const double> g) {
  const contact_measures::AsStored stored{p.data(), g.data()};
  return contact_measures::measure_bounded(level, level.cap, stored, stored);
}

}  // namespace asperity
