// SPDX-License-Identifier: GPL-3.0-or-later
// Inexact Newton method (Dembo, Eisenstat and Steihaug, SIAM J. Numer. Anal. 19, 1982) by secants. Near full
// contact of a periodic tile the load is well-posed: the deepest gap falls as a power above one of the
// missing load, but below one of the missing approach. With nearly constant contact area pressures and gaps
// are linear in the load: the search follows the line through two answers.
#include "engine/contact/elasticity/half_space/solver/load_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

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
        applications_(answer_.iterations),
        long_cells_(keeps_line_loads(problem.grid.hy() / problem.grid.hx())) {
    now_.best_effort = true;
    now_.tolerance = std::max(problem.tolerance, start_tolerance);
  }

  HalfSpaceAnswer run();

 private:
  static constexpr int most_applications = 6000;
  // Applications before the other way; its budget as a multiple; last budget.
  static constexpr int many_applications = 300, share_of_the_other_way = 3, last_applications = 2000;
  static constexpr int most_doubts = 4;
  static constexpr double near_if_easy = 2;  // as near_start, after an easy solve
  static constexpr int few_applications = 40;
  static constexpr double next_error = 2e-3;  // next tolerance per present error
  // Smaller steps relative to the error: a false bracket.
  static constexpr double least_step = 0.01;
  // Below the requested tolerance for a rough measure.
  static constexpr double tighter = 0.1, tightest_of_all = 1e-3;
  static constexpr double same_contact = 0.1;
  static constexpr double furthest_along = 3;  // in steps between the answers
  static constexpr double enough_gain = 0.5;   // ratio of errors after a step

  struct Measured {
    double pressure = 0, found = 0, certificate = infinity;
    std::int64_t contacts = 0, yielded = 0;
  };

  // Below complete contact, extrapolated to complete contact.
  struct ShortOfAll {
    BracketedSecant::Point last{}, before{};
    void take(BracketedSecant::Point found) {
      if (found.at <= last.at) return;
      before = std::exchange(last, found);
    }
    std::optional<double> go_on(double wanted, double tried) const {
      constexpr double less = 0.9;
      if (!(before.at > 0) || !(last.value > before.value)) return {};
      const double step = (wanted - last.value) * (last.at - before.at) / (last.value - before.value);
      return step < less * (tried - last.at) ? std::optional(last.at + step) : std::nullopt;
    }
  };

  struct Told {
    BracketedSecant::Point point;
    bool certainly;
  };

  double first_load();
  void solve(double pressure);
  HalfSpaceAnswer beginning(double pressure);
  std::optional<double> along_the_line() const;
  double error_of(double found) const { return std::abs(found / sought_.wanted - 1); }
  bool tells(double error, double residual) const { return error > gap_per_residual * unit_ * residual; }
  double floor() const {
    return std::max(least_tolerance, tightest_of_all * problem_.tolerance / std::max(1.0, unit_));
  }
  void set_unit();
  void doubt(BracketedSecant::Point found);
  bool go_the_other_way(int most);
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
  HalfSpaceAnswer answer_, before_;
  Measured last_, previous_;
  ShortOfAll short_of_all_;
  std::vector<Told> told_;
  int applications_;
  const bool long_cells_;
  bool easy_ = false, hard_ = false;  // few applications; last resort
  // The next measure replaces a rough one.
  bool rough_ = false, in_place_ = false;
  bool went_the_other_way_ = false;
};

double LoadSearch::first_load() {
  // A stalled descent gives the order of the load.
  double pressure = std::max(answer_.mean_pressure, small_load(problem_, sought_.length));
  for (const auto& met : {sought_.met.below, sought_.met.above})
    if (met && met->at < end_.at) {
      root_.take(*met, true);
      told_.push_back({*met, met->certainly});
    }
  if (sought_.met.below || sought_.met.above) pressure = root_.next().value_or(pressure);
  return pressure < end_.at ? pressure : 0.5 * end_.at;
}

void LoadSearch::set_unit() {
  if (!sought_.on_the_line || !(problem_.rms > 0)) return;
  unit_ =
      (answer_.approach < light_approach * problem_.rms ? answer_.approach : problem_.rms) / sought_.length;
}

// After a solve on the wrong side: bracket from the certain points.
void LoadSearch::doubt(BracketedSecant::Point found) {
  root_ = bracket_;
  for (const Told& before : told_) root_.take(before.point, before.certainly);
  root_.take(found, false);
}

// Moved out of the last two answers.
HalfSpaceAnswer LoadSearch::beginning(double pressure) {
  in_place_ = false;
  if (!sought_.on_the_line) return std::move(answer_);
  const double apart = answer_.mean_pressure - before_.mean_pressure;
  const double steps = (pressure - answer_.mean_pressure) / apart;
  const bool line = before_.pressure.size() == answer_.pressure.size() && apart != 0;
  if (!line || !(std::abs(steps) <= furthest_along)) {
    in_place_ = line && rough_;
    if (in_place_) return std::move(answer_);
    before_ = answer_;
    return std::move(answer_);
  }
  in_place_ = rough_;
  HalfSpaceAnswer& target = in_place_ ? answer_ : before_;
  for_nodes(
      answer_.pressure.size(),
      [steps, p = answer_.pressure.data(), g = answer_.gap.data(), p0 = before_.pressure.data(),
       g0 = before_.gap.data(), to_p = target.pressure.data(), to_g = target.gap.data()](std::size_t k) {
        to_p[k] = p[k] == p0[k] ? p[k] : p[k] + steps * (p[k] - p0[k]);
        to_g[k] = g[k] + steps * (g[k] - g0[k]);
      });
  HalfSpaceAnswer start = std::move(target);
  start.mean_pressure = pressure;
  if (!in_place_) before_ = std::move(answer_);
  return start;
}

void LoadSearch::solve(double pressure) {
  const double ratio = pressure / answer_.mean_pressure;
  const double near = easy_ ? near_if_easy : near_start;
  const bool warm = answer_.certificate.worst() < good_start && ratio > 1 / (1 + near) && ratio < 1 + near &&
                    !answer_.pressure.empty();
  HalfSpaceAnswer start;
  if (warm) {
    start = beginning(pressure);
  } else {
    before_ = {};
    in_place_ = rough_;
  }
  // On long cells brief solves often fail and repeat the descent.
  const bool loose = sought_.on_the_line && now_.tolerance > problem_.tolerance && !long_cells_;
  const bool tight = now_.tolerance < problem_.tolerance;
  now_.brief = (warm && easy_) || ((loose || tight) && !hard_);
  answer_ = solve_at_pressure(now_, pressure, warm ? &start : nullptr, monitor_);
  applications_ += answer_.iterations;
  // The start may have failed. Unconverged answers are enough if the side is clear.
  set_unit();
  const auto will_do = [&] {
    const double residual = answer_.certificate.worst();
    return (tight && residual <= problem_.tolerance) ||
           (loose && tells(error_of(sought_.measure(answer_)), residual));
  };
  if (now_.brief && !answer_.converged && !will_do()) {
    now_.brief = false;
    hard_ = loose;
    answer_ = solve_at_pressure(now_, pressure, nullptr, monitor_);
    applications_ += answer_.iterations;
  }
  easy_ = answer_.converged && answer_.iterations <= few_applications;
  if (!in_place_) previous_ = last_;
  last_ = {pressure, sought_.measure(answer_), answer_.certificate.worst(), answer_.contacts,
           answer_.yielded};
}

// Empty for different contact areas.
std::optional<double> LoadSearch::along_the_line() const {
  const auto alike = [](std::int64_t a, std::int64_t b) {
    return static_cast<double>(std::abs(a - b)) <= same_contact * static_cast<double>(std::max(a, b));
  };
  if (!sought_.on_the_line) return {};
  if (!(previous_.pressure > 0) || !alike(last_.contacts, previous_.contacts) ||
      !alike(last_.yielded, previous_.yielded)) {
    const auto nodes = static_cast<std::int64_t>(problem_.grid.nodes());
    if (end_.at != sought_.above.at || !(end_.value < infinity) || !alike(last_.contacts, nodes) ||
        !(last_.found < sought_.wanted))
      return {};
    return last_.pressure +
           (sought_.wanted - last_.found) * (end_.at - last_.pressure) / (end_.value - last_.found);
  }
  const double rough = sought_.wanted * unit_ * (last_.certificate + previous_.certificate);
  if (!(std::abs(last_.found - previous_.found) > gap_per_residual * rough)) return {};
  std::optional<double> share = (sought_.wanted - previous_.found) / (last_.found - previous_.found);
  if (before_.mean_pressure == previous_.pressure) share = sought_.on_the_line(answer_, before_);
  if (!share || !(std::abs(*share - 1) <= furthest_along)) return {};
  return previous_.pressure + *share * (last_.pressure - previous_.pressure);
}

HalfSpaceAnswer LoadSearch::ended(double error, bool converged) {
  answer_.iterations = applications_;
  answer_.certificate.load = std::max(answer_.certificate.load, error);
  answer_.converged = converged;
  if (converged) answer_.solver += ", load sought";
  return std::move(answer_);
}

// Success: `answer_` is the result; otherwise the next start.
bool LoadSearch::go_the_other_way(int most) {
  before_ = {};
  answer_ = sought_.other_way(std::move(answer_), most);
  applications_ += answer_.iterations;
  answer_.iterations = applications_;
  return answer_.converged;
}

HalfSpaceAnswer LoadSearch::run() {
  double pressure = first_load(), error = infinity, error_before = infinity;
  int doubts = 0;
  bool by_line = false;
  for (int solve_count = 0; solve_count < most_solves && pressure > 0 && std::isfinite(pressure);
       ++solve_count) {
    solve(pressure);
    const double found = last_.found;
    error_before = std::exchange(error, error_of(found));
    const bool near_enough = error <= 0.5 * problem_.tolerance;
    if (near_enough && answer_.certificate.worst() <= problem_.tolerance) return ended(error, true);
    const bool tightest = now_.tolerance <= least_, no_tighter = least_ <= floor();
    if (applications_ > most_applications || (near_enough && tightest)) break;
    if (sought_.other_way && !went_the_other_way_ && applications_ > many_applications) {
      went_the_other_way_ = true;
      if (go_the_other_way(share_of_the_other_way * applications_)) return std::move(answer_);
    }
    const double residual = std::max(answer_.certificate.worst(), tightest ? 0.0 : now_.tolerance);
    const bool told = tells(error, residual);
    rough_ = !told;
    const bool kept = !sought_.on_the_line || no_tighter;
    const bool sure = told || (tightest && kept && answer_.converged);
    if (tightest && !told && !near_enough && !kept) least_ = std::max(floor(), tighter * least_);
    const bool nothing_more = nearly_all(found, sought_.wanted, sought_.most);
    root_.take({pressure, nothing_more ? infinity : found}, sure || nothing_more, in_place_);
    const double solved_to = now_.tolerance;
    now_.tolerance = std::clamp(next_error * error / unit_, least_, now_.tolerance);
    if (near_enough) continue;
    // On long cells wrong steps are expensive: repeat until the side is clear.
    if (long_cells_ && !sought_.on_the_line && !told && !tightest && now_.tolerance < solved_to) continue;
    const bool line_fails = by_line && error > enough_gain * error_before;
    std::optional<double> next;
    if (nothing_more)
      next = short_of_all_.go_on(sought_.wanted, pressure);
    else if (!line_fails)
      next = along_the_line();
    if (next && !root_.holds(*next)) next = {};
    by_line = next.has_value();
    if (!nothing_more && sure && found < sought_.wanted) short_of_all_.take({pressure, found});
    if (!next) next = root_.next();
    const double room = std::min(pressure, end_.at - pressure);
    if (!next || std::abs(*next - pressure) < least_step * std::min(error, 1.0) * room) {
      if (++doubts > most_doubts || (tightest && kept && !next)) break;
      if (tightest && !kept) least_ = std::max(floor(), tighter * least_);
      now_.tolerance = std::max(least_, much_tighter * now_.tolerance);
      if (doubts > 1) told_.clear();  // certain points were false
      doubt({pressure, found});
    } else if (!in_place_) {
      told_.push_back({{pressure, nothing_more ? infinity : found},
                       error > LoadsMet::certain * gap_per_residual * unit_ * residual});
    }
    pressure = next.value_or(pressure);
  }
  if (sought_.other_way) {
    if (go_the_other_way(last_applications)) return std::move(answer_);
    error = error_of(sought_.measure(answer_));
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
