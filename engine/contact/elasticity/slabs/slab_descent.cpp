// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_descent.hpp"

namespace asperity {

namespace {

void extend(const double* below, const double* here, const double* above, const std::uint8_t* mask, int nx,
            double* to) {
  const auto at = [&](int i, int left, int right) {
    const double mean = 0.25 * ((below[i] + above[i]) + (here[left] + here[right]));
    to[i] = mask[i] != 0 ? here[i] : mean;
  };
  at(0, nx - 1, nx > 1 ? 1 : 0);
  for (int i = 1; i < nx - 1; ++i) at(i, i - 1, i + 1);
  if (nx > 1) at(nx - 1, nx - 2, 0);
}

// Transpose of `extend`.
struct RowOf {
  const double* value;
  const std::uint8_t* mask;
  double off(int i) const { return mask[i] != 0 ? 0.0 : value[i]; }
};
void gather_back(RowOf below, RowOf here, RowOf above, int nx, double* to) {
  const auto at = [&](int i, int left, int right) {
    const double quarter = 0.25 * ((below.off(i) + above.off(i)) + (here.off(left) + here.off(right)));
    to[i] = (here.mask[i] != 0 ? here.value[i] : 0.0) + quarter;
  };
  at(0, nx - 1, nx > 1 ? 1 : 0);
  for (int i = 1; i < nx - 1; ++i) at(i, i - 1, i + 1);
  if (nx > 1) at(nx - 1, nx - 2, 0);
}

using namespace descent_rules;

constexpr int steps_a_slab_pass = 2;  // applications of K

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
  bool project(std::span<double> values, const std::uint8_t* marks) {
    return project_to_load(level_, values.data(), marks, level_.cap, level_.total_load(),
                           SlabLevel::resolves_shifts, values.data());
  }
  void project(const ContactQuality& at, std::span<double> target);
  std::optional<double> shift_to_load(const ContactQuality& at);
  void mark_free(const ContactQuality& at);
  void free_the_nearest(double offset);
  double precondition();
  void settle_step(const ContactQuality& at);
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

// target = p clipped, with the interior shifted to the load. Without enough interior, all nodes move in the
// order of their gaps. Overwrites old_free.
void SlabDescent::project(const ContactQuality& at, std::span<double> target) {
  const double upper = level_.cap;
  level_.each([=, p = f_.pressure.data(), to = target.data(), marks = f_.old_free.data()](std::size_t k) {
    marks[k] = ((p[k] > 0) & (p[k] < upper)) ? 1 : 0;
    to[k] = std::min(std::max(p[k], 0.0), upper);
  });
  if (project(target, f_.old_free.data())) return;
  level_.each([=, g = f_.gap.data(), to = target.data(), stiffness = level_.short_wave_stiffness,
               middle = at.interior_gap](std::size_t k) { to[k] -= stiffness * (g[k] - middle); });
  project(target, nullptr);
}

// By two Newton steps; empty if the first misses the load by over 1 %.
std::optional<double> SlabDescent::shift_to_load(const ContactQuality& at) {
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

// Newly clipped nodes may not leave the bound: their gaps are stale.
void SlabDescent::mark_free(const ContactQuality& at) {
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
  if (free_count_ < 2 && level_.slab.all_nodes() >= 2) free_the_nearest(offset);
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

// One application of K for clipping and a fixed preconditioned step.
void SlabDescent::settle_step(const ContactQuality& at) {
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

// After `steps` steps of this pass; false without any step.
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
    ContactQuality at = contact_quality(level_, f_.pressure, f_.gap);
    level_.report_pass(at.residual);
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
    if (advice == Watch::Advice::remember_pass) level_.work([&] { f_.remember_pass(); });
    if (advice == Watch::Advice::average_passes) {
      level_.work([&] { f_.average_passes(); });
      have_direction_ = false;
      at = contact_quality(level_, f_.pressure, f_.gap);
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

SlabPreconditioner::SlabPreconditioner(SlabLevel& level)
    : level_(level), rim_(rim_rows(level.team, level.slab, sweeps)) {
  level.team.work([&] {
    const Slab& slab = level.slab;
    const std::size_t rows = static_cast<std::size_t>(slab.rows() + 2 * sweeps);
    field_.resize(rows * slab.width());
    mask_.resize(rows * slab.width());
    before_.resize(slab.width() * sweeps);
    fresh_.resize(slab.width());
  });
  level.team.agree();
}

void SlabPreconditioner::set_free(std::span<const std::uint8_t> free) {
  std::copy(free.begin(), free.end(), mask_.begin() + static_cast<std::ptrdiff_t>(offset()));
  exchange_rim(mask_);
}

template <class Number>
void SlabPreconditioner::exchange_rim(Array<Number>& field) {
  const std::size_t width = level_.slab.width();
  const std::size_t after = offset() + level_.nodes();
  rim_.run(
      [&](int j, double* to) {
        std::copy_n(field.data() + offset() + static_cast<std::size_t>(j) * width, width, to);
      },
      [&](std::size_t k, const double* row) {
        const std::size_t at = k < sweeps ? k * width : after + (k - sweeps) * width;
        std::transform(row, row + width, field.data() + at,
                       [](double value) { return static_cast<Number>(value); });
      });
}
template void SlabPreconditioner::exchange_rim(Array<double>&);

// Sweep s processes row j = t − s at step t: the row above has passed sweep s − 1, `before_` has the row
// below before sweep s.
void SlabPreconditioner::sweep(bool adjoint) {
  const Slab& slab = level_.slab;
  const int rows = slab.rows() + 2 * sweeps, nx = slab.nx;
  if (slab.rows() == 0) return;
  const auto row = [&](int j) { return field_.data() + static_cast<std::size_t>(j) * slab.width(); };
  const auto mask = [&](int j) { return mask_.data() + static_cast<std::size_t>(j) * slab.width(); };
  const auto before = [&](int s) { return before_.data() + static_cast<std::size_t>(s - 1) * slab.width(); };
  for (int t = 1; t < rows + sweeps; ++t) {
    for (int s = 1; s <= sweeps; ++s) {
      const int j = t - s;
      // Later sweeps do not read this row.
      if (j < s || j >= rows - s) {
        if (j == s - 1) std::copy_n(row(j), nx, before(s));
        continue;
      }
      if (adjoint)
        gather_back({before(s), mask(j - 1)}, {row(j), mask(j)}, {row(j + 1), mask(j + 1)}, nx,
                    fresh_.data());
      else
        extend(before(s), row(j), row(j + 1), mask(j), nx, fresh_.data());
      std::copy_n(row(j), nx, before(s));
      std::copy_n(fresh_.data(), nx, row(j));
    }
  }
}

SlabFields::SlabFields(Team& team, std::size_t nodes) : DescentFields(0) {
  team.work([&] {
    static_cast<DescentFields&>(*this) = DescentFields(nodes);
    direction.resize(nodes);
  });
  team.agree();
}

DescentEnd run_chain(SlabLevel& level, SlabFields& fields, double tolerance, ChainEffort effort) {
  const auto descend = [&] {
    return SlabDescent(level, fields, tolerance, quick, effort != ChainEffort::start).run();
  };
  const auto shake = [&](int most) {
    return spectral_gradient(level, PressureCap{level.cap}, fields.pressure, fields.gap, fields.direction,
                             fields.image, tolerance, most);
  };
  return run_stages(effort, descend, shake);
}

}  // namespace asperity
