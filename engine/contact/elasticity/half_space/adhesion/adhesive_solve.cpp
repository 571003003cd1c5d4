// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/adhesion/adhesive_solve.hpp"

#include <numbers>
#include <numeric>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr int most_steps = 4000;
constexpr int most_passes = 400;          // per tangent
constexpr int most_applications = 20000;  // of K

// Cell units: lengths in cells, pressures in E*.
class AdhesiveDescent {
 public:
  // Prescribed pressure [Pa] or approach [m]; the other is 0.
  AdhesiveDescent(const AdhesiveProblem& problem, double asked_pressure, double asked_approach,
                  Monitor& monitor)
      : problem_(problem),
        grid_(problem.contact.grid),
        nodes_(grid_.nodes()),
        length_(grid_.hx()),
        modulus_(problem.contact.modulus),
        compliance_(grid_.nx, grid_.ny, grid_.hy() / grid_.hx(), problem.contact.boundary),
        preconditioner_(grid_.nx, grid_.ny, grid_.hy() / grid_.hx(), problem.contact.boundary),
        drop_(nodes_),
        p_(nodes_),
        q_(nodes_),
        g_(nodes_),
        direction_(nodes_),
        image_(nodes_),
        z_(nodes_),
        r_(nodes_),
        before_(nodes_),
        free_(nodes_),
        task_(monitor, problem.attraction.front().effect, 1000) {
    const auto h = problem.contact.heights->values();
    const double peak = known_range(h).max;
    for_nodes(nodes_, [&](std::size_t k) { drop_[k] = (peak - h[k]) / length_; });
    double longest = 0;
    for (const GapTerm& term : problem.attraction) {
      greatest_ += term.greatest() / modulus_;
      shortest_ = std::min(shortest_, term.range / length_);
      longest = std::max(longest, term.range / length_);
    }
    if (!problem.contact.overhangs) return;
    // Contact and attraction are exactly zero without a counterpart: e^−800 is 0.
    constexpr double faded = 800;
    const double pressed = std::abs(asked_pressure) + greatest_ * modulus_;
    deep_ = known_range(drop_).max + std::abs(asked_approach) / length_ + faded * longest +
            out_of_reach(problem.contact, pressed) / length_;
    for (double& drop : drop_)
      if (std::isnan(drop)) drop = deep_;
  }

  void begin_from(const AdhesiveAnswer& start) {
    for_nodes(nodes_, [&](std::size_t k) {
      p_[k] = start.contact.pressure[k] / modulus_;
      q_[k] = start.attraction[k] / modulus_;
    });
  }

  // Without attraction a pull would separate the bodies at once.
  void begin_touching() {
    for_nodes(nodes_, [&](std::size_t k) { q_[k] = traction(drop_[k]); });
  }

  // Iterates until fixed attraction and attraction of the gap agree to `tolerance`.
  void run(double tolerance);

  double approach = 0;         // δ, cells
  std::optional<double> load;  // prescribed mean p − mean q, E*
  bool separates = false;

  AdhesiveAnswer answer() const;
  double mean(const Array<double>& values) const {
    return over_nodes<1>(nodes_, [&](std::size_t k, double* v) { v[0] = values[k]; })[0] /
           static_cast<double>(nodes_);
  }

 private:
  double traction(double g) const {
    double sum = 0;
    for (const GapTerm& term : problem_.attraction) sum += term.traction(std::max(0.0, g) * length_);
    return sum / modulus_;
  }
  void apply(const Array<double>& p, Array<double>& u) {
    stop_flag().check();
    compliance_.apply(p, u);
    ++applications_;
  }
  void find_gap() {
    for_nodes(nodes_, [&](std::size_t k) { image_[k] = p_[k] - q_[k]; });
    apply(image_, g_);
    for_nodes(nodes_, [&](std::size_t k) { g_[k] += drop_[k] - approach; });
  }
  void scale_to(double target) {
    const double now = mean(p_);
    if (now > 0)
      for_nodes(nodes_, [&](std::size_t k) { p_[k] *= target / now; });
    else
      for_nodes(nodes_, [&](std::size_t k) { p_[k] = drop_[k] < deep_ ? target : 0.0; });
  }
  double contact(double close, double target);
  void balance_contact_gaps();
  double precondition(bool fixed, double contacts);
  void step_back(double step, std::optional<double> target);

  CostScope scope_;
  Cost first_contact_;
  const AdhesiveProblem& problem_;
  Grid grid_;
  std::size_t nodes_;
  double length_, modulus_;
  double deep_ = std::numeric_limits<double>::infinity();  // of nodes without a counterpart
  double greatest_ = 0, shortest_ = std::numeric_limits<double>::infinity();
  HalfSpaceCompliance compliance_;
  ContactPreconditioner preconditioner_;
  Array<double> drop_, p_, q_, g_, direction_, image_, z_, r_, before_;
  Array<std::uint8_t> free_;
  Task task_;
  int applications_ = 0, steps_ = 0;
  double off_ = std::numeric_limits<double>::infinity(), touch_ = 0;
};

void AdhesiveDescent::balance_contact_gaps() {
  const auto sums = over_nodes<2>(nodes_, [&](std::size_t k, double* v) {
    v[0] = p_[k] > 0 ? g_[k] : 0.0;
    v[1] = p_[k] > 0 ? 1.0 : 0.0;
  });
  const double shift = sums[0] / sums[1];
  approach += shift;
  for_nodes(nodes_, [&](std::size_t k) { g_[k] -= shift; });
}

// z from the residual r; returns r·z.
double AdhesiveDescent::precondition(bool fixed, double contacts) {
  const std::uint8_t* const free = free_.data();
  preconditioner_.apply(r_, z_);
  const auto sums = over_nodes<2>(nodes_, [&](std::size_t k, double* v) {
    v[0] = free[k] ? z_[k] : 0.0;
    v[1] = r_[k];
  });
  // The preconditioner ignores constants; the longest wave approximates them.
  const double level = fixed ? -sums[0] / contacts
                             : std::numbers::pi / std::max<double>(grid_.nx, grid_.ny) / contacts * sums[1];
  return over_nodes<1>(nodes_, [&](std::size_t k, double* v) {
    z_[k] = free[k] ? z_[k] + level : 0.0;
    v[0] = r_[k] * z_[k];
  })[0];
}

// Halves a step out of bounds until the energy falls. `target`: mean pressure under a load.
void AdhesiveDescent::step_back(double step, std::optional<double> target) {
  for_nodes(nodes_, [&](std::size_t k) {
    before_[k] = p_[k];
    r_[k] = g_[k];
  });
  for (int half = 0; half < 30; ++half, step *= 0.5) {
    for_nodes(nodes_, [&](std::size_t k) { p_[k] = std::max(0.0, before_[k] + step * direction_[k]); });
    if (target) scale_to(*target);
    find_gap();
    // The energy changes by Σ Δp times the mean of both gaps.
    const double change = over_nodes<1>(
        nodes_, [&](std::size_t k, double* v) { v[0] = (p_[k] - before_[k]) * (g_[k] + r_[k]); })[0];
    if (change <= 0) break;
  }
}

// Contact with fixed attraction: p >= 0, g = K (p − q) + d − δ >= 0, p g = 0, to `close` in the gap. Under a
// load mean p = target and the mean contact gap is 0. Projected conjugate gradients (Polonsky & Keer 1999),
// restarted when the contact set changes.
double AdhesiveDescent::contact(double close, double target) {
  const bool fixed = load.has_value();
  if (fixed) scale_to(target);
  find_gap();
  bool same = false;
  double old_rz = 0, worst = std::numeric_limits<double>::infinity();
  std::uint8_t* const free = free_.data();
  for (int pass = 0; pass < most_passes && applications_ < most_applications; ++pass) {
    if (fixed) balance_contact_gaps();
    const auto found = over_nodes<3, 1>(nodes_, [&](std::size_t k, double* v) {
      const std::uint8_t in = p_[k] > 0 || g_[k] < 0 ? 1 : 0;
      v[0] = in != free[k] ? 1.0 : 0.0;
      v[1] = in;
      v[2] = in ? g_[k] : 0.0;
      v[3] = in ? -std::abs(g_[k]) : 0.0;
      free[k] = in;
    });
    worst = -found[3];
    if (!std::isfinite(worst))
      refuse_infeasible(
          "the numbers of this contact overflow: load, attraction, range and cells are too far apart",
          "check the units of `work`, `range`, the load and the size");
    if (worst <= close || found[1] == 0) break;
    const double middle = fixed ? found[2] / found[1] : 0.0;
    for_nodes(nodes_, [&](std::size_t k) { r_[k] = free[k] ? middle - g_[k] : 0.0; });
    if (found[0] > 0 || pass == 0) {
      same = false;
      preconditioner_.set_free(free_);
    }
    const double rz = precondition(fixed, found[1]);
    const double keep = same && old_rz > 0 ? rz / old_rz : 0.0;
    old_rz = rz;
    for_nodes(nodes_, [&](std::size_t k) { direction_[k] = free[k] ? z_[k] + keep * direction_[k] : 0.0; });
    apply(direction_, image_);
    const auto slope = over_nodes<2>(nodes_, [&](std::size_t k, double* v) {
      v[0] = r_[k] * direction_[k];
      v[1] = direction_[k] * image_[k];
    });
    if (!(slope[1] > 0) || !(slope[0] > 0)) {
      if (!same) break;
      same = false;
      old_rz = 0;
      continue;
    }
    const double step = slope[0] / slope[1];
    const double clipped = over_nodes<1>(
        nodes_, [&](std::size_t k, double* v) { v[0] = p_[k] + step * direction_[k] < 0 ? 1.0 : 0.0; })[0];
    same = clipped == 0;
    if (same) {
      for_nodes(nodes_, [&](std::size_t k) {
        p_[k] += step * direction_[k];
        g_[k] += step * image_[k];
      });
      continue;
    }
    step_back(step, fixed ? std::optional(target) : std::nullopt);
  }
  return worst;
}

void AdhesiveDescent::run(double tolerance) {
  // The certificate measures gaps by the rms height, attraction by its range.
  const double rms = problem_.contact.rms / length_;
  const double tightest = 0.5 * tolerance * (rms > 0 ? std::min(shortest_, rms) : shortest_);
  double loose = 0.1 * shortest_;
  int since = 0;
  bool fresh = false;
  Array<double> last(nodes_);
  for (steps_ = 1; steps_ <= most_steps && applications_ < most_applications; ++steps_) {
    task_.advance();
    double target = 0;
    if (load) {
      target = *load + mean(q_);
      if (!(target > 0)) {
        separates = true;
        return;
      }
    }
    touch_ = contact(std::max(tightest, loose), target);
    if (steps_ == 1) first_contact_ = scope_.so_far();
    const auto change = over_nodes<3, 1>(nodes_, [&](std::size_t k, double* v) {
      const double held = traction(g_[k]), by = held - q_[k], old = last[k];
      v[0] = by * by;
      v[1] = by * old;
      v[2] = old * old;
      v[3] = -std::abs(by);
      last[k] = by;
      z_[k] = held;
    });
    off_ = greatest_ > 0 ? -change[3] / greatest_ : 0.0;
    const double rate = change[2] > 0 ? change[1] / change[2] : 0.0;
    if (off_ <= tolerance && touch_ <= tightest) {
      if (fresh) return;
      fresh = true;  // repeat with freshly computed gaps
      loose = 0;
      continue;
    }
    fresh = false;
    loose = std::min(0.1, 0.2 * off_) * shortest_;
    // Geometric convergence: extrapolate.
    const bool alike = change[1] > 0.95 * std::sqrt(change[0] * change[2]);
    if (++since > 2 && alike && rate > 0.3 && rate < 0.98 && off_ < 0.3) {
      const double further = 0.9 * rate / (1 - 0.9 * rate);
      for_nodes(nodes_,
                [&](std::size_t k) { q_[k] = std::clamp(z_[k] + further * last[k], 0.0, greatest_); });
      since = 0;
    } else {
      std::swap(q_, z_);
    }
  }
  --steps_;
}

AdhesiveAnswer AdhesiveDescent::answer() const {
  AdhesiveAnswer result;
  HalfSpaceAnswer& at = result.contact;
  at.pressure = Field(grid_.nx, grid_.ny);
  at.gap = Field(grid_.nx, grid_.ny);
  result.attraction = Field(grid_.nx, grid_.ny);
  for (std::size_t k = 0; k < nodes_; ++k) {
    at.pressure[k] = p_[k] * modulus_;
    at.gap[k] = g_[k] * length_;
    result.attraction[k] = q_[k] * modulus_;
  }
  at.approach = approach * length_;
  at.offset = at.approach - known_range(problem_.contact.heights->values()).max;
  result.mean_attraction = mean(q_) * modulus_;
  at.mean_pressure = mean(p_) * modulus_ - result.mean_attraction;
  at.contacts = std::count_if(p_.begin(), p_.end(), [](double p) { return p > 0; });
  at.peak_pressure = range(at.pressure.values()).max;
  at.iterations = applications_;
  at.solver = "tangents of the attraction";
  result.stationarity = off_;
  result.steps = steps_;
  result.first_contact = first_contact_;
  const std::vector<GapTerm>& terms = problem_.attraction;
  for (const GapTerm& term : terms)
    result.shares.push_back(over_nodes<1>(nodes_, [&](std::size_t k, double* v) {
      v[0] = term.traction(std::max(0.0, at.gap[k])) / modulus_;
    })[0]);
  const double all = std::accumulate(result.shares.begin(), result.shares.end(), 0.0);
  for (double& share : result.shares) share = all > 0 ? share / all : 1 / static_cast<double>(terms.size());
  return result;
}

// Throws if the certificate is above the tolerance.
void finish(const AdhesiveProblem& problem, AdhesiveAnswer& answer, std::optional<double> asked) {
  HalfSpaceAnswer& at = answer.contact;
  double shortest = std::numeric_limits<double>::infinity();
  for (const GapTerm& term : problem.attraction) shortest = std::min(shortest, term.range);
  const double length = problem.contact.rms > 0 ? problem.contact.rms : shortest;
  const auto found = over_nodes<2, 1>(at.pressure.size(), [&](std::size_t k, double* v) {
    v[0] = at.pressure[k];
    v[1] = at.pressure[k] * std::abs(at.gap[k]);
    v[2] = at.gap[k];
  });
  Certificate& certificate = at.certificate;
  certificate.penetration = std::max(0.0, -found[2]) / length;
  if (found[0] > 0) certificate.complementarity = found[1] / found[0] / length;
  certificate.attraction = answer.stationarity;
  if (asked) {
    const double scale = std::max(std::abs(*asked), answer.mean_attraction);
    certificate.load = scale > 0 ? std::abs(at.mean_pressure - *asked) / scale : 0.0;
    at.mean_pressure = *asked;
  }
  at.converged = certificate.worst() <= problem.contact.tolerance;
  if (at.converged || problem.contact.best_effort) return;
  throw Error(ErrorCode::not_converged,
              "the attraction and the gap agree to " + format_short(certificate.worst(), 3) + " after " +
                  std::to_string(answer.steps) + " tangents, above the `tolerance` of " +
                  format_short(problem.contact.tolerance, 3),
              "give a larger `tolerance`, or press farther from the jump of the contact");
}

}  // namespace

AdhesiveAnswer adhere_at_approach(const AdhesiveProblem& problem, double approach,
                                  const AdhesiveAnswer* start, Monitor& monitor) {
  require(std::isfinite(approach), "approach", approach, "m", "give a finite length");
  const HalfSpaceProblem& contact = problem.contact;
  if (contact.boundary == Boundary::periodic) {
    const auto h = contact.heights->values();
    const double most = range(h).max - mean(h);
    if (approach >= most)
      refuse_infeasible("an approach of " + format_quantity(approach, dimension::length) +
                            " cannot be reached: this periodic tile is in full contact at " +
                            format_quantity(most, dimension::length),
                        "give a smaller `approach`, or press by `pressure`");
  }
  AdhesiveDescent descent(problem, 0, approach, monitor);
  if (start != nullptr) descent.begin_from(*start);
  descent.approach = approach / contact.grid.hx();
  descent.run(contact.tolerance);
  AdhesiveAnswer answer = descent.answer();
  finish(problem, answer, {});
  return answer;
}

AdhesiveAnswer adhere_at_pressure(const AdhesiveProblem& problem, double mean_pressure,
                                  const AdhesiveAnswer* start, Monitor& monitor) {
  if (!std::isfinite(mean_pressure))
    refuse("the mean pressure is " + format_short(mean_pressure) + " Pa", "give a finite pressure");
  AdhesiveDescent descent(problem, mean_pressure, 0, monitor);
  if (start != nullptr)
    descent.begin_from(*start);
  else
    descent.begin_touching();
  descent.load = mean_pressure / problem.contact.modulus;
  descent.run(problem.contact.tolerance);
  if (descent.separates)
    refuse_infeasible("the bodies separate under a mean pressure of " +
                          format_quantity(mean_pressure, dimension::pressure) +
                          ": past the pull-off no contact carries the pull",
                      "pull by less, or prescribe the `approach`");
  AdhesiveAnswer answer = descent.answer();
  finish(problem, answer, mean_pressure);
  return answer;
}

}  // namespace asperity
