// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/adhesive_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/half_space_solution.hpp"
#include "engine/contact/elasticity/half_space/half_space_solver.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

double rms_height_of(std::span<const double> heights) {
  const double middle = mean(heights);
  return std::sqrt(over_nodes<1>(heights.size(),
                                 [&](std::size_t k, double* v) {
                                   v[0] = (heights[k] - middle) * (heights[k] - middle);
                                 })[0] /
                   static_cast<double>(heights.size()));
}

}  // namespace

struct AdhesiveSolver::Ready {
  std::shared_ptr<const ContactGeometry> geometry;
  HalfSpaceOperator half_space;
  AdhesiveProblem problem;

  struct Turn {
    bool by_load = false;
    std::vector<double> values;
    AdhesiveAnswer answer;
  };
  mutable std::mutex mutex;
  mutable std::shared_ptr<const Turn> turn;
};

class AdhesiveSolver::UnderLoad final : public HalfSpaceSolution {
 public:
  UnderLoad(const Ready& ready, AdhesiveAnswer answer, bool by_load, std::vector<double> preload)
      : HalfSpaceSolution(ready.geometry, ready.problem.contact, std::move(answer.contact),
                          ready.half_space.lower_share),
        attraction_(std::move(answer.attraction)),
        mean_attraction_(answer.mean_attraction),
        by_load_(by_load),
        preload_(std::move(preload)) {}

  double attraction() const override { return mean_attraction_ * problem_.grid.area(); }
  std::span<const double> preload() const override { return preload_; }
  // The problem is not convex: only the prescribed quantity has a bound.
  SolutionError error() const override {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    SolutionError error{.load = by_load_ ? rounding * std::abs(load()) : unknown};
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
  double mean_attraction_;
  bool by_load_;
  std::vector<double> preload_;
};

AdhesiveSolver::AdhesiveSolver(const Plan& plan, const HalfSpaceOperator& half_space,
                               std::shared_ptr<const ContactGeometry> geometry)
    : Solver(plan, std::move(geometry)) {
  const CostScope scope;
  auto ready = std::make_shared<Ready>();
  ready->geometry = geometry_;
  ready->half_space = half_space;
  HalfSpaceProblem& contact = ready->problem.contact;
  contact.grid = ready->geometry->grid();
  contact.boundary = ready->geometry->boundary();
  contact.modulus = half_space.modulus;
  contact.heights = {ready->geometry, &ready->geometry->combined()};
  contact.overhangs = ready->geometry->overhangs();
  contact.rms = contact.overhangs ? rms_height_of(ready->geometry->facing_heights())
                                  : rms_height_of(contact.heights->values());
  contact.tolerance = plan.accuracy.tolerance;
  contact.best_effort = plan.accuracy.on_failure == Accuracy::OnFailure::best;
  for (const GapTerm& term : plan.attraction)
    if (term.work > 0) ready->problem.attraction.push_back(term);
  preparation_ = elasticity_alone(scope.so_far());
  ready_ = std::move(ready);
}

State AdhesiveSolver::press(const PressRequest& request, Monitor& monitor) const {
  check(request, true);
  const AdhesiveProblem& problem = ready_->problem;
  const double height = geometry().peak_to_valley();
  check_fraction(request, height);
  const bool by_load = request.by == PressBy::load || request.by == PressBy::pressure;
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
  std::shared_ptr<const Ready::Turn> from;
  if (!turns.empty()) {
    std::vector<double> values = turns;
    for (double& value : values) value *= unit;
    {
      const std::lock_guard lock(ready_->mutex);
      if (ready_->turn && ready_->turn->by_load == by_load && ready_->turn->values == values)
        from = ready_->turn;
    }
    if (!from) {
      auto made = std::make_shared<Ready::Turn>();
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
    const std::lock_guard lock(ready_->mutex);
    ready_->turn = std::move(from);
  }
  const StateCost cost = parted(whole, contacts, answer);
  return State(std::make_shared<const UnderLoad>(*ready_, std::move(answer), by_load, std::move(turns)),
               plan_, cost);
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
  const std::vector<GapTerm>& terms = ready_->problem.attraction;
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

}  // namespace asperity
