// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/contact/elasticity/slabs/slab_preconditioner.hpp"
#include "engine/contact/elasticity/slabs/slab_quality.hpp"

namespace asperity {

namespace {
using namespace descent_rules;

constexpr int steps_a_slab_pass = 2;  // applications of K

// From fields.pressure, feasible. Returns whether it converged.
bool slab_gradient(SlabLevel& level, SlabFields& f, double tolerance, int most_applications) {
  constexpr std::size_t window = 8;
  constexpr int renewals = 20;  // steps between recomputations of the gap (drift)
  const double upper = level.cap;
  const int last = level.applications + most_applications;
  double *const p = f.pressure.data(), *const g = f.gap.data();
  double *const d = f.direction.data(), *const image = f.image.data();
  level.gap(f.pressure, f.gap);
  bool fresh = true;
  std::array<double, window> energies;
  energies.fill(-std::numeric_limits<double>::infinity());
  double energy = 0, pace = 0.5;
  energies[0] = energy;
  for (int step = 0;; ++step) {
    const SlabQuality at = slab_quality(level, f.pressure, f.gap);
    level.team.work([&] {
      if (level.report) level.report(at.residual);
    });
    if (at.residual < tolerance) {
      if (fresh) return true;
      level.gap(f.pressure, f.gap);
      fresh = true;
      continue;
    }
    if (level.applications >= last || !std::isfinite(at.residual)) return false;

    level.each([=, middle = at.interior_gap](std::size_t k) { d[k] = p[k] - pace * (g[k] - middle); });
    project_slabs_to_load(level, f.direction, nullptr, f.direction);
    level.apply([=](std::size_t k) { return d[k] -= p[k]; }, [=](std::size_t k, double u) { image[k] = u; });
    const auto sums = level.over<4>([=, middle = at.interior_gap](std::size_t k, double* v) {
      v[0] = (g[k] - middle) * d[k];
      v[1] = d[k] * image[k];
      v[2] = image[k] * image[k];
      v[3] = d[k] * d[k];
    });
    const double slope = sums[0], curvature = sums[1];
    if (!(curvature > 0)) return false;
    const double highest = *std::max_element(energies.begin(), energies.end());
    const double t = energy + slope + 0.5 * curvature > highest ? std::min(1.0, -slope / curvature) : 1.0;
    level.each([=](std::size_t k) {
      p[k] = t == 1 ? p[k] + d[k] : std::min(std::max(p[k] + t * d[k], 0.0), upper);
      g[k] += t * image[k];
    });
    energy += t * slope + 0.5 * t * t * curvature;
    energies[static_cast<std::size_t>(step + 1) % window] = energy;
    fresh = false;
    pace = step % 2 == 0 ? sums[3] / curvature : curvature / sums[2];
    if (step % renewals == renewals - 1) {
      project_slabs_to_load(level, f.pressure, nullptr, f.pressure);
      level.gap(f.pressure, f.gap);
      fresh = true;
    }
  }
}

class SlabDescent {
 public:
  SlabDescent(SlabLevel& level, SlabFields& fields, double tolerance, int most, bool exact)
      : level_(level),
        f_(fields),
        preconditioner_(level),
        tolerance_(tolerance),
        most_(level.applications + most),
        exact_(exact) {}
  bool run();

 private:
  void project(const SlabQuality& at, Array<double>& target);
  std::optional<double> shift_to_load(const SlabQuality& at);
  void mark_free(const SlabQuality& at);
  void free_the_nearest(double offset);
  double precondition();
  void settle_step(const SlabQuality& at);
  bool descend(int steps);
  void balance();

  SlabLevel& level_;
  SlabFields& f_;
  SlabPreconditioner preconditioner_;
  double tolerance_;
  int most_;
  const bool exact_;
  double free_count_ = 0;
  bool changed_ = true;
  double mean_gap_ = 0;  // of the free nodes
  double surplus_ = 0;   // load of the preconditioned residual per free node
  bool have_direction_ = false;
  double direction_rz_ = 0;
};

// target = p clipped and shifted to the load on the interior; if the interior cannot carry the load, all
// nodes move in the order of their gaps. Overwrites old_free.
void SlabDescent::project(const SlabQuality& at, Array<double>& target) {
  const double upper = level_.cap;
  level_.each([=, p = f_.pressure.data(), to = target.data(), marks = f_.old_free.data()](std::size_t k) {
    marks[k] = ((p[k] > 0) & (p[k] < upper)) ? 1 : 0;
    to[k] = std::min(std::max(p[k], 0.0), upper);
  });
  if (project_slabs_to_load(level_, target, f_.old_free.data(), target)) return;
  level_.each([=, g = f_.gap.data(), to = target.data(), stiffness = level_.short_wave_stiffness,
               middle = at.interior_gap](std::size_t k) { to[k] -= stiffness * (g[k] - middle); });
  project_slabs_to_load(level_, target, nullptr, target);
}

// Interior shift to the load by two Newton steps; none if the first misses the load by over 1 %.
std::optional<double> SlabDescent::shift_to_load(const SlabQuality& at) {
  const double load = level_.total_load(), upper = level_.cap;
  if (at.interior == 0) return {};
  const double first = (load - at.load) / at.interior;
  const auto found = level_.over<2>([=, p = f_.pressure.data()](std::size_t k, double* v) {
    const double q = std::min(std::max(p[k], 0.0), upper);
    const bool here = (p[k] > 0) & (p[k] < upper);
    const double x = here ? q + first : q;
    v[0] = std::min(std::max(x, 0.0), upper);
    v[1] = (here & (x > 0) & (x < upper)) ? 1.0 : 0.0;
  });
  if (!(std::abs(found[0] - load) < 0.01 * load) || found[1] == 0) return {};
  return first - (found[0] - load) / found[1];
}

// Nodes clipped in this pass may not leave the bound: their gaps are stale.
void SlabDescent::mark_free(const SlabQuality& at) {
  const double upper = level_.cap, offset = at.interior_gap;
  const auto sums = level_.over<3>([=, p = f_.pressure.data(), g = f_.gap.data(), before = f_.old_free.data(),
                                    free = f_.free.data()](std::size_t k, double* v) {
    const double pressure = p[k], gap = g[k], q = std::min(std::max(pressure, 0.0), upper);
    const bool inside = (q > 0) & (q < upper);
    const bool enters =
        ((q <= 0) & (gap < offset) & (pressure >= 0)) | ((q > 0) & (gap > offset) & (pressure <= upper));
    const std::uint8_t mark = (inside | enters) ? 1 : 0;
    free[k] = mark;
    v[0] = mark;
    v[1] = mark != 0 ? gap : 0.0;
    v[2] = mark != before[k] ? 1.0 : 0.0;
  });
  free_count_ = sums[0];
  changed_ = sums[2] != 0;
  mean_gap_ = free_count_ > 0 ? sums[1] / free_count_ : offset;
  if (free_count_ < 2 && level_.shape.slab.all_nodes() >= 2) free_the_nearest(offset);
  if (changed_) preconditioner_.set_free(f_.free);
}

void SlabDescent::free_the_nearest(double offset) {
  constexpr std::size_t few = 9;
  std::array<double, few> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (const double g : f_.gap) {
    const double distance = std::abs(g - offset);
    if (!(distance < least.back())) continue;
    least.back() = distance;
    for (std::size_t i = few - 1; i > 0 && least[i] < least[i - 1]; --i) std::swap(least[i], least[i - 1]);
  }
  Array<double> all = level_.team.gather(least);
  std::nth_element(all.begin(), all.begin() + (few - 1), all.end());
  const double furthest = all[few - 1];
  const auto sums = level_.over<2>([=, g = f_.gap.data(), free = f_.free.data()](std::size_t k, double* v) {
    const double distance = std::abs(g[k] - offset);
    if (distance <= furthest && std::isfinite(distance)) free[k] = 1;
    v[0] = free[k];
    v[1] = free[k] != 0 ? g[k] : 0.0;
  });
  changed_ = true;
  free_count_ = sums[0];
  if (free_count_ > 0) mean_gap_ = sums[1] / free_count_;
}

void SlabDescent::balance() {
  const auto sum = level_.over<1>([g = f_.gap.data(), free = f_.free.data()](std::size_t k, double* v) {
    v[0] = free[k] != 0 ? g[k] : 0.0;
  });
  mean_gap_ = sum[0] / free_count_;
}

// Returns r·(M r) for r = mean gap − gap.
double SlabDescent::precondition() {
  preconditioner_.apply([g = f_.gap.data(), mean = mean_gap_](std::size_t k) { return mean - g[k]; });
  const auto sums = level_.over<2>([z = preconditioner_.values(), g = f_.gap.data(), free = f_.free.data(),
                                    mean = mean_gap_](std::size_t k, double* v) {
    v[0] = free[k] != 0 ? z[k] : 0.0;
    v[1] = free[k] != 0 ? z[k] * (mean - g[k]) : 0.0;
  });
  surplus_ = sums[0] / free_count_;
  return sums[1];
}

// Applies clipping and a fixed preconditioned step for one application of K.
void SlabDescent::settle_step(const SlabQuality& at) {
  const double upper = level_.cap;
  const std::optional<double> shift = shift_to_load(at);
  if (!shift) project(at, f_.image);
  precondition();
  const bool by_shift = shift.has_value();
  level_.apply(
      [=, p = f_.pressure.data(), target = f_.image.data(), free = f_.free.data(),
       z = preconditioner_.values(), surplus = surplus_, by = shift.value_or(0)](std::size_t k) {
        double to = target[k];
        if (by_shift) {
          const double q = std::min(std::max(p[k], 0.0), upper);
          const bool here = (p[k] > 0) & (p[k] < upper);
          to = here ? std::min(std::max(q + by, 0.0), upper) : q;
        }
        const double before = p[k];
        p[k] =
            to + (free[k] != 0 ? richardson_step * (z[k] - surplus) : 0.0);  // exactly the bound if not free
        return p[k] - before;
      },
      [g = f_.gap.data()](std::size_t k, double u) { g[k] += u; });
  balance();
}

// Conjugate gradients after `steps` steps of this pass; false if no step was possible.
bool SlabDescent::descend(int steps) {
  const int enough = steps == 0 ? 1 : steps_a_slab_pass;
  while (steps < enough) {
    const double rz = precondition();
    const double beta = have_direction_ && direction_rz_ > 0 ? rz / direction_rz_ : 0.0;
    direction_rz_ = rz;
    have_direction_ = true;
    level_.apply(
        [beta, d = f_.direction.data(), free = f_.free.data(), z = preconditioner_.values(),
         surplus = surplus_](std::size_t k) {
          const double next = (z[k] - surplus) + (beta != 0 ? beta * d[k] : 0.0);
          return d[k] = free[k] != 0 ? next : 0.0;
        },
        [image = f_.image.data()](std::size_t k, double u) { image[k] = u; });
    const auto sums = level_.over<2>(
        [d = f_.direction.data(), image = f_.image.data(), free = f_.free.data()](std::size_t k, double* v) {
          v[0] = d[k] * image[k];
          v[1] = free[k] != 0 ? image[k] : 0.0;
        });
    if (!(sums[0] > 0) || !(rz > 0)) {
      have_direction_ = false;
      break;
    }
    const double length = rz / sums[0];
    mean_gap_ += length * (sums[1] / free_count_);
    level_.each([length, p = f_.pressure.data(), g = f_.gap.data(), d = f_.direction.data(),
                 image = f_.image.data()](std::size_t k) {
      p[k] += length * d[k];
      g[k] += length * image[k];
    });
    ++steps;
  }
  return steps > 0;
}

bool SlabDescent::run() {
  level_.gap(f_.pressure, f_.gap);
  bool fresh = true;
  Watch watch;
  int renewals = 0;
  std::fill(f_.old_free.begin(), f_.old_free.end(), std::uint8_t{255});
  for (;;) {
    SlabQuality at = slab_quality(level_, f_.pressure, f_.gap);
    level_.team.work([&] {
      if (level_.report) level_.report(at.residual);
    });
    if (at.residual < tolerance_) {
      const double load = level_.total_load();
      if (!exact_ || (at.within && fresh && std::abs(at.load - load) < tolerance_ * load)) return true;
      project(at, f_.pressure);
      if (++renewals > most_renewals) return false;
      level_.gap(f_.pressure, f_.gap);
      fresh = true;
      have_direction_ = false;
      std::fill(f_.old_free.begin(), f_.old_free.end(), std::uint8_t{255});
      continue;
    }
    watch.take(at.residual);
    if (watch.without_gain() > passes_without_gain || level_.applications > most_ ||
        !std::isfinite(at.residual)) {
      project(at, f_.pressure);
      return false;
    }
    const Watch::Advice advice = watch.advice();
    if (advice == Watch::Advice::average_passes) {
      level_.each([p = f_.pressure.data(), g = f_.gap.data(), q = f_.old_pressure.data(),
                   old = f_.old_gap.data()](std::size_t k) {
        p[k] = 0.5 * (p[k] + q[k]);
        g[k] = 0.5 * (g[k] + old[k]);
      });
      have_direction_ = false;
      at = slab_quality(level_, f_.pressure, f_.gap);
    } else if (advice == Watch::Advice::remember_pass) {
      level_.team.work([&] {
        f_.old_pressure = f_.pressure;
        f_.old_gap = f_.gap;
      });
    }
    mark_free(at);
    if (!at.within || changed_) have_direction_ = false;
    fresh = false;
    if (!at.within) settle_step(at);
    if (!descend(at.within ? 0 : 1)) {  // free nodes are balanced to rounding
      project(at, f_.pressure);
      return false;
    }
    std::swap(f_.free, f_.old_free);
  }
}
}  // namespace

SlabFields::SlabFields(Team& team, std::size_t nodes) {
  team.work([&] {
    for (Array<double>* field : {&pressure, &gap, &direction, &image}) field->resize(nodes);
    free.resize(nodes);
    old_free.resize(nodes);
  });
  team.agree();
}

DescentEnd descend_in_slabs(SlabLevel& level, SlabFields& fields, double tolerance, ChainEffort effort) {
  constexpr int quick = 300, shake = 12, last_resort = 3000;
  DescentEnd end;
  for (int stage = 0; stage < (effort == ChainEffort::full ? 5 : 3) && !end.converged; ++stage) {
    if (stage % 2 == 0 && stage < 4) {
      end.stage = stage == 0 ? "preconditioned descent" : "preconditioned descent, restarted";
      end.converged = SlabDescent(level, fields, tolerance, quick, effort != ChainEffort::start).run();
    } else {
      end.stage = "spectral projected gradients";
      end.converged = slab_gradient(level, fields, tolerance, stage == 4 ? last_resort : shake);
    }
  }
  return end;
}

}  // namespace asperity
