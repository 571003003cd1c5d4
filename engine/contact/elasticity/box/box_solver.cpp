// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/box_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

struct BoxSolver::Ready {
  std::shared_ptr<const ContactGeometry> geometry;
  BoxOperator box;
  SortedDrops drops;

  Ready(std::shared_ptr<const ContactGeometry> g, const BoxOperator& b)
      : geometry(std::move(g)),
        box(b),
        drops(geometry->overhangs() ? SortedDrops(geometry->facing_heights())
                                    : SortedDrops(geometry->combined().values())) {}
};

class BoxSolver::UnderLoad final : public Solution {
 public:
  UnderLoad(std::shared_ptr<const Ready> ready, const Load& load)
      : ready_(std::move(ready)), at_(load), touched_(drops().touched(load.approach)) {}

  const ContactGeometry& geometry() const override { return *ready_->geometry; }
  double load() const override { return at_.load; }
  double pressure() const override { return at_.pressure; }
  double approach() const override { return at_.approach; }
  std::int64_t contacts() const override { return static_cast<std::int64_t>(touched_); }
  double peak_pressure() const override { return ready_->box.stiffness * at_.approach; }
  double stiffness() const override {
    return ready_->box.stiffness * (static_cast<double>(touched_) / nodes());
  }
  double flatten() const override {
    return drops().peak_to_valley() > 0 ? std::min(1.0, at_.approach / drops().peak_to_valley()) : 0.0;
  }
  int iterations() const override { return 0; }
  std::string_view solver() const override { return "closed form (sorted heights)"; }

  double mean_gap() const override {
    return drops().remaining_gap(at_.approach) / static_cast<double>(drops().size());
  }
  double energy() const override {
    return 0.5 * ready_->box.stiffness * drops().squared_shortening(at_.approach) *
           geometry().grid().cell_area();
  }
  Certificate certificate() const override;
  SolutionError error() const override;
  PressureSplit split(double threshold) const override;

  Array<std::uint8_t> contact_mask() const override {
    const std::span<const double> h = geometry().combined().values();
    Array<std::uint8_t> mask(h.size());
    std::transform(h.begin(), h.end(), mask.begin(),
                   [&](double z) { return static_cast<std::uint8_t>(drops().peak() - z < at_.approach); });
    return mask;
  }
  Field pressure_field() const override {
    return from_heights([&](double h) { return ready_->box.stiffness * shortening(h); });
  }
  Field gap_field() const override {
    return from_heights([&](double h) { return std::max(0.0, (drops().peak() - h) - at_.approach); });
  }
  Field displacement_field() const override {
    return from_heights([&](double h) { return shortening(h); });
  }
  Field lower_under_load() const override;
  Field upper_under_load() const override;

 private:
  // Drops of facing nodes only.
  const SortedDrops& drops() const { return ready_->drops; }
  double nodes() const { return static_cast<double>(geometry().grid().nodes()); }
  // 0 at NaN heights (no counterpart).
  double shortening(double h) const { return std::max(0.0, at_.approach - (drops().peak() - h)); }
  template <class Function>
  Field from_heights(Function function) const {
    Field result = geometry().combined();
    for (double& value : result.values()) value = function(value);
    return result;
  }

  std::shared_ptr<const Ready> ready_;
  Load at_;
  std::size_t touched_;
};

Certificate BoxSolver::UnderLoad::certificate() const {
  Certificate result;
  if (touched_ == 0) {
    // The whole load is missing.
    result.load = at_.pressure > 0 ? 1 : 0;
    return result;
  }
  const double k = ready_->box.stiffness;
  const std::span<const double> g = drops().drops();
  auto pressure_at = [&](std::size_t i) { return k * (at_.approach - g[i]); };
  auto gap_at = [&](std::size_t i) { return (g[i] - at_.approach) + pressure_at(i) / k; };

  double least_gap =
      touched_ < g.size() ? g[touched_] - at_.approach : std::numeric_limits<double>::infinity();
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
  const double length = drops().rms() > 0 ? drops().rms() : at_.approach;
  const double mean = total.value() / nodes();
  result.penetration = std::max(0.0, -least_gap) / length;
  result.tension = -least_pressure / at_.pressure;
  result.complementarity = apart.value() / total.value() / length;
  result.load = std::abs(mean - at_.pressure) / at_.pressure;
  return result;
}

// Every quantity is monotone in the approach: the bounds are the values at both ends of its rounding
// interval.
SolutionError BoxSolver::UnderLoad::error() const {
  SolutionError error{.load = 0.0};
  if (!(at_.approach > 0)) return error;
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double k = ready_->box.stiffness, facing = static_cast<double>(drops().size());
  const double cell = geometry().grid().cell_area(), depth = at_.approach;
  const double wanted = at_.pressure / k * nodes();
  double off =
      rounding * depth + std::abs(drops().shortening(depth) - wanted) / static_cast<double>(touched_);
  const auto low = [&] { return std::max(0.0, depth - off); };
  const auto brackets = [&] {
    return drops().shortening(low()) <= wanted * (1 - rounding) &&
           drops().shortening(depth + off) >= wanted * (1 + rounding);
  };
  while (off < depth && !brackets()) off *= 2;
  const double high = depth + off;
  error.load = rounding * at_.load + k * std::abs(drops().shortening(depth) - wanted) * cell;
  error.approach = off;
  error.mean_gap =
      (drops().remaining_gap(low()) - drops().remaining_gap(high)) / facing + rounding * mean_gap();
  error.energy = 0.5 * k * cell * (drops().squared_shortening(high) - drops().squared_shortening(low())) +
                 rounding * energy();
  error.peak_pressure = k * off + rounding * peak_pressure();
  error.contacts = {static_cast<std::int64_t>(drops().touched(low())),
                    static_cast<std::int64_t>(drops().touched(high))};
  error.may_differ = error.contacts.high - error.contacts.low;
  return error;
}

PressureSplit BoxSolver::UnderLoad::split(double threshold) const {
  const double k = ready_->box.stiffness;
  const std::span<const double> touched = drops().drops().first(touched_);
  auto pressure = [&](double drop) { return k * (at_.approach - drop); };
  const auto first_below = std::partition_point(touched.begin(), touched.end(),
                                                [&](double drop) { return pressure(drop) >= threshold; });
  PressureSplit result;
  result.above = first_below - touched.begin();
  result.below = touched.end() - first_below;
  if (result.above == 0) {
    result.sum_below = k * drops().shortening(at_.approach);
    return result;
  }
  // Summed directly: a difference of two large sums would lose a small rest.
  Accumulator sum;
  for (auto drop = first_below; drop != touched.end(); ++drop) sum.add(pressure(*drop));
  result.sum_below = sum.value();
  return result;
}

Field BoxSolver::UnderLoad::lower_under_load() const {
  Field z = geometry().lower().heights();
  const double share = ready_->box.lower_share;
  if (share == 1 && geometry().upper_is_flat()) {
    // Cut by the plane itself: touching nodes are exactly flat.
    const double plane = drops().peak() - at_.approach;
    for (double& height : z.values()) height = std::min(height, plane);
    return z;
  }
  if (share == 0) return z;
  const Field& h = geometry().combined();
  for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * shortening(h[k]);
  return z;
}

Field BoxSolver::UnderLoad::upper_under_load() const {
  const auto* rough = std::get_if<Surface>(&geometry().upper());
  const Grid& grid = geometry().grid();
  Field z = rough ? rough->heights() : Field(grid.nx, grid.ny);
  const double share = 1 - ready_->box.lower_share;
  if (share == 0) return z;
  const Field own = geometry().pose().to_upper(displacement_field(), grid);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] -= share * own[k];
  return z;
}

BoxSolver::BoxSolver(const Plan& plan, const BoxOperator& box,
                     std::shared_ptr<const ContactGeometry> geometry)
    : Solver(plan, std::move(geometry)) {
  const CostScope scope;
  ready_ = std::make_shared<const Ready>(geometry_, box);
  preparation_ = elasticity_alone(scope.so_far());
}

BoxSolver::Load BoxSolver::resolve(const PressRequest& request) const {
  const double k = ready_->box.stiffness;
  const SortedDrops& drops = ready_->drops;
  const auto nodes = static_cast<double>(geometry().grid().nodes());
  const double tile = geometry().grid().area();
  const bool by_depth =
      request.by == PressBy::approach || request.by == PressBy::indentation || request.by == PressBy::flatten;
  if (request.value == 0) return {0, 0, 0};

  Load result{};
  if (by_depth) {
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

  const std::string asked = quoted(name(request.by)) + " is " + format_short(request.value);
  constexpr double least = 1e-280;  // of the modulus
  if (result.pressure < least * ready_->box.reference_pressure ||
      result.approach < std::numeric_limits<double>::min())
    refuse(asked + ", a pressure under 1e-280 of the modulus: too small to mean anything",
           "give zero for no load, or check its unit");
  // The squared approach in the energy overflows first.
  const double square = result.approach * result.approach;
  if (!std::isfinite(square * nodes) || !std::isfinite(k * square * tile) ||
      !std::isfinite(k * result.approach) || !std::isfinite(result.load) || !std::isfinite(result.pressure))
    refuse(asked + ", so large that the numbers of the solution leave the range of a double",
           "check its unit");
  return result;
}

State BoxSolver::press(const PressRequest& request, Monitor&) const {
  check(request);
  const CostScope scope;
  const Load load = resolve(request);
  auto solution = std::make_shared<const UnderLoad>(ready_, load);
  const State state(solution, plan_, elasticity_alone(scope.so_far()));

  // Rounding leaves an ulp of the depth in each gap and at each touched node of the sum. The certificate is
  // computed here only if this bound exceeds the tolerance.
  const SortedDrops& drops = ready_->drops;
  const double length = drops.rms() > 0 ? drops.rms() : load.approach;
  const double bound =
      4 * std::numeric_limits<double>::epsilon() *
      std::max(load.approach * solution->stiffness() / load.pressure, load.approach / length);
  if (load.approach > 0 && bound > plan_.accuracy.tolerance) check_rounding(state, plan_.accuracy);
  return state;
}

void check_rounding(const State& state, const Accuracy& accuracy) {
  if (accuracy.on_failure == Accuracy::OnFailure::error && !state.converged())
    throw Error(ErrorCode::not_converged,
                "the residual of the closed form is " + format_short(state.residual(), 3) +
                    ", above the `tolerance` of " + format_short(accuracy.tolerance),
                "it is rounding that remains; raise `tolerance` or set `on_failure` to \"best\"");
}

}  // namespace asperity
