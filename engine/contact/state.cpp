// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>
#include <numbers>

#include "engine/contact/plan.hpp"
#include "engine/contact/regions.hpp"
#include "engine/contact/scene/elastic_model.hpp"
#include "engine/contact/solution.hpp"
#include "engine/contact/state_limits.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Failures are not cached: the next call tries again.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(Make make) {
    std::call_once(once_, [&] { value_ = make(); });
    return value_;
  }

 private:
  std::once_flag once_;
  T value_{};
};

const std::array<std::string, 5> names_of_fields = {"pressure", "gap", "contact", "displacement", "plastic"};

}  // namespace

StateCost elasticity_alone(const Cost& cost) { return {cost, {{std::string(elasticity_effect), cost}}}; }

StateCost& StateCost::operator+=(const StateCost& other) {
  total += other.total;
  for (const auto& entry : other.by_effect) {
    const auto mine = std::find_if(by_effect.begin(), by_effect.end(),
                                   [&](const auto& e) { return e.first == entry.first; });
    if (mine == by_effect.end())
      by_effect.push_back(entry);
    else
      mine->second += entry.second;
  }
  return *this;
}

struct State::Shared {
  Grid tile;
  bool periodic = false;
  double overlap = 1;
  double tolerance;
  std::vector<std::string> effects_run, effects_off;
  Effects effects;
  bool moves_every_node = false;
  std::vector<GapTerm> attraction;
  bool yields = false;

  Lazy<double> mean_gap, separation, energy, corrected, flatten, stiffness, plastic_volume;
  Lazy<Certificate> certificate;
  Lazy<AlgebraicError> algebraic_error;
  Lazy<std::vector<std::int64_t>> spot_sizes;
  Lazy<std::int64_t> spots8;
  Lazy<std::string> digest;
  std::array<Lazy<std::shared_ptr<const Field>>, 5> fields;

  mutable std::mutex mutex;                  // of the members below
  std::shared_ptr<const Solution> solution;  // a ClosedSolution once closed
  bool closed = false;

  const Grid& grid() const { return tile; }
  bool wraps() const { return periodic; }

  std::shared_ptr<const Solution> now() const {
    const std::lock_guard lock(mutex);
    return solution;
  }
  Array<std::int64_t> find_regions(Neighbours neighbours) const {
    return region_sizes(now()->contact_mask(), grid().nx, grid().ny, neighbours, wraps());
  }
  const Certificate& find_certificate() {
    return certificate.get([&] { return now()->certificate(); });
  }
  const std::string& find_digest() {
    return digest.get([&] {
      const std::shared_ptr<const Solution> known = now();
      Digester digester;
      digester.add("state").add(known->load()).add(known->pressure()).add(known->approach());
      digester.add(known->pressure_field().values());
      for (const auto& [effect, options] : effects) {
        if (effect->acts != Effect::Acts::reads_state || effect->keeps.empty()) continue;
        const MetMemory memory = met(known->geometry(), known->geometry().kept(effect->keeps), 0);
        for (const auto& body : {memory.lower, memory.upper})
          if (body) digester.add(effect->keeps).add(body->values());
      }
      return digester.hex();
    });
  }
  const std::vector<std::int64_t>& sizes_of_spots() {
    return spot_sizes.get([&] {
      const Array<std::int64_t> sizes = find_regions(Neighbours::four);
      std::vector<std::int64_t> sorted(sizes.begin(), sizes.end());
      std::sort(sorted.begin(), sorted.end(), std::greater<>());
      return sorted;
    });
  }
};

State::State(std::shared_ptr<const Solution> solution, const Plan& plan, StateCost cost)
    : shared_(std::make_shared<Shared>()), cost_(std::make_shared<const StateCost>(std::move(cost))) {
  shared_->tile = solution->geometry().grid();
  shared_->periodic = solution->geometry().boundary() == Boundary::periodic;
  shared_->overlap = solution->geometry().overlap_fraction();
  shared_->solution = std::move(solution);
  shared_->tolerance = plan.accuracy.tolerance;
  shared_->effects_run = plan.effects_run;
  shared_->effects_off = plan.effects_off;
  shared_->effects = plan.effects;
  shared_->moves_every_node = plan.model != nullptr && plan.model->moves_every_node;
  std::ranges::copy_if(plan.attraction, std::back_inserter(shared_->attraction),
                       [](const GapTerm& term) { return term.work > 0; });
  shared_->yields = plan.yield.has_value();
}

State State::costing_also(const StateCost& more) const {
  State result = *this;
  StateCost sum = *cost_;
  sum += more;
  result.cost_ = std::make_shared<const StateCost>(std::move(sum));
  return result;
}

State State::beside(std::shared_ptr<const CompanionGrids> companion_grids) const {
  State result = *this;
  result.companion_grids_ = std::move(companion_grids);
  return result;
}

State State::chosen_as(std::shared_ptr<const ChosenAccuracy> chosen) const {
  State result = *this;
  result.chosen_ = std::move(chosen);
  return result;
}

State State::with_outline(double modulus, bool boxes) const {
  State result = *this;
  result.outline_.reset();
  if (!geometry().overhangs()) {
    const std::shared_ptr<const Solution> solution = shared_->now();
    result.outline_ =
        outline_area(solution->pressure_field(), solution->gap_field(), grid(), modulus, shared_->wraps(),
                     boxes             ? OutlineLaw::boxes
                     : shared_->yields ? OutlineLaw::capped
                                       : OutlineLaw::elastic);
  }
  return result;
}

void State::close(const Watch& watch) {
  const std::shared_ptr<Shared> shared = watch.lock();
  if (!shared) return;
  shared->find_digest();
  shared->find_certificate();
  const std::lock_guard lock(shared->mutex);
  if (std::exchange(shared->closed, true)) return;
  shared->solution = std::make_shared<const ClosedSolution>(*shared->solution);
}
State::Watch State::watch() const { return shared_; }
std::shared_ptr<const Solution> State::solution() const { return shared_->now(); }

bool State::closed() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->closed;
}

double State::load() const { return shared_->now()->load(); }
double State::pressure() const { return shared_->now()->pressure(); }
double State::attraction() const { return shared_->now()->attraction(); }
std::vector<double> State::preload() const {
  const std::shared_ptr<const Solution> solution = shared_->now();
  const std::span<const double> turns = solution->preload();
  return {turns.begin(), turns.end()};
}
double State::approach() const { return shared_->now()->approach(); }
std::int64_t State::contacts() const { return shared_->now()->contacts(); }
double State::peak_pressure() const { return shared_->now()->peak_pressure(); }
double State::stiffness() const {
  return shared_->stiffness.get([&] { return shared_->now()->stiffness(); });
}
int State::iterations() const { return shared_->now()->iterations(); }
std::string State::solver() const { return std::string(shared_->now()->solver()); }
const Grid& State::grid() const { return shared_->grid(); }
const ContactGeometry& State::geometry() const { return shared_->now()->geometry(); }
std::int64_t State::bytes_held() const { return shared_->now()->bytes(); }
PressureSplit State::split(double threshold) const { return shared_->now()->split(threshold); }
const std::vector<std::string>& State::effects_run() const { return shared_->effects_run; }
const std::vector<std::string>& State::effects_off() const { return shared_->effects_off; }
const Effects& State::effects() const { return shared_->effects; }
bool State::yields() const { return shared_->yields; }
const StateCost& State::cost() const { return *cost_; }
bool State::moves_every_node() const { return shared_->moves_every_node; }
const std::vector<GapTerm>& State::attraction_terms() const { return shared_->attraction; }
bool State::converged() const { return residual() <= shared_->tolerance; }

double State::indentation() const {
  if (!(approach() > 0)) return 0;
  const double height = geometry().peak_to_valley();
  if (!(height > 0))
    throw Error(
        ErrorCode::bad_state,
        "`indentation` is a fraction of a peak-to-valley that is zero: all combined heights are equal",
        "read `approach`");
  return approach() / height;
}
double State::flatten() const {
  return shared_->flatten.get([&] { return shared_->now()->flatten(); });
}
double State::separation() const {
  return shared_->separation.get([&] {
    const ContactGeometry& bodies = geometry();
    const double before = bodies.combined_range().max - known_mean(bodies.combined().values()) - approach();
    if (!(plastic_volume() > 0)) return before;
    return before + plastic_volume() / (static_cast<double>(bodies.facing()) * bodies.grid().cell_area());
  });
}
double State::displacement() const {
  return geometry().first_touch() - geometry().combined_range().max + approach();
}
double State::secant_stiffness() const {
  if (approach() > 0) return pressure() / approach();
  // Two flats on a periodic tile do not approach under load.
  return approach() == 0 && pressure() > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}
double State::area() const { return static_cast<double>(contacts()) * shared_->grid().cell_area(); }

double State::area_fraction() const {
  return static_cast<double>(contacts()) / static_cast<double>(shared_->grid().nodes());
}

double State::overlap_fraction() const { return shared_->overlap; }

double State::mean_gap() const {
  return shared_->mean_gap.get([&] { return shared_->now()->mean_gap(); });
}

double State::energy() const {
  return shared_->energy.get([&] { return shared_->now()->energy(); });
}

const Certificate& State::certificate() const { return shared_->find_certificate(); }

const AlgebraicError& State::algebraic_error() const {
  return shared_->algebraic_error.get([&] { return find_algebraic_error(*shared_->now(), shared_->yields); });
}

double State::corrected_area_fraction() const {
  if (outline_) return outline_->fraction;
  return shared_->corrected.get([&] {
    // Excess of a touching node, counted as a whole cell, per edge, averaged over outline directions, in
    // cells (Yastrebov, Anciaux & Molinari 2017, "On the accurate computation of the true contact-area").
    constexpr double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24;
    const Grid& grid = shared_->grid();
    const BoundaryEdges edges =
        boundary_edges(shared_->now()->contact_mask(), grid.nx, grid.ny, shared_->wraps());
    // Edges between columns have length hy and width hx, edges between rows the reverse.
    const auto cells = static_cast<double>(edges.between_columns + edges.between_rows);
    return (static_cast<double>(contacts()) - excess * cells) / static_cast<double>(grid.nodes());
  });
}

std::int64_t State::spots() const { return static_cast<std::int64_t>(shared_->sizes_of_spots().size()); }

std::int64_t State::spots8() const {
  return shared_->spots8.get(
      [&] { return static_cast<std::int64_t>(shared_->find_regions(Neighbours::eight).size()); });
}

std::vector<double> State::spot_areas() const {
  std::vector<double> areas;
  for (const std::int64_t nodes : shared_->sizes_of_spots())
    areas.push_back(static_cast<double>(nodes) * shared_->grid().cell_area());
  return areas;
}

const std::string& State::digest() const { return shared_->find_digest(); }

std::span<const std::string> State::field_names() { return names_of_fields; }

std::shared_ptr<const Field> State::field(std::string_view name) const {
  const auto found = std::find(names_of_fields.begin(), names_of_fields.end(), name);
  if (found == names_of_fields.end())
    throw Error(ErrorCode::unknown_name,
                "a state has no field " + quoted(name) + did_you_mean(name, names_of_fields),
                "fields are " + joined(names_of_fields, " and "));
  if (name == "plastic" && !shared_->yields)
    refuse_without("the field `plastic`", effects_that(Effect::Acts::bounds_pressure),
                   "there is no plastic change without it");
  const auto which = static_cast<std::size_t>(found - names_of_fields.begin());
  return shared_->fields[which].get([&] {
    const std::shared_ptr<const Solution> now = shared_->now();
    const Solution& solution = *now;
    if (name == "pressure") return std::make_shared<const Field>(solution.pressure_field());
    if (name == "gap") {
      Field gap = solution.gap_field();
      if (solution.geometry().overhangs()) {
        const Field& heights = solution.geometry().combined();
        for (std::size_t k = 0; k < gap.size(); ++k)
          if (std::isnan(heights[k])) gap[k] = std::numeric_limits<double>::quiet_NaN();
      }
      return std::make_shared<const Field>(std::move(gap));
    }
    if (name == "displacement") return std::make_shared<const Field>(solution.displacement_field());
    if (name == "plastic") {
      std::optional<PlasticChange> change = solution.plastic_change();
      return std::make_shared<const Field>(change ? std::move(change->approach)
                                                  : Field(shared_->grid().nx, shared_->grid().ny));
    }
    Field contact(shared_->grid().nx, shared_->grid().ny);
    const Array<std::uint8_t> mask = solution.contact_mask();
    std::copy(mask.begin(), mask.end(), contact.values().begin());
    return std::make_shared<const Field>(std::move(contact));
  });
}

Surface State::deformed(std::string_view body) const {
  const ContactGeometry& bodies = geometry();
  SurfaceTraits traits;
  if (body == "lower") {
    traits.material = bodies.lower().material();
    traits.periodic = bodies.lower().traits().periodic;
    return Surface(bodies.grid(), shared_->now()->lower_under_load(), std::move(traits));
  }
  if (body != "upper")
    throw Error(ErrorCode::unknown_name, "a contact has no body " + quoted(body),
                "give \"lower\" or \"upper\"");
  if (const Material* material = upper_material(bodies.upper())) traits.material = *material;
  const auto* rough = std::get_if<Surface>(&bodies.upper());
  traits.periodic = rough ? rough->traits().periodic : true;
  return Surface(bodies.grid(), shared_->now()->upper_under_load(), std::move(traits));
}

Histogram State::distribution(std::string_view name, const HistogramOptions& options) const {
  static const std::array<std::string, 3> known = {"pressure", "gap", "spot_area"};
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error(ErrorCode::unknown_name,
                "a state has no distribution " + quoted(name) + did_you_mean(name, known),
                "distributions are " + joined(known, " and "));
  if (name == "spot_area") {
    const std::vector<double> areas = spot_areas();
    if (areas.empty())
      throw Error(ErrorCode::bad_state, "no node touches, so there are no spots to distribute");
    return make_histogram(areas, options);
  }
  const std::shared_ptr<const Field> values = field(name);
  Array<double> positive;
  std::copy_if(values->values().begin(), values->values().end(), std::back_inserter(positive),
               [](double value) { return value > 0; });
  if (positive.empty())
    throw Error(ErrorCode::bad_state, name == "gap"
                                          ? "every node touches, so there are no gaps to distribute"
                                          : "no node touches, so there are no pressures to distribute");
  return make_histogram(positive, options);
}

double State::plastic_volume() const {
  return shared_->plastic_volume.get([&] { return shared_->now()->plastic_volume(); });
}

double State::plastic_fraction() const {
  return static_cast<double>(shared_->now()->yielded()) / static_cast<double>(shared_->grid().nodes());
}

std::optional<PlasticChange> State::plastic_change() const { return shared_->now()->plastic_change(); }

std::string State::text(const std::string& of_the_cells) const {
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->closed)
      return "contact under " + format_quantity(shared_->solution->pressure(), dimension::pressure) +
             ": approach " + format_quantity(shared_->solution->approach(), dimension::length) +
             ", since closed";
  }
  const AlgebraicError& error = algebraic_error();
  // In the unit of the value.
  const bool few = rests_on_few_nodes(*this);  // the solver's bound then misleads
  const auto within = [few](double value, double by, Dimension dimension) {
    if (few || !std::isfinite(by)) return format_quantity(value, dimension);
    const DisplayUnit unit = display_unit(std::abs(value), dimension);
    return format_short(value / unit.factor, 4) + " ± " + format_short(by / unit.factor, 2) + " " + unit.name;
  };
  std::string result = "contact under ";
  if (error.pressure && *error.pressure > 1e-12 * std::abs(pressure()))
    result += within(pressure(), *error.pressure, dimension::pressure);
  else
    result += format_quantity(pressure(), dimension::pressure);
  result += " (" + format_quantity(load(), dimension::force) + "): approach " +
            within(approach(), error.approach, dimension::length) + ", area fraction " +
            format_short(area_fraction(), 4) +
            (!few && (error.contact_bracket.low > 0 || error.contact_bracket.high < error.nodes)
                 ? " ± " + format_short(error.area_fraction, 2)
                 : std::string()) +
            " of " + std::to_string(shared_->grid().nodes()) + " nodes" +
            (overlap_fraction() < 1 ? ", of which the bodies face each other on " +
                                          format_short(100 * overlap_fraction(), 3) + " %"
                                    : std::string()) +
            ", energy " + within(energy(), error.energy, dimension::energy);
  if (error.plastic_volume)
    result += ", plastic volume " + within(plastic_volume(), *error.plastic_volume, dimension::volume) +
              " with " + format_short(100 * plastic_fraction(), 3) + " % of the tile at the limit";
  // The solver does not know the discretisation error, mostly the greatest part.
  if (result.find("±") != std::string::npos)
    result += of_the_cells.empty()
                  ? "; ± is the solver's alone: cells, seed and inputs are not in it"
                  : "; ± is the solver's alone, " + of_the_cells + "; seed and inputs are in neither";
  else if (!of_the_cells.empty())
    result += "; " + of_the_cells;
  const Cost& total = cost().total;
  constexpr double mebibyte = 1 << 20;
  return result + "; residual " + format_short(residual(), 2) + (converged() ? "" : " (not converged)") +
         "; " + format_quantity(total.seconds, dimension::time, 3) + ", " +
         format_short(total.transforms, 4) + " transforms, " +
         format_short(static_cast<double>(total.bytes) / mebibyte, 3) + " MiB; " + std::string(solver());
}

}  // namespace asperity
