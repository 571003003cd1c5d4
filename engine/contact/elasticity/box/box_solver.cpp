// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/box_solver.hpp"

#include "engine/contact/elasticity/box/yielding_elements.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr double box_rounding = 8 * std::numeric_limits<double>::epsilon();

std::string text_of(const PressRequest& request) {
  return quoted(name(request.by)) + " is " + format_short(request.value);
}
[[noreturn]] void refuse_tiny(const PressRequest& request, const std::string& of) {
  refuse(text_of(request) + ", a pressure under 1e-280 of the " + of + ": too small to mean anything",
         "give zero for no load, or check its unit");
}
[[noreturn]] void refuse_huge(const PressRequest& request) {
  refuse(text_of(request) + ", too large: the results leave the range of a double", "check its unit");
}

// Throws Error{not_converged} if rounding leaves the certificate above the tolerance and the scene does not
// accept the best result.
void check_rounding(const State& state, const Accuracy& accuracy) {
  if (accuracy.on_failure == Accuracy::OnFailure::error && !state.converged())
    throw Error(ErrorCode::not_converged,
                "the residual of the closed form is " + format_short(state.residual(), 3) +
                    ", above the `tolerance` of " + format_short(accuracy.tolerance),
                "only rounding remains: give a larger `tolerance`, or accept the best result with "
                "on_failure=\"best\"");
}

std::shared_ptr<const SortedDrops> sorted_drops(const ContactGeometry& geometry) {
  return geometry.overhangs() ? std::make_shared<const SortedDrops>(geometry.facing_heights())
                              : std::make_shared<const SortedDrops>(geometry.combined().values());
}

struct Element {
  double depth, yield, pressure;
  double elastic, plastic;  // parts of the shortening, m
};

Element element(const ElementLaw& law, const RestingPlane& plane, double drop, double yield) {
  const double pressure = plane.pressure(law, drop, yield);
  return {plane.high - drop, yield, pressure, pressure / law.stiffness, plane.plastic_part(law, drop, yield)};
}

template <class Test>
std::int64_t count(const YieldingElements& elements, const RestingPlane& plane, Test test) {
  std::int64_t number = 0;
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (test(element(elements.law(), plane, elements.drop(k), elements.yield(k)))) ++number;
  return number;
}

// At least 0.
template <class Function>
double greatest(const YieldingElements& elements, const RestingPlane& plane, Function function) {
  double most = 0;
  for (std::size_t k = 0; k < elements.size(); ++k)
    most = std::max(most, function(element(elements.law(), plane, elements.drop(k), elements.yield(k))));
  return most;
}

bool touches(const Element& e) { return e.pressure > 0; }
bool yields(const Element& e) { return e.pressure > 0 && e.pressure >= e.yield; }
double pressure_of(const Element& e) { return e.pressure; }

Solution::Numbers numbers_of(const YieldingElements& elements, const RestingPlane& plane, double pressure,
                             double load) {
  return {.load = load,
          .pressure = pressure,
          .approach = std::max(0.0, plane.high),
          .peak_pressure = greatest(elements, plane, pressure_of),
          .contacts = count(elements, plane, touches),
          .yielded = count(elements, plane, yields),
          .solver = "closed form (sorted elements)"};
}

}  // namespace

class BoxSolver::UnderLoad final : public BoxSolution {
 public:
  UnderLoad(PlacedContact contact, std::shared_ptr<const SortedDrops> drops, const Numbers& numbers)
      : BoxSolution(std::move(contact), std::move(drops), numbers),
        touched_(static_cast<std::size_t>(numbers.contacts)) {}

  double stiffness() const override { return modulus() * (static_cast<double>(touched_) / nodes()); }
  double energy() const override { return 0.5 * modulus() * drops().squared_shortening(approach()) * cell(); }
  Certificate certificate() const override;
  SolutionError error() const override;
  PressureSplit split(double threshold) const override;

  Field pressure_field() const override {
    return from_heights([&](double h) { return modulus() * shortening(h); });
  }
  Field gap_field() const override {
    return from_heights([&](double h) { return std::max(0.0, (drops().peak() - h) - approach()); });
  }
  Field displacement_field() const override {
    return from_heights([&](double h) { return shortening(h); });
  }
  Field lower_under_load() const override;

 private:
  // 0 at NaN heights.
  double shortening(double h) const { return std::max(0.0, approach() - (drops().peak() - h)); }
  template <class Function>
  Field from_heights(Function function) const {
    Field result = geometry().combined();
    for (double& value : result.values()) value = function(value);
    return result;
  }

  std::size_t touched_;
};

Certificate BoxSolver::UnderLoad::certificate() const {
  Certificate result;
  if (touched_ == 0) {
    // The whole load is missing.
    result.load = numbers().pressure > 0 ? 1 : 0;
    return result;
  }
  const double k = modulus();
  const std::span<const double> g = drops().drops();
  auto pressure_at = [&](std::size_t i) { return k * (approach() - g[i]); };
  auto gap_at = [&](std::size_t i) { return (g[i] - approach()) + pressure_at(i) / k; };

  double least_gap = touched_ < g.size() ? g[touched_] - approach() : std::numeric_limits<double>::infinity();
  double least_pressure = 0;
  Accumulator total;
  for (std::size_t i = 0; i < touched_; ++i) {
    least_gap = std::min(least_gap, gap_at(i));
    least_pressure = std::min(least_pressure, pressure_at(i));
    total.add(pressure_at(i));
  }
  Accumulator apart;
  for (std::size_t i = 0; i < touched_; ++i) apart.add(pressure_at(i) * (gap_at(i) - least_gap));

  // Equal heights have no rms.
  const double length = drops().rms() > 0 ? drops().rms() : approach();
  const double mean = total.value() / nodes();
  result.penetration = std::max(0.0, -least_gap) / length;
  result.tension = -least_pressure / numbers().pressure;
  result.complementarity = apart.value() / total.value() / length;
  result.load = std::abs(mean - numbers().pressure) / numbers().pressure;
  return result;
}

// Quantities are monotone in the approach: bounds are their values at both ends of its rounding interval.
SolutionError BoxSolver::UnderLoad::error() const {
  SolutionError error{.load = 0.0};
  if (!(approach() > 0)) return error;
  const double k = modulus(), facing = static_cast<double>(drops().size());
  const double cell = geometry().grid().cell_area(), depth = approach();
  const double wanted = numbers().pressure / k * nodes();
  double off =
      box_rounding * depth + std::abs(drops().shortening(depth) - wanted) / static_cast<double>(touched_);
  const auto low = [&] { return std::max(0.0, depth - off); };
  const auto brackets = [&] {
    return drops().shortening(low()) <= wanted * (1 - box_rounding) &&
           drops().shortening(depth + off) >= wanted * (1 + box_rounding);
  };
  while (off < depth && !brackets()) off *= 2;
  const double high = depth + off;
  error.load = box_rounding * numbers().load + k * std::abs(drops().shortening(depth) - wanted) * cell;
  error.approach = off;
  error.mean_gap =
      (drops().remaining_gap(low()) - drops().remaining_gap(high)) / facing + box_rounding * mean_gap();
  error.energy = 0.5 * k * cell * (drops().squared_shortening(high) - drops().squared_shortening(low())) +
                 box_rounding * energy();
  error.peak_pressure = k * off + box_rounding * numbers().peak_pressure;
  error.contacts = {static_cast<std::int64_t>(drops().touched(low())),
                    static_cast<std::int64_t>(drops().touched(high))};
  error.may_differ = error.contacts.high - error.contacts.low;
  return error;
}

PressureSplit BoxSolver::UnderLoad::split(double threshold) const {
  const double k = modulus();
  const std::span<const double> touched = drops().drops().first(touched_);
  auto pressure = [&](double drop) { return k * (approach() - drop); };
  const auto first_below = std::partition_point(touched.begin(), touched.end(),
                                                [&](double drop) { return pressure(drop) >= threshold; });
  PressureSplit result;
  result.above = first_below - touched.begin();
  result.below = touched.end() - first_below;
  if (result.above == 0) {
    result.sum_below = k * drops().shortening(approach());
    return result;
  }
  // A difference of two large sums would lose a small rest.
  Accumulator sum;
  for (auto drop = first_below; drop != touched.end(); ++drop) sum.add(pressure(*drop));
  result.sum_below = sum.value();
  return result;
}

Field BoxSolver::UnderLoad::lower_under_load() const {
  if (plan().elasticity->lower_share != 1 || !geometry().upper_is_flat()) return Solution::lower_under_load();
  // Touching nodes are exactly flat.
  Field z = geometry().lower().heights();
  const double plane = drops().peak() - approach();
  for (double& height : z.values()) height = std::min(height, plane);
  return z;
}

BoxSolver::BoxSolver(const Plan& given, double reference_pressure,
                     std::shared_ptr<const ContactGeometry> geometry)
    : Solver(given, std::move(geometry)), reference_pressure_(reference_pressure) {
  const CostScope scope;
  drops_ = sorted_drops(*contact_.geometry);
  preparation_ = elasticity_alone(scope.so_far());
}

Solution::Numbers BoxSolver::resolve(const PressRequest& request) const {
  const double k = plan().elasticity->modulus;
  const SortedDrops& drops = *drops_;
  const auto nodes = static_cast<double>(geometry().grid().nodes());
  const double tile = geometry().grid().area();
  Solution::Numbers result{.solver = "closed form (sorted heights)"};
  if (request.value == 0) return result;

  if (!request.by_load()) {
    check_fraction(request, drops.peak_to_valley());
    result.approach =
        request.by == PressBy::approach ? request.value : request.value * drops.peak_to_valley();
    result.pressure = k * (drops.shortening(result.approach) / nodes);
    result.load = result.pressure * tile;
  } else {
    result.pressure = request.by == PressBy::load ? request.value / tile : request.value;
    result.load = request.by == PressBy::load ? request.value : request.value * tile;
    result.approach = drops.depth(result.pressure / k * nodes);
  }

  result.contacts = static_cast<std::int64_t>(drops.touched(result.approach));
  result.peak_pressure = k * result.approach;

  constexpr double least = 1e-280;  // of the modulus
  if (result.pressure < least * reference_pressure_ || result.approach < std::numeric_limits<double>::min())
    refuse_tiny(request, "modulus");
  // The squared approach overflows first.
  const double square = result.approach * result.approach;
  if (!std::isfinite(square * nodes) || !std::isfinite(k * square * tile) ||
      !std::isfinite(result.peak_pressure) || !std::isfinite(result.load) || !std::isfinite(result.pressure))
    refuse_huge(request);
  return result;
}

State BoxSolver::press(const PressRequest& request, Monitor&) const {
  check(request);
  const CostScope scope;
  const Solution::Numbers at = resolve(request);
  auto solution = std::make_shared<const UnderLoad>(contact_, drops_, at);
  const double stiffness = solution->stiffness();
  const State state(std::move(solution), elasticity_alone(scope.so_far()));

  // Rounding leaves an ulp of the depth in each gap and touched node. The certificate is computed here only
  // if this bound exceeds the tolerance.
  const double length = drops_->rms() > 0 ? drops_->rms() : at.approach;
  const double bound = 4 * std::numeric_limits<double>::epsilon() *
                       std::max(at.approach * stiffness / at.pressure, at.approach / length);
  if (at.approach > 0 && bound > plan().accuracy.tolerance) check_rounding(state, plan().accuracy);
  return state;
}

std::shared_ptr<const YieldingElements> YieldingBoxSolver::elements(const YieldLaw& law) const {
  if (!law.yield) return std::make_shared<const YieldingElements>(*alike_, law.cap);
  Array<double> below, yields;
  below.reserve(drops_->size());
  yields.reserve(drops_->size());
  const std::span<const double> h = geometry().combined().values();
  for (std::size_t k = 0; k < h.size(); ++k) {
    if (std::isnan(h[k])) continue;
    below.push_back(drops_->peak() - h[k]);
    yields.push_back((*law.yield)[k]);
  }
  return std::make_shared<const YieldingElements>(alike_->law(), below, yields);
}

class YieldingBoxSolver::UnderLoad final : public BoxSolution {
 public:
  // `law`: yield pressures of this press; `factor`: softening by creep.
  UnderLoad(PlacedContact contact, std::shared_ptr<const SortedDrops> drops,
            std::shared_ptr<const YieldingElements> elements, YieldLaw law, const RestingPlane& plane,
            double pressure, double load, double factor)
      : BoxSolution(std::move(contact), std::move(drops), numbers_of(*elements, plane, pressure, load)),
        elements_(std::move(elements)),
        law_(std::move(law)),
        plane_(plane),
        factor_(factor),
        fits_(covered(plan().yield->carried, carried())) {}

  double plastic_volume() const override {
    return fits_ ? 0.0 : sum([](const Element& e) { return e.plastic; }) * cell();
  }
  std::optional<PlasticChange> plastic_change() const override;

  double stiffness() const override {
    const ElementLaw& law = elements_->law();
    const double elastic =
        law.rigid() ? 0 : law.stiffness * static_cast<double>(numbers().contacts - numbers().yielded);
    return (elastic + law.slope_past_yield() * static_cast<double>(numbers().yielded)) / nodes();
  }
  double energy() const override {
    return 0.5 * cell() * sum([](const Element& e) { return e.pressure * e.elastic; });
  }
  Certificate certificate() const override;
  SolutionError error() const override;
  PressureSplit split(double threshold) const override {
    PressureSplit result;
    result.above = count(*elements_, plane_,
                         [&](const Element& e) { return e.pressure > 0 && e.pressure >= threshold; });
    result.below = numbers().contacts - result.above;
    result.sum_below = sum([&](const Element& e) { return e.pressure < threshold ? e.pressure : 0.0; });
    return result;
  }

  Field pressure_field() const override { return field(pressure_of); }
  Field gap_field() const override {
    return field([](const Element& e) { return e.pressure > 0 ? 0.0 : std::max(0.0, -e.depth); });
  }
  Field displacement_field() const override {
    return field([](const Element& e) { return e.elastic; });
  }

 private:
  double mean_over_elements() const { return numbers().pressure / geometry().overlap_fraction(); }
  CarriedLoad carried() const { return {numbers().pressure, factor_}; }

  template <class Function>
  double sum_at(const RestingPlane& plane, Function function) const {
    return elements_->sum(
        [&](double drop, double yield) { return function(element(elements_->law(), plane, drop, yield)); });
  }
  template <class Function>
  double sum(Function function) const {
    return sum_at(plane_, function);
  }
  // In the lower body's frame; zero at NaN heights.
  template <class Function>
  Field field(Function function) const {
    Field result = geometry().combined();
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = function(element(elements_->law(), plane_, drops().peak() - result[k],
                                   law_.yield ? (*law_.yield)[k] : law_.cap));
    return result;
  }

  std::shared_ptr<const YieldingElements> elements_;
  YieldLaw law_;
  RestingPlane plane_;
  double factor_;
  bool fits_;  // this load was carried before, as placed
};

std::optional<PlasticChange> YieldingBoxSolver::UnderLoad::plastic_change() const {
  if (fits_ || numbers().yielded == 0) return {};
  PlasticChange change{field([](const Element& e) { return e.plastic; }), {}, carried()};
  if (range(change.approach.values()).max == 0) return {};
  if (law_.hardens())
    // At the reference dwell: a repeated press finds exactly this hardness.
    change.hardness = field([&](const Element& e) { return e.plastic > 0 ? e.pressure / factor_ : 0.0; });
  return change;
}

Certificate YieldingBoxSolver::UnderLoad::certificate() const {
  Certificate result;
  if (numbers().contacts == 0) {
    result.load = numbers().pressure > 0 ? 1 : 0;
    return result;
  }
  const double length = drops().rms() > 0 ? drops().rms() : std::max(approach(), drops().peak_to_valley());
  const double total = sum(pressure_of);
  result.load = std::abs(total / nodes() - numbers().pressure) / numbers().pressure;
  result.tension =
      greatest(*elements_, plane_, [](const Element& e) { return -e.pressure; }) / numbers().pressure;
  if (!law_.hardens())
    result.cap = greatest(*elements_, plane_,
                          [](const Element& e) { return std::max(0.0, e.pressure - e.yield) / e.yield; });
  if (!(length > 0)) return result;
  const auto gap = [](const Element& e) { return (e.elastic + e.plastic) - e.depth; };
  result.penetration = greatest(*elements_, plane_, [&](const Element& e) { return -gap(e); }) / length;
  result.complementarity =
      sum([&](const Element& e) { return e.pressure * std::max(0.0, gap(e)); }) / total / length;
  return result;
}

// As above, at two planes with certainly too little and too much load.
SolutionError YieldingBoxSolver::UnderLoad::error() const {
  SolutionError error{.load = 0.0};
  if (numbers().contacts == 0) return error;
  const double depth = approach(), least = std::numeric_limits<double>::denorm_min();
  const ElementLaw& law = elements_->law();
  double off = std::max(box_rounding * depth, 2 * least);
  const auto brackets = [&] {
    return elements_->mean_pressure(depth - off) <= mean_over_elements() * (1 - box_rounding) &&
           elements_->mean_pressure(depth + off) >= mean_over_elements() * (1 + box_rounding);
  };
  const double furthest = depth + drops().peak_to_valley() + law.depth_at_yield(numbers().peak_pressure);
  while (!brackets() && off < furthest) off *= 2;
  const RestingPlane low{depth - off, depth - off, 1}, high{depth + off, depth + off, 1};
  const auto between = [&](auto function) { return sum_at(high, function) - sum_at(low, function); };

  error.load = box_rounding * numbers().load +
               std::abs(sum(pressure_of) / nodes() - numbers().pressure) * geometry().grid().area();
  error.approach = off;
  error.mean_gap = (drops().remaining_gap(std::max(0.0, depth - off)) - drops().remaining_gap(depth + off)) /
                       static_cast<double>(drops().size()) +
                   box_rounding * mean_gap();
  error.energy = 0.5 * cell() * between([](const Element& e) { return e.pressure * e.elastic; }) +
                 box_rounding * energy();
  error.peak_pressure = std::max(0.0, greatest(*elements_, high, pressure_of) - numbers().peak_pressure) +
                        box_rounding * numbers().peak_pressure;
  error.plastic_volume =
      fits_ ? 0.0
            : cell() * between([](const Element& e) { return e.plastic; }) + box_rounding * plastic_volume();
  error.contacts = {count(*elements_, low, touches), count(*elements_, high, touches)};
  error.yielded = {count(*elements_, low, yields), count(*elements_, high, yields)};
  error.may_differ = error.contacts.high - error.contacts.low;
  return error;
}

YieldingBoxSolver::YieldingBoxSolver(const Plan& given, std::shared_ptr<const ContactGeometry> geometry)
    : Solver(given, std::move(geometry)) {
  const CostScope scope;
  const PlannedYield& yield = *plan().yield;
  if (yield.hardens()) hardness_ = local_hardness(*contact_.geometry, yield);
  drops_ = sorted_drops(*contact_.geometry);
  const ElementLaw law{plan().elasticity->modulus, yield.hardens() ? yield.hardening : 0};
  alike_ = std::make_shared<const YieldingElements>(law, drops_->drops(), yield.hardness());
  preparation_ = elasticity_alone(scope.so_far());
}

State YieldingBoxSolver::press(const PressRequest& request, Monitor&) const {
  check(request);
  const CostScope scope;
  const double height = geometry().peak_to_valley(), tile = geometry().grid().area();
  const double overlap = geometry().overlap_fraction();
  const double factor = plan().yield->softened(request.dwell);
  const YieldLaw law = yield_law(*plan().yield, hardness_, factor);
  const auto elements = this->elements(law);
  check_fraction(request, height);

  RestingPlane plane{-std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::denorm_min(),
                     1};
  double pressure = 0, load = 0;
  if (request.value > 0 && request.by_load()) {
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
  if (request.value > 0 && pressure < least * law.cap) refuse_tiny(request, "hardness");
  auto solution =
      std::make_shared<const UnderLoad>(contact_, drops_, elements, law, plane, pressure, load, factor);
  if (!std::isfinite(plane.high * plane.high * static_cast<double>(elements->size())) ||
      !std::isfinite(load) || !std::isfinite(solution->numbers().peak_pressure) ||
      !std::isfinite(solution->energy()))
    refuse_huge(request);
  const State state(std::move(solution), elasticity_alone(scope.so_far()));
  check_rounding(state, plan().accuracy);
  return state;
}

}  // namespace asperity
