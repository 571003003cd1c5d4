// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "engine/contact/elasticity/half_space/error/half_space_error.hpp"
#include "engine/contact/elasticity/half_space/half_space_solution.hpp"
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/planned_yield.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// One list for writing and reading, so both agree.
template <class Answer, class Visit>
void numbers_of(Answer& answer, Visit visit) {
  visit("offset", answer.offset);
  visit("mean_pressure", answer.mean_pressure);
  visit("approach", answer.approach);
  visit("contacts", answer.contacts);
  visit("yielded", answer.yielded);
  visit("peak_pressure", answer.peak_pressure);
  visit("penetration", answer.certificate.penetration);
  visit("tension", answer.certificate.tension);
  visit("complementarity", answer.certificate.complementarity);
  visit("load_error", answer.certificate.load);
  visit("cap_excess", answer.certificate.cap);
  visit("attraction_error", answer.certificate.attraction);
  visit("converged", answer.converged);
  visit("iterations", answer.iterations);
}

// Counts are below 2^53.
void write_numbers(const HalfSpaceAnswer& answer, ResultFacts& facts) {
  numbers_of(answer, [&](const char* name, auto value) {
    facts.numbers.emplace_back(name, static_cast<double>(value));
  });
  facts.texts.emplace_back("solver", answer.solver);
}

HalfSpaceAnswer read_answer(FoundResult& found) {
  HalfSpaceAnswer answer;
  numbers_of(answer, [&]<class Number>(const char* name, Number& value) {
    value = static_cast<Number>(found.number(name));
  });
  answer.solver = found.text("solver");
  answer.pressure = found.take("pressure");
  answer.gap = found.take("gap");
  return answer;
}

const ResultForm<HalfSpaceAnswer> half_space_form = {
    "half-space contact",
    [](const HalfSpaceAnswer& answer, ResultFacts& facts, KeptFields& fields) {
      write_numbers(answer, facts);
      fields = {{"pressure", &answer.pressure}, {"gap", &answer.gap}};
    },
    read_answer};

const ResultForm<AdhesiveAnswer> adhesive_form = {
    "half-space contact with attraction",
    [](const AdhesiveAnswer& answer, ResultFacts& facts, KeptFields& fields) {
      write_numbers(answer.contact, facts);
      facts.numbers.emplace_back("mean_attraction", answer.mean_attraction);
      facts.numbers.emplace_back("stationarity", answer.stationarity);
      facts.numbers.emplace_back("steps", answer.steps);
      facts.numbers.emplace_back("shares", static_cast<double>(answer.shares.size()));
      for (std::size_t k = 0; k < answer.shares.size(); ++k)
        facts.numbers.emplace_back("share_" + std::to_string(k + 1), answer.shares[k]);
      facts.numbers.emplace_back("first_contact_seconds", answer.first_contact.seconds);
      facts.numbers.emplace_back("first_contact_transforms", answer.first_contact.transforms);
      facts.numbers.emplace_back("first_contact_bytes", static_cast<double>(answer.first_contact.bytes));
      fields = {{"pressure", &answer.contact.pressure},
                {"gap", &answer.contact.gap},
                {"attraction", &answer.attraction}};
    },
    [](FoundResult& found) {
      AdhesiveAnswer answer;
      answer.contact = read_answer(found);
      answer.attraction = found.take("attraction");
      answer.mean_attraction = found.number("mean_attraction");
      answer.stationarity = found.number("stationarity");
      answer.steps = static_cast<int>(found.number("steps"));
      const auto shares = static_cast<std::size_t>(found.number("shares"));
      for (std::size_t k = 0; k < shares; ++k)
        answer.shares.push_back(found.number("share_" + std::to_string(k + 1)));
      answer.first_contact = {found.number("first_contact_seconds"), found.number("first_contact_transforms"),
                              static_cast<std::int64_t>(found.number("first_contact_bytes"))};
      return answer;
    }};

void add(Digester& digester, const HalfSpaceProblem& problem) {
  const Grid& grid = problem.grid;
  digester.add(grid.nx).add(grid.ny).add(grid.size_x).add(grid.size_y);
  digester.add(static_cast<int>(problem.boundary)).add(problem.modulus);
  digester.add(problem.heights->values()).add(problem.rms);
  const YieldLaw& law = problem.yield;
  digester.add(law.cap).add(law.hardening).add(law.yield ? law.yield->values() : std::span<const double>());
  digester.add(problem.tolerance).add(problem.best_effort).add(problem.single);
  if (const auto& share = problem.share)
    digester.add("share")
        .add(share->length)
        .add(share->uniform)
        .add(std::span<const double>(share->parameters));
}

}  // namespace

Costed<HalfSpaceAnswer> recall_or_solve(const HalfSpaceProblem& problem, std::string_view by, double value,
                                        const HalfSpaceAnswer* start, Monitor& monitor,
                                        const std::function<HalfSpaceAnswer()>& solve) {
  const auto key = [&] {
    Digester digester;
    digester.add(half_space_form.call);
    add(digester, problem);
    if (start != nullptr) digester.add("from").add(start->pressure.values()).add(start->gap.values());
    return digester.add(by).add(value).hex();
  };
  return recall_or(monitor, half_space_form, key, solve);
}

Costed<AdhesiveAnswer> recall_or_adhere(const AdhesiveProblem& problem, std::string_view by, double value,
                                        const AdhesiveAnswer* start, Monitor& monitor,
                                        const std::function<AdhesiveAnswer()>& solve) {
  const auto key = [&] {
    Digester digester;
    digester.add(adhesive_form.call);
    add(digester, problem.contact);
    for (const GapTerm& term : problem.attraction)
      digester.add(term.effect).add(static_cast<int>(term.law)).add(term.work).add(term.range).add(term.edge);
    if (start != nullptr)
      digester.add("from").add(start->contact.pressure.values()).add(start->attraction.values());
    return digester.add(by).add(value).hex();
  };
  return recall_or(monitor, adhesive_form, key, solve);
}

namespace {

double rms_of(std::span<const double> heights) {
  const double middle = mean(heights), n = static_cast<double>(heights.size());
  Array<double> squares(heights.size());
  std::transform(heights.begin(), heights.end(), squares.begin(),
                 [&](double h) { return (h - middle) * (h - middle); });
  const double sum = block_sum(squares), most = range(heights).span();
  // Scale by a power of two if squares underflow.
  constexpr double least = 1e-140;
  if (!(most > 0 && most < least)) return std::sqrt(sum / n);
  const int power = -std::ilogb(most);
  std::transform(heights.begin(), heights.end(), squares.begin(), [&](double h) {
    const double from_middle = std::ldexp(h - middle, power);
    return from_middle * from_middle;
  });
  return std::ldexp(std::sqrt(block_sum(squares) / n), -power);
}

}  // namespace

struct HalfSpaceSolver::Ready {
  std::shared_ptr<const ContactGeometry> geometry;
  HalfSpaceOperator half_space;
  std::optional<PlannedYield> yield;
  MetMemory hardness;  // empty unless past events left hardness fields
  HalfSpaceProblem problem;

  static std::shared_ptr<const Ready> make(const Plan& plan, const HalfSpaceOperator& half_space,
                                           std::shared_ptr<const ContactGeometry> geometry) {
    auto ready = std::make_shared<Ready>();
    ready->geometry = std::move(geometry);
    ready->half_space = half_space;
    ready->yield = plan.yield;
    HalfSpaceProblem& problem = ready->problem;
    problem.grid = ready->geometry->grid();
    problem.boundary = ready->geometry->boundary();
    problem.modulus = half_space.modulus;
    problem.share = half_space.share;
    problem.heights = {ready->geometry, &ready->geometry->combined()};
    problem.overhangs = ready->geometry->overhangs();
    problem.rms =
        problem.overhangs ? rms_of(ready->geometry->facing_heights()) : rms_of(problem.heights->values());
    problem.tolerance = plan.accuracy.tolerance;
    problem.single = plan.accuracy.precision == Accuracy::Precision::single;
    problem.best_effort = plan.accuracy.on_failure == Accuracy::OnFailure::best;
    if (ready->yield && ready->yield->hardens())
      ready->hardness = local_hardness(*ready->geometry, *ready->yield);
    return ready;
  }
};

class HalfSpaceSolver::UnderLoad final : public HalfSpaceSolution {
 public:
  // `problem` has the yield law in force; `factor`: softening by creep.
  UnderLoad(std::shared_ptr<const Ready> ready, HalfSpaceProblem problem, HalfSpaceAnswer answer,
            double factor, const Reported& asked)
      : HalfSpaceSolution(ready->geometry, std::move(problem), std::move(answer),
                          ready->half_space.lower_share),
        ready_(std::move(ready)),
        factor_(factor),
        asked_(asked),
        fits_(ready_->yield && covered(ready_->yield->carried, carried())) {}

  SolutionError error() const override {
    Reported reported = asked_;
    reported.mean_gap = mean_gap();
    reported.energy = energy();
    reported.plastic_volume = plastic_volume();
    return half_space_error(problem_, at_, reported);
  }
  double flatten() const override { return std::max(0.0, flattened(problem_, at_)); }  // rounding
  double energy() const override;
  std::int64_t bytes() const override {
    return static_cast<std::int64_t>((at_.pressure.size() + at_.gap.size()) * sizeof(double));
  }
  std::int64_t yielded() const override { return at_.yielded; }
  double plastic_volume() const override {
    return sum([&](std::size_t k) { return yielded(k); }) * problem_.grid.cell_area();
  }
  std::optional<PlasticChange> plastic_change() const override;

 private:
  const std::optional<PlannedYield>& limit() const override { return ready_->yield; }
  CarriedLoad carried() const { return {at_.mean_pressure, factor_}; }
  // Plastic displacement w, m.
  double yielded(std::size_t k) const {
    if (fits_) return 0;
    const YieldLaw& law = problem_.yield;
    if (law.hardens()) {
      const double most = law.yields_at(k);
      return at_.pressure[k] > most ? (at_.pressure[k] - most) / law.hardening : 0.0;
    }
    return at_.pressure[k] >= law.cap ? std::max(0.0, -at_.gap[k]) : 0.0;
  }

  std::shared_ptr<const Ready> ready_;
  double factor_;
  Reported asked_;
  bool fits_;  // the bodies have carried this load in this position
};

// Half the sum of pressures times displacements. In periodic full contact a large mean pressure can cost the
// pressures their precision: their differences then come from the displacements.
double HalfSpaceSolver::UnderLoad::energy() const {
  Field pressure = at_.pressure;
  double uniform = 0;  // twice the energy of the mean pressure
  if (problem_.boundary == Boundary::periodic && static_cast<double>(at_.contacts) == nodes() &&
      yielded() == 0) {
    const Grid& grid = problem_.grid;
    HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem_.boundary, 1, false,
                                   multiplier_of(problem_));
    compliance.apply_inverse(displacement_field().values(), pressure.values());
    for (double& p : pressure.values()) p *= problem_.modulus / grid.hx();
    uniform = uniform_compliance(problem_) * at_.mean_pressure * load();
  }
  const double twice = sum([&](std::size_t k) { return faces(k) ? pressure[k] * displacement(k) : 0.0; });
  return 0.5 * uniform + std::max(0.0, 0.5 * twice * problem_.grid.cell_area());  // rounding
}

std::optional<PlasticChange> HalfSpaceSolver::UnderLoad::plastic_change() const {
  if (!problem_.yield.limits() || at_.yielded == 0) return {};
  if (fits_) return {};
  PlasticChange change{field([&](std::size_t k) { return yielded(k); }), {}};
  if (range(change.approach.values()).max == 0) return {};
  if (at_.converged) change.carried = carried();
  if (problem_.yield.hardens())
    // At the reference dwell: a repeated press finds the nodes exactly as hard.
    change.hardness = field([&](std::size_t k) { return yielded(k) > 0 ? at_.pressure[k] / factor_ : 0.0; });
  return change;
}

HalfSpaceSolver::HalfSpaceSolver(const Plan& plan, const HalfSpaceOperator& half_space,
                                 std::shared_ptr<const ContactGeometry> geometry)
    : Solver(plan, std::move(geometry)) {
  const CostScope scope;
  ready_ = Ready::make(plan, half_space, geometry_);
  preparation_ = elasticity_alone(scope.so_far());
}

namespace {

// From `start`; again without `start` if this does not converge at once.
HalfSpaceAnswer solve_from(const HalfSpaceAnswer* start, const HalfSpaceProblem& problem,
                           double mean_pressure, Monitor& monitor) {
  if (start == nullptr) return solve_at_pressure(problem, mean_pressure, nullptr, monitor);
  HalfSpaceProblem brief = problem;
  brief.brief = brief.best_effort = true;
  HalfSpaceAnswer answer = solve_at_pressure(brief, mean_pressure, start, monitor);
  if (answer.converged) return answer;
  const int before = answer.iterations;
  answer = solve_at_pressure(problem, mean_pressure, nullptr, monitor);
  answer.iterations += before;
  return answer;
}

// Hardening on long cells converges within some 150 transforms or hardly at all (docs/stability.md). Controls
// other than the load take some three solves.
constexpr double most_under_load = 400, most_of_other_controls = 2000;

bool hardens_on_long_cells(const HalfSpaceProblem& problem) {
  return problem.yield.hardens() && !problem.best_effort &&
         keeps_line_loads(problem.grid.hy() / problem.grid.hx());
}

HalfSpaceAnswer solve_within(double most, const Grid& grid, const std::function<HalfSpaceAnswer()>& solve) {
  try {
    const TransformLimit limit(most);
    return solve();
  } catch (const TransformLimit::Spent&) {
    const double aspect = std::max(grid.hx(), grid.hy()) / std::min(grid.hx(), grid.hy());
    throw Error(ErrorCode::not_converged,
                "`hardening` on cells " + format_short(aspect, 3) +
                    " times longer than wide did not converge in " + format_short(most) + " transforms",
                "give cells nearer to square, or leave `hardening` out");
  }
}

}  // namespace

State HalfSpaceSolver::press(const PressRequest& request, Monitor& monitor) const {
  return pressed(request, nullptr, monitor);
}

State HalfSpaceSolver::press_from(const Solution& guess, const PressRequest& request,
                                  Monitor& monitor) const {
  const bool by_load = request.by == PressBy::pressure || request.by == PressBy::load;
  if (!by_load || geometry().overhangs()) return press(request, monitor);
  HalfSpaceAnswer start;
  start.pressure = guess.pressure_field();
  start.gap = guess.gap_field();
  start.mean_pressure = guess.pressure();
  return pressed(request, &start, monitor);
}

State HalfSpaceSolver::pressed(const PressRequest& request, const HalfSpaceAnswer* start,
                               Monitor& monitor) const {
  check(request);
  const double height = geometry().peak_to_valley();
  check_fraction(request, height);

  const double factor = ready_->yield ? ready_->yield->softened(request.dwell) : 1.0;
  HalfSpaceProblem problem = ready_->problem;
  if (ready_->yield) problem.yield = yield_law(*ready_->yield, ready_->hardness, factor);
  Reported asked;
  std::string_view by = "pressure";
  double value = request.value;
  switch (request.by) {
    case PressBy::pressure:
      break;
    case PressBy::load:
      value /= problem.grid.area();
      break;
    case PressBy::indentation:
      value *= height;
      [[fallthrough]];
    case PressBy::approach:
      by = "approach";
      asked.prescribed = Prescribed::approach;
      asked.asked_approach = value;
      break;
    case PressBy::flatten:
      by = "flatten";
      asked.prescribed = Prescribed::flattening;
      break;
  }
  const auto solve = [&] {
    return by == "approach"  ? solve_at_approach(problem, value, monitor)
           : by == "flatten" ? solve_at_flattening(problem, value, monitor)
                             : solve_from(start, problem, value, monitor);
  };
  Costed<HalfSpaceAnswer> solved = recall_or_solve(problem, by, value, start, monitor, [&] {
    const double most = by == "pressure" ? most_under_load : most_of_other_controls;
    return hardens_on_long_cells(problem) ? solve_within(most, problem.grid, solve) : solve();
  });
  // The energy sums pressures times lengths.
  const HalfSpaceAnswer& answer = solved.result;
  const double most = answer.peak_pressure * (std::abs(answer.approach) + height);
  if (!std::isfinite(most * static_cast<double>(problem.grid.nodes())) ||
      !std::isfinite(answer.mean_pressure * problem.grid.area()))
    refuse(quoted(name(request.by)) + " is " + format_short(request.value) +
               ", so large that the numbers of the solution leave the range of a double",
           "check its unit and that of the heights");
  auto solution =
      std::make_shared<const UnderLoad>(ready_, std::move(problem), std::move(solved.result), factor, asked);
  return State(std::move(solution), plan_, elasticity_alone(solved.cost));
}

}  // namespace asperity
