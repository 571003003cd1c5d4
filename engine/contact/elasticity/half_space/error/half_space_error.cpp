// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/error/half_space_error.hpp"

#include <array>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/core/constants.hpp"

namespace asperity {

namespace {

// Error of a sum or transform; roundings partly cancel.
constexpr double relative_rounding = 8 * std::numeric_limits<double>::epsilon();

// Greatest a with a² <= linear·a + rest.
double greatest_root(double linear, double rest) {
  return 0.5 * (linear + std::sqrt(linear * linear + 4 * rest));
}

// 0 · ∞ = 0.
double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

// Error of a slope from difference quotients of a convex function exact to `slack`, steps at most `room`: min
// over t of curvature·t/2 + slack/t.
double slope_slack(double curvature, double slack, double room) {
  if (!(room > 0)) return infinity;
  if (!(slack > 0)) return 0;
  const double best = curvature > 0 ? std::sqrt(2 * slack / curvature) : infinity;
  if (best <= room) return std::sqrt(2 * slack * curvature);
  return curvature > 0 ? 0.5 * curvature * room + slack / room : slack / room;
}

// Cell units, greatest pressure 1. Sums over nodes.
class Bounds {
 public:
  Bounds(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, const Reported& reported)
      : problem_(problem),
        at_(answer),
        reported_(reported),
        nodes_(problem.grid.nodes()),
        n_(static_cast<double>(nodes_)),
        facing_(static_cast<double>(known_count(problem.heights->values()))),
        with_mean_(reported.prescribed == Prescribed::approach && uniform_compliance(problem) > 0),
        periodic_(problem.boundary == Boundary::periodic && !with_mean_),
        compression_(with_mean_ ? 0 : uniform_compliance(problem) * answer.mean_pressure),
        approach_(answer.approach - compression_),
        energy_(reported.energy - 0.5 * compression_ * answer.mean_pressure * problem.grid.area()),
        pascal_(answer.peak_pressure),
        metre_(pascal_ / problem.modulus * problem.grid.hx()),
        joule_(pascal_ * problem.grid.cell_area() * metre_),
        give_(problem.yield.hardens() ? pascal_ / problem.yield.hardening / metre_ : 0),
        cap_(problem.yield.caps() ? problem.yield.cap / pascal_ : infinity),
        compliance_(problem.grid.nx, problem.grid.ny, problem.grid.hy() / problem.grid.hx(), problem.boundary,
                    1, false, multiplier_of(problem, with_mean_)),
        spectrum_(compliance_.spectrum()) {}

  SolutionError find() {
    take_pressures();
    take_gaps();
    take_residual();
    if (reported_.prescribed == Prescribed::approach)
      follow_asked_approach();
    else
      bracket_approach();
    near_gap_ = product(std::sqrt(spectrum_.node), distance_) + approach_error_ + gap_rounding_;
    near_pressure_ = product(std::sqrt(spectrum_.inverse_node), distance_) +
                     (periodic_ ? load_error_ / n_ : 0) + moved_most_ + relative_rounding;
    return result();
  }

 private:
  bool faces(std::size_t k) const { return problem_.faces(k); }
  double pressure(std::size_t k) const { return pressure_[k]; }
  double limit(std::size_t k) const {
    return problem_.yield.hardens() ? problem_.yield.yields_at(k) / pascal_ : cap_;
  }
  double opening(std::size_t k) const {
    return give_ > 0 ? give_ * std::max(0.0, pressure(k) - limit(k)) : 0.0;
  }
  double yielding_gap(std::size_t k) const { return gap_[k] + opening(k); }

  void take_pressures();
  void take_gaps();
  void take_residual();
  void bracket_approach();
  void follow_asked_approach();
  double norm_by_image();
  double step_norm();     // ‖work_‖_K
  double inverse_norm();  // ‖work_‖_{K⁻¹}
  std::array<double, 9> states();
  SolutionError result();

  const HalfSpaceProblem& problem_;
  const HalfSpaceAnswer& at_;
  const Reported& reported_;
  std::size_t nodes_;
  double n_, facing_;  // all nodes, those with a counterpart
  bool with_mean_;     // K(0) of a layer enters
  bool periodic_;      // the mean pressure moves nothing
  // Uniform compression of a layer, m; approach [m] and energy [J] without it.
  double compression_, approach_, energy_;
  double pascal_, metre_, joule_;  // SI values of the units
  double give_, cap_;              // 1/K_h, H
  HalfSpaceCompliance compliance_;
  HalfSpaceCompliance::Spectrum spectrum_;

  Array<double> pressure_;             // at exactly the prescribed load
  double moved_ = 0, moved_most_ = 0;  // change of pressure_: sum, greatest
  Array<double> gap_, work_, image_;   // Kp − h − δ
  double total_ = 0;                   // Σ p
  double norm_ = 0;                    // ‖p‖_K
  double gap_rounding_ = 0;
  double residual_ = 0, rest_ = 0;  // ‖r‖_{K⁻¹}, Σ p s⁺ + Σ (H − p) s⁻
  double mean_residual_ = 0;        // of r

  double distance_ = 0;                             // bounds ‖d‖_K
  double slack_ = 0;                                // bounds E(p) − E(p*)
  double approach_error_ = 0, load_error_ = 0;      // |δ − δ*|, |Σ d|
  double near_gap_ = infinity, near_pressure_ = 0;  // at any node
};

// Distributes the missing load over nodes with room.
void Bounds::take_pressures() {
  pressure_ = Array<double>(nodes_);
  const auto room = [cap = cap_](double p) {
    return std::isfinite(cap) ? std::max(0.0, std::min(p, cap - p)) : p;
  };
  const auto sums = over_nodes<2>(nodes_, [&](std::size_t k, double* v) {
    const double p = pressure_[k] = at_.pressure[k] / pascal_;
    v[0] = p;
    v[1] = room(p);
  });
  const double missing = at_.mean_pressure / pascal_ * n_ - sums[0];
  total_ = sums[0];
  if (missing == 0 || std::abs(missing) > sums[1]) return;
  const double share = missing / sums[1];
  const auto moved = over_nodes<2, 1>(nodes_, [&](std::size_t k, double* v) {
    const double by = share * room(pressure_[k]);
    v[0] = pressure_[k] = pressure_[k] + by;
    v[1] = std::abs(by);
    v[2] = -std::abs(by);
  });
  total_ = moved[0];
  moved_ = moved[1];
  moved_most_ = -moved[2];
}

// Heights count from the highest node.
void Bounds::take_gaps() {
  work_ = Array<double>(nodes_);
  gap_ = Array<double>(nodes_);
  compliance_.apply(pressure_, gap_);
  const double middle = periodic_ ? total_ / n_ : 0;
  const auto sums = over_nodes<2, 1>(nodes_, [&](std::size_t k, double* v) {
    v[0] = (pressure_[k] - middle) * gap_[k];
    v[1] = pressure_[k] * pressure_[k];
    v[2] = -std::abs(gap_[k]);
  });
  norm_ = std::sqrt(std::max(0.0, sums[0]));
  const double from_pressures = std::sqrt(spectrum_.greatest * spectrum_.node * sums[1] / n_);
  gap_rounding_ = relative_rounding * (-sums[2] + approach_ / metre_ + from_pressures);
  const Field& h = *problem_.heights;
  const double peak = known_range(h.values()).max;
  for_nodes(nodes_, [&](std::size_t k) {
    gap_[k] = faces(k) ? gap_[k] + ((peak - h[k]) - approach_) / metre_ : at_.gap[k] / metre_;
  });
  // Rounding and the remaining load error add to the distance.
  const double miss =
      std::abs(total_ / n_ * pascal_ - at_.mean_pressure) / std::max(at_.mean_pressure, 1e-300);
  distance_ = relative_rounding * std::sqrt(spectrum_.node * sums[1]) + miss * norm_;
}

void Bounds::take_residual() {
  const double own = spectrum_.inverse_node > 0 ? 1 / spectrum_.inverse_node : infinity;
  image_ = Array<double>(nodes_);
  // `rest_`: gaps that a node's own pressure cannot close.
  const auto sums = over_nodes<4, 1>(nodes_, [&](std::size_t k, double* v) {
    const double p = pressure(k), gap = yielding_gap(k), room = cap_ - p;
    const double most = gap > 0 ? p : room, wrong = std::abs(gap);
    const double part = most > 0 ? std::min(wrong, own * most) : 0.0;
    work_[k] = gap > 0 ? part : -part;
    v[0] = work_[k];
    v[1] = wrong > part && most > 0 ? (wrong - part) * most : 0.0;
    v[2] = gap > 0 ? p * gap : (std::isfinite(cap_) ? room * wrong : -p * wrong);
    v[3] = part > 0 ? 1.0 : 0.0;
    v[4] = gap;
  });
  rest_ = sums[1];
  mean_residual_ = periodic_ ? sums[0] / n_ : 0;
  for_nodes(nodes_, [&](std::size_t k) { work_[k] -= mean_residual_; });
  residual_ = inverse_norm();
  residual_ += std::sqrt(spectrum_.inverse_node * sums[3]) * gap_rounding_;

  const double base = distance_;
  distance_ = base + greatest_root(residual_, rest_);
  slack_ = 0.5 * residual_ * residual_ + rest_;
  if (reported_.prescribed != Prescribed::approach) {
    // The duality gap needs no inverse and no small residual at every node.
    const double duality =
        (std::isfinite(cap_) ? sums[2] : sums[2] - sums[4] * total_) + 2 * gap_rounding_ * total_;
    if (duality >= 0 && duality < slack_) slack_ = duality;
    if (duality >= 0) distance_ = std::min(distance_, base + std::sqrt(duality));
  }
  slack_ += base * (base + distance_);
}

double Bounds::norm_by_image() {
  const double squares =
      over_nodes<1>(nodes_, [&](std::size_t k, double* v) { v[0] = work_[k] * image_[k]; })[0];
  return std::sqrt(std::max(0.0, squares));
}

double Bounds::step_norm() {
  compliance_.apply(work_, image_);
  return norm_by_image();
}

double Bounds::inverse_norm() {
  compliance_.apply_inverse(work_, image_);
  return spectrum_.least > 0 ? norm_by_image() : infinity;
}

// δ*, slope of the least energy over Σ p, is between difference quotients of energies known to `slack_`.
void Bounds::bracket_approach() {
  double above = infinity, below = infinity;  // distance of δ*
  const double own = spectrum_.node;
  // Direction: one node alone.
  const auto single = over_nodes<1, 4>(nodes_, [&](std::size_t k, double* v) {
    const double p = pressure(k), bound = limit(k), gap = yielding_gap(k);
    const double room = bound - p;
    double up = slope_slack(own, slack_, room);
    if (give_ > 0) up = std::min(up, slope_slack(own + give_, slack_, infinity));
    v[0] = p > 0 && room <= 0 ? 1.0 : 0.0;
    v[1] = gap + up;
    v[2] = slope_slack(own + (p > bound ? give_ : 0), slack_, p) - gap;
    v[3] = p > 0 ? room / p : infinity;
    v[4] = p;
  });
  above = single[1];
  below = single[2];
  const auto along = [&](double slope, double norm_squared, double room_up, double room_down) {
    above = std::min(above, slope + slope_slack(norm_squared, slack_, room_up));
    below = std::min(below, slope_slack(norm_squared, slack_, room_down) - slope);
  };
  // Direction: all pressures in proportion; yielding nodes give way.
  const bool at_limit = single[0] > 0;
  if (!at_limit || give_ > 0) {
    const auto sums = over_nodes<3>(nodes_, [&](std::size_t k, double* v) {
      const double p = pressure(k);
      v[0] = p * yielding_gap(k);
      v[1] = p > limit(k) ? p * p : 0.0;
      v[2] = p * p;
    });
    const double slope = sums[0] / total_, elastic = norm_ * norm_, unit = total_ * total_;
    const auto with_give = [&](double squares) { return (elastic + give_ * squares) / unit; };
    along(slope, with_give(sums[1]), 0, total_);
    if (give_ > 0) along(slope, with_give(sums[2]), infinity, 0);
    if (!at_limit) along(slope, elastic / unit, single[3] * total_, 0);
  }
  // Direction: nodes below their limit and not open, weighted by their room.
  if (at_limit) {
    const auto room = over_nodes<2>(nodes_, [&](std::size_t k, double* v) {
      const double p = pressure(k);
      v[0] = work_[k] = std::max(0.0, std::min(p, limit(k) - p));
      v[1] = v[0] * gap_[k];
    });
    if (room[0] > 0) {
      const double norm = step_norm() / room[0];
      along(room[1] / room[0], norm * norm, room[0], room[0]);
    }
  }
  // Direction: a uniform pressure.
  if (periodic_ && !at_limit && at_.contacts == static_cast<std::int64_t>(nodes_)) {
    const double slope = block_sum(gap_) / n_;
    const auto least = over_nodes<0, 2>(nodes_, [&](std::size_t k, double* v) {
      v[0] = pressure(k);
      v[1] = limit(k) - pressure(k);
    });
    along(slope, 0, least[1] * n_, least[0] * n_);
  }
  approach_error_ = std::max({above, below, 0.0}) + gap_rounding_;
}

// Load at the requested approach: Σ d <= σ ‖d‖_K if nothing touches outside a set between both solutions.
// Sufficient: no gap changes by more than the least gap outside.
void Bounds::follow_asked_approach() {
  const double shift = (approach_ - reported_.asked_approach) / metre_;
  approach_error_ = std::abs(shift);
  const double pull = std::abs(mean_residual_ + shift) + gap_rounding_;
  const double moved = std::max(std::abs(mean_residual_), std::abs(shift));
  const double own = std::sqrt(spectrum_.node), start = distance_;
  double margin = 2 * (own * start + moved + gap_rounding_);
  constexpr int most_tries = 12;
  for (int turn = 0; turn < most_tries; ++turn) {
    const auto inside = [&](std::size_t k) {
      return faces(k) && gap_[k] <= margin && !(std::isfinite(cap_) && gap_[k] < -margin);
    };
    const double count =
        over_nodes<1>(nodes_, [&](std::size_t k, double* v) { v[0] = inside(k) ? 1.0 : 0.0; })[0];
    if (periodic_ && count == n_) break;
    const double outside = periodic_ ? -count / (n_ - count) : 0;
    for_nodes(nodes_, [&](std::size_t k) { work_[k] = inside(k) ? 1.0 : outside; });
    const double sigma = inverse_norm();
    const double farthest =
        (start - greatest_root(residual_, rest_)) + greatest_root(residual_ + pull * sigma, rest_);
    const double needed = own * farthest + moved + gap_rounding_;
    if (needed < margin) {
      distance_ = farthest;
      load_error_ = sigma * farthest + std::abs(total_ - at_.mean_pressure / pascal_ * n_);
      return;
    }
    margin = 1.5 * needed;
    if (!std::isfinite(margin)) break;
  }
  distance_ = load_error_ = infinity;
}

// Over certain and possible states of nodes.
std::array<double, 9> Bounds::states() {
  const bool caps = std::isfinite(cap_), hardens = give_ > 0;
  return over_nodes<9>(nodes_, [&](std::size_t k, double* v) {
    if (!faces(k)) {
      std::fill_n(v, 9, 0.0);
      return;
    }
    const double p = pressure(k), gap = gap_[k], bound = limit(k);
    const double unsure = near_gap_ + relative_rounding * std::abs(gap);
    const bool touches = p > near_pressure_ || (gap < -unsure && (caps || hardens));
    const bool open = gap > unsure;
    const bool yields = (gap < -unsure && (caps || hardens)) || (hardens && p - bound > near_pressure_);
    const bool elastic = open || p < bound - near_pressure_;
    const bool in_contact = p > 0;
    v[0] = touches && !open ? 1.0 : 0.0;
    v[1] = open && !touches ? 0.0 : 1.0;
    v[2] = (in_contact && touches && !open) || (!in_contact && open && !touches) ? 0.0 : 1.0;
    v[3] = yields && !elastic ? 1.0 : 0.0;
    v[4] = elastic && !yields && !(p > bound) ? 0.0 : 1.0;
    v[5] = std::max(0.0, -gap);
    v[6] = gap < -unsure ? 1.0 : 0.0;
    v[7] = std::abs(gap) <= unsure ? unsure : 0.0;
    v[8] = std::max(0.0, gap);
  });
}

SolutionError Bounds::result() {
  const bool caps = std::isfinite(cap_), hardens = give_ > 0;
  const std::array<double, 9> counts = states();
  const auto whole = [](double count) { return static_cast<std::int64_t>(count); };
  SolutionError error;
  error.contacts = {whole(counts[0]), whole(counts[1])};
  error.may_differ = whole(counts[2]);

  error.approach = approach_error_ * metre_ + relative_rounding * at_.approach;
  error.energy = joule_ * distance_ * (norm_ + 0.5 * distance_) +
                 std::abs(energy_ - 0.5 * joule_ * norm_ * norm_) + relative_rounding * reported_.energy;
  const double least_peak = caps && counts[3] > 0 ? cap_ : std::max(0.0, 1 - near_pressure_);
  const double greatest_peak = std::min(cap_, 1 + near_pressure_);
  error.peak_pressure = pascal_ * std::max(1 - least_peak, greatest_peak - 1);

  // Σ w: surely negative gaps change together, others individually.
  double openings = counts[5];  // error of Σ g⁻
  if (caps || hardens) {
    error.yielded = {whole(counts[3]), whole(counts[4])};
    openings = counts[7] + product(counts[6], approach_error_ + gap_rounding_);
    if (counts[6] > 0) {
      for_nodes(nodes_, [&](std::size_t k) {
        work_[k] = gap_[k] < -(near_gap_ + relative_rounding * std::abs(gap_[k])) ? 1.0 : 0.0;
      });
      openings += step_norm() * distance_;
    }
    const double volume = metre_ * problem_.grid.cell_area();
    const double apart = std::abs(reported_.plastic_volume / volume - counts[5]);
    double plastic = openings + apart;
    // Hardening makes the energy convex in w: Σ (Δw)²/give is bounded.
    if (hardens && reported_.prescribed != Prescribed::approach) {
      const double convex = std::sqrt(counts[4] * give_ * (0.25 * residual_ * residual_ + rest_)) +
                            give_ * (moved_ + relative_rounding * n_);
      plastic = std::min(plastic, convex);
      openings = std::min(openings, convex + apart);
    }
    error.plastic_volume = plastic * volume + relative_rounding * reported_.plastic_volume;
  }
  // mean(g⁺) = mean(g) + mean(g⁻); the longest wave bounds mean K d.
  const double sunk = periodic_ ? 0 : std::sqrt(spectrum_.greatest / facing_) * distance_;
  const double reported = reported_.mean_gap / metre_;
  const double gap_error =
      approach_error_ + sunk + openings / facing_ + std::abs(counts[8] / facing_ - reported);
  error.mean_gap = gap_error * metre_ + relative_rounding * (reported_.mean_gap + approach_);

  const double load = at_.mean_pressure * problem_.grid.area();
  if (reported_.prescribed == Prescribed::load) error.load = relative_rounding * load;
  if (reported_.prescribed == Prescribed::approach)
    error.load = load_error_ * pascal_ * problem_.grid.cell_area() + relative_rounding * load;
  return error;
}

}  // namespace

SolutionError half_space_error(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer,
                               const Reported& reported) {
  // First touch is exact.
  if (!(answer.peak_pressure > 0)) return SolutionError{.load = 0.0};
  return Bounds(problem, answer, reported).find();
}

}  // namespace asperity
