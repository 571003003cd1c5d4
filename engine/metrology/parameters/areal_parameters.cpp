// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/areal_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/metrology/spectrum.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

enum Term { edges_x, edges_y, crosses, cells, terms };

// Sum and count per kind of difference.
struct SlopeSums {
  std::array<double, terms> sum{}, count{};
  void add(Term term, double value) {
    if (std::isnan(value)) return;
    sum[term] += value;
    count[term] += 1;
  }
};

// √(1 + s²) - 1 without cancellation.
double excess(double squared) { return squared / (1 + std::sqrt(1 + squared)); }

class SlopesOfRows {
 public:
  explicit SlopesOfRows(const Surface& surface)
      : z_(surface.measured_heights()), hx_(surface.grid().hx()), hy_(surface.grid().hy()) {}

  SlopeSums row(int j) const {
    SlopeSums sums;
    const std::span<const double> here = z_.row(j);
    const bool last = j + 1 == z_.ny();
    const std::span<const double> above = z_.row(last ? j : j + 1);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (i + 1 < here.size()) {
        const double a = (here[i + 1] - here[i]) / hx_;
        sums.add(edges_x, a * a);
        if (!last) {
          const double b = (above[i + 1] - above[i]) / hx_, c = (above[i] - here[i]) / hy_,
                       d = (above[i + 1] - here[i + 1]) / hy_;
          sums.add(cells, (excess(a * a + d * d) + excess(b * b + c * c) + excess(a * a + c * c) +
                           excess(b * b + d * d)) /
                              4);
        }
      }
      if (!last) {
        const double c = (above[i] - here[i]) / hy_;
        sums.add(edges_y, c * c);
      }
    }
    if (j >= 3 && j + 3 < z_.ny())
      for (int i = 3; i + 3 < z_.nx(); ++i) {
        const double x = seven([&](int k) { return z_(i + k, j); }) / hx_,
                     y = seven([&](int k) { return z_(i, j + k); }) / hy_;
        sums.add(crosses, x * x + y * y + 0 * z_(i, j));  // NaN if the middle is missing
      }
    return sums;
  }

 private:
  template <class Height>
  static double seven(const Height& z) {
    return (45 * (z(1) - z(-1)) - 9 * (z(2) - z(-2)) + (z(3) - z(-3))) / 60;
  }

  const Field& z_;
  double hx_, hy_;
};

constexpr int tiles_a_side = 4;
constexpr double lengths_a_tile = 10;  // autocorrelation lengths

struct Uncertain {
  const char* name;
  std::optional<double> ArealUncertainty::*u;
};
constexpr std::array<Uncertain, 6> uncertain{{{"u_Sa", &ArealUncertainty::Sa},
                                              {"u_Sq", &ArealUncertainty::Sq},
                                              {"u_Ssk", &ArealUncertainty::Ssk},
                                              {"u_Sku", &ArealUncertainty::Sku},
                                              {"u_Sdq", &ArealUncertainty::Sdq},
                                              {"u_Sdr", &ArealUncertainty::Sdr}}};

// s/√n; empty if a tile has no value.
std::optional<double> standard_uncertainty(const std::vector<std::optional<double>>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const auto& value : values) {
    if (!value) return {};
    mean += *value / n;
  }
  for (const auto& value : values) squares += (*value - mean) * (*value - mean);
  return std::sqrt(squares / (n - 1) / n);
}

std::optional<Surface> tile(const Surface& map, int i0, int j0, int nx, int ny) {
  const Field& z = map.measured_heights();
  Field heights(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) heights(i, j) = z(i0 + i, j0 + j);
  if (2 * known_count(heights.values()) < heights.size()) return {};
  const Grid& grid = map.grid();
  return Surface::with_holes(make_grid(nx, ny, nx * grid.hx(), ny * grid.hy()), std::move(heights));
}

constexpr int half_degrees = 360;
constexpr double least_cycles = 3;  // shortest waves along the shorter side

// Bins of waves (x, y), y >= 0, by cross products, without arc tangents.
class Bins {
 public:
  Bins() {
    for (int k = 0; k < half_degrees; ++k) {
      const double angle = (k + 0.5) * std::numbers::pi / half_degrees;
      borders_[static_cast<std::size_t>(k)] = {elementary::cos(angle), elementary::sin(angle)};
    }
  }
  int of(double x, double y) const {
    const auto passed = [&](const Border& b) { return y * b.cosine - x * b.sine >= 0; };
    const auto next = std::ranges::partition_point(borders_, passed);
    return static_cast<int>(next - borders_.begin()) % half_degrees;
  }

 private:
  struct Border {
    double cosine, sine;
  };
  std::array<Border, half_degrees> borders_{};
};

Surface prepared_map(const Surface& surface, const ArealPreparation& preparation) {
  Surface result = surface;
  if (preparation.F) result = levelled(result, *preparation.F);
  if (preparation.S) result = gaussian_filtered(result, {.short_wave = preparation.S, .long_wave = {}});
  if (preparation.L) result = gaussian_filtered(result, {.short_wave = {}, .long_wave = preparation.L});
  return result;
}

// Subtracting a plane leaves a few units in the last place.
bool rounding_alone(const Surface& before, const Surface& after, const ArealPreparation& preparation) {
  if (!preparation.F && !preparation.S && !preparation.L) return after.peak_to_valley() == 0;
  const Range r = before.height_range();
  constexpr double last_places = 1024 * std::numeric_limits<double>::epsilon();
  return after.peak_to_valley() <= last_places * std::max(std::abs(r.min), std::abs(r.max));
}

}  // namespace

ArealSlopes areal_slopes(const Surface& surface) {
  const SlopesOfRows slopes(surface);
  Array<SlopeSums> rows(static_cast<std::size_t>(surface.grid().ny));
  for_each_row(surface.grid().ny, [&](int j) { rows[static_cast<std::size_t>(j)] = slopes.row(j); });
  std::array<double, terms> total{}, number{};
  Array<double> column(rows.size());
  const auto sum_of = [&](auto member, std::size_t t) {
    std::ranges::transform(rows, column.begin(), [&](const SlopeSums& row) { return (row.*member)[t]; });
    return block_sum(column);
  };
  for (std::size_t t = 0; t < terms; ++t)
    total[t] = sum_of(&SlopeSums::sum, t), number[t] = sum_of(&SlopeSums::count, t);
  const auto mean_square = [&](Term term) { return number[term] > 0 ? total[term] / number[term] : 0; };
  ArealSlopes result;
  if (number[edges_x] > 0 || number[edges_y] > 0)
    result.Sdq = std::sqrt(mean_square(edges_x) + mean_square(edges_y));
  if (number[crosses] > 0) result.Sdq_seven = std::sqrt(mean_square(crosses));
  if (number[cells] > 0) result.Sdr = mean_square(cells);
  result.cells = static_cast<std::size_t>(number[cells]);
  return result;
}

ArealUncertainty areal_uncertainty(const Surface& map, std::optional<double> Sal) {
  ArealUncertainty result;
  const Grid& grid = map.grid();
  const int nx = grid.nx / tiles_a_side, ny = grid.ny / tiles_a_side;
  const double side = std::min(nx * grid.hx(), ny * grid.hy());
  if (!Sal) {
    result.why_not = "no autocorrelation length Sal says how large independent tiles are";
    return result;
  }
  if (nx < 2 || ny < 2 || side < lengths_a_tile * *Sal) {
    result.why_not = "a sixteenth of the map, " + metres(side) +
                     " wide, is under ten autocorrelation lengths (Sal " + metres(*Sal) +
                     "): measure a larger map";
    return result;
  }
  std::array<std::vector<std::optional<double>>, uncertain.size()> values;
  for (int J = 0; J < tiles_a_side; ++J)
    for (int I = 0; I < tiles_a_side; ++I) {
      const auto part = tile(map, I * nx, J * ny, nx, ny);
      if (!part) {
        result.why_not = "less than half of one of the sixteen tiles was measured";
        return result;
      }
      const Roughness heights = roughness(*part);
      const ArealSlopes slopes = areal_slopes(*part);
      const bool flat = !(heights.amplitude > 0);
      const std::array<std::optional<double>, uncertain.size()> of_tile{
          heights.Ra,
          heights.Rq,
          flat ? std::nullopt : std::optional(heights.skewness),
          flat ? std::nullopt : std::optional(heights.kurtosis),
          slopes.Sdq,
          slopes.Sdr};
      for (std::size_t k = 0; k < of_tile.size(); ++k) values[k].push_back(of_tile[k]);
    }
  for (std::size_t k = 0; k < values.size(); ++k) result.*uncertain[k].u = standard_uncertainty(values[k]);
  return result;
}

TextureDirection texture_direction(const Surface& surface) {
  const Grid& grid = surface.grid();
  const Range r = surface.height_range();
  if (r.span() == 0) refuse("a flat surface has no direction", "it needs heights that differ");
  const double nyquist = 0.5 / std::max(grid.hx(), grid.hy());
  if (nyquist * std::min(grid.size_x, grid.size_y) < least_cycles)
    refuse("the map is under six of its longer cells wide, and so few waves have no direction",
           "measure more cells along the shorter side");
  const Field& z = surface.measured_heights();
  const double mean = exact_mean(MeasuredValues(surface).values(), r);
  const double unit = std::ldexp(1.0, -scale_exponent(std::max(r.max - mean, mean - r.min)));
  const Array<double> along_x = hann_window(grid.nx), along_y = hann_window(grid.ny);
  Field windowed(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      if (const double h = z(i, j); !std::isnan(h))
        windowed(i, j) =
            (h - mean) * unit * along_x[static_cast<std::size_t>(i)] * along_y[static_cast<std::size_t>(j)];
  const HalfSpectrum spectrum = fourier_forward(windowed);

  const Bins bins;
  Field of_rows(half_degrees, grid.ny);
  parallel_for(grid.ny, [&](std::int64_t row) {
    const int b = static_cast<int>(row), wave_y = spectrum.wave_y(b);
    const std::span<double> power = of_rows.row(b);
    for (int a = 0; a < spectrum.bins_x(); ++a) {
      if (a == 0 && wave_y < 0) continue;  // same as its opposite
      const double fx = a / grid.size_x, fy = wave_y / grid.size_y;
      if (a * a + static_cast<double>(wave_y) * wave_y <= 1.5 * 1.5 || fx * fx + fy * fy >= nyquist * nyquist)
        continue;
      const int bin = fy < 0 ? bins.of(-fx, -fy) : bins.of(fx, fy);
      power[static_cast<std::size_t>(bin)] += std::norm(spectrum(a, b));
    }
  });
  std::array<double, half_degrees> power{};
  for (int b = 0; b < grid.ny; ++b)
    for (int k = 0; k < half_degrees; ++k) power[static_cast<std::size_t>(k)] += of_rows(k, b);
  double total = 0;
  for (const double p : power) total += p;
  if (!(total > 0))
    refuse("no wave of the surface is longer than two cells and shorter than two thirds of the map",
           "its direction needs more cells");
  const auto greatest = std::max_element(power.begin(), power.end());
  const auto bin = static_cast<double>(greatest - power.begin());
  TextureDirection result;
  result.wave = bin * std::numbers::pi / half_degrees;
  result.lay = (bin < half_degrees / 2 ? bin + half_degrees / 2.0 : bin - half_degrees / 2.0) *
               std::numbers::pi / half_degrees;
  result.share = *greatest / total;
  return result;
}

struct ArealParameters::Groups {
  Surface map;
  ArealPreparation preparation;
  bool flat;
  Lazy<Roughness> heights;
  Lazy<ArealSlopes> slopes;
  Lazy<MaterialRatioCurve> curve;
  Lazy<CoreOfCurve> core;
  Lazy<VolumesOfCurve> volumes;
  Lazy<Hills> hills;
  Lazy<std::optional<TextureAspect>> texture;
  Lazy<std::optional<TextureDirection>> direction;
  Lazy<ArealUncertainty> uncertainty;

  Groups(Surface m, const Surface& before, ArealPreparation p)
      : map(std::move(m)), preparation(p), flat(rounding_alone(before, map, p)) {}
};

ArealParameters::ArealParameters(const Surface& surface, const ArealPreparation& preparation) {
  require_positive("S", preparation.S, "m");
  require_positive("L", preparation.L, "m");
  if (preparation.S && preparation.L && !(*preparation.S < *preparation.L))
    refuse(
        "the nesting index `S`, " + metres(*preparation.S) + ", is not below `L`, " + metres(*preparation.L),
        "give a smaller `S` or a larger `L`");
  require(preparation.pruning >= 0 && preparation.pruning <= 1, "pruning", preparation.pruning, "",
          "give the share of Sz that a hill must rise, from 0 to 1");
  groups_ = std::make_shared<Groups>(prepared_map(surface, preparation), surface, preparation);
}

const Surface& ArealParameters::prepared() const { return groups_->map; }
const ArealPreparation& ArealParameters::preparation() const { return groups_->preparation; }
bool ArealParameters::flat() const { return groups_->flat; }
bool ArealParameters::has_inside() const { return prepared().grid().nx > 2 && prepared().grid().ny > 2; }

std::string ArealParameters::how() const {
  const ArealPreparation& p = preparation();
  std::string text;
  if (p.F) text += "F-operation of degree " + std::to_string(*p.F) + ", ";
  if (p.S) text += "S-filter " + metres(*p.S) + ", ";
  if (p.L) text += "L-filter " + metres(*p.L) + ", ";
  return text + "mean removed";
}

const Roughness& ArealParameters::heights() const {
  return groups_->heights.get([&] { return roughness(prepared()); });
}
const ArealSlopes& ArealParameters::slopes() const {
  return groups_->slopes.get([&] { return areal_slopes(prepared()); });
}
const MaterialRatioCurve& ArealParameters::curve() const {
  return groups_->curve.get([&] { return MaterialRatioCurve(prepared().measured_heights().values()); });
}
const CoreOfCurve& ArealParameters::core() const {
  return groups_->core.get([&] { return curve().core(); });
}
const VolumesOfCurve& ArealParameters::volumes() const {
  return groups_->volumes.get([&] { return curve().volumes(); });
}
const Hills& ArealParameters::hills() const {
  return groups_->hills.get([&] { return asperity::hills(prepared(), preparation().pruning); });
}
const std::optional<TextureAspect>& ArealParameters::texture() const {
  return groups_->texture.get([&]() -> std::optional<TextureAspect> {
    const Grid& grid = prepared().grid();
    if (flat() || grid.nx < 2 || grid.ny < 2) return {};
    return Autocorrelation(prepared()).texture();
  });
}
const std::optional<TextureDirection>& ArealParameters::direction() const {
  return groups_->direction.get([&]() -> std::optional<TextureDirection> {
    if (flat()) return {};
    try {
      return texture_direction(prepared());
    } catch (const Error& error) {
      if (error.code() != ErrorCode::bad_value) throw;
      return {};
    }
  });
}
const ArealUncertainty& ArealParameters::uncertainty() const {
  return groups_->uncertainty.get(
      [&] { return areal_uncertainty(prepared(), texture() ? texture()->Sal : std::nullopt); });
}

std::string ArealParameters::why_not(const std::string& parameter) const {
  const auto one_of = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return parameter == name; });
  };
  const std::string equal = prepared().peak_to_valley() == 0
                                ? "all heights are equal"
                                : "all heights are equal but for rounding of the map that was prepared";
  if (one_of({"Ssk", "Sku", "Smr1", "Smr2", "Sk_window", "Spd", "Svd", "Spc", "S5p", "S5v", "S10z"}) &&
      flat())
    return equal;
  if (parameter == "Sdq" && !slopes().Sdq) return "no two neighbouring points were measured";
  if (parameter == "Sdq_seven" && !slopes().Sdq_seven)
    return "no point has three measured neighbours on each side along both axes";
  if (parameter == "Sdr" && !slopes().Sdr) return "no cell has four measured corners";
  if (parameter.starts_with("u_")) {
    const ArealUncertainty& u = uncertainty();
    if (!u.why_not.empty()) return u.why_not;
    for (const auto& [name, value] : uncertain)
      if (parameter == name && !(u.*value)) return "one of sixteen tiles does not define it";
  }
  if (one_of({"Sal", "Str", "Str_bound"})) {
    if (!texture()) return flat() ? equal : "the map is one node wide";
    if (parameter == "Sal" && !texture()->Sal)
      return "along no direction does the autocorrelation fall to 0.2 within half the map";
    if (parameter == "Str" && !texture()->Str)
      return "along some direction the autocorrelation does not fall to 0.2 within half the map; Str is "
             "below Str_bound";
    if (parameter == "Str_bound" && !texture()->Str_bound) return "Str itself is defined";
  }
  if (one_of({"Std", "Std_wave"}) && !direction())
    return flat() ? equal
                  : "the map is under six cells wide, or no wave is between two cells and two thirds of the "
                    "map long";
  if (one_of({"Spd", "Svd", "Spc", "S5p", "S5v", "S10z"}) && !has_inside())
    return "the map is under three nodes wide, and all of them are at its rim";
  if (parameter == "Spc" && !hills().Spc) return "no peak is left after pruning";
  if (parameter == "S5p" && !hills().S5p) return "fewer than five peaks are left after pruning";
  if (parameter == "S5v" && !hills().S5v) return "fewer than five pits are left after pruning";
  if (parameter == "S10z" && !hills().S10z)
    return "fewer than five peaks or five pits are left after pruning";
  return "";
}

std::string ArealParameters::digest() const {
  Digester digester;
  digester.add("areal parameters").add(prepared().digest()).add(how()).add(preparation().pruning);
  return digester.hex();
}

}  // namespace asperity
