// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_solver.hpp"

#include "engine/contact/elasticity/half_space/error/half_space_error.hpp"
#include "engine/contact/elasticity/half_space/half_space_solution.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

// One list, so writing and reading agree.
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

// As planned and placed; without rms height and yield.
HalfSpaceProblem problem_of(const Plan& plan, const std::shared_ptr<const ContactGeometry>& geometry) {
  HalfSpaceProblem problem;
  problem.grid = geometry->grid();
  problem.boundary = geometry->boundary();
  problem.modulus = plan.elasticity->modulus;
  if (const WaveShare* share = plan.elasticity->wave_share()) problem.share = *share;
  problem.heights = {geometry, &geometry->combined()};
  problem.overhangs = geometry->overhangs();
  problem.tolerance = plan.accuracy.tolerance;
  problem.single = plan.accuracy.precision == Accuracy::Precision::single;
  problem.best_effort = plan.accuracy.on_failure == Accuracy::OnFailure::best;
  return problem;
}

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

class PressedHalfSpace final : public HalfSpaceSolution {
 public:
  // `problem` has its yield law; `factor`: softening by creep.
  PressedHalfSpace(PlacedContact contact, HalfSpaceProblem problem, HalfSpaceAnswer answer, double factor,
                   const Reported& asked)
      : HalfSpaceSolution(std::move(contact), std::move(problem), std::move(answer)),
        factor_(factor),
        asked_(asked),
        fits_(plan().yield && covered(plan().yield->carried, carried())) {}

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
  double plastic_volume() const override {
    return sum([&](std::size_t k) { return yielded(k); }) * problem_.grid.cell_area();
  }
  std::optional<PlasticChange> plastic_change() const override;

 private:
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

  double factor_;
  Reported asked_;
  bool fits_;  // carried before, as placed
};

// Half the sum of pressures times displacements. In periodic full contact a large mean can hide pressure
// differences; they then come from the displacements.
double PressedHalfSpace::energy() const {
  Field pressure = at_.pressure;
  double uniform = 0;  // twice the energy of the mean pressure
  if (problem_.boundary == Boundary::periodic && static_cast<double>(at_.contacts) == nodes() &&
      at_.yielded == 0) {
    pressure = plan().elasticity->inverse(displacement_field(), problem_.grid);
    uniform = plan().elasticity->compliance_of_mean() * at_.mean_pressure * numbers().load;
  }
  const double twice = sum([&](std::size_t k) { return faces(k) ? pressure[k] * displacement(k) : 0.0; });
  return 0.5 * uniform + std::max(0.0, 0.5 * twice * problem_.grid.cell_area());  // rounding
}

std::optional<PlasticChange> PressedHalfSpace::plastic_change() const {
  if (!problem_.yield.limits() || at_.yielded == 0) return {};
  if (fits_) return {};
  PlasticChange change{field([&](std::size_t k) { return yielded(k); }), {}};
  if (range(change.approach.values()).max == 0) return {};
  if (at_.converged) change.carried = carried();
  if (problem_.yield.hardens())
    // At the reference dwell: a repeated press finds exactly this hardness.
    change.hardness = field([&](std::size_t k) { return yielded(k) > 0 ? at_.pressure[k] / factor_ : 0.0; });
  return change;
}

// From `start`; on failure again without `start`.
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

// Hardening on long cells converges within some 150 transforms or hardly at all (docs/stability.md). Other
// controls take some three solves.
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

class HalfSpaceSolver final : public Solver {
 public:
  HalfSpaceSolver(const Plan& given, std::shared_ptr<const ContactGeometry> geometry)
      : Solver(given, std::move(geometry)) {
    const CostScope scope;
    const std::optional<PlannedYield>& yield = plan().yield;
    problem_ = problem_of(plan(), contact_.geometry);
    problem_.rms =
        problem_.overhangs ? rms_of(contact_.geometry->facing_heights()) : rms_of(problem_.heights->values());
    if (yield && yield->hardens()) hardness_ = local_hardness(*contact_.geometry, *yield);
    preparation_ = elasticity_alone(scope.so_far());
  }

  State press(const PressRequest& request, Monitor& monitor) const override {
    return pressed(request, nullptr, monitor);
  }
  State press_from(const Solution& guess, const PressRequest& request, Monitor& monitor) const override;

 private:
  // `start` may be null.
  State pressed(const PressRequest& request, const HalfSpaceAnswer* start, Monitor& monitor) const;

  MetMemory hardness_;  // empty without hardness fields
  HalfSpaceProblem problem_;
};

State HalfSpaceSolver::press_from(const Solution& guess, const PressRequest& request,
                                  Monitor& monitor) const {
  if (!request.by_load() || geometry().overhangs()) return press(request, monitor);
  HalfSpaceAnswer start;
  start.pressure = guess.pressure_field();
  start.gap = guess.gap_field();
  start.mean_pressure = guess.numbers().pressure;
  return pressed(request, &start, monitor);
}

State HalfSpaceSolver::pressed(const PressRequest& request, const HalfSpaceAnswer* start,
                               Monitor& monitor) const {
  check(request);
  const double height = geometry().peak_to_valley();
  check_fraction(request, height);

  const std::optional<PlannedYield>& yield = plan().yield;
  const double factor = yield ? yield->softened(request.dwell) : 1.0;
  HalfSpaceProblem problem = problem_;
  if (yield) problem.yield = yield_law(*yield, hardness_, factor);
  const double value = request.by == PressBy::load          ? request.value / problem.grid.area()
                       : request.by == PressBy::indentation ? request.value * height
                                                            : request.value;
  Reported asked;
  std::string_view by = "pressure";
  if (request.by == PressBy::flatten) {
    by = "flatten";
    asked.prescribed = Prescribed::flattening;
  } else if (!request.by_load()) {
    by = "approach";
    asked.prescribed = Prescribed::approach;
    asked.asked_approach = value;
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
               ", too large: the results leave the range of a double",
           "check its unit and that of the heights");
  auto solution = std::make_shared<const PressedHalfSpace>(contact_, std::move(problem),
                                                           std::move(solved.result), factor, asked);
  return State(std::move(solution), elasticity_alone(solved.cost));
}

double rms_height_of(std::span<const double> heights) {
  const double middle = mean(heights);
  return std::sqrt(over_nodes<1>(heights.size(),
                                 [&](std::size_t k, double* v) {
                                   v[0] = (heights[k] - middle) * (heights[k] - middle);
                                 })[0] /
                   static_cast<double>(heights.size()));
}

class AdhesiveSolution final : public HalfSpaceSolution {
 public:
  AdhesiveSolution(PlacedContact contact, const HalfSpaceProblem& problem, AdhesiveAnswer answer,
                   bool by_load, std::vector<double> preload)
      : HalfSpaceSolution(std::move(contact), problem, std::move(answer.contact),
                          answer.mean_attraction * problem.grid.area(), std::move(preload)),
        attraction_(std::move(answer.attraction)),
        by_load_(by_load) {}

  // Not convex: only the prescribed quantity has a bound.
  SolutionError error() const override {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    SolutionError error{.load = by_load_ ? rounding * std::abs(numbers().load) : unknown};
    error.approach = error.mean_gap = error.energy = error.peak_pressure = unknown;
    error.contacts = {0, geometry().facing()};
    error.may_differ = error.contacts.high;
    return error;
  }
  double flatten() const override {
    const double height = geometry().peak_to_valley();
    if (!(height > 0)) return 0;
    const auto ends = over_nodes<0, 2>(at_.gap.size(), [&](std::size_t k, double* v) {
      const double gap = faces(k) ? at_.gap[k] : std::numeric_limits<double>::quiet_NaN();
      v[0] = gap;  // a minimum ignores NaN
      v[1] = -gap;
    });
    return 1 - (-ends[1] - ends[0]) / height;
  }
  double energy() const override {
    return 0.5 * problem_.grid.cell_area() * sum([&](std::size_t k) {
             return faces(k) ? (at_.pressure[k] - attraction_[k]) * displacement(k) : 0.0;
           });
  }
  std::int64_t bytes() const override {
    return static_cast<std::int64_t>(3 * problem_.grid.nodes() * sizeof(double));
  }

 private:
  Field moving_pressures() const override {
    return field([&](std::size_t k) { return at_.pressure[k] - attraction_[k]; });
  }

  Field attraction_;
  bool by_load_;
};

class AdhesiveSolver final : public Solver {
 public:
  AdhesiveSolver(const Plan& given, std::shared_ptr<const ContactGeometry> geometry)
      : Solver(given, std::move(geometry)) {
    const CostScope scope;
    HalfSpaceProblem& contact = problem_.contact;
    contact = problem_of(plan(), contact_.geometry);
    contact.rms = contact.overhangs ? rms_height_of(contact_.geometry->facing_heights())
                                    : rms_height_of(contact.heights->values());
    for (const GapTerm& term : plan().attraction)
      if (term.work > 0) problem_.attraction.push_back(term);
    preparation_ = elasticity_alone(scope.so_far());
  }

  State press(const PressRequest& request, Monitor& monitor) const override;

 private:
  struct Turn {
    bool by_load = false;
    std::vector<double> values;
    AdhesiveAnswer answer;
  };
  StateCost parted(const Cost& whole, const Cost& contacts, const AdhesiveAnswer& answer) const;

  AdhesiveProblem problem_;
  mutable std::mutex mutex_;  // of the next member
  mutable std::shared_ptr<const Turn> turn_;
};

State AdhesiveSolver::press(const PressRequest& request, Monitor& monitor) const {
  check(request, true);
  const AdhesiveProblem& problem = problem_;
  const double height = geometry().peak_to_valley();
  check_fraction(request, height);
  const bool by_load = request.by_load();
  const double unit = request.by == PressBy::load          ? 1 / problem.contact.grid.area()
                      : request.by == PressBy::indentation ? height
                                                           : 1;
  Cost whole;
  const auto solve = [&](double value, const AdhesiveAnswer* start) {
    const double target = value * unit;
    Costed<AdhesiveAnswer> solved =
        recall_or_adhere(problem, by_load ? "pressure" : "approach", target, start, monitor, [&] {
          return by_load ? adhere_at_pressure(problem, target, start, monitor)
                         : adhere_at_approach(problem, target, start, monitor);
        });
    whole += solved.cost;
    return std::move(solved.result);
  };
  std::vector<double> turns = request.preload;
  if (by_load && (turns.empty() ? request.value : turns.front()) < 0) turns.insert(turns.begin(), 0.0);
  Cost contacts;  // of the first tangents
  std::shared_ptr<const Turn> from;
  if (!turns.empty()) {
    std::vector<double> values = turns;
    for (double& value : values) value *= unit;
    {
      const std::lock_guard lock(mutex_);
      if (turn_ && turn_->by_load == by_load && turn_->values == values) from = turn_;
    }
    if (!from) {
      auto made = std::make_shared<Turn>();
      int iterations = 0;
      for (std::size_t k = 0; k < turns.size(); ++k) {
        made->answer = solve(turns[k], k > 0 ? &made->answer : nullptr);
        iterations += made->answer.contact.iterations;
        contacts += made->answer.first_contact;
      }
      made->answer.contact.iterations = iterations;
      made->by_load = by_load;
      made->values = std::move(values);
      from = std::move(made);
    }
  }
  AdhesiveAnswer answer = solve(request.value, from ? &from->answer : nullptr);
  contacts += answer.first_contact;
  if (from) answer.contact.iterations += from->answer.contact.iterations;
  if (from) {  // a refused press leaves no trace
    const std::lock_guard lock(mutex_);
    turn_ = std::move(from);
  }
  const StateCost cost = parted(whole, contacts, answer);
  return State(std::make_shared<const AdhesiveSolution>(contact_, problem.contact, std::move(answer), by_load,
                                                        std::move(turns)),
               cost);
}

StateCost AdhesiveSolver::parted(const Cost& whole, const Cost& contacts,
                                 const AdhesiveAnswer& answer) const {
  StateCost cost{whole, {{"elasticity", {contacts.seconds, contacts.transforms, whole.bytes}}}};
  const auto field = static_cast<std::int64_t>(geometry().grid().nodes() * sizeof(double));
  Cost left = whole;
  left.seconds -= contacts.seconds;
  left.transforms -= contacts.transforms;
  left.bytes = field;
  double share_left = 1;
  const std::vector<GapTerm>& terms = problem_.attraction;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double share = k + 1 == terms.size() ? 1 : answer.shares[k] / share_left;
    const Cost own{share * left.seconds, share * left.transforms, field};
    cost.by_effect.emplace_back(terms[k].effect, own);
    left.seconds -= own.seconds;
    left.transforms -= own.transforms;
    share_left = std::max(share_left - answer.shares[k], std::numeric_limits<double>::min());
  }
  return cost;
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
      digester.add(term.effect).add(static_cast<int>(term.law)).add(term.work).add(term.range);
    if (start != nullptr)
      digester.add("from").add(start->contact.pressure.values()).add(start->attraction.values());
    return digester.add(by).add(value).hex();
  };
  return recall_or(monitor, adhesive_form, key, solve);
}

std::shared_ptr<const Solver> make_half_space_solver(const Plan& plan,
                                                     std::shared_ptr<const ContactGeometry> geometry) {
  return std::make_shared<const HalfSpaceSolver>(plan, std::move(geometry));
}

std::shared_ptr<const Solver> make_adhesive_solver(const Plan& plan,
                                                   std::shared_ptr<const ContactGeometry> geometry) {
  return std::make_shared<const AdhesiveSolver>(plan, std::move(geometry));
}

}  // namespace asperity
