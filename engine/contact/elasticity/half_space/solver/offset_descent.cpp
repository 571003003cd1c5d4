// SPDX-License-Identifier: GPL-3.0-or-later
// Contact at an offset δ on one grid: g = K p − h − δ (+ w) with the pressure law, no prescribed load.
// Conjugate gradients as in active_set_descent.cpp, with free gaps brought to δ. If this stalls, passes that
// each lower the energy ½ p·Kp − (h + δ)·p.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/half_space/solver/free_set.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/core/constants.hpp"

namespace asperity {

namespace {

// Per pass: quick, with an expensive K, downhill.
constexpr int quick_steps = 3, quick_steps_if_dear = 2, careful_steps = 24;
constexpr double careful_gain = 0.03;            // relative residual that ends a pass
constexpr int careful_passes_without_gain = 40;  // the residual may rise while the energy falls

struct OffsetQuality {
  double residual = 0;
  bool within = true;
};

template <class Limit>
class OffsetDescent {
 public:
  OffsetDescent(ContactLevel& level, const Limit& limit, DescentFields& fields, double offset,
                double tolerance, int most, ChainEffort effort, bool careful)
      : level_(level),
        limit_(limit),
        f_(fields),
        preconditioner_(level, limit),
        offset_(offset),
        tolerance_(tolerance),
        most_(level.applications + most),
        effort_(effort),
        careful_(careful),
        periodic_(level.shape.boundary == Boundary::periodic),
        immobile_(level.mean_is_immobile()),
        dear_(Limit::hardens || !periodic_),
        work_(fields.pressure.size()),
        direction_(fields.pressure.size()) {}

  bool run(bool gap_known);

 private:
  std::size_t nodes() const { return f_.pressure.size(); }
  DescentNodes<Limit> view() const {
    return {f_.pressure.data(), f_.gap.data(), f_.free.data(), limit_, offset_};
  }
  OffsetQuality quality() const;
  void settle() {
    for_nodes(nodes(), [n = view()](std::size_t k) { n.pressure[k] = n.settled(k); });
  }
  void find_gap();
  void settled_lines(std::span<double> target);
  void renew() {
    settled_lines(work_);
    std::copy(work_.begin(), work_.end(), f_.pressure.begin());
    find_gap();
  }
  double turn(double target);
  void settle_step();
  bool all_free() const {
    return immobile_ && set_.elastic_count == static_cast<double>(nodes()) && set_.yielding_count == 0 &&
           set_.settling_count == 0;
  }
  void shift_all();
  bool descend(int steps);
  bool go_downhill();
  struct Change {
    double slope = 0, energy = 0;  // change of energy: first order, total
    bool enough() const { return slope < 0 && energy <= 0.1 * slope; }
  };
  Change change_since() const;

  ContactLevel& level_;
  const Limit& limit_;
  DescentFields& f_;
  SetPreconditioner<Limit> preconditioner_;
  double offset_, tolerance_;
  int most_;
  const ChainEffort effort_;
  const bool careful_, periodic_, immobile_, dear_;
  Array<double> work_, direction_;
  FreeSet set_;
  bool fresh_ = false, have_direction_ = false;
  double direction_rz_ = 0;
  double residual_ = infinity;
};

// The immobile periodic mean can cost p precision: subtracted first.
template <class Limit>
void OffsetDescent<Limit>::find_gap() {
  double mean = 0;
  if (immobile_)
    mean = over_nodes<1>(nodes(), [p = f_.pressure.data()](std::size_t k, double* v) { v[0] = p[k]; })[0] /
           static_cast<double>(nodes());
  for_nodes(nodes(),
            [mean, p = f_.pressure.data(), to = f_.image.data()](std::size_t k) { to[k] = p[k] - mean; });
  level_.gap_beside_mean(f_.image, f_.gap);
  fresh_ = true;
  have_direction_ = false;
}

template <class Limit>
OffsetQuality OffsetDescent<Limit>::quality() const {
  const double upper = limit_.upper(), most = std::isfinite(upper) ? upper : 0.0;
  enum { load, energy, settled, least_gap, loaded };
  const auto found =
      over_nodes<3, 2>(nodes(), [n = view(), offset = offset_, upper, most](std::size_t k, double* v) {
        const double q = n.settled(k), gap = n.gap[k] - offset + n.limit.opening(k, q);
        v[load] = q;
        v[energy] = (q - (gap > 0 ? 0.0 : most)) * gap;
        v[settled] = q != n.pressure[k] ? 1.0 : 0.0;
        v[least_gap] = q < upper ? gap : infinity;
        v[loaded] = q > 0 ? -gap : infinity;
      });
  OffsetQuality at;
  at.within = found[settled] == 0;
  const double overlap = std::isfinite(found[least_gap]) ? std::max(0.0, -found[least_gap]) : 0.0;
  const double open = std::isfinite(found[loaded]) ? std::max(0.0, -found[loaded]) : 0.0;
  const double weighted = found[load] > 0 ? std::abs(found[energy]) / found[load] : 0.0;
  at.residual = std::max({overlap, weighted, contact_measures::open_weight * open}) / level_.length;
  if (!(overlap + weighted + open < infinity)) at.residual = infinity;
  return at;
}

// work_ = M r, r = target − gap when free. Returns r·M r.
template <class Limit>
double OffsetDescent<Limit>::turn(double target) {
  const auto lack = [n = view(), target](std::size_t k) {
    return n.moves(k) ? target - n.total_gap(k) : 0.0;
  };
  // The preconditioner does not see their constant.
  const bool full = set_.count() == static_cast<double>(nodes());
  const bool all_that_moves = full || (Limit::hardens && !preconditioner_.apart());
  const auto counts = [n = view(), all_that_moves](std::size_t k) {
    return n.free[k] == elastic || (all_that_moves && n.moves(k));
  };
  const auto sums = over_nodes<2>(nodes(), [lack, counts, to = work_.data()](std::size_t k, double* v) {
    const double r = lack(k);
    to[k] = r;
    v[0] = counts(k) ? r : 0.0;
    v[1] = counts(k) ? 1.0 : 0.0;
  });
  preconditioner_.apply(f_.free, work_);
  // The preconditioner ignores a periodic constant: stiffness from the longest wave, yielding nodes and K(0).
  // With all nodes free a constant moves only yielding nodes (on a layer all).
  double level = 0;
  if (periodic_ && sums[1] > 0) {
    const double all = static_cast<double>(nodes()), others = all - sums[1];
    // A constant on nearly all nodes: its negative on the others.
    const double lacking = LinearHardening::own_compliance * std::sqrt(level_.shape.aspect) * others;
    const double elastically = std::min(level_.greatest_compliance * sums[1], lacking);
    const double yields = all_that_moves ? limit_.yielding_slope() * set_.yielding_count : 0.0;
    double gives = elastically + yields;
    if (!immobile_) gives += level_.shape.multiplier.uniform * sums[1] * (sums[1] / all);
    if (gives > 0) level = sums[0] / gives;
  }
  return over_nodes<1>(nodes(), [lack, counts, z = work_.data(), level](std::size_t k, double* v) {
    if (counts(k)) z[k] += level;
    v[0] = lack(k) * z[k];
  })[0];
}

// On long cells with unchanged line loads.
template <class Limit>
void OffsetDescent<Limit>::settled_lines(std::span<double> target) {
  for_nodes(nodes(), [n = view(), to = target.data()](std::size_t k) { to[k] = n.settled(k); });
  if (!keeps_line_loads(level_.shape.aspect)) return;
  Array<std::uint8_t> where(nodes());
  for_nodes(nodes(), [n = view(), to = target.data(), w = where.data()](std::size_t k) {
    w[k] = n.shifts(k, to[k], true) ? 1 : 0;
  });
  keep_line_loads(level_.shape, f_.pressure, where, limit_.upper(), target);
}

// One application for settling and, if K is expensive, a fixed step.
template <class Limit>
void OffsetDescent<Limit>::settle_step() {
  const bool steps = dear_ && !all_free();
  settled_lines(direction_);
  if (steps) turn(offset_);
  for_nodes(nodes(), [n = view(), steps, z = work_.data(), d = direction_.data()](std::size_t k) {
    const double p = n.pressure[k], q = d[k];
    const double next = q + (steps && n.moves(k) ? descent_rules::richardson_step * z[k] : 0.0);
    d[k] = next - p;
    n.pressure[k] = next;
  });
  level_.apply(direction_, f_.image);
  for_nodes(nodes(), [n = view(), image = f_.image.data()](std::size_t k) {
    n.gap[k] += image[k];
    if (n.free[k] == settling) n.free[k] = yielding;
  });
  if (set_.settling_count > 0) {
    set_.yielding_count += set_.settling_count;
    set_.settling_count = 0;
    preconditioner_.set_free(f_.free);
  }
}

// In periodic full contact a uniform pressure moves nothing. Shifts a little past the first opening (down) or
// yield (up).
template <class Limit>
void OffsetDescent<Limit>::shift_all() {
  const double upper = limit_.upper();
  enum { gaps, least, least_room };
  const auto found = over_nodes<1, 2>(nodes(), [n = view(), upper](std::size_t k, double* v) {
    double bound = upper;
    if constexpr (Limit::hardens) bound = n.limit.yields_at(k);
    v[gaps] = n.gap[k];
    v[least] = n.pressure[k];
    v[least_room] = bound - n.pressure[k];
  });
  const double lack = offset_ - found[gaps] / static_cast<double>(nodes()),
               further = level_.short_wave_stiffness * lack;
  const double by = lack > 0 ? found[least_room] + further : further - found[least];
  if (!std::isfinite(by)) return;
  for_nodes(nodes(), [p = f_.pressure.data(), by](std::size_t k) { p[k] += by; });
}

template <class Limit>
bool OffsetDescent<Limit>::descend(int steps) {
  const int enough = careful_ ? careful_steps : dear_ ? quick_steps_if_dear : steps > 0 ? quick_steps : 1;
  double target = offset_, first = 0;
  if (all_free())
    target = over_nodes<1>(nodes(), [g = f_.gap.data()](std::size_t k, double* v) { v[0] = g[k]; })[0] /
             static_cast<double>(nodes());
  bool any = steps > 0;
  while (steps < enough) {
    if (careful_ && level_.report) level_.report(residual_);  // lets the user stop
    const double rz = turn(target);
    if (!(rz > 0)) break;
    if (first == 0) first = rz;
    if (careful_ && rz < careful_gain * careful_gain * first) break;
    const double beta = have_direction_ && direction_rz_ > 0 ? rz / direction_rz_ : 0.0;
    for_nodes(nodes(), [n = view(), beta, z = work_.data(), d = direction_.data()](std::size_t k) {
      const double old = beta != 0 ? beta * d[k] : 0.0;
      d[k] = n.moves(k) ? z[k] + old : 0.0;
    });
    level_.apply(direction_, f_.image);
    const auto sums = over_nodes<2>(nodes(), [n = view(), target, d = direction_.data(),
                                              image = f_.image.data()](std::size_t k, double* v) {
      const double bent = image[k] + (n.free[k] == yielding ? n.limit.yielding_slope() * d[k] : 0.0);
      v[0] = d[k] * bent;
      v[1] = d[k] != 0 ? d[k] * (target - n.total_gap(k)) : 0.0;
    });
    if (!(sums[0] > 0)) {
      have_direction_ = false;
      break;
    }
    const double length = sums[1] / sums[0];
    for_nodes(nodes(), [n = view(), length, d = direction_.data(), image = f_.image.data()](std::size_t k) {
      n.pressure[k] += length * d[k];
      n.gap[k] += length * image[k];
    });
    direction_rz_ = rz;
    have_direction_ = true;
    any = true;
    ++steps;
    if (level_.applications > most_) break;
  }
  if (all_free()) {
    const auto apart = over_nodes<0, 1>(
        nodes(), [g = f_.gap.data(), target](std::size_t k, double* v) { v[0] = -std::abs(g[k] - target); });
    if (-apart[0] < 0.5 * std::abs(offset_ - target)) {
      shift_all();
      have_direction_ = false;
      any = true;
    }
  }
  return any;
}

// In the energy ½ p·Kp − (h + δ)·p with yield.
template <class Limit>
typename OffsetDescent<Limit>::Change OffsetDescent<Limit>::change_since() const {
  const auto sums = over_nodes<2>(nodes(), [n = view(), offset = offset_, p0 = f_.old_pressure.data(),
                                            g0 = f_.old_gap.data()](std::size_t k, double* v) {
    const double step = n.pressure[k] - p0[k];
    const double before = n.limit.opening(k, p0[k]), after = n.limit.opening(k, n.pressure[k]);
    const double slope = step * (g0[k] - offset + before);
    const double bend = 0.5 * step * (n.gap[k] - g0[k]);
    double yields = 0;
    if constexpr (Limit::hardens)
      yields = n.limit.compliance > 0
                   ? 0.5 * (after - before) * (after + before) / n.limit.compliance - step * before
                   : 0.0;
    v[0] = slope;
    v[1] = slope + bend + yields;
  });
  return {sums[0], sums[1]};
}

// Lowers the energy: steps on the free set or, out of bounds, a projected part of the steps or of a step
// against the gaps.
template <class Limit>
bool OffsetDescent<Limit>::go_downhill() {
  const double upper = limit_.upper();
  f_.old_pressure = f_.pressure;
  f_.old_gap = f_.gap;
  have_direction_ = false;
  const bool moved = descend(0);
  const auto out = over_nodes<1>(nodes(), [n = view(), upper](std::size_t k, double* v) {
    v[0] = n.pressure[k] < 0 || n.pressure[k] > upper ? 1.0 : 0.0;
  });
  if (moved && out[0] == 0 && change_since().energy < 0) return true;
  const auto step_to = [&](double share) {
    for_nodes(nodes(), [n = view(), upper, share, x = direction_.data(), p0 = f_.old_pressure.data(),
                        s = work_.data()](std::size_t k) {
      const double next = std::clamp(p0[k] + share * x[k], 0.0, upper);
      s[k] = next - p0[k];
      n.pressure[k] = next;
    });
    level_.apply(work_, f_.image);
    for_nodes(nodes(), [n = view(), image = f_.image.data(), g0 = f_.old_gap.data()](std::size_t k) {
      n.gap[k] = g0[k] + image[k];
    });
  };
  if (moved) {
    for_nodes(nodes(), [n = view(), x = direction_.data(), p0 = f_.old_pressure.data()](std::size_t k) {
      x[k] = n.pressure[k] - p0[k];
    });
    for (double share = 1; share > 0.05; share *= 0.25) {
      step_to(share);
      if (change_since().enough()) return true;
    }
  }
  for_nodes(nodes(),
            [n = view(), offset = offset_, upper, x = direction_.data(), stiff = level_.short_wave_stiffness,
             p0 = f_.old_pressure.data(), g0 = f_.old_gap.data()](std::size_t k) {
              const double against = -stiff * (g0[k] - offset + n.limit.opening(k, p0[k]));
              x[k] = std::clamp(p0[k] + against, 0.0, upper) - p0[k];
            });
  double share = 1;
  for (int tries = 0; tries < 4; ++tries) {
    step_to(share);
    const Change change = change_since();
    if (change.enough()) return true;
    if (!(change.slope < 0)) return false;
    const double bend = change.energy - change.slope;
    share *= bend > 0 ? std::min(0.5, -0.5 * change.slope / bend) : 0.5;
  }
  return change_since().energy < 0;
}

template <class Limit>
bool OffsetDescent<Limit>::run(bool gap_known) {
  using namespace descent_rules;
  if (!gap_known) find_gap();
  Watch watch;
  int renewals = 0;
  f_.old_free.assign(nodes(), unmarked);
  for (;;) {
    OffsetQuality at = quality();
    residual_ = at.residual;
    if (level_.report) level_.report(at.residual);
    if (at.residual < tolerance_) {
      if (effort_ == ChainEffort::start || (at.within && (fresh_ || effort_ == ChainEffort::brief))) {
        settle();
        return true;
      }
      if (++renewals > most_renewals) {
        settle();
        return false;
      }
      renew();
      continue;
    }
    watch.take(at.residual);
    const int most_without_gain = careful_ ? careful_passes_without_gain : passes_without_gain;
    if (watch.without_gain() > most_without_gain || level_.applications > most_ ||
        !std::isfinite(at.residual)) {
      settle();
      return false;
    }
    const Watch::Advice advice = careful_ ? Watch::Advice::go_on : watch.advice();
    if (advice == Watch::Advice::remember_pass) f_.remember_pass();
    if (advice == Watch::Advice::average_passes) {
      f_.average_passes();
      have_direction_ = false;
      at = quality();
    }
    set_ = mark_nodes(limit_, offset_, offset_, 0, f_.pressure, f_.gap, f_.old_free, f_.free);
    if (set_.changed) preconditioner_.set_free(f_.free);
    if (!at.within || set_.changed) have_direction_ = false;
    fresh_ = false;
    if (careful_) {
      if (!go_downhill()) {
        settle();
        return false;
      }
      std::swap(f_.free, f_.old_free);
      continue;
    }
    if (!at.within) settle_step();
    if (!descend(at.within ? 0 : 1)) {
      settle();
      return false;
    }
    std::swap(f_.free, f_.old_free);
  }
}

bool offset_descent(ContactLevel& level, DescentFields& fields, double offset, double tolerance, int most,
                    ChainEffort effort, bool careful, bool gap_known) {
  return std::visit(
      [&](const auto& limit) {
        return OffsetDescent<std::remove_cvref_t<decltype(limit)>>(level, limit, fields, offset, tolerance,
                                                                   most, effort, careful)
            .run(gap_known);
      },
      level.limit);
}

}  // namespace

DescentEnd run_offset_chain(ContactLevel& level, DescentFields& fields, double offset, double tolerance,
                            ChainEffort effort, bool gap_known) {
  constexpr int quick = 150, careful = 80, less_careful = 34;
  DescentEnd end;
  end.stage = "preconditioned descent at a given approach";
  end.converged = offset_descent(level, fields, offset, tolerance, quick, effort, false, gap_known);
  if (end.converged || effort == ChainEffort::start) return end;
  // On long cells load searches are quicker.
  if (effort == ChainEffort::brief && keeps_line_loads(level.shape.aspect)) return end;
  end.stage = "preconditioned descent at a given approach, downhill";
  end.converged = offset_descent(level, fields, offset, tolerance,
                                 effort == ChainEffort::less ? less_careful : careful, effort, true, false);
  return end;
}

}  // namespace asperity
