// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/state.hpp"

#include <array>
#include <iterator>
#include <numbers>

#include "engine/contact/regions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/hdf5_surface.hpp"

namespace asperity {

namespace {

const std::array<std::string, 5> names_of_fields = {"pressure", "gap", "contact", "displacement", "plastic"};

// Forward, at facing nodes, not across the rim.
double combined_rms_slope(const ContactGeometry& geometry) {
  const Field& z = geometry.combined();
  const Grid& grid = geometry.grid();
  double squares = 0, nodes = 0;
  for (int j = 0; j + 1 < grid.ny; ++j)
    for (int i = 0; i + 1 < grid.nx; ++i) {
      const double along = (z(i + 1, j) - z(i, j)) / grid.hx(), up = (z(i, j + 1) - z(i, j)) / grid.hy();
      if (!std::isfinite(along) || !std::isfinite(up)) continue;
      squares += along * along + up * up;
      ++nodes;
    }
  return nodes > 0 ? std::sqrt(squares / nodes) : 0;
}

// Name and hardness.
std::pair<std::string, double> softer_body(const ContactGeometry& geometry) {
  const auto hardness = [](const Material* material) {
    return material != nullptr && !material->rigid ? material->hardness.value_or(infinity) : infinity;
  };
  const double lower = hardness(lower_material(geometry.lower())),
               upper = hardness(upper_material(geometry.upper()));
  return upper < lower ? std::pair("upper", upper) : std::pair("lower", lower);
}

// Empty without a warning, and for flats.
std::string cut_off_at_the_rim(const State& state) {
  const ContactGeometry& geometry = state.geometry();
  const Grid& grid = state.grid();
  if (state.plan().elasticity->is_local() || geometry.boundary() != Boundary::free ||
      !(geometry.peak_to_valley() > 0))
    return {};
  const auto contact = state.field("contact");
  const auto gap = state.plan().attracts() ? state.field("gap") : contact;
  double least = infinity;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; i += j == 0 || j == grid.ny - 1 ? 1 : std::max(grid.nx - 1, 1)) {
      if ((*contact)(i, j) > 0)
        return "the contact reaches the rim of the free tile, where the bodies end; press less, or give a "
               "larger tile";
      if (!std::isnan((*gap)(i, j))) least = std::min(least, std::max((*gap)(i, j), 0.0));
    }
  constexpr double noticeable = 0.01;  // of the traction at touch
  for (const GapTerm& term : state.plan().attraction)
    if (const double share = term.work > 0 ? term.traction(least) / term.greatest() : 0; share > noticeable)
      return quoted(term.effect) + " reaches the rim of the free tile, where the bodies end, with " +
             format_short(100 * share, 2) +
             " % of its greatest traction; take a larger tile or a shorter range";
  return {};
}

Hdf5Array field_array(const State& state, const std::string& name) {
  const std::shared_ptr<const Field> field = state.field(name);
  std::vector<std::size_t> shape{static_cast<std::size_t>(field->ny()),
                                 static_cast<std::size_t>(field->nx())};
  if (name == "contact") {
    Array<std::uint8_t> touching(field->size());
    for (std::size_t k = 0; k < touching.size(); ++k) touching[k] = (*field)[k] != 0 ? 1 : 0;
    return owning_array(name, std::move(shape), std::move(touching));
  }
  return {name, std::move(shape), field->values(), name == "pressure" ? "Pa" : "m", field};
}

// Without "plastic" unless something can yield.
std::vector<std::string> fields_of(const State& state) {
  const auto names = State::field_names();
  std::vector<std::string> fields(names.begin(), names.end());
  if (!state.yields()) std::erase(fields, "plastic");
  return fields;
}

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
  explicit Shared(std::shared_ptr<const Solution> of)
      : plan(of->shared_plan()),
        numbers(of->numbers()),
        tile(of->geometry().grid()),
        wraps(of->geometry().boundary() == Boundary::periodic),
        solution(std::move(of)) {}

  const std::shared_ptr<const Plan> plan;
  const Solution::Numbers numbers;
  const Grid tile;
  const bool wraps;

  Lazy<double> mean_gap, separation, energy, corrected, flatten, stiffness, plastic_volume;
  Lazy<Certificate> certificate;
  Lazy<AlgebraicError> algebraic_error;
  Lazy<std::vector<std::int64_t>> spot_sizes;
  Lazy<std::int64_t> spots8;
  Lazy<std::string> digest;
  std::array<Lazy<std::shared_ptr<const Field>>, 5> fields;

  mutable std::mutex mutex;                  // of the next member
  std::shared_ptr<const Solution> solution;  // none once closed

  // Throws Error{bad_state} if closed.
  std::shared_ptr<const Solution> open(std::string_view read) const {
    const std::lock_guard lock(mutex);
    if (solution) return solution;
    refuse_state(std::string(read) + " was not read before the contact was closed",
                 "read it before c:close(), or leave the contact open: Lua frees it with its last state");
  }
  Array<std::uint8_t> mask() const { return open("which nodes touch")->contact_mask(); }
  Array<std::int64_t> find_regions(Neighbours neighbours) const {
    return region_sizes(mask(), tile.nx, tile.ny, neighbours, wraps);
  }
  const Certificate& find_certificate() {
    return certificate.get([&] { return open("`certificate`")->certificate(); });
  }
  const std::string& find_digest() {
    return digest.get([&] {
      const std::shared_ptr<const Solution> known = open("the field `pressure`");
      Digester digester;
      digester.add("state").add(numbers.load).add(numbers.pressure).add(numbers.approach);
      digester.add(known->pressure_field().values());
      for (const auto& [effect, options] : plan->effects) {
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

State::State(std::shared_ptr<const Solution> solution, StateCost cost)
    : shared_(std::make_shared<Shared>(std::move(solution))),
      plan_(shared_->plan.get()),
      numbers_(&shared_->numbers),
      cost_(std::make_shared<const StateCost>(std::move(cost))) {}

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

State State::with_outline(double modulus) const {
  State result = *this;
  result.outline_.reset();
  if (!geometry().overhangs()) {
    const std::shared_ptr<const Solution> now = solution();
    result.outline_ = outline_area(now->pressure_field(), now->gap_field(), grid(), modulus, shared_->wraps,
                                   plan().elasticity->is_local() ? OutlineLaw::boxes
                                   : yields()                    ? OutlineLaw::capped
                                                                 : OutlineLaw::elastic);
  }
  return result;
}

void State::close(const Watch& watch) {
  const std::shared_ptr<Shared> shared = watch.lock();
  if (!shared) return;
  {
    const std::lock_guard lock(shared->mutex);
    if (!shared->solution) return;
  }
  shared->find_digest();
  shared->find_certificate();
  const std::lock_guard lock(shared->mutex);
  shared->solution.reset();
}
State::Watch State::watch() const { return shared_; }
std::shared_ptr<const Solution> State::solution() const { return shared_->open("the field `pressure`"); }

bool State::closed() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->solution == nullptr;
}

double State::stiffness() const {
  return shared_->stiffness.get([&] { return shared_->open("`stiffness`")->stiffness(); });
}
const Grid& State::grid() const { return shared_->tile; }
const ContactGeometry& State::geometry() const {
  return shared_->open("a property of the placed bodies")->geometry();
}
std::int64_t State::bytes_held() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->solution ? shared_->solution->bytes() : 0;
}
PressureSplit State::split(double threshold) const {
  return shared_->open("the pressure of each node")->split(threshold);
}
bool State::rests_on_few_nodes() const {
  constexpr std::int64_t few = 30;
  return !plan().elasticity->is_local() && contacts() > 0 && contacts() < few &&
         contacts() < geometry().facing();
}

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
  return shared_->flatten.get([&] { return shared_->open("`flatten`")->flatten(); });
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
  // Two periodic flats do not approach.
  return approach() == 0 && pressure() > 0 ? infinity : 0.0;
}
double State::area() const { return static_cast<double>(contacts()) * grid().cell_area(); }

double State::area_fraction() const {
  return static_cast<double>(contacts()) / static_cast<double>(grid().nodes());
}

double State::mean_gap() const {
  return shared_->mean_gap.get([&] { return shared_->open("`mean_gap`")->mean_gap(); });
}

double State::energy() const {
  return shared_->energy.get([&] { return shared_->open("`energy`")->energy(); });
}

const Certificate& State::certificate() const { return shared_->find_certificate(); }

const AlgebraicError& State::algebraic_error() const {
  return shared_->algebraic_error.get(
      [&] { return find_algebraic_error(*shared_->open("`error.algebraic`")); });
}

double State::corrected_area_fraction() const {
  if (outline_) return outline_->fraction;
  return shared_->corrected.get([&] {
    // Excess in cells of a touching node, counted whole, per edge, averaged over outline directions
    // (Yastrebov, Anciaux & Molinari 2017, Tribol. Int. 114, 161).
    constexpr double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24;
    const Grid& tile = grid();
    const BoundaryEdges edges = boundary_edges(shared_->mask(), tile.nx, tile.ny, shared_->wraps);
    // Edges between columns: length hy, width hx; between rows the reverse.
    const auto cells = static_cast<double>(edges.between_columns + edges.between_rows);
    return (static_cast<double>(contacts()) - excess * cells) / static_cast<double>(tile.nodes());
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
    areas.push_back(static_cast<double>(nodes) * grid().cell_area());
  return areas;
}

bool State::open_path(PathDirection along) const {
  return has_open_path(shared_->mask(), grid().nx, grid().ny, along, shared_->wraps);
}

const std::string& State::digest() const { return shared_->find_digest(); }

std::span<const std::string> State::field_names() { return names_of_fields; }

std::shared_ptr<const Field> State::field(std::string_view name) const {
  const auto found = std::find(names_of_fields.begin(), names_of_fields.end(), name);
  if (found == names_of_fields.end())
    refuse_name("a state has no field " + quoted(name) + did_you_mean(name, names_of_fields),
                "fields are " + joined(names_of_fields, " and "));
  if (name == "plastic" && !yields())
    refuse_without("the field `plastic`", effects_that(Effect::Acts::bounds_pressure),
                   "there is no plastic change without it");
  const auto which = static_cast<std::size_t>(found - names_of_fields.begin());
  return shared_->fields[which].get([&] {
    if (name == "contact") {
      const Array<std::uint8_t> mask = shared_->mask();
      Field contact(grid().nx, grid().ny);
      std::copy(mask.begin(), mask.end(), contact.values().begin());
      return std::make_shared<const Field>(std::move(contact));
    }
    const std::shared_ptr<const Solution> now = shared_->open("the field " + quoted(name));
    if (name == "pressure") return std::make_shared<const Field>(now->pressure_field());
    if (name == "displacement") return std::make_shared<const Field>(now->displacement_field());
    if (name == "plastic") {
      std::optional<PlasticChange> change = now->plastic_change();
      return std::make_shared<const Field>(change ? std::move(change->approach)
                                                  : Field(grid().nx, grid().ny));
    }
    Field gap = now->gap_field();
    if (now->geometry().overhangs()) {
      const Field& heights = now->geometry().combined();
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (std::isnan(heights[k])) gap[k] = std::numeric_limits<double>::quiet_NaN();
    }
    return std::make_shared<const Field>(std::move(gap));
  });
}

Surface State::deformed(std::string_view body) const {
  const ContactGeometry& bodies = geometry();
  SurfaceTraits traits;
  if (body == "lower") {
    traits.material = bodies.lower().material();
    traits.periodic = bodies.lower().traits().periodic;
    return Surface(bodies.grid(), solution()->lower_under_load(), std::move(traits));
  }
  if (body != "upper") refuse_name("a contact has no body " + quoted(body), "give \"lower\" or \"upper\"");
  if (const Material* material = upper_material(bodies.upper())) traits.material = *material;
  const auto* rough = std::get_if<Surface>(&bodies.upper());
  traits.periodic = rough ? rough->traits().periodic : true;
  return Surface(bodies.grid(), solution()->upper_under_load(), std::move(traits));
}

Histogram State::distribution(std::string_view name, const HistogramOptions& options) const {
  static const std::array<std::string, 3> known = {"pressure", "gap", "spot_area"};
  if (std::find(known.begin(), known.end(), name) == known.end())
    refuse_name("a state has no distribution " + quoted(name) + did_you_mean(name, known),
                "distributions are " + joined(known, " and "));
  if (name == "spot_area") {
    const std::vector<double> areas = spot_areas();
    if (areas.empty()) refuse_state("no node touches, so there are no spots to distribute");
    return make_histogram(areas, options);
  }
  const std::shared_ptr<const Field> values = field(name);
  Array<double> positive;
  std::copy_if(values->values().begin(), values->values().end(), std::back_inserter(positive),
               [](double value) { return value > 0; });
  if (positive.empty())
    refuse_state(name == "gap" ? "every node touches, so there are no gaps to distribute"
                               : "no node touches, so there are no pressures to distribute");
  return make_histogram(positive, options);
}

double State::plastic_volume() const {
  return shared_->plastic_volume.get([&] { return shared_->open("`plastic_volume`")->plastic_volume(); });
}

double State::plastic_fraction() const {
  return static_cast<double>(numbers_->yielded) / static_cast<double>(grid().nodes());
}

std::optional<PlasticChange> State::plastic_change() const {
  return shared_->open("what yielded")->plastic_change();
}

std::string State::text(const std::string& of_the_cells) const {
  if (closed())
    return "contact under " + format_quantity(pressure(), dimension::pressure) + ": approach " +
           format_quantity(approach(), dimension::length) + ", since closed";
  const AlgebraicError& error = algebraic_error();
  const bool few = rests_on_few_nodes();  // the solver's bound then misleads
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
            " of " + std::to_string(grid().nodes()) + " nodes" +
            (overlap_fraction() < 1 ? ", of which the bodies face each other on " +
                                          format_short(100 * overlap_fraction(), 3) + " %"
                                    : std::string()) +
            ", energy " + within(energy(), error.energy, dimension::energy);
  if (error.plastic_volume)
    result += ", plastic volume " + within(plastic_volume(), *error.plastic_volume, dimension::volume) +
              " with " + format_short(100 * plastic_fraction(), 3) + " % of the tile at the limit";
  // The solver does not know the discretisation error.
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
         format_short(static_cast<double>(total.bytes) / mebibyte, 3) + " MiB; " + solver();
}

std::vector<std::string> state_limits(const State& state) {
  const ContactGeometry& geometry = state.geometry();
  std::vector<std::string> sentences;
  if (state.rests_on_few_nodes())
    sentences.push_back(
        "only " + std::to_string(state.contacts()) +
        (state.contacts() == 1 ? " node touches" : " nodes touch") +
        ", so the result depends on the cells: press harder, or take finer cells on a smaller tile");
  if (std::string cut = cut_off_at_the_rim(state); !cut.empty()) sentences.push_back(std::move(cut));
  if (state.load() <= 0) return sentences;
  constexpr double steep = 1;
  if (const double slope = combined_rms_slope(geometry); slope > steep)
    sentences.push_back("the combined heights have an rms slope of " + format_short(slope, 3) +
                        ", and the theory holds for slopes well below 1");
  constexpr double large = 0.5;
  if (const auto compliance = contact_compliance(geometry); compliance && *compliance > 0)
    if (const double times = state.pressure() * *compliance; times > large)
      sentences.push_back("the mean pressure is " + format_short(times, 3) +
                          " times the contact modulus, and the theory holds for small strains");
  if (!state.yields()) {
    const auto [softer, hardness] = softer_body(geometry);
    constexpr double rounding = 1e-9;
    if (const double times = state.peak_pressure() / hardness; times > 1 + rounding)
      sentences.push_back("the peak pressure is " + format_short(times, 3) + " times the hardness of the " +
                          softer + " body, " + format_quantity(hardness, dimension::pressure) +
                          ": it would yield, and this scene does not name " +
                          effects_that(Effect::Acts::bounds_pressure));
  }
  return sentences;
}

void write_state(const State& state, const std::filesystem::path& path, std::vector<std::string> fields) {
  const std::string extension = file_extension(path.string());
  if (extension != "h5" && extension != "hdf5")
    refuse_bad_file("cannot write a state to " + file_name(path.string()),
                    "its fields go into one HDF5 file: use .h5");
  if (fields.empty()) fields = fields_of(state);
  Hdf5Content content;
  content.texts = {{"content", "asperity state"},
                   {"digest", state.digest()},
                   {"solver", state.solver()},
                   {"units", "SI: load N, pressure Pa, approach m, area m^2, the certificate relative"}};
  const Certificate& c = state.certificate();
  content.numbers = {{"load", state.load()},
                     {"pressure", state.pressure()},
                     {"approach", state.approach()},
                     {"area", state.area()},
                     {"area_fraction", state.area_fraction()},
                     {"certificate", c.worst()},
                     {"certificate penetration", c.penetration},
                     {"certificate tension", c.tension},
                     {"certificate complementarity", c.complementarity},
                     {"certificate load", c.load},
                     {"certificate cap", c.cap},
                     {"certificate attraction", c.attraction}};
  if (state.overlap_fraction() < 1)
    content.numbers.emplace_back("overlap_fraction", state.overlap_fraction());
  for (const std::string& name : fields) content.arrays.push_back(field_array(state, name));
  content.arrays.push_back(tile_size(state.grid()));
  write_hdf5_and_xdmf(path, state.grid(), "state", content);
}

}  // namespace asperity
