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
constexpr int most_renewals = 50;

// The fields by plain pointers and the law by value: what the loops over the nodes take along.
template <class Limit>
struct Nodes {
  double *pressure, *gap, *step, *direction, *residual;
  std::uint8_t* free;
  Limit limit;
  double balance;

  double settled(std::size_t k) const { return limit.settle(k, pressure[k], gap[k], balance); }
  // The gap of a free node with the opening it would have if it went on yielding, or not, as marked.
  double total_gap(std::size_t k) const {
    const double elastic_gap = gap[k];
    if constexpr (Limit::hardens) {
      const double opening = limit.compliance * (pressure[k] - limit.yields_at(k));
      return elastic_gap + (free[k] == yielding ? opening : 0.0);
    } else {
      return elastic_gap;
    }
  }
  bool moves(std::size_t k) const {
    if constexpr (Limit::hardens)
      return free[k] == elastic || free[k] == yielding;
    else
      return free[k] != fixed;
  }
  // Whether pressure q, settled, belongs to the elastic interior, which is shifted to the load.
  bool shifts(std::size_t k, [[maybe_unused]] double q, [[maybe_unused]] bool any_interior) const {
    if constexpr (Limit::hardens)
      return q > 0 && (q < limit.yields_at(k) || !any_interior);
    else  // the same of the pressure as of q, without waiting for it
      return (pressure[k] > 0) & (pressure[k] < limit.upper());
  }
};

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
  Nodes<Limit> view() {
    return {f_.pressure.data(), f_.gap.data(),  f_.step.data(), f_.direction.data(),
            f_.residual.data(), f_.free.data(), limit_,         balance_};
  }
  ContactQuality quality();
  // What the pressures lack of feasible ones: each settled, those of the elastic interior shifted to the
  // load.
  void project(const ContactQuality& at, Array<double>& target);
  std::optional<double> shift_to_load(const ContactQuality& at);
  // Feasible pressures and their gap.
  void renew(const ContactQuality& at) {
    project(at, f_.pressure);
    level_.gap(f_.pressure, f_.gap);
    fresh_ = true;
    balance_ = std::numeric_limits<double>::quiet_NaN();
  }
  double form_residual();
  double precondition();
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
  double untaken_ = 0;  // length along `direction` that the pressures and gaps have yet to go
  bool fresh_ = false;
  bool have_direction_ = false;
  double direction_rz_ = 0;
};

// Takes the last step on the way.
template <class Limit>
ContactQuality Descent<Limit>::quality() {
  const PressureStep step{untaken_, f_.direction, f_.step};
  untaken_ = 0;
  return contact_quality(level_, f_.pressure, f_.gap, step, balance_);
}

// target = the settled pressures, those of the elastic interior shifted to the load; where it cannot carry
// the load all nodes move, in the order of their gaps.
template <class Limit>
void Descent<Limit>::project(const ContactQuality& at, Array<double>& target) {
  const double upper = limit_.upper();
  const bool any_interior = at.interior > 0;
  for_nodes(nodes(), [n = view(), to = target.data(), any_interior](std::size_t k) {
    const double q = n.settled(k);
    n.free[k] = n.shifts(k, q, any_interior) ? 1 : 0;
    to[k] = q;
  });
  if (project_to_load(target, f_.free, upper, level_.total_load(), target)) return;
  const double elastic_stiffness = level_.short_wave_stiffness;
  const double yielding_stiffness = elastic_stiffness / (1 + elastic_stiffness * limit_.yielding_slope());
  for_nodes(nodes(), [=, n = view(), to = target.data(), middle = at.interior_gap](std::size_t k) {
    const double q = to[k], opening = n.limit.opening(k, q), apart = n.gap[k] + opening - middle;
    to[k] = q - (opening > 0 ? yielding_stiffness : elastic_stiffness) * apart;
  });
  project_to_load(target, {}, upper, level_.total_load(), target);
}

// The shift of project(), two Newton steps from none: what it misses of the load the next pass makes good.
// Nothing where that is not small.
template <class Limit>
std::optional<double> Descent<Limit>::shift_to_load(const ContactQuality& at) {
  const double load = level_.total_load(), upper = limit_.upper();
  if (at.interior == 0) return {};
  const double first = (load - at.load) / at.interior;
  const auto found = over_nodes<2>(nodes(), [=, n = view()](std::size_t k, double* v) {
    const double q = n.settled(k);
    const bool here = n.shifts(k, q, true);
    const double x = q + (here ? first : 0.0);
    const bool above = x > 0, below = x < upper;
    const double positive = above ? x : 0.0;
    v[0] = below ? positive : upper;
    v[1] = (here & above & below) ? 1.0 : 0.0;
  });
  if (!(std::abs(found[0] - load) < 0.01 * load) || found[1] == 0) return {};
  return first - (found[0] - load) / found[1];
}

// residual = what the gaps of the free nodes lack of their mean; off them it means nothing. Returns its norm.
template <class Limit>
double Descent<Limit>::form_residual() {
  const auto squares =
      over_marked_nodes<1>(f_.free, [n = view(), mean = mean_gap_](std::size_t k, double* v) {
        const double all = mean - n.total_gap(k), r = n.moves(k) ? all : 0.0;
        n.residual[k] = r;
        v[0] = r * r;
      });
  return std::sqrt(squares[0]);
}

// From the residual: residual = M r, the load not yet kept, 0 off the free nodes; returns r·(M r with the
// load kept).
template <class Limit>
double Descent<Limit>::precondition() {
  preconditioner_.apply(f_.free, f_.residual);
  const auto sums = over_marked_nodes<2>(f_.free, [n = view(), mean = mean_gap_](std::size_t k, double* v) {
    const double all = n.residual[k], r = mean - n.total_gap(k), here = n.moves(k) ? all : 0.0;
    v[0] = here;
    v[1] = here * r;
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
  form_residual();
  precondition();
  const Freedom balancing = set_.balancing();
  const auto advance = [=, n = view(), surplus = surplus_](std::size_t k, double target) {
    const double p = n.pressure[k], z = n.residual[k] - (n.free[k] == balancing ? surplus : 0.0);
    const double descent = richardson_step * z, x = (target - p) + (n.moves(k) ? descent : 0.0);
    n.step[k] = x;
    n.pressure[k] = p + x;
  };
  if (shift) {
    for_nodes(nodes(), [=, n = view(), by = *shift, upper = limit_.upper()](std::size_t k) {
      const double q = n.settled(k), moved = q + by, positive = moved > 0 ? moved : 0.0;
      const double shifted = moved < upper ? positive : upper;
      advance(k, n.shifts(k, q, true) ? shifted : q);
    });
  } else {
    for_nodes(nodes(), [=, n = view()](std::size_t k) { advance(k, n.step[k]); });
  }
  level_.apply(f_.step, f_.step);
  if (set_.settling_count > 0) {
    for (std::uint8_t& kind : f_.free)
      if (kind == settling) kind = yielding;
    set_.yielding_count += set_.settling_count;
    set_.settling_count = 0;
    preconditioner_.set_free(f_.free);
  }
  const Freedom balances = set_.balancing();
  const auto sums = over_nodes<1>(nodes(), [n = view(), balances](std::size_t k, double* v) {
    n.gap[k] += n.step[k];
    const double gap = n.total_gap(k);
    v[0] = n.free[k] == balances ? gap : 0.0;
  });
  mean_gap_ = sums[0] / set_.balancing_count();
}

// Conjugate gradients on the free set, `steps` of the pass being taken already; false where no step could be.
template <class Limit>
bool Descent<Limit>::descend(int steps) {
  const Freedom balancing = set_.balancing();
  double start = 0;
  while (steps < steps_a_pass) {
    const double norm = form_residual();
    // A pass that begins with conjugate gradients ends when it has gained enough for this free set.
    if (steps == 0)
      start = norm;
    else if (norm < enough_reduction * start)
      break;
    const double rz = precondition();
    const double keep = have_direction_ && direction_rz_ > 0 ? rz / direction_rz_ : 0.0;
    direction_rz_ = rz;
    const auto turn = [=, n = view(), surplus = surplus_](std::size_t k) {
      const double z = n.residual[k] - (n.free[k] == balancing ? surplus : 0.0);
      const double old = n.direction[k], next = z + (keep != 0 ? keep * old : 0.0);
      n.direction[k] = n.moves(k) ? next : 0.0;
    };
    // An old direction is of the same free set, and 0 off it.
    have_direction_ ? for_marked_nodes(f_.free, turn) : for_nodes(nodes(), turn);
    have_direction_ = true;
    level_.apply(f_.direction, f_.step);
    const double slope = limit_.yielding_slope();
    const auto sums = over_marked_nodes<2>(f_.free, [=, n = view()](std::size_t k, double* v) {
      const double d = n.direction[k];
      double image = n.step[k];
      if constexpr (Limit::hardens) image += n.free[k] == yielding ? slope * d : 0.0;
      v[0] = d * image;
      v[1] = n.free[k] == balancing ? image : 0.0;
    });
    if (!(sums[0] > 0) || !(rz > 0)) {
      have_direction_ = false;
      break;
    }
    const double length = rz / sums[0];
    mean_gap_ += length * (sums[1] / set_.balancing_count());
    if (++steps == steps_a_pass) {
      untaken_ = length;  // until the pressures and gaps are read again
    } else {
      for_nodes(nodes(), [=, n = view()](std::size_t k) {
        n.pressure[k] += length * n.direction[k];
        n.gap[k] += length * n.step[k];
      });
    }
  }
  return steps > 0;
}

template <class Limit>
StageEnd Descent<Limit>::run() {
  level_.gap(f_.pressure, f_.gap);
  fresh_ = true;
  StageEnd end;
  double least = end.best;
  int without_gain = 0, slow_ones = 0, jumps = 0, renewals = 0;
  double before = end.best;
  bool have_old = false;
  f_.old_free.assign(nodes(), 255);
  for (;;) {
    ContactQuality at = quality();
    end.residual = at.residual;
    if (level_.report) level_.report(at.residual);
    if (at.residual < tolerance_) {
      if (at.within && fresh_ && std::abs(at.load - level_.total_load()) < tolerance_ * level_.total_load()) {
        end.converged = true;
        end.best = at.residual;
        return end;
      }
      if (++renewals > most_renewals) {  // feasible pressures are worse again each time
        project(at, f_.pressure);
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
      for_nodes(nodes(), [n = view(), p = f_.old_pressure.data(), g = f_.old_gap.data()](std::size_t k) {
        n.pressure[k] = 0.5 * (n.pressure[k] + p[k]);
        n.gap[k] = 0.5 * (n.gap[k] + g[k]);
      });
      have_direction_ = have_old = fresh_ = false;
      slow_ones = jumps = 0;
      at = quality();
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
