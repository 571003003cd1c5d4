// SPDX-License-Identifier: GPL-3.0-or-later
// Inexact Newton method (Dembo, Eisenstat and Steihaug, SIAM J. Numer. Anal. 19, 1982) by secants. Near full
// contact of a periodic tile the load is well-posed: the deepest gap falls as a power above one of the
// missing load, but below one of the missing approach.
#include "engine/contact/elasticity/half_space/solver/load_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

namespace asperity {

std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  if (!problem.yield.caps() ||
      answer.yielded != static_cast<std::int64_t>(known_count(problem.heights->values())))
    return {};
  const auto least = over_nodes<0, 1>(answer.gap.size(), [&](std::size_t k, double* v) {
    v[0] = problem.faces(k) ? -answer.gap[k] : infinity;
  });
  return answer.approach - least[0];
}

namespace {

// By the exact filter: multiplies the least load by ten until it converges, then bisects to a factor of two.
HalfSpaceAnswer full_under_more(const HalfSpaceProblem& problem, double least, Monitor& monitor) {
  constexpr int tries = 3;
  constexpr double more = 10, near = 2;
  int applications = 0;
  const auto take = [&](double load) {
    HalfSpaceAnswer found = solve_if_full(problem, load, monitor);
    applications += found.iterations;
    return found;
  };
  double short_of_it = least;
  HalfSpaceAnswer full;
  for (int n = 0; n < tries && !full.converged && more * short_of_it < problem.yield.cap; ++n) {
    full = take(more * short_of_it);
    if (!full.converged) short_of_it *= more;
  }
  while (full.converged && full.mean_pressure > near * short_of_it) {
    const double between = std::sqrt(full.mean_pressure * short_of_it);
    if (HalfSpaceAnswer found = take(between); found.converged)
      full = std::move(found);
    else
      short_of_it = between;
  }
  full.iterations = applications;
  if (full.converged) full.solver += ", under more than the least load";
  return full;
}

using namespace search_rules;

BracketedSecant::Point upper_end(const HalfSpaceProblem& problem, const SoughtByLoad& sought) {
  BracketedSecant::Point end = sought.above;
  if (problem.yield.caps()) {
    const double facing = static_cast<double>(known_count(problem.heights->values()));
    const double cap =
        problem.yield.cap * (1 - a_little) * (facing / static_cast<double>(problem.grid.nodes()));
    // Targets below half of the maximum: the upper value misleads the secant.
    constexpr double far = 0.5;
    if (!(end.at < cap)) end = {cap, sought.wanted < far * sought.most ? infinity : sought.most};
  }
  return end;
}

// A tenth of the load of the tile as a punch.
double small_load(const HalfSpaceProblem& problem, double length) {
  return 0.1 * problem.modulus * length / std::max(problem.grid.size_x, problem.grid.size_y);
}

class LoadSearch {
 public:
  LoadSearch(const HalfSpaceProblem& problem, const SoughtByLoad& sought, HalfSpaceAnswer begun,
             Monitor& monitor)
      : problem_(problem),
        sought_(sought),
        monitor_(monitor),
        end_(upper_end(problem, sought)),
        // Relative measure per unit residual.
        unit_(problem.rms > 0 ? std::min(problem.rms / sought.length, 1.0) : 1.0),
        bracket_(sought.wanted, {0, 0}, end_, BracketedSecant::Scale::logarithmic),
        root_(bracket_),
        now_(problem),
        least_(problem.tolerance),
        answer_(std::move(begun)),
        applications_(answer_.iterations) {
    now_.best_effort = true;
    now_.tolerance = std::max(problem.tolerance, start_tolerance);
  }

  HalfSpaceAnswer run();

 private:
  static constexpr int most_applications = 6000;
  static constexpr int most_doubts = 4;
  static constexpr double next_error = 2e-3;  // next tolerance per present error
  // Smaller steps relative to the error: a false bracket.
  static constexpr double least_step = 0.01;
  // Below the requested tolerance for a rough measure.
  static constexpr double tighter = 0.1, tightest_of_all = 1e-3;

  double first_load();
  void solve(double pressure);
  double floor() const {
    return std::max(least_tolerance, tightest_of_all * problem_.tolerance / std::max(1.0, unit_));
  }
  HalfSpaceAnswer ended(double error, bool converged);

  const HalfSpaceProblem& problem_;
  const SoughtByLoad& sought_;
  Monitor& monitor_;
  const BracketedSecant::Point end_;
  double unit_;
  const BracketedSecant bracket_;
  BracketedSecant root_;
  HalfSpaceProblem now_;
  double least_;
  HalfSpaceAnswer answer_;
  int applications_;
};

double LoadSearch::first_load() {
  // A stalled descent gives the order of the load.
  double pressure = std::max(answer_.mean_pressure, small_load(problem_, sought_.length));
  for (const auto& met : {sought_.met.below, sought_.met.above})
    if (met && met->at < end_.at) root_.take(*met, true);
  if (sought_.met.below || sought_.met.above) pressure = root_.next().value_or(pressure);
  return pressure < end_.at ? pressure : 0.5 * end_.at;
}

void LoadSearch::solve(double pressure) {
  const double ratio = pressure / answer_.mean_pressure;
  const bool warm = answer_.certificate.worst() < good_start && ratio > 1 / (1 + near_start) &&
                    ratio < 1 + near_start && !answer_.pressure.empty();
  const HalfSpaceAnswer start = std::move(answer_);
  answer_ = solve_at_pressure(now_, pressure, warm ? &start : nullptr, monitor_);
  applications_ += answer_.iterations;
  if (sought_.of_gaps && problem_.rms > 0)
    unit_ =
        (answer_.approach < light_approach * problem_.rms ? answer_.approach : problem_.rms) / sought_.length;
}

HalfSpaceAnswer LoadSearch::ended(double error, bool converged) {
  answer_.iterations = applications_;
  answer_.certificate.load = std::max(answer_.certificate.load, error);
  answer_.converged = converged;
  if (converged) answer_.solver += ", load sought";
  return std::move(answer_);
}

HalfSpaceAnswer LoadSearch::run() {
  double pressure = first_load(), error = infinity;
  int doubts = 0;
  for (int solve_count = 0; solve_count < most_solves && pressure > 0 && std::isfinite(pressure);
       ++solve_count) {
    solve(pressure);
    const double found = sought_.measure(answer_);
    error = std::abs(found / sought_.wanted - 1);
    const bool near_enough = error <= near_enough_share * problem_.tolerance;
    if (near_enough && answer_.certificate.worst() <= problem_.tolerance) return ended(error, true);
    const bool tightest = now_.tolerance <= least_, no_tighter = least_ <= floor();
    if (applications_ > most_applications || (near_enough && tightest)) break;
    const double residual = std::max(answer_.certificate.worst(), tightest ? 0.0 : now_.tolerance);
    const bool told = error > gap_per_residual * unit_ * residual;
    const bool kept = !sought_.of_gaps || no_tighter;
    const bool sure = told || (tightest && kept && answer_.converged);
    if (tightest && !told && !near_enough && !kept) least_ = std::max(floor(), tighter * least_);
    const bool nothing_more = nearly_all(found, sought_.wanted, sought_.most);
    root_.take({pressure, nothing_more ? infinity : found}, sure || nothing_more);
    now_.tolerance = std::clamp(next_error * error / unit_, least_, std::max(least_, start_tolerance));
    if (near_enough) continue;
    const std::optional<double> next = root_.next();
    const double room = std::min(pressure, end_.at - pressure);
    if (!next || std::abs(*next - pressure) < least_step * std::min(error, 1.0) * room) {
      if (++doubts > most_doubts || (tightest && kept && !next)) break;
      if (tightest && !kept) least_ = std::max(floor(), tighter * least_);
      now_.tolerance = std::max(least_, much_tighter * now_.tolerance);
      root_ = bracket_;
      root_.take({pressure, found}, false);
    }
    pressure = next.value_or(pressure);
  }
  return ended(error, false);
}

}  // namespace

HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor) {
  int applications = 0;
  const auto counted = [&](HalfSpaceAnswer found) {
    applications += found.iterations;
    return found;
  };
  // The certificate multiplies rounding of gaps by hardness / load: more load helps, descents do not.
  HalfSpaceAnswer answer;
  if (problem.yield.caps()) {
    answer = counted(solve_if_full(problem, mean_pressure, monitor));
    const bool rounding_alone = !answer.converged && !answer.pressure.empty();
    if (!answer.converged && !rounding_alone) {
      HalfSpaceProblem brief = problem;
      brief.brief = brief.best_effort = true;
      answer = counted(solve_at_pressure(brief, mean_pressure, nullptr, monitor));
    }
    if (!answer.converged) answer = counted(full_under_more(problem, mean_pressure, monitor));
  }
  if (!answer.converged) answer = counted(solve_at_pressure(problem, mean_pressure, nullptr, monitor));
  answer.iterations = applications;
  answer.certificate.load = std::max(answer.certificate.load, missed);
  return answer;
}

HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what) {
  if (const auto most = most_at_the_cap(problem, answer))
    refuse_infeasible(what + " is not reached: the whole " + (problem.overhangs ? "overlap" : "tile") +
                          " is at its hardness at " + metres(*most),
                      "give less, or press by `pressure`");
  if (answer.converged || problem.best_effort) return answer;
  throw_unconverged(what, answer.certificate, problem.tolerance, answer.iterations, problem.grid,
                    rounding_residual(problem, answer));
}

HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor) {
  return LoadSearch(problem, sought, std::move(begun), monitor).run();
}

}  // namespace asperity
