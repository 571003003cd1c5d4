// SPDX-License-Identifier: GPL-3.0-or-later
// Solver of yielding box elements.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/contact/elastic_bodies.hpp"
#include "engine/contact/elasticity/box/box_solver.hpp"
#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/elasticity/box/yielding_elements.hpp"
#include "engine/contact/planned_yield.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr double box_rounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

struct YieldingBoxSolver::Ready {
  std::shared_ptr<const ContactGeometry> geometry;
  BoxOperator box;
  PlannedYield yield;
  MetMemory hardness;  // empty before the first event
  SortedDrops drops;
  YieldingElements alike;  // with one yield pressure

  Ready(std::shared_ptr<const ContactGeometry> g, const BoxOperator& b, const PlannedYield& y)
      : geometry(std::move(g)),
        box(b),
        yield(y),
        hardness(y.hardens() ? local_hardness(*geometry, y) : MetMemory{}),
        drops(geometry->overhangs() ? SortedDrops(geometry->facing_heights())
                                    : SortedDrops(geometry->combined().values())),
        alike({b.stiffness, y.hardens() ? y.hardening : 0}, drops.drops(), y.hardness()) {}

  std::shared_ptr<const YieldingElements> elements(const YieldLaw& law) const {
    if (!law.yield) return std::make_shared<const YieldingElements>(alike, law.cap);
    Array<double> below, yields;
    below.reserve(drops.size());
    yields.reserve(drops.size());
    const std::span<const double> h = geometry->combined().values();
    for (std::size_t k = 0; k < h.size(); ++k) {
      if (std::isnan(h[k])) continue;
      below.push_back(drops.peak() - h[k]);
      yields.push_back((*law.yield)[k]);
    }
    return std::make_shared<const YieldingElements>(alike.law(), below, yields);
  }
};

class YieldingBoxSolver::UnderLoad final : public Solution {
 public:
  // `law`: yield pressures of this press; `factor`: softening by creep.
  UnderLoad(std::shared_ptr<const Ready> ready, std::shared_ptr<const YieldingElements> elements,
            YieldLaw law, const RestingPlane& plane, double pressure, double load, double factor)
      : ready_(std::move(ready)),
        elements_(std::move(elements)),
        law_(std::move(law)),
        plane_(plane),
        pressure_(pressure),
        load_(load),
        factor_(factor),
        fits_(covered(ready_->yield.carried, carried())),
        contacts_(count([](const Element& e) { return e.pressure > 0; })),
        yielded_(count([](const Element& e) { return e.pressure > 0 && e.pressure >= e.yield; })),
        peak_pressure_(greatest([](const Element& e) { return e.pressure; })) {}

  const ContactGeometry& geometry() const override { return *ready_->geometry; }
  double load() const override { return load_; }
  double pressure() const override { return pressure_; }
  double approach() const override { return std::max(0.0, plane_.high); }
  std::int64_t contacts() const override { return contacts_; }
  double peak_pressure() const override { return peak_pressure_; }
  int iterations() const override { return 0; }
  std::string_view solver() const override { return "closed form (sorted elements)"; }
  std::int64_t yielded() const override { return yielded_; }
  double plastic_volume() const override {
    return fits_ ? 0.0 : sum([](const Element& e) { return e.plastic; }) * cell();
  }
  std::optional<PlasticChange> plastic_change() const override;

  double stiffness() const override {
    const ElementLaw& law = elements_->law();
    const double elastic = law.rigid() ? 0 : law.stiffness * static_cast<double>(contacts_ - yielded_);
    return (elastic + law.slope_past_yield() * static_cast<double>(yielded_)) / nodes();
  }
  double flatten() const override {
    const double height = drops().peak_to_valley();
    return height > 0 ? std::min(1.0, approach() / height) : 0.0;
  }
  double mean_gap() const override {
    return drops().remaining_gap(approach()) / static_cast<double>(drops().size());
  }
  double energy() const override {
    return 0.5 * cell() * sum([](const Element& e) { return e.pressure * e.elastic; });
  }
  Certificate certificate() const override;
  SolutionError error() const override;
  PressureSplit split(double threshold) const override {
    PressureSplit result;
    result.above = count([&](const Element& e) { return e.pressure > 0 && e.pressure >= threshold; });
    result.below = contacts_ - result.above;
    result.sum_below = sum([&](const Element& e) { return e.pressure < threshold ? e.pressure : 0.0; });
    return result;
  }

  Array<std::uint8_t> contact_mask() const override {
    const Field pressure = pressure_field();
    Array<std::uint8_t> mask(pressure.size());
    for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = pressure[k] > 0 ? 1 : 0;
    return mask;
  }
  Field pressure_field() const override {
    return field([](const Element& e) { return e.pressure; });
  }
  Field gap_field() const override {
    return field([](const Element& e) { return e.pressure > 0 ? 0.0 : std::max(0.0, -e.depth); });
  }
  Field displacement_field() const override {
    return field([](const Element& e) { return e.elastic; });
  }
  Field lower_under_load() const override { return lower_heights(geometry(), ready_->yield, deformation()); }
  Field upper_under_load() const override { return upper_heights(geometry(), ready_->yield, deformation()); }

 private:
  struct Element {
    double depth, yield, pressure;
    double elastic, plastic;  // parts of the shortening, m
  };
  static Element element(const ElementLaw& law, const RestingPlane& plane, double drop, double yield) {
    const double pressure = plane.pressure(law, drop, yield);
    return {plane.high - drop, yield, pressure, pressure / law.stiffness,
            plane.plastic_part(law, drop, yield)};
  }

  const SortedDrops& drops() const { return ready_->drops; }
  // Nodes of the tile; elements exist only at facing nodes.
  double nodes() const { return static_cast<double>(geometry().grid().nodes()); }
  double mean_over_elements() const { return pressure_ / geometry().overlap_fraction(); }
  double cell() const { return geometry().grid().cell_area(); }
  CarriedLoad carried() const { return {pressure_, factor_}; }
  Deformation deformation() const {
    return {displacement_field(), ready_->box.lower_share, plastic_change()};
  }

  template <class Function>
  double sum_at(const RestingPlane& plane, Function function) const {
    return elements_->sum(
        [&](double drop, double yield) { return function(element(elements_->law(), plane, drop, yield)); });
  }
  template <class Function>
  double sum(Function function) const {
    return sum_at(plane_, function);
  }
  template <class Test>
  std::int64_t count_at(const RestingPlane& plane, Test test) const {
    std::int64_t number = 0;
    for (std::size_t k = 0; k < elements_->size(); ++k)
      if (test(element(elements_->law(), plane, elements_->drop(k), elements_->yield(k)))) ++number;
    return number;
  }
  template <class Test>
  std::int64_t count(Test test) const {
    return count_at(plane_, test);
  }
  template <class Function>
  double greatest_at(const RestingPlane& plane, Function function) const {
    double most = 0;
    for (std::size_t k = 0; k < elements_->size(); ++k)
      most =
          std::max(most, function(element(elements_->law(), plane, elements_->drop(k), elements_->yield(k))));
    return most;
  }
  template <class Function>
  double greatest(Function function) const {
    return greatest_at(plane_, function);
  }
  // In the frame of the lower body; zero at NaN heights (no counterpart).
  template <class Function>
  Field field(Function function) const {
    Field result = geometry().combined();
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = function(element(elements_->law(), plane_, drops().peak() - result[k],
                                   law_.yield ? (*law_.yield)[k] : law_.cap));
    return result;
  }

  std::shared_ptr<const Ready> ready_;
  std::shared_ptr<const YieldingElements> elements_;
  YieldLaw law_;
  RestingPlane plane_;
  double pressure_, load_, factor_;
  bool fits_;  // this load was carried before, as placed
  std::int64_t contacts_, yielded_;
  double peak_pressure_;
};

std::optional<PlasticChange> YieldingBoxSolver::UnderLoad::plastic_change() const {
  if (fits_ || yielded_ == 0) return {};
  PlasticChange change{field([](const Element& e) { return e.plastic; }), {}, carried()};
  if (range(change.approach.values()).max == 0) return {};
  if (law_.hardens())
    // At the reference dwell: the same press again finds exactly this hardness.
    change.hardness = field([&](const Element& e) { return e.plastic > 0 ? e.pressure / factor_ : 0.0; });
  return change;
}

Certificate YieldingBoxSolver::UnderLoad::certificate() const {
  Certificate result;
  if (contacts_ == 0) {
    // The whole load is missing.
    result.load = pressure_ > 0 ? 1 : 0;
    return result;
  }
  // Equal heights have no rms.
  const double length = drops().rms() > 0 ? drops().rms() : std::max(approach(), drops().peak_to_valley());
  const double total = sum([](const Element& e) { return e.pressure; });
  result.load = std::abs(total / nodes() - pressure_) / pressure_;
  result.tension = greatest([](const Element& e) { return -e.pressure; }) / pressure_;
  if (!law_.hardens())
    result.cap = greatest([](const Element& e) { return std::max(0.0, e.pressure - e.yield) / e.yield; });
  if (!(length > 0)) return result;
  const auto gap = [](const Element& e) { return (e.elastic + e.plastic) - e.depth; };
  result.penetration = greatest([&](const Element& e) { return -gap(e); }) / length;
  result.complementarity =
      sum([&](const Element& e) { return e.pressure * std::max(0.0, gap(e)); }) / total / length;
  return result;
}

// Every quantity is monotone in the depth: the bounds are the values at two planes with certainly too little
// and too much load.
SolutionError YieldingBoxSolver::UnderLoad::error() const {
  SolutionError error{.load = 0.0};
  if (contacts_ == 0) return error;
  const double depth = approach(), least = std::numeric_limits<double>::denorm_min();
  const ElementLaw& law = elements_->law();
  double off = std::max(box_rounding * depth, 2 * least);
  const auto brackets = [&] {
    return elements_->mean_pressure(depth - off) <= mean_over_elements() * (1 - box_rounding) &&
           elements_->mean_pressure(depth + off) >= mean_over_elements() * (1 + box_rounding);
  };
  const double furthest = depth + drops().peak_to_valley() + law.depth_at_yield(peak_pressure_);
  while (!brackets() && off < furthest) off *= 2;
  const RestingPlane low{depth - off, depth - off, 1}, high{depth + off, depth + off, 1};
  const auto touches = [](const Element& e) { return e.pressure > 0; };
  const auto yields = [](const Element& e) { return e.pressure > 0 && e.pressure >= e.yield; };
  const auto between = [&](auto function) { return sum_at(high, function) - sum_at(low, function); };

  error.load = box_rounding * load_ +
               std::abs(sum([](const Element& e) { return e.pressure; }) / nodes() - pressure_) *
                   geometry().grid().area();
  error.approach = off;
  error.mean_gap = (drops().remaining_gap(std::max(0.0, depth - off)) - drops().remaining_gap(depth + off)) /
                       static_cast<double>(drops().size()) +
                   box_rounding * mean_gap();
  error.energy = 0.5 * cell() * between([](const Element& e) { return e.pressure * e.elastic; }) +
                 box_rounding * energy();
  error.peak_pressure =
      std::max(0.0, greatest_at(high, [](const Element& e) { return e.pressure; }) - peak_pressure_) +
      box_rounding * peak_pressure_;
  error.plastic_volume =
      fits_ ? 0.0
            : cell() * between([](const Element& e) { return e.plastic; }) + box_rounding * plastic_volume();
  error.contacts = {count_at(low, touches), count_at(high, touches)};
  error.yielded = {count_at(low, yields), count_at(high, yields)};
  error.may_differ = error.contacts.high - error.contacts.low;
  return error;
}

YieldingBoxSolver::YieldingBoxSolver(const Plan& plan, const BoxOperator& box,
                                     std::shared_ptr<const ContactGeometry> geometry)
    : Solver(plan, std::move(geometry)) {
  const CostScope scope;
  ready_ = std::make_shared<const Ready>(geometry_, box, *plan.yield);
  preparation_ = elasticity_alone(scope.so_far());
}

State YieldingBoxSolver::press(const PressRequest& request, Monitor&) const {
  check(request);
  const CostScope scope;
  const double height = geometry().peak_to_valley(), tile = geometry().grid().area();
  const double overlap = geometry().overlap_fraction();
  const double factor = ready_->yield.softened(request.dwell);
  const YieldLaw law = yield_law(ready_->yield, ready_->hardness, factor);
  const auto elements = ready_->elements(law);
  const std::string asked = quoted(name(request.by)) + " is " + format_short(request.value);
  const bool by_load = request.by == PressBy::pressure || request.by == PressBy::load;
  check_fraction(request, height);

  RestingPlane plane{-std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::denorm_min(),
                     1};
  double pressure = 0, load = 0;
  if (request.value > 0 && by_load) {
    pressure = request.by == PressBy::load ? request.value / tile : request.value;
    load = request.by == PressBy::load ? request.value : request.value * tile;
    const double greatest = elements->greatest_mean_pressure();
    if (pressure / overlap >= greatest)
      refuse_infeasible("a mean pressure of " + format_quantity(pressure, dimension::pressure) +
                            " cannot be carried: the elements carry " +
                            format_quantity(greatest * overlap, dimension::pressure) +
                            " at most, their `hardness`" +
                            (overlap < 1 ? " on the " + format_short(100 * overlap, 3) +
                                               " % of the tile where the bodies face each other"
                                         : std::string()),
                        "press with less than the hardness, or give `hardening`");
    plane = elements->plane_under(pressure / overlap);
  } else if (request.value > 0) {
    const double depth = request.by == PressBy::approach ? request.value : request.value * height;
    plane = {depth, depth, 1};
    pressure = elements->mean_pressure(depth) * overlap;
    load = pressure * tile;
  }

  constexpr double least = 1e-280;  // of the hardness
  if (request.value > 0 && pressure < least * law.cap)
    refuse(asked + ", a pressure under 1e-280 of the hardness: too small to mean anything",
           "give zero for no load, or check its unit");
  auto solution = std::make_shared<const UnderLoad>(ready_, elements, law, plane, pressure, load, factor);
  if (!std::isfinite(plane.high * plane.high * static_cast<double>(elements->size())) ||
      !std::isfinite(load) || !std::isfinite(solution->peak_pressure()) || !std::isfinite(solution->energy()))
    refuse(asked + ", so large that the numbers of the solution leave the range of a double",
           "check its unit");
  const State state(std::move(solution), plan_, elasticity_alone(scope.so_far()));
  check_rounding(state, plan_.accuracy);
  return state;
}

}  // namespace asperity
