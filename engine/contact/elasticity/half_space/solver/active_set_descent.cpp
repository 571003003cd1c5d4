// SPDX-License-Identifier: GPL-3.0-or-later
// The quick stage: preconditioned conjugate gradients on the current free set. Pressures may leave their
// bounds until the next pass settles (clips) them. Settling shares one application of K with a fixed
// preconditioned (Richardson) step and, on long cells, preserves line loads (load_projection.hpp).
// Two-cycles are broken by averaging two passes. No proof of convergence; stops without gain.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/half_space/solver/free_set.hpp"

namespace asperity {

namespace {
using namespace descent_rules;

// Applications of K in a settling pass; fewer if K is expensive or with hardening, where one stalled three
// times as many random scenes (6 of 20 000). Other passes take one: more cost up to two thirds more.
constexpr int steps_a_pass = 3, steps_of_dear_pass = 2;
// From this tolerance up directions are single: half the memory traffic, mirrored contacts equal to 1e-9.
constexpr double single_enough = 5e-9;
constexpr std::size_t worth_side = 256, worth_rounding = worth_side * worth_side;  // fewer nodes save no time
// Relative error of the gaps per pass (1.3e-6 in a whole solve on 2048²). Settling can recompute gaps at no
// cost.
constexpr double rounding_of_steps = 2e-6, rounding_share = 0.1;  // of the tolerance
constexpr double load_slack = 1e-6;                               // relative, left to a later pass

// Row of a direction: stored M r, beta times the previous direction, smooth field; load not balanced.
template <class Stored>
struct Along {
  const Stored *values, *before;
  double beta;
  SmoothRow<double> smooth;

  template <class Value>
  void read(std::size_t k, Value& to) const {
    Value old, low, high;
    lane_terms::read(values + k, to);
    lane_terms::read(before + k, old);
    lane_terms::read(smooth.low + k, low);
    lane_terms::read(smooth.high + k, high);
    to += beta * old + (smooth.low_share * low + smooth.high_share * high);
  }
};

// Two directions and pending steps, taken by the next loop over the fields to save a pass over memory.
// Rounding them is harmless: pressures and gaps use rounded values.
template <class Stored>
class DescentDirections {
 public:
  // Takes the oldest pending step and reuses its memory.
  Stored* next(std::span<double> pressure);
  Stored* last() { return now_.data(); }
  Along<Stored> row(int j, int nx, double beta, SmoothRow<double> smooth) const {
    const auto begin = static_cast<std::ptrdiff_t>(j) * nx;
    smooth.low -= begin;
    smooth.high -= begin;
    return {now_.data(), beta != 0 ? before_.data() : now_.data(), beta, smooth};
  }

  // `image` must persist until the gaps take the step.
  void go(double length, const double* image) {
    step_.along[0].length = step_.gap_length = length;
    step_.image = image;
  }
  // The direction and its image may contain NaN; `finite` replaces the image.
  void drop_last(std::span<const double> finite) {
    step_.along[0] = {0, step_.along[1].direction};
    step_.image = finite.data();
  }

  PressureStep<Stored> hand_over() { return std::exchange(step_, {}); }
  ContactPreconditioner::Step hand_over_gaps(std::span<double> gap) {
    const double length = std::exchange(step_.gap_length, 0);
    return length != 0 ? ContactPreconditioner::Step{gap.data(), length, step_.image}
                       : ContactPreconditioner::Step{};
  }
  void take(std::span<double> pressure, std::span<double> gap);

 private:
  UnsetArray<Stored> now_, before_;
  PressureStep<Stored> step_{};
};

template <class Stored>
Stored* DescentDirections<Stored>::next(std::span<double> pressure) {
  using Step = typename PressureStep<Stored>::Along;
  Step &latest = step_.along[0], &oldest = step_.along[1];
  if (oldest.length != 0)
    for_lanes(pressure.size(), [oldest, p = pressure.data()]<class Value>(std::size_t k) {
      Value value, change;
      lane_terms::read(p + k, value);
      lane_terms::read(oldest.direction + k, change);
      value += oldest.length * change;
      lane_terms::put(value, p + k);
    });
  before_.resize(pressure.size());
  std::swap(now_, before_);
  oldest = latest.length != 0 ? latest : Step{0, now_.data()};
  latest = {0, now_.data()};
  return now_.data();
}

template <class Stored>
void DescentDirections<Stored>::take(std::span<double> pressure, std::span<double> gap) {
  const PressureStep<Stored> step = hand_over();
  if (step.none()) return;
  for_lanes(pressure.size(), [step, p = pressure.data(), g = gap.data()]<class Value>(std::size_t k) {
    Value at, apart;
    step.take(k, p, g, at, apart);
  });
}

template <class Limit, class Stored>
class Descent {
 public:
  Descent(ContactLevel& level, const Limit& limit, DescentFields& fields, double tolerance, int most,
          bool exact)
      : level_(level),
        limit_(limit),
        f_(fields),
        preconditioner_(level, limit),
        tolerance_(tolerance),
        most_(level.applications + most),
        exact_(exact),
        dear_(Limit::hardens || level.shape.boundary == Boundary::free),
        keeps_line_loads_(keeps_line_loads(level.shape.aspect)),
        rounds_(level.shape.single ||
                (std::is_same_v<Stored, float> && level.shape.nodes() >= worth_rounding)),
        steps_a_pass_(dear_ ? steps_of_dear_pass : steps_a_pass),
        no_field_(Limit::hardens ? static_cast<std::size_t>(level.shape.nx) : 0) {}

  bool run();

 private:
  std::size_t nodes() const { return f_.pressure.size(); }
  DescentNodes<Limit> view() const {
    return {f_.pressure.data(), f_.gap.data(), f_.free.data(), limit_, balance_};
  }

  ContactQuality quality();
  void project(const ContactQuality& at, std::span<double> target);
  std::optional<double> shift_to_load(const ContactQuality& at) const;
  void renew(const ContactQuality& at) {
    project(at, f_.pressure);
    level_.gap(f_.pressure, f_.gap);
    fresh_ = true;
    drift_ = 0;
    balance_ = std::numeric_limits<double>::quiet_NaN();
  }
  double turn();
  Along<Stored> along(int j) const;
  void settle_step(const ContactQuality& at, bool afresh);
  double yield_settled();
  bool descend(int steps);

  ContactLevel& level_;
  const Limit& limit_;
  DescentFields& f_;
  SetPreconditioner<Limit> preconditioner_;
  double tolerance_;
  int most_;
  const bool exact_, dear_, keeps_line_loads_;
  const bool rounds_;  // images are in single precision
  const int steps_a_pass_;
  FreeSet set_;
  DescentDirections<Stored> directions_;
  double mean_gap_ = 0;  // of the balancing nodes
  double surplus_ = 0;   // load of the direction per balancing node
  double balance_ = std::numeric_limits<double>::quiet_NaN();
  double beta_ = 0;
  double drift_ = 0;  // bounds the rounding of gaps, as a residual
  bool fresh_ = false;
  bool have_direction_ = false;
  double direction_rz_ = 0;
  Array<double> work_, no_field_;  // with hardening
};

template <class Limit, class Stored>
ContactQuality Descent<Limit, Stored>::quality() {
  return contact_quality(level_, f_.pressure, f_.gap, directions_.hand_over(), balance_);
}

// target = settled pressures, with the elastic interior shifted to the load. Without enough interior, all
// nodes move by their gaps.
template <class Limit, class Stored>
void Descent<Limit, Stored>::project(const ContactQuality& at, std::span<double> target) {
  const double upper = limit_.upper();
  const bool any_interior = at.interior > 0;
  if (keeps_line_loads_) work_.assign(f_.pressure.begin(), f_.pressure.end());
  for_nodes(nodes(), [n = view(), to = target.data(), any_interior](std::size_t k) {
    const double q = n.settled(k);
    n.free[k] = n.shifts(k, q, any_interior) ? 1 : 0;
    to[k] = q;
  });
  if (keeps_line_loads_) keep_line_loads(level_.shape, work_, f_.free, upper, target);
  if (project_to_load(target, f_.free, upper, level_.total_load(), target)) return;
  const double elastic_stiffness = level_.short_wave_stiffness;
  const double yielding_stiffness = elastic_stiffness / (1 + elastic_stiffness * limit_.yielding_slope());
  for_nodes(nodes(), [=, n = view(), to = target.data(), middle = at.interior_gap](std::size_t k) {
    const double q = to[k], opening = n.limit.opening(k, q), apart = n.gap[k] + opening - middle;
    to[k] = q - (opening > 0 ? yielding_stiffness : elastic_stiffness) * apart;
  });
  project_to_load(target, {}, upper, level_.total_load(), target);
}

// First of two Newton steps of project().
double first_shift(const ContactQuality& at, double load) {
  return at.interior > 0 ? (load - at.load) / at.interior : 0.0;
}

// By two Newton steps; empty if the first leaves 1 % of the load or more.
template <class Limit, class Stored>
std::optional<double> Descent<Limit, Stored>::shift_to_load(const ContactQuality& at) const {
  if (keeps_line_loads_) return {};
  const double load = level_.total_load(), found = set_.shifted_load;
  if (at.interior == 0 || !(std::abs(found - load) < 0.01 * load) || set_.shifted_count == 0) return {};
  return first_shift(at, load) - (found - load) / set_.shifted_count;
}

// Direction from M r, r = mean gap − gap on the free nodes. Returns r·M r.
template <class Limit, class Stored>
double Descent<Limit, Stored>::turn() {
  const double shrink = 1 / level_.pressure_unit();
  Stored* const direction = directions_.next(f_.pressure);
  // r has no load: r·M r needs no balance.
  double rz = 0, load = 0;
  if constexpr (Limit::hardens) {
    work_.resize(nodes());
    for_nodes(nodes(), [n = view(), to = work_.data(), mean = mean_gap_](std::size_t k) {
      const double all = mean - n.total_gap(k);
      to[k] = n.moves(k) ? all : 0.0;
    });
    preconditioner_.apply(f_.free, work_);
    const auto sums = over_nodes<2>(nodes(), [n = view(), z = work_.data(), d = direction, shrink,
                                              mean = mean_gap_](std::size_t k, double* v) {
      const double all = z[k] * (mean - n.total_gap(k)), along = z[k] * shrink;
      d[k] = static_cast<Stored>(along);
      v[0] = n.moves(k) ? all : 0.0;
      v[1] = n.moves(k) ? along : 0.0;
    });
    rz = sums[0];
    load = sums[1];
  } else {
    rz = level_.preconditioner.spread({f_.gap.data(), -1, mean_gap_}, directions_.hand_over_gaps(f_.gap));
    Array<std::array<double, 1>> parts(level_.preconditioner.tiles());
    const auto put = [&](std::size_t tile, std::size_t first, std::size_t n, const float* values,
                         double factor) {
      if (!values) {
        std::fill_n(direction + first, n, Stored{});
        return;
      }
      const auto part = over_lanes_of_stretch<1>(
          first, first + n,
          [z = values - first, d = direction, times = factor * shrink]<class Value>(std::size_t k, Value* v) {
            Value value;
            lane_terms::read(z + k, value);
            value *= times;
            lane_terms::put(value, d + k);
            v[0] = value;  // 0 off the free set
          });
      parts[tile][0] += part[0];
    };
    std::fill(parts.begin(), parts.end(), std::array<double, 1>{});
    level_.preconditioner.gather(put);
    load = added_up(parts)[0] + level_.preconditioner.smooth_sum() * shrink;
  }
  rz *= shrink;
  beta_ = have_direction_ && direction_rz_ > 0 ? rz / direction_rz_ : 0.0;
  surplus_ = load / set_.balancing_count();
  direction_rz_ = rz;
  return rz;
}

template <class Limit, class Stored>
Along<Stored> Descent<Limit, Stored>::along(int j) const {
  SmoothRow<double> smooth{no_field_.data(), no_field_.data(), 0, 0};
  if constexpr (!Limit::hardens) smooth = level_.preconditioner.smooth(j, 1 / level_.pressure_unit());
  return directions_.row(j, level_.shape.nx, beta_, smooth);
}

// Settled nodes yield from now on. Returns the balancing gaps' sum.
template <class Limit, class Stored>
double Descent<Limit, Stored>::yield_settled() {
  for (std::uint8_t& kind : f_.free)
    if (kind == settling) kind = yielding;
  set_.yielding_count += set_.settling_count;
  set_.settling_count = 0;
  preconditioner_.set_free(f_.free);
  return over_nodes<1>(nodes(), [n = view(), now = set_.balancing()](std::size_t k, double* v) {
    const double gap = n.total_gap(k);
    v[0] = n.free[k] == now ? gap : 0.0;
  })[0];
}

// One application for settling and, if K is expensive, a fixed step; updates the gaps or recomputes them in
// double.
template <class Limit, class Stored>
void Descent<Limit, Stored>::settle_step(const ContactQuality& at, bool afresh) {
  const std::optional<double> shift = shift_to_load(at);
  if (!shift) {                       // the last image is free memory
    std::swap(f_.free, f_.old_free);  // project() overwrites the marks
    project(at, f_.image);
    std::swap(f_.free, f_.old_free);
  }
  if (dear_) turn();
  const auto nx = static_cast<std::size_t>(level_.shape.nx);
  const double unit = level_.pressure_unit(), shrink = 1 / unit, immobile = level_.immobile_pressure();
  const auto advance = [=, n = view(), balancing = set_.balancing(), surplus = surplus_](
                           std::size_t k, double along, double target) {
    const double p = n.pressure[k], z = along - (n.free[k] == balancing ? surplus : 0.0);
    const double descent = richardson_step * unit * z, next = target + (n.moves(k) ? descent : 0.0);
    n.pressure[k] = next;  // unmoved: exactly at the bound
    return (next - (afresh ? immobile : p)) * shrink;
  };
  const auto move = [&](int j, double* to, const auto& target) {
    const std::size_t begin = static_cast<std::size_t>(j) * nx;
    if (dear_)
      for_stretch(begin, begin + nx, [=, along = along(j)](std::size_t k) {
        double z;
        along.read(k, z);
        to[k] = advance(k, z, target(k));
      });
    else
      for_stretch(begin, begin + nx, [=, p = f_.pressure.data()](std::size_t k) {
        const double next = target(k);
        to[k] = (next - (afresh ? immobile : p[k])) * shrink;
        p[k] = next;
      });
  };
  const auto source = [&](int j, double* step) -> const double* {
    double* const to = step - static_cast<std::ptrdiff_t>(static_cast<std::size_t>(j) * nx);
    if (shift)
      move(j, to, [n = view(), by = *shift, upper = limit_.upper()](std::size_t k) {
        const double q = n.settled(k), moved = q + by, positive = moved > 0 ? moved : 0.0;
        const double shifted = moved < upper ? positive : upper;
        return n.shifts(k, q, true) ? shifted : q;
      });
    else
      move(j, to, [from = f_.image.data()](std::size_t k) { return from[k]; });
    return step;
  };
  // Nodes yielding after settling do not balance.
  const Freedom balances = set_.balancing();
  Array<std::array<double, 1>> rows(static_cast<std::size_t>(level_.shape.ny));
  const auto sink = [&](int j, const double* image) {
    const std::size_t begin = static_cast<std::size_t>(j) * nx;
    if (afresh) level_.unpressed_gap(begin, nx, f_.gap.data() + begin);
    rows[static_cast<std::size_t>(j)] = take_image(view(), begin, begin + nx, image, unit, balances);
  };
  if (afresh)
    level_.apply_in_double(source, sink, f_.image);  // in place: row j is read before written
  else
    level_.apply(source, sink, rounds_);
  const double gaps = set_.settling_count > 0 ? yield_settled() : added_up(rows)[0];
  mean_gap_ = gaps / set_.balancing_count();
}

// After `steps` steps. False without any step.
template <class Limit, class Stored>
bool Descent<Limit, Stored>::descend(int steps) {
  const auto nx = static_cast<std::size_t>(level_.shape.nx);
  const int enough = steps > 0 || Limit::hardens ? steps_a_pass_ : 1;
  while (steps < enough) {
    if constexpr (Limit::hardens) directions_.take(f_.pressure, f_.gap);
    const double rz = turn();
    have_direction_ = true;
    const Freedom balancing = set_.balancing();
    const auto source = [&](int j, double* row) -> const double* {
      const std::size_t begin = static_cast<std::size_t>(j) * nx;
      for_lanes_of_stretch(begin, begin + nx,
                           [along = along(j), balancing, surplus = surplus_, marks = f_.free.data(),
                            d = directions_.last(), to = row - begin]<class Value>(std::size_t k) {
                             Value value, mark;
                             along.read(k, value);
                             lane_terms::read(marks + k, mark);
                             const Value none = {}, at = none + static_cast<double>(balancing);
                             const Value balanced = mark == at ? value - surplus : value;
                             const Value next = mark > none ? balanced : none;
                             lane_terms::put(next, d + k);
                             lane_terms::read(d + k, value);
                             lane_terms::put(value, to + k);
                           });
      return row;
    };
    Array<ImageSums> rows(static_cast<std::size_t>(level_.shape.ny));
    const auto sink = [&](int j, const double* image) {
      const std::size_t begin = static_cast<std::size_t>(j) * nx;
      rows[static_cast<std::size_t>(j)] = weigh_image(view(), begin, begin + nx, balancing, mean_gap_,
                                                      directions_.last(), image, f_.image.data());
    };
    level_.apply(source, sink, rounds_);
    const auto sums = added_up(rows);
    if (!(sums[0] > 0) || !(rz > 0)) {
      have_direction_ = false;
      directions_.drop_last(f_.gap);
      break;
    }
    // Without hardening r·M r is single precision only.
    const double length = (Limit::hardens ? rz : sums[2]) / sums[0];
    mean_gap_ += length * (sums[1] / set_.balancing_count());
    directions_.go(length, f_.image.data());
    ++steps;
  }
  return steps > 0;
}

template <class Limit, class Stored>
bool Descent<Limit, Stored>::run() {
  level_.gap(f_.pressure, f_.gap);
  fresh_ = true;
  Watch watch;
  int renewals = 0;
  f_.old_free.assign(nodes(), unmarked);
  for (;;) {
    ContactQuality at = quality();
    level_.report_pass(at.residual);
    if (at.residual < tolerance_) {
      const bool loaded = std::abs(at.load - level_.total_load()) < tolerance_ * level_.total_load();
      if (!exact_ || (at.within && fresh_ && loaded)) return true;
      if (++renewals > most_renewals) {  // pressures are worse again each time
        project(at, f_.pressure);
        return false;
      }
      renew(at);
      have_direction_ = false;
      continue;
    }
    watch.take(at.residual);
    if (watch.without_gain() > passes_without_gain || level_.applications > most_ ||
        !std::isfinite(at.residual)) {
      project(at, f_.pressure);
      return false;
    }
    const Watch::Advice advice = watch.advice();
    if (advice == Watch::Advice::remember_pass) f_.remember_pass();
    if (advice == Watch::Advice::average_passes) {
      f_.average_passes();
      have_direction_ = false;
      at = quality();
    }

    set_ = mark_free_set(limit_, at, balance_, first_shift(at, level_.total_load()), f_.pressure, f_.gap,
                         f_.old_free, f_.free);
    if (set_.changed) preconditioner_.set_free(f_.free);
    const bool settles =
        !at.within || std::abs(at.load - level_.total_load()) > load_slack * level_.total_load();
    if (settles || set_.changed) have_direction_ = false;
    fresh_ = false;
    mean_gap_ = set_.count() > 0 ? set_.balancing_gap() / set_.balancing_count() : at.interior_gap;
    const double rounding = rounding_of_steps * at.residual, harmless = rounding_share * tolerance_;
    const bool afresh = settles && drift_ > harmless && (rounding <= harmless || rounding < 0.01 * drift_);
    if (afresh) drift_ = 0;
    if (rounds_) drift_ += rounding;
    if (settles) settle_step(at, afresh);
    if (!descend(settles ? 1 : 0)) {  // free nodes balance to the last bit
      project(at, f_.pressure);
      return false;
    }
    balance_ = mean_gap_;
    std::swap(f_.free, f_.old_free);
  }
}

// Returns whether residual < tolerance; pressures are feasible before and after failure. `exact`: also after
// success, with a fresh gap.
bool active_set_descent(ContactLevel& level, DescentFields& fields, double tolerance, bool exact) {
  const auto run = [&]<class Stored>(const auto& limit, Stored) {
    return Descent<std::remove_cvref_t<decltype(limit)>, Stored>(level, limit, fields, tolerance, quick,
                                                                 exact)
        .run();
  };
  if (const auto* hardening = std::get_if<LinearHardening>(&level.limit)) return run(*hardening, double{});
  const PressureCap& cap = std::get<PressureCap>(level.limit);
  return tolerance >= single_enough ? run(cap, float{}) : run(cap, double{});
}
}  // namespace

DescentEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort) {
  const auto descend = [&] {
    return active_set_descent(level, fields, tolerance, effort != ChainEffort::start);
  };
  const auto shake = [&](int most) {
    Array<double> direction(level.nodes()), image(level.nodes());
    return std::visit(
        [&](const auto& limit) {
          return spectral_gradient(level, limit, fields.pressure, fields.gap, direction, image, tolerance,
                                   most);
        },
        level.limit);
  };
  return run_stages(effort, descend, shake);
}

}  // namespace asperity
