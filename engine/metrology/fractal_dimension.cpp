// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/fractal_dimension.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/dimension_scaling.hpp"
#include "engine/metrology/scale_dependence.hpp"
#include "engine/metrology/spectrum.hpp"
#include "engine/surface/operations/missing_points.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace {

constexpr int longest_default_step = 16;

struct ProfileSet {
  std::int64_t count = 0;
  int shortest = 0, longest = 0;
  bool wrap = false;
  std::int64_t points = 0, measured = 0;
  double range = 0, magnitude = 0;  // m, maxima
  double spacing = 0;               // m, minimum
  double tip_cut_off = 0;           // m, maximum; 0 without tip
  struct One {
    Array<double> heights;
    double spacing = 0;
  };
  std::function<void(std::int64_t, One&)> read;
};

std::vector<int> chosen_steps(const FractalDimensionOptions& options, int samples, bool wrap) {
  if (options.method == DimensionMethod::psd) {
    if (!options.steps.empty())
      refuse("`steps` were given for the method `psd`",
             "it fits bands of wavelengths of its own; leave `steps` out");
    return {};
  }
  const int longest = wrap ? samples : samples - 1;
  if (options.steps.empty()) {
    // Boxes of a few samples alone reflect the sampling.
    std::vector<int> steps;
    const bool is_box = options.method == DimensionMethod::box;
    for (int s = 1; s <= (is_box ? longest / 4 : std::min(longest / 2, longest_default_step)); s *= 2)
      steps.push_back(s);
    return steps;
  }
  for (const int s : options.steps) {
    if (s < 1 || s >= samples)
      refuse(
          "`steps` holds " + std::to_string(s) + " for profiles of " + std::to_string(samples) + " samples",
          "a step is a whole number of samples from 1 to " + std::to_string(std::max(samples - 1, 1)));
    if (std::count(options.steps.begin(), options.steps.end(), s) > 1)
      refuse("`steps` holds " + std::to_string(s) + " more than once", "give each step once");
  }
  if (options.steps.size() < 2) refuse("`steps` holds one step", "a slope needs two steps or more");
  return options.steps;
}

double log_ordinate(DimensionMethod method, double statistic) {
  if (method == DimensionMethod::psd) return statistic;
  return method == DimensionMethod::length ? elementary::log1p(statistic) : elementary::log(statistic);
}

// D = at_zero + per_slope · slope. The statistic has the unit m^power.
struct Relation {
  double at_zero, per_slope;
  int power;
};

Relation relation(DimensionMethod method) {
  // In the order of DimensionMethod: length, psd, structure, box, madogram.
  constexpr std::array<Relation, 5> relations{
      {{1, -1, 0}, {2.5, -0.5, 2}, {2, -0.5, 2}, {0, -1, 0}, {2, -1, 1}}};
  return relations[static_cast<std::size_t>(method)];
}

bool has_logarithm(DimensionMethod method, double statistic) {
  return method == DimensionMethod::length || method == DimensionMethod::psd || statistic > 0;
}

// In SI units.
double reported(DimensionMethod method, double statistic, double unit) {
  if (method == DimensionMethod::length) return 1 + statistic;
  double result = method == DimensionMethod::psd ? elementary::exp(statistic) : statistic;
  for (int k = 0; k < relation(method).power; ++k) result *= unit;
  return result;
}

struct Fitted {
  bool any = false;
  double D = 1, error = 0, r_squared = 0;
  LineFit line;
};

Fitted fit_dimension(DimensionMethod method, std::span<const double> log_steps,
                     std::span<const double> statistics) {
  std::vector<double> x, y;
  for (std::size_t k = 0; k < log_steps.size(); ++k)
    if (has_logarithm(method, statistics[k])) {
      x.push_back(log_steps[k]);
      y.push_back(log_ordinate(method, statistics[k]));
    }
  Fitted result;
  if (x.size() < 2) return result;
  const LineFit line = fit_line(x, y);
  const auto [at_zero, per_slope, power] = relation(method);
  result.any = true;
  result.D = at_zero + per_slope * line.slope;
  result.error = std::abs(per_slope) * line.slope_error;
  result.r_squared = line.r_squared;
  result.line = line;
  return result;
}

// Row: profile; column: step.
struct Tables {
  Array<double> statistics, mean_square_slopes;
  Array<double> D, error;  // NaN: profile without D
  Array<char> gappy;       // 1: no measured pair at some step
};

Tables tabulate(const ProfileSet& set, DimensionMethod method, const Stepping& stepping,
                std::span<const double> log_steps) {
  const std::size_t width = log_steps.size(), count = static_cast<std::size_t>(set.count);
  Tables tables;
  tables.statistics.resize(width * count);
  if (method == DimensionMethod::length) tables.mean_square_slopes.resize(width * count);
  tables.D.assign(count, std::numeric_limits<double>::quiet_NaN());
  tables.error.assign(count, 0.0);
  tables.gappy.assign(count, 0);
  constexpr std::size_t profiles_per_turn = 16;
  for_each_block(count, profiles_per_turn, [&](std::size_t first, std::size_t last) {
    ProfileSet::One one;
    for (std::size_t k = first; k < last; ++k) {
      set.read(static_cast<std::int64_t>(k), one);
      const auto statistics = std::span(tables.statistics).subspan(k * width, width);
      if (stepping.holes && known_count(one.heights) < 2) {
        tables.gappy[k] = 1;
        continue;
      }
      const bool flat = !((stepping.holes ? known_range(one.heights) : range(one.heights)).span() > 0);
      const auto without_pairs = [&] {
        return stepping.holes && std::ranges::any_of(statistics, [](double s) { return std::isnan(s); });
      };
      if (method == DimensionMethod::length) {
        step_statistics(one.heights, one.spacing, 1, stepping, statistics,
                        std::span(tables.mean_square_slopes).subspan(k * width, width));
      } else if (flat) {
        continue;
      } else if (method == DimensionMethod::psd) {
        // Bands depend on the length: use the shortest.
        const auto n = static_cast<std::size_t>(set.shortest);
        band_log_powers(std::span<const double>(one.heights).first(n), set.range, stepping.wrap, statistics);
      } else {
        // Boxes use each profile's unit square; averages need a common unit.
        const double unit = method == DimensionMethod::box ? range(one.heights).span() : set.range;
        step_statistics(one.heights, one.spacing, unit, stepping, statistics, {});
      }
      if (without_pairs()) {
        tables.gappy[k] = 1;
        continue;
      }
      const Fitted fitted = fit_dimension(method, log_steps, statistics);
      if (!fitted.any) continue;
      tables.D[k] = fitted.D;
      tables.error[k] = fitted.error;
    }
  });
  return tables;
}

double column_mean(const Tables& tables, std::span<const double> table, std::size_t width, std::size_t k) {
  Array<double> column;
  for (std::size_t p = 0; p < tables.D.size(); ++p)
    if (!std::isnan(tables.D[p])) column.push_back(table[p * width + k]);
  return mean(column);
}

// Returns a reason, or an empty string, as do the checks below.
std::string too_flat(std::span<const double> mean_square_slopes, std::span<const int> steps) {
  double share = 0;
  for (const double s2 : mean_square_slopes) share += length_sensitivity(std::sqrt(s2));
  share /= static_cast<double>(mean_square_slopes.size());
  if (share >= length_share_wanted) return {};
  const auto shortest = std::min_element(steps.begin(), steps.end()) - steps.begin();
  const auto longest = std::max_element(steps.begin(), steps.end()) - steps.begin();
  const auto slope = [&](std::ptrdiff_t k) {
    return format_short(std::sqrt(mean_square_slopes[static_cast<std::size_t>(k)]), 3);
  };
  return "heights are too small for the length method: rms slopes run from " + slope(shortest) + " at step " +
         std::to_string(steps[static_cast<std::size_t>(shortest)]) + " to " + slope(longest) + " at step " +
         std::to_string(steps[static_cast<std::size_t>(longest)]) + ", where a Gaussian profile shows " +
         format_short(100 * share, 2) +
         " % of D - 1; a slope of 2 to 3.5 at the longest step is needed, or the method `structure`";
}

std::string gap_in_spectrum(int samples, bool wrap, std::span<const double> log_wavelengths,
                            std::span<const double> log_powers, const LineFit& line) {
  std::vector<double> above_line(log_powers.begin(), log_powers.end());
  for (std::size_t k = 0; k < above_line.size(); ++k)
    above_line[k] -= line.intercept + line.slope * log_wavelengths[k];
  const std::optional<std::size_t> empty = empty_band(samples, wrap, above_line);
  if (!empty) return {};
  return "waves of about " + format_short(elementary::exp(log_wavelengths[*empty]), 2) + " samples hold " +
         format_short(elementary::exp(above_line[*empty]), 2) +
         " of the power on the fitted line: the spectrum has gaps, ends or bends; draw `spectrum`, or use "
         "the method `structure`";
}

// All `statistics` have logarithms.
std::string lack_of_scaling(DimensionMethod method, std::span<const double> steps,
                            std::span<const double> statistics, const FractalDimension& found, bool offsets,
                            int samples) {
  std::vector<std::pair<double, double>> sorted;
  for (std::size_t k = 0; k < steps.size(); ++k)
    sorted.emplace_back(steps[k], log_ordinate(method, statistics[k]));
  std::ranges::sort(sorted);
  std::vector<double> rising, ordinates;
  for (const auto& [step, ordinate] : sorted) {
    rising.push_back(step);
    ordinates.push_back(ordinate);
  }
  const auto [at_zero, per_slope, power] = relation(method);
  const ScalingSteps scaling{rising, ordinates, at_zero, per_slope};
  if (method == DimensionMethod::box) return smooth_in_small_boxes(scaling, found.D);
  const bool few_starts = method == DimensionMethod::length && !offsets;
  return running_dimension(scaling, found.D, samples, found.profiles, few_starts ? 1.2 : 0.5);
}

// Jumps scale like a rough profile. In the median profile, up to four jumps then hold half of the mean square
// (four of 64 Gaussian steps: 30 %).
std::string made_by_jumps(const ProfileSet& set) {
  constexpr std::size_t most = 4, steps_a_jump = 16;
  Array<double> jumps(static_cast<std::size_t>(set.count), most + 1);  // per profile
  parallel_for(set.count, [&](std::int64_t k) {
    ProfileSet::One one;
    set.read(k, one);
    Array<double> squares;
    for (std::size_t i = 1; i < one.heights.size(); ++i)
      if (const double step = (one.heights[i] - one.heights[i - 1]) / set.range; !std::isnan(step))
        squares.push_back(step * step);
    double left = 0.5 * block_sum(squares);
    std::ranges::partial_sort(squares, squares.begin() + std::min<std::ptrdiff_t>(most, std::ssize(squares)),
                              std::greater<>());
    const std::size_t some = std::clamp<std::size_t>(squares.size() / steps_a_jump, 1, most);
    for (std::size_t n = 0; n < some && squares.size() > 1 && left >= 0; ++n)
      if ((left -= squares[n]) < 0) jumps[static_cast<std::size_t>(k)] = static_cast<double>(n + 1);
  });
  std::ranges::sort(jumps);
  const double middle = jumps[jumps.size() / 2];
  if (middle > most) return {};
  return (middle == 1 ? "one jump causes all" : format_short(middle) + " jumps cause most") +
         std::string(" height differences: the heights do not scale");
}

std::string shown_by_tip(const ProfileSet& set, double radius, std::span<const double> steps, bool is_psd) {
  const double shortest = *std::ranges::min_element(steps) * set.spacing;
  if (!(shortest < set.tip_cut_off)) return {};
  std::string reason = (is_psd ? "waves of " : "steps of ") + metres(shortest) + " may show the tip of " +
                       metres(radius) + ", which is reliable from " + metres(set.tip_cut_off) + " on; ";
  if (is_psd) return reason + "use the method `structure` with longer `steps`";
  return reason + "give `steps` of " + format_short(std::ceil(set.tip_cut_off / set.spacing)) +
         " samples and more";
}

FractalDimension unresolved(std::string reason) {
  FractalDimension result;
  result.reason = std::move(reason);
  return result;
}

std::string count_text(std::size_t n, const std::string& what) {
  return (n == 0 ? "no " : std::to_string(n) + " ") + what + (n == 1 ? "" : "s");
}

// Throws for methods that need every point.
void require_pairs(const ProfileSet& set, DimensionMethod method) {
  const bool is_psd = method == DimensionMethod::psd;
  if (is_psd || method == DimensionMethod::box)
    refuse("the method `" + std::string(is_psd ? "psd" : "box") + "` needs every point, and " +
               std::to_string(set.points - set.measured) + " of " + std::to_string(set.points) +
               " were not measured",
           "use the method `structure`, or fill the points first with `filled`");
}

// Needs D, its error, steps and profiles of `found`.
std::string reason_against(const FractalDimension& found, const ProfileSet& set,
                           const FractalDimensionOptions& options, std::span<const int> steps, bool wrap,
                           const Tables& tables, std::span<const double> log_steps,
                           std::span<const double> statistics, const LineFit& line) {
  const DimensionMethod method = options.method;
  const bool is_psd = method == DimensionMethod::psd;
  const std::size_t width = statistics.size(), profiles = static_cast<std::size_t>(found.profiles);
  const auto gappy = static_cast<std::size_t>(std::ranges::count(tables.gappy, 1));
  if (profiles + gappy < tables.D.size())
    return std::to_string(tables.D.size() - profiles - gappy) + " of " +
           count_text(tables.D.size(), "profile") + " have equal heights";
  if (width < 3)
    return "2 " + std::string(is_psd ? "bands" : "steps") + " always lie on a line; 3 or more are needed";
  std::string reason;
  if (method == DimensionMethod::length) {
    std::vector<double> squares(width);
    for (std::size_t k = 0; k < width; ++k)
      squares[k] = column_mean(tables, tables.mean_square_slopes, width, k);
    reason = too_flat(squares, steps);
  }
  for (std::size_t k = 0; k < width && reason.empty(); ++k)
    if (!has_logarithm(method, statistics[k]))
      reason = "heights a step of " + format_short(found.steps[k]) + " apart never differ: they repeat";
  if (reason.empty()) reason = made_by_jumps(set);
  if (reason.empty() && (found.D < 1 - found.error || found.D > 2 + found.error))
    reason = "D = " + format_short(found.D, 4) + " is outside 1 … 2: the heights do not scale over these " +
             (is_psd ? "bands" : "steps");
  if (reason.empty() && is_psd) reason = gap_in_spectrum(set.shortest, wrap, log_steps, statistics, line);
  if (reason.empty() && options.tip) reason = shown_by_tip(set, *options.tip, found.steps, is_psd);
  if (reason.empty() && !is_psd)
    reason = lack_of_scaling(method, found.steps, statistics, found, options.offsets, set.shortest);
  return reason;
}

double standard_deviation(Array<double> values) {
  const double centre = mean(values);
  for (double& one : values) one = (one - centre) * (one - centre);
  return std::sqrt(block_sum(values) / static_cast<double>(values.size() - 1));
}

FractalDimension measure(const ProfileSet& set, const FractalDimensionOptions& options) {
  const DimensionMethod method = options.method;
  const bool is_psd = method == DimensionMethod::psd;
  const std::vector<int> steps = chosen_steps(options, set.shortest, set.wrap);
  const bool holes = set.measured < set.points;
  if (holes) require_pairs(set, method);
  // A cut profile is not periodic.
  const bool wrap = set.wrap && !(is_psd && set.shortest < set.longest);
  const std::vector<double> step_values =
      is_psd ? band_wavelengths(set.shortest, wrap) : std::vector<double>(steps.begin(), steps.end());
  const std::size_t width = step_values.size();
  if (width < 2)
    return unresolved("profiles of " + count_text(static_cast<std::size_t>(set.shortest), "sample") +
                      " are too short: " + count_text(width, is_psd ? "band" : "step") +
                      " of at least 3 fits");
  if (set.range <= 64 * std::numeric_limits<double>::epsilon() * set.magnitude)
    return unresolved("all heights of a profile are equal");

  std::vector<double> log_steps(width);
  std::transform(step_values.begin(), step_values.end(), log_steps.begin(),
                 [](double s) { return elementary::log(s); });
  const Tables tables = tabulate(set, method, {method, steps, wrap, options.offsets, holes}, log_steps);

  FractalDimension result;
  result.steps = step_values;
  Array<double> D;
  for (const double one : tables.D)
    if (!std::isnan(one)) D.push_back(one);
  result.profiles = static_cast<int>(D.size());
  if (D.empty())
    return unresolved(std::ranges::count(tables.gappy, 1) > 0
                          ? "no profile has measured points a step apart at every step"
                          : "all heights of a profile are equal");
  if (holes) result.measured = set.measured;

  std::vector<double> statistics(width);
  for (std::size_t k = 0; k < width; ++k) {
    statistics[k] = column_mean(tables, tables.statistics, width, k);
    result.lengths.push_back(reported(method, statistics[k], set.range));
  }
  const Fitted pooled = fit_dimension(method, log_steps, statistics);
  result.r_squared = pooled.r_squared;
  result.D = options.pooled ? pooled.D : mean(D);
  result.error = D.size() == 1 ? pooled.error : standard_deviation(D);
  if (method == DimensionMethod::box) {
    const double bias = box_counting_bias(result.D, set.shortest);
    result.error = std::sqrt(result.error * result.error + bias * bias);
  }

  result.reason =
      reason_against(result, set, options, steps, wrap, tables, log_steps, statistics, pooled.line);
  // Biased box counts rarely detect missing scaling.
  if (result.reason.empty() && method == DimensionMethod::box)
    if (const FractalDimension other = measure(
            set,
            {.method = DimensionMethod::structure, .steps = {}, .wrap = options.wrap, .tip = options.tip});
        !other.resolved)
      result.reason = "by the method `structure` on the same profiles, " + other.reason;
  result.resolved = result.reason.empty();
  return result;
}

double cut_off_of_trace(const Profile& profile, double radius) {
  const Grid grid = make_grid(profile.size(), 1, profile.size() * profile.spacing(), profile.spacing());
  return tip_cut_off(Surface(grid, line_of(profile), {.periodic = profile.closed()}), ScaleAxis::x, radius);
}

}  // namespace

FractalDimension fractal_dimension(const Surface& surface, const FractalDimensionOptions& options) {
  const Field& z = surface.measured_heights();
  const Grid& grid = surface.grid();
  const bool along_x = options.along != Along::y, along_y = options.along != Along::x;
  if (along_x && along_y && options.pooled && std::abs(grid.hx() - grid.hy()) > 1e-9 * grid.hx())
    refuse("`pooled` needs square cells, and these are " + format_short(grid.hx()) + " m x " +
               format_short(grid.hy()) + " m",
           "use `along=\"x\"`, `along=\"y\"` or leave `pooled` out");
  ProfileSet set;
  const std::int64_t rows = along_x ? grid.ny : 0;
  set.count = rows + (along_y ? grid.nx : 0);
  set.shortest = along_x && along_y ? std::min(grid.nx, grid.ny) : (along_x ? grid.nx : grid.ny);
  set.longest = along_x && along_y ? std::max(grid.nx, grid.ny) : set.shortest;
  set.wrap = options.wrap.value_or(false);
  set.spacing = std::min(along_x ? grid.hx() : infinity, along_y ? grid.hy() : infinity);
  if (options.tip) {
    if (along_x) set.tip_cut_off = tip_cut_off(surface, ScaleAxis::x, *options.tip);
    if (along_y)
      set.tip_cut_off = std::max(set.tip_cut_off, tip_cut_off(surface, ScaleAxis::y, *options.tip));
  }
  const Range r = surface.height_range();
  set.range = r.span();
  set.points = static_cast<std::int64_t>(grid.nodes());
  set.measured = static_cast<std::int64_t>(surface.measured());
  set.magnitude = std::max(std::abs(r.min), std::abs(r.max));
  set.read = [&z, &grid, rows](std::int64_t p, ProfileSet::One& one) {
    if (p < rows) {
      const std::span<const double> row = z.row(static_cast<int>(p));
      one.heights.assign(row.begin(), row.end());
      one.spacing = grid.hx();
      return;
    }
    one.heights.resize(static_cast<std::size_t>(grid.ny));
    for (int j = 0; j < grid.ny; ++j)
      one.heights[static_cast<std::size_t>(j)] = z(static_cast<int>(p - rows), j);
    one.spacing = grid.hy();
  };
  return measure(set, options);
}

FractalDimension fractal_dimension(const Profile& profile, const FractalDimensionOptions& options) {
  return fractal_dimension(std::span(&profile, 1), options);
}

FractalDimension fractal_dimension(std::span<const Profile> profiles,
                                   const FractalDimensionOptions& options) {
  if (profiles.empty())
    refuse("a fractal dimension needs profiles, and there are none", "give one profile or more");
  ProfileSet set;
  set.count = static_cast<std::int64_t>(profiles.size());
  set.shortest = profiles.front().size();
  set.spacing = infinity;
  bool closed = true;
  for (const Profile& profile : profiles) {
    set.shortest = std::min(set.shortest, profile.size());
    set.longest = std::max(set.longest, profile.size());
    const Range r = profile.height_range();
    set.points += profile.size();
    set.measured += static_cast<std::int64_t>(profile.measured());
    set.range = std::max(set.range, r.span());
    set.magnitude = std::max({set.magnitude, std::abs(r.min), std::abs(r.max)});
    closed = closed && profile.closed();
    set.spacing = std::min(set.spacing, profile.spacing());
    if (options.tip) set.tip_cut_off = std::max(set.tip_cut_off, cut_off_of_trace(profile, *options.tip));
  }
  set.wrap = options.wrap.value_or(closed);
  set.read = [profiles](std::int64_t p, ProfileSet::One& one) {
    const Profile& profile = profiles[static_cast<std::size_t>(p)];
    one.heights.assign(profile.measured_heights().begin(), profile.measured_heights().end());
    one.spacing = profile.spacing();
  };
  return measure(set, options);
}

}  // namespace asperity
