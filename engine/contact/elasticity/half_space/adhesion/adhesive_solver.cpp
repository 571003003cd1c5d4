// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/adhesion/adhesive_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/contact_stiffness.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/recalled_solve.hpp"
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
  StateCost cost;

  // The preload of the last press.
  struct Turn {
    bool by_load = false;
    std::vector<double> values;
    AdhesiveAnswer answer;
  };
  mutable std::mutex mutex;
  mutable std::shared_ptr<const Turn> turn;
};

class AdhesiveSolver::UnderLoad final : public Solution {
 public:
  UnderLoad(std::shared_ptr<const Ready> ready, AdhesiveAnswer answer, bool by_load,
            std::vector<double> preload)
      : ready_(std::move(ready)), at_(std::move(answer)), by_load_(by_load), preload_(std::move(preload)) {}

  const ContactGeometry& geometry() const override { return *ready_->geometry; }
  double load() const override { return at_.contact.mean_pressure * grid().area(); }
  double pressure() const override { return at_.contact.mean_pressure; }
  double attraction() const override { return at_.mean_attraction * grid().area(); }
  std::span<const double> preload() const override { return preload_; }
  double approach() const override { return at_.contact.approach; }
  std::int64_t contacts() const override { return at_.contact.contacts; }
  double peak_pressure() const override { return at_.contact.peak_pressure; }
  int iterations() const override { return at_.contact.iterations; }
  std::string_view solver() const override { return at_.contact.solver; }
  Certificate certificate() const override { return at_.contact.certificate; }
  // The problem is not convex: nothing is bounded but what was asked for.
  SolutionError error() const override {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    SolutionError error{.load = by_load_ ? rounding * std::abs(load()) : unknown};
    error.approach = error.mean_gap = error.energy = error.peak_pressure = unknown;
    error.contacts = {0, geometry().facing()};
    error.may_differ = error.contacts.high;
    return error;
  }
  // Of the contacts, the attraction held.
  double stiffness() const override {
    return contacts() > 0 ? contact_stiffness(ready_->problem.contact, at_.contact, Monitor::silent()) : 0.0;
  }
  double flatten() const override {
    const double height = geometry().peak_to_valley();
    if (!(height > 0)) return 0;
    const auto ends = over_nodes<0, 2>(at_.contact.gap.size(), [&](std::size_t k, double* v) {
      const double gap = faces(k) ? at_.contact.gap[k] : std::numeric_limits<double>::quiet_NaN();
      v[0] = gap;  // a minimum goes over what is a number
      v[1] = -gap;
    });
    return 1 - (-ends[1] - ends[0]) / height;
  }
  double mean_gap() const override {
    return sum([&](std::size_t k) { return faces(k) ? std::max(0.0, at_.contact.gap[k]) : 0.0; }) /
           static_cast<double>(geometry().facing());
  }
  double energy() const override {
    return 0.5 * grid().cell_area() * sum([&](std::size_t k) {
             return faces(k) ? (at_.contact.pressure[k] - at_.attraction[k]) * displacement(k) : 0.0;
           });
  }
  PressureSplit split(double threshold) const override {
    PressureSplit result;
    for (const double p : at_.contact.pressure.values())
      if (p > 0) ++(p >= threshold ? result.above : result.below);
    result.sum_below = sum([&](std::size_t k) {
      const double p = at_.contact.pressure[k];
      return p > 0 && p < threshold ? p : 0.0;
    });
    return result;
  }
  std::int64_t bytes() const override {
    return static_cast<std::int64_t>(3 * grid().nodes() * sizeof(double));
  }
  Array<std::uint8_t> contact_mask() const override {
    Array<std::uint8_t> mask(grid().nodes());
    for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = at_.contact.pressure[k] > 0 ? 1 : 0;
    return mask;
  }
  Field pressure_field() const override { return at_.contact.pressure; }
  Field gap_field() const override {
    return field(
        [&](std::size_t k) { return at_.contact.pressure[k] > 0 ? 0.0 : std::max(0.0, at_.contact.gap[k]); });
  }
  Field displacement_field() const override {
    Field u = field([&](std::size_t k) { return displacement(k); });
    if (!geometry().overhangs()) return u;
    // Ground that nothing faces moves with the rest.
    const Field all =
        displacement_under(ready_->problem.contact,
                           field([&](std::size_t k) { return at_.contact.pressure[k] - at_.attraction[k]; }));
    for (std::size_t k = 0; k < u.size(); ++k)
      if (!faces(k)) u[k] = all[k];
    return u;
  }
  Field lower_under_load() const override {
    Field z = geometry().lower().heights();
    const double share = ready_->half_space.lower_share;
    const Field u = displacement_field();
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * u[k];
    return z;
  }
  Field upper_under_load() const override {
    const auto* rough = std::get_if<Surface>(&geometry().upper());
    Field z = rough ? rough->heights() : Field(grid().nx, grid().ny);
    const double share = 1 - ready_->half_space.lower_share;
    if (share == 0) return z;
    const Field own = geometry().pose().to_upper(displacement_field(), grid());
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * own[k];
    return z;
  }

 private:
  const Grid& grid() const { return ready_->problem.contact.grid; }
  bool faces(std::size_t k) const { return !geometry().overhangs() || !std::isnan(geometry().combined()[k]); }
  // K (p − σ) of both bodies.
  double displacement(std::size_t k) const {
    return at_.contact.gap[k] +
           (at_.contact.approach - (geometry().combined_range().max - geometry().combined()[k]));
  }
  template <class Function>
  Field field(Function function) const {
    Field result(grid().nx, grid().ny);
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = function(k);
    return result;
  }
  template <class Function>
  double sum(Function function) const {
    return block_sum(field(function).values());
  }

  std::shared_ptr<const Ready> ready_;
  AdhesiveAnswer at_;
  bool by_load_;
  std::vector<double> preload_;
};

AdhesiveSolver::AdhesiveSolver(const Plan& plan, const HalfSpaceOperator& half_space,
                               std::shared_ptr<const ContactGeometry> geometry)
    : plan_(plan) {
  const CostScope scope;
  auto ready = std::make_shared<Ready>();
  ready->geometry = std::move(geometry);
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
  ready->cost = {scope.so_far(), {{"elasticity", scope.so_far()}}};
  ready_ = std::move(ready);
}

const ContactGeometry& AdhesiveSolver::geometry() const { return *ready_->geometry; }
const StateCost& AdhesiveSolver::preparation() const { return ready_->cost; }

State AdhesiveSolver::press(const PressRequest& request, Monitor& monitor) const {
  check(request, true);
  const AdhesiveProblem& problem = ready_->problem;
  const double height = geometry().peak_to_valley();
  if (request.by == PressBy::indentation && !(height > 0))
    throw Error(
        ErrorCode::bad_value,
        "`indentation` is a fraction of a peak-to-valley that is zero: all combined heights are equal",
        "give `pressure`, `load` or `approach`");
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
  if (from) {  // not before: a press that is refused leaves no trace
    const std::lock_guard lock(ready_->mutex);
    ready_->turn = std::move(from);
  }
  const StateCost cost = parted(whole, contacts, answer);
  return State(std::make_shared<const UnderLoad>(ready_, std::move(answer), by_load, std::move(turns)), plan_,
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
