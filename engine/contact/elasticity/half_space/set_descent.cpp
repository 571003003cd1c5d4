// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/set_descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/contact/elasticity/half_space/contact_quality.hpp"
#include "engine/contact/elasticity/half_space/free_set.hpp"
#include "engine/contact/elasticity/half_space/load_projection.hpp"
#include "engine/contact/elasticity/half_space/set_preconditioner.hpp"

namespace asperity {

namespace {
constexpr double richardson_step = 0.65;
constexpr int steps_a_pass = 2;
constexpr double enough_reduction = 0.1;  // of the residual's norm within a pass
constexpr int passes_without_gain = 4;
constexpr double slow = 0.7;  // a pass that leaves more than this of the best residual is slow
constexpr int slow_passes = 2;
constexpr double jump = 10;  // a pass whose residual is so many times the one before has gone back
constexpr int jumps_in_a_cycle = 2;

template <class Limit>
class Descent {
 public:
  Descent(ContactLevel& level, const Limit& limit, DescentFields& fields, double tolerance, int most)
      : level_(level),
        limit_(limit),
        f_(fields),
        preconditioner_(level, limit),
        tolerance_(tolerance),
        most_(level.applications + most) {}

  StageEnd run();

 private:
  std::size_t nodes() const { return f_.pressure.size(); }
  double settled(std::size_t k) const { return limit_.settle(k, f_.pressure[k], f_.gap[k], balance_); }
  // The gap of a free node with the opening it would have if it went on yielding, or not, as marked.
  double total_gap(std::size_t k) const {
    if constexpr (Limit::hardens)
      return f_.free[k] == yielding ? f_.gap[k] + limit_.compliance * (f_.pressure[k] - limit_.yields_at(k))
                                    : f_.gap[k];
    else
      return f_.gap[k];
  }
  bool moves(std::size_t k) const { return f_.free[k] == elastic || f_.free[k] == yielding; }

  // What the pressures lack of feasible ones: each settled, those of the elastic interior shifted to the
  // load.
  bool shifts(std::size_t k, double q, const ContactQuality& at) const {
    if constexpr (Limit::hardens)
      return q > 0 && (q < limit_.yields_at(k) || at.interior == 0);
    else
      return q > 0 && q < limit_.upper();
  }
  void project(const ContactQuality& at, Array<double>& target);
  std::optional<double> shift_to_load(const ContactQuality& at) const;
  // Feasible pressures and their gap.
  void renew(const ContactQuality& at) {
    project(at, f_.pressure);
    level_.gap(f_.pressure, f_.gap);
    fresh_ = true;
    balance_ = std::numeric_limits<double>::quiet_NaN();
  }
  double residual_norm();
  double precondition();
  // M r with the load kept, after precondition().
  double preconditioned(std::size_t k) const {
    return f_.free[k] == set_.balancing() ? f_.residual[k] - surplus_ : f_.residual[k];
  }
  void settle_step(const ContactQuality& at);
  bool descend(int steps);

  ContactLevel& level_;
  const Limit& limit_;
  DescentFields& f_;
  SetPreconditioner<Limit> preconditioner_;
  double tolerance_;
  int most_;
  FreeSet set_;
  double mean_gap_ = 0;  // of the balancing nodes
  double surplus_ = 0;   // of load in `residual`, a balancing node
  double balance_ = std::numeric_limits<double>::quiet_NaN();
  bool fresh_ = false;
  bool have_direction_ = false;
  double direction_rz_ = 0;
};

// target = the settled pressures, those of the elastic interior shifted to the load; where it cannot carry
// the load all nodes move, in the order of their gaps.
template <class Limit>
void Descent<Limit>::project(const ContactQuality& at, Array<double>& target) {
  const double upper = limit_.upper();
  for_nodes(nodes(), [&](std::size_t k) {
    const double q = settled(k);
    f_.free[k] = shifts(k, q, at) ? 1 : 0;
    target[k] = q;
  });
  if (project_to_load(target, f_.free, upper, level_.total_load(), target)) return;
  for_nodes(nodes(), [&](std::size_t k) {
    const double q = target[k], apart = f_.gap[k] + limit_.opening(k, q) - at.interior_gap;
    double stiffness = level_.short_wave_stiffness;
    if (limit_.opening(k, q) > 0) stiffness /= 1 + stiffness * limit_.yielding_slope();
    target[k] = q - stiffness * apart;
  });
  project_to_load(target, {}, upper, level_.total_load(), target);
}

// The shift of project(), two Newton steps from none: what it misses of the load the next pass makes good.
// Nothing where that is not small.
template <class Limit>
std::optional<double> Descent<Limit>::shift_to_load(const ContactQuality& at) const {
  const double load = level_.total_load(), upper = limit_.upper();
  if (at.interior == 0) return {};
  const double first = (load - at.load) / at.interior;
  const auto found = over_nodes<2>(nodes(), [&](std::size_t k, double* v) {
    const double q = settled(k);
    const bool here = shifts(k, q, at);
    const double x = here ? q + first : q;
    v[0] = std::min(std::max(x, 0.0), upper);
    v[1] = here && x > 0 && x < upper ? 1.0 : 0.0;
  });
  if (!(std::abs(found[0] - load) < 0.01 * load) || found[1] == 0) return {};
  return first - (found[0] - load) / found[1];
}

// The norm of the residual over the free nodes.
template <class Limit>
double Descent<Limit>::residual_norm() {
  const auto squares = over_nodes<1>(nodes(), [&](std::size_t k, double* v) {
    const double r = moves(k) ? total_gap(k) - mean_gap_ : 0.0;
    v[0] = r * r;
  });
  return std::sqrt(squares[0]);
}

// residual = M r, the load not yet kept; returns r·(M r with the load kept).
template <class Limit>
double Descent<Limit>::precondition() {
  Array<double>& z = f_.residual;
  for_nodes(nodes(), [&](std::size_t k) { z[k] = moves(k) ? mean_gap_ - total_gap(k) : 0.0; });
  preconditioner_.apply(f_.free, z);
  const auto sums = over_nodes<2>(nodes(), [&](std::size_t k, double* v) {
    const double here = moves(k) ? z[k] : 0.0;
    v[0] = here;
    v[1] = here * (mean_gap_ - total_gap(k));
  });
  surplus_ = sums[0] / set_.balancing_count();
  return sums[1];
}

// What settling changes and a fixed step of the preconditioner, at the cost of one application.
template <class Limit>
void Descent<Limit>::settle_step(const ContactQuality& at) {
  const std::optional<double> shift = shift_to_load(at);
  if (!shift) {
    std::swap(f_.free, f_.old_free);  // project() needs marks of its own
    project(at, f_.step);
    std::swap(f_.free, f_.old_free);
  }
  precondition();
  const double upper = limit_.upper();
  for_nodes(nodes(), [&](std::size_t k) {
    double x = f_.step[k];
    if (shift) {
      const double q = settled(k);
      x = shifts(k, q, at) ? std::min(std::max(q + *shift, 0.0), upper) : q;
    }
    x -= f_.pressure[k];
    if (moves(k)) x += richardson_step * preconditioned(k);
    f_.step[k] = x;
    f_.pressure[k] += x;
  });
  level_.apply(f_.step, f_.step);
  if (set_.settling_count > 0) {
    for (std::uint8_t& kind : f_.free)
      if (kind == settling) kind = yielding;
    set_.yielding_count += set_.settling_count;
    set_.settling_count = 0;
    preconditioner_.set_free(f_.free);
  }
  const Freedom balancing = set_.balancing();
  const auto sums = over_nodes<1>(nodes(), [&](std::size_t k, double* v) {
    f_.gap[k] += f_.step[k];
    v[0] = f_.free[k] == balancing ? total_gap(k) : 0.0;
  });
  mean_gap_ = sums[0] / set_.balancing_count();
}

// Conjugate gradients on the free set, `steps` of the pass being taken already; false where no step could be.
template <class Limit>
bool Descent<Limit>::descend(int steps) {
  const Freedom balancing = set_.balancing();
  // A pass that begins with conjugate gradients ends when it has gained enough for this free set.
  const double start = steps == 0 ? residual_norm() : 0;
  while (steps < steps_a_pass) {
    const double rz = precondition();
    const double keep = have_direction_ && direction_rz_ > 0 ? rz / direction_rz_ : 0.0;
    direction_rz_ = rz;
    for_nodes(nodes(), [&](std::size_t k) {
      const double old = keep != 0 ? keep * f_.direction[k] : 0.0;
      f_.direction[k] = moves(k) ? preconditioned(k) + old : 0.0;
    });
    have_direction_ = true;
    level_.apply(f_.direction, f_.step);
    const auto curvature = over_nodes<1>(nodes(), [&](std::size_t k, double* v) {
      const double d = f_.direction[k];
      v[0] = d * (f_.step[k] + (f_.free[k] == yielding ? limit_.yielding_slope() * d : 0.0));
    });
    if (!(curvature[0] > 0) || !(rz > 0)) {
      have_direction_ = false;
      break;
    }
    const double length = rz / curvature[0];
    const auto sums = over_nodes<1>(nodes(), [&](std::size_t k, double* v) {
      f_.pressure[k] += length * f_.direction[k];
      f_.gap[k] += length * f_.step[k];
      v[0] = f_.free[k] == balancing ? total_gap(k) : 0.0;
    });
    mean_gap_ = sums[0] / set_.balancing_count();
    ++steps;
    if (steps < steps_a_pass && residual_norm() < enough_reduction * start) break;
  }
  return steps > 0;
}

template <class Limit>
StageEnd Descent<Limit>::run() {
  level_.gap(f_.pressure, f_.gap);
  fresh_ = true;
  StageEnd end;
  double least = end.best;
  int without_gain = 0, slow_ones = 0, jumps = 0;
  double before = end.best;
  bool have_old = false;
  f_.old_free.assign(nodes(), 255);
  for (;;) {
    ContactQuality at = contact_quality(level_, f_.pressure, f_.gap, balance_);
    end.residual = at.residual;
    if (level_.report) level_.report(at.residual);
    if (at.residual < tolerance_) {
      if (at.within && fresh_ && std::abs(at.load - level_.total_load()) < tolerance_ * level_.total_load()) {
        end.converged = true;
        end.best = at.residual;
        return end;
      }
      renew(at);
      have_direction_ = false;
      continue;
    }
    if (at.residual < 0.9 * end.best) {
      end.best = at.residual;
      without_gain = 0;
    } else {
      ++without_gain;
    }
    slow_ones = at.residual > slow * least ? slow_ones + 1 : 0;
    least = std::min(least, at.residual);
    if (at.residual > jump * before) ++jumps;
    before = at.residual;
    if (without_gain > passes_without_gain || level_.applications > most_ || !std::isfinite(at.residual)) {
      project(at, f_.pressure);
      return end;
    }
    if ((slow_ones >= slow_passes || jumps >= jumps_in_a_cycle) && have_old) {
      for_nodes(nodes(), [&](std::size_t k) {
        f_.pressure[k] = 0.5 * (f_.pressure[k] + f_.old_pressure[k]);
        f_.gap[k] = 0.5 * (f_.gap[k] + f_.old_gap[k]);
      });
      have_direction_ = have_old = fresh_ = false;
      slow_ones = jumps = 0;
      at = contact_quality(level_, f_.pressure, f_.gap, balance_);
    } else if ((have_old = slow_ones + 1 >= slow_passes || jumps + 1 >= jumps_in_a_cycle)) {
      f_.old_pressure = f_.pressure;
      f_.old_gap = f_.gap;
    }

    set_ = mark_free_set(limit_, at, balance_, f_.pressure, f_.gap, f_.old_free, f_.free);
    if (set_.changed) preconditioner_.set_free(f_.free);
    if (!at.within || set_.changed) have_direction_ = false;
    fresh_ = false;
    mean_gap_ = set_.count() > 0 ? set_.balancing_gap() / set_.balancing_count() : at.interior_gap;
    if (!at.within) settle_step(at);
    if (!descend(at.within ? 0 : 1)) {  // the free nodes are in balance to the last bit
      project(at, f_.pressure);
      return end;
    }
    balance_ = mean_gap_;
    std::swap(f_.free, f_.old_free);
  }
}
}  // namespace

StageEnd set_descent(ContactLevel& level, DescentFields& fields, double tolerance, int most_applications) {
  return std::visit(
      [&](const auto& limit) { return Descent(level, limit, fields, tolerance, most_applications).run(); },
      level.limit);
}

}  // namespace asperity
