// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration/placement.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"

namespace asperity::registration {

namespace {

// The coarse search: band-passed, clipped maps; the after-map, turned angle by angle, is correlated with
// whitening and zero padding. Several peaks become candidates: the highest may be wrong.

struct CoarseOptions {
  double greatest_turn = 0;   // rad to either side; from pi on the whole circle
  double greatest_shift = 0;  // cells; infinite: down to a tenth of overlap
  double from_x = 0,
         from_y = 0;  // cells: offset of the map centres at zero shift
  double step = 0;    // rad, between angles
  int candidates = 8;
  std::size_t of_an_angle = 3;  // peaks per angle
};

struct Candidate {
  Pose pose;
  double peak = 0;  // in root mean squares of the correlation
};

constexpr double short_sigma = 1, greatest_long_sigma = 15, least_long_sigma = 3;  // nodes of the coarse map
constexpr double clip = 1.2;                                                       // root mean squares
constexpr int peak_radius = 3;                                                     // nodes

// Holes are zero.
Field band_passed(const HeightMap& map, double long_sigma) {
  const SmoothMap fine = smoothed_map(map, short_sigma * map.hx);
  const SmoothMap broad = smoothed_map(map, long_sigma * map.hx);
  Field band(map.nx(), map.ny());
  double squares = 0, count = 0;
  for (std::size_t k = 0; k < band.size(); ++k) {
    if (std::isnan(map.heights[k])) continue;
    band[k] = fine.map.heights[k] - broad.map.heights[k];
    squares += band[k] * band[k];
    count += 1;
  }
  const double limit = clip * std::sqrt(squares / std::max(count, 1.0));
  for (double& value : band.values()) value = std::clamp(value, -limit, limit);
  return band;
}

// Turns about the map's centre, bilinearly, to centre (cx, cy); zeros outside.
void turn_into(const Field& band, double angle, double cx, double cy, Field& out) {
  const auto [sine, cosine] = elementary::sincos(angle);
  const int nx = band.nx(), ny = band.ny();
  for (int j = 0; j < out.ny(); ++j) {
    const double y = j - cy;
    for (int i = 0; i < out.nx(); ++i) {
      const double x = i - cx;
      const double at_x = cosine * x + sine * y + 0.5 * (nx - 1);
      const double at_y = -sine * x + cosine * y + 0.5 * (ny - 1);
      double value = 0;
      if (at_x >= 0 && at_y >= 0 && at_x < nx - 1 && at_y < ny - 1) {
        const int a = static_cast<int>(at_x), b = static_cast<int>(at_y);
        const double s = at_x - a, t = at_y - b;
        value = (1 - t) * ((1 - s) * band(a, b) + s * band(a + 1, b)) +
                t * ((1 - s) * band(a, b + 1) + s * band(a + 1, b + 1));
      }
      out(i, j) = value;
    }
  }
}

// Limits of the centres' distance and of the shift, in nodes.
struct Reach {
  double x, y, radius, from_x, from_y;
  bool holds(double dx, double dy) const {
    const double shift_x = dx - from_x, shift_y = dy - from_y;
    return std::abs(dx) <= x && std::abs(dy) <= y && shift_x * shift_x + shift_y * shift_y <= radius * radius;
  }
};

struct Search {
  const Field& after;
  HalfSpectrum before;
  int period_x, period_y;
  double middle_x, middle_y;  // of the before-map, from its node (0, 0)
  Reach reach;
  std::size_t peaks;  // per angle
};

// The first `most` candidates that differ from all before by more than `turn` or the radius of a peak.
std::vector<Candidate> apart(const std::vector<Candidate>& sorted, double turn, std::size_t most) {
  std::vector<Candidate> kept;
  for (const Candidate& c : sorted) {
    const bool close = std::any_of(kept.begin(), kept.end(), [&](const Candidate& k) {
      return std::abs(k.pose.x - c.pose.x) <= peak_radius && std::abs(k.pose.y - c.pose.y) <= peak_radius &&
             std::abs(std::remainder(k.pose.turn - c.pose.turn, 2 * std::numbers::pi)) <= turn;
    });
    if (!close) kept.push_back(c);
    if (kept.size() == most) break;
  }
  return kept;
}

std::vector<Candidate> peaks(const Search& search, double angle) {
  const int px = search.period_x, py = search.period_y;
  Field turned(px, py);
  const double cx = 0.5 * (px - 1), cy = 0.5 * (py - 1);
  turn_into(search.after, angle, cx, cy, turned);
  HalfSpectrum spectrum = fourier_forward(turned);
  const auto bins = spectrum.bins();
  const auto others = search.before.bins();
  double sum = 0;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    bins[k] = std::conj(bins[k]) * others[k];
    sum += std::abs(bins[k].real()) + std::abs(bins[k].imag());
  }
  const double least = 0.1 * sum / static_cast<double>(bins.size());
  for (std::complex<double>& bin : bins)
    bin /= std::sqrt(bin.real() * bin.real() + bin.imag() * bin.imag()) + least;
  const Field correlation = fourier_inverse(std::move(spectrum));
  double squares = 0;
  for (const double value : correlation.values()) squares += value * value;
  const double unit = std::sqrt(squares / static_cast<double>(correlation.size()));
  std::vector<Candidate> found;
  if (!(unit > 0)) return found;
  // Lag (a, b) shifts node (cx, cy) of the turned map to (cx + a, cy + b) of the before-map.
  for (int b = 0; b < py; ++b)
    for (int a = 0; a < px; ++a) {
      const double dx0 = cx - search.middle_x + a, dy0 = cy - search.middle_y + b;
      const double dx = dx0 - px * std::floor(dx0 / px + 0.5), dy = dy0 - py * std::floor(dy0 / py + 0.5);
      if (!search.reach.holds(dx, dy)) continue;
      const double value = correlation(a, b);
      const int left = (a + px - 1) % px, right = (a + 1) % px, low = (b + py - 1) % py, high = (b + 1) % py;
      if (value < correlation(left, b) || value < correlation(right, b) || value < correlation(a, low) ||
          value < correlation(a, high))
        continue;
      found.push_back({{dx, dy, angle}, value / unit});
    }
  std::sort(found.begin(), found.end(), [](const Candidate& p, const Candidate& q) {
    if (p.peak != q.peak) return p.peak > q.peak;
    return std::pair(p.pose.y, p.pose.x) < std::pair(q.pose.y, q.pose.x);
  });
  return apart(found, 2 * std::numbers::pi, search.peaks);
}

std::vector<double> angles(const CoarseOptions& options) {
  std::vector<double> list;
  if (options.greatest_turn >= std::numbers::pi * (1 - 1e-9)) {
    const int count = static_cast<int>(std::ceil(2 * std::numbers::pi / options.step - 1e-9));
    for (int k = 0; k < count; ++k) list.push_back((k - count / 2) * 2 * std::numbers::pi / count);
  } else {
    const int half = static_cast<int>(std::ceil(options.greatest_turn / options.step - 1e-9));
    for (int k = -half; k <= half; ++k) list.push_back(half == 0 ? 0 : k * options.greatest_turn / half);
  }
  return list;
}

// By falling peak. Square cells of one spacing. Cost: two transforms per angle, two padded maps per thread.
std::vector<Candidate> coarse_candidates(const HeightMap& before, const HeightMap& after,
                                         const CoarseOptions& options, Monitor& monitor) {
  const int narrowest = std::min({before.nx(), before.ny(), after.nx(), after.ny()});
  const double long_sigma = std::clamp(narrowest / 6.0, least_long_sigma, greatest_long_sigma);
  const Field before_band = band_passed(before, long_sigma), after_band = band_passed(after, long_sigma);
  const double spacing = before.hx;
  // Box of the turned after-map; large angles: its diagonal.
  const double quarter = std::min(options.greatest_turn, 0.5 * std::numbers::pi);
  const double diagonal = elementary::hypot(after.nx(), after.ny());
  const elementary::SineCosine of_quarter = elementary::sincos(quarter);
  const double sine = of_quarter.sine, cosine = of_quarter.cosine;
  const auto box = [&](double along, double across) {
    return std::min(diagonal, options.greatest_turn < 0.25 * std::numbers::pi ? along * cosine + across * sine
                                                                              : diagonal);
  };
  const double box_x = box(after.nx(), after.ny()), box_y = box(after.ny(), after.nx());
  // Larger shifts overlap less than a tenth.
  const double most = options.greatest_shift / spacing, longer = std::max(after.nx(), after.ny());
  const double from_x = options.from_x / spacing, from_y = options.from_y / spacing;
  const Reach reach{std::min(most + std::abs(from_x), 0.4 * (before.nx() + std::min(box_x, longer))),
                    std::min(most + std::abs(from_y), 0.4 * (before.ny() + std::min(box_y, longer))), most,
                    from_x, from_y};
  // Wrapped lags stay outside the reach.
  const auto period = [](int n, double turned, double reached) {
    const double least = std::max({0.5 * (n + turned) + reached, turned, static_cast<double>(n)});
    return good_fourier_length(static_cast<int>(std::ceil(least)) + 2);
  };
  const int px = period(before.nx(), box_x, reach.x), py = period(before.ny(), box_y, reach.y);
  Field padded(px, py);
  for (int j = 0; j < before_band.ny(); ++j)
    std::copy(before_band.row(j).begin(), before_band.row(j).end(), padded.row(j).begin());
  const Search search{after_band, fourier_forward(padded), px,
                      py,         0.5 * (before.nx() - 1), 0.5 * (before.ny() - 1),
                      reach,      options.of_an_angle};
  const std::vector<double> turns = angles(options);
  std::vector<std::vector<Candidate>> of_angles(turns.size());
  Task task(monitor, "looking for the place of the map", static_cast<std::int64_t>(turns.size()));
  constexpr std::size_t batch = 16;
  for (std::size_t first = 0; first < turns.size(); first += batch) {
    const std::size_t here = std::min(batch, turns.size() - first);
    parallel_for(static_cast<std::int64_t>(here), [&](std::int64_t k) {
      const std::size_t at = first + static_cast<std::size_t>(k);
      of_angles[at] = peaks(search, turns[at]);
    });
    task.advance(static_cast<std::int64_t>(here));
  }
  std::vector<Candidate> all;
  for (const std::vector<Candidate>& some : of_angles) all.insert(all.end(), some.begin(), some.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& p, const Candidate& q) { return p.peak > q.peak; });
  std::vector<Candidate> kept = apart(all, 2.5 * options.step, static_cast<std::size_t>(options.candidates));
  for (Candidate& c : kept) {
    c.pose.x *= spacing;
    c.pose.y *= spacing;
  }
  return kept;
}

// The choice among the candidates, and its refinement.

constexpr int least_coarse_cells = 16, usual_coarse_cells = 256, most_coarse_cells = 2048;  // along a side
constexpr double degree = std::numbers::pi / 180;
constexpr double least_overlap = 0.1;    // of the smaller map
constexpr double least_explained = 0.5;  // of the variance
constexpr double firmly_explained = 0.9;
constexpr double gaussian_reach = 3;  // standard deviations
// A second placement is as good below this multiple of the best's unexplained variance.
constexpr double clearly_worse = 1.5, least_difference = 5e-4;

// Required measured share; lower if scattered holes would exclude most nodes.
double share_that_counts(const SmoothMap& before, const SmoothMap& after, const HeightMap& before_raw,
                         const HeightMap& after_raw) {
  const auto counting = [](const SmoothMap& map, const HeightMap& raw, double share) {
    std::size_t counts = 0;
    for (const double value : map.share.values()) counts += value >= share ? 1 : 0;
    return static_cast<double>(counts) /
           static_cast<double>(std::max<std::size_t>(1, known_count(raw.heights.values())));
  };
  for (const double share : {0.99, 0.9})
    if (std::min(counting(before, before_raw, share), counting(after, after_raw, share)) >= 0.6) return share;
  return 0.7;
}

MapPair smoothed_alike(const HeightMap& before, const HeightMap& after, double sigma) {
  const SmoothMap smooth_before = smoothed_map(before, sigma);
  SmoothMap smooth_after = smoothed_map(after, sigma);
  const double share = share_that_counts(smooth_before, smooth_after, before, after);
  return MapPair(smooth_before, std::move(smooth_after), share);
}

struct Judged {
  Refined best;
  double second = 0;  // variance explained elsewhere
  double moved = 0;   // variance explained a few cells away, in the weakest direction
};

bool elsewhere(const Pose& a, const Pose& b, double way, double turn) {
  return elementary::hypot(a.x - b.x, a.y - b.y) > way ||
         std::abs(std::remainder(a.turn - b.turn, 2 * std::numbers::pi)) > turn;
}

// Refines candidates, then shifts the best both ways along its weakest direction: on ridges or spheres this
// fits as well. The shifted pose stays fixed: refinement would follow rim and noise.
Judged judged(const HeightMap& before, const HeightMap& after, const std::vector<Candidate>& candidates,
              const CoarseOptions& search, Monitor& monitor) {
  const double spacing = before.hx;
  const MapPair maps = smoothed_alike(before, after, 1.5 * spacing);
  RefinementOptions options;
  options.most_steps = 20;
  options.tolerance = 1e-3 * spacing;
  options.least_overlap = least_overlap;
  std::vector<Refined> found;
  bool relief = true;
  Task task(monitor, "comparing places of the map", static_cast<std::int64_t>(candidates.size()));
  for (const Candidate& candidate : candidates) {
    const Refined one = refined(maps, candidate.pose, options);
    relief = relief && one.relief;
    const double shift = elementary::hypot(one.pose.x - search.from_x, one.pose.y - search.from_y);
    // The search resolves its cells only.
    if (one.possible && shift <= search.greatest_shift + 2 * spacing) found.push_back(one);
    task.advance();
  }
  if (found.empty() && !relief)
    refuse("the surface has no features along one direction, so the after-map has no definite place",
           "measure a place with features in every direction");
  if (found.empty())
    refuse("no placement of the after-map makes the two maps overlap enough",
           "measure more of the same place, or search more angles and longer shifts (`angle`, `at_most`)");
  const auto best = std::max_element(found.begin(), found.end(), [](const Refined& a, const Refined& b) {
    return a.explained < b.explained;
  });
  Judged result{*best, 0, 0};
  for (const Refined& other : found)
    if (elsewhere(other.pose, best->pose, 3 * spacing, 2 * search.step))
      result.second = std::max(result.second, other.explained);
  const double way = 4 * spacing;
  const Pose change = weakest_change(maps, *best, options, way);
  for (const double side : {-1.0, 1.0}) {
    const Pose start{best->pose.x + side * change.x, best->pose.y + side * change.y,
                     best->pose.turn + side * change.turn};
    RefinementOptions there = options;
    there.plane_alone = true;
    there.most_steps = 6;
    const Refined moved = refined(maps, start, there);
    if (moved.possible) result.moved = std::max(result.moved, moved.explained);
  }
  return result;
}

std::string percent_of(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

void refuse_what_is_not_decided(const Refined& found, const Judged& coarse) {
  if (found.explained < least_explained || coarse.best.explained < least_explained)
    refuse("the best placement explains " +
               percent_of(std::max(0.0, std::min(found.explained, coarse.best.explained))) +
               " of the heights: the maps show different places, or too much wear",
           "search more angles and longer shifts (`angle`, `at_most`), or take maps of one specimen");
  const double as_good = std::max(clearly_worse * (1 - coarse.best.explained), least_difference);
  const double other = std::max(coarse.moved, coarse.second);
  if (coarse.best.explained < firmly_explained && 1 - other < as_good)
    refuse("no placement stands out: the best explains " + percent_of(coarse.best.explained) +
               " of the heights, another one " + percent_of(other),
           "take maps that show more of the same place, or search more angles and longer shifts");
  if (1 - coarse.moved < as_good)
    refuse(
        "the after-map fits a few cells away as well: the surface has no features along one direction, or "
        "looks the same when it is turned",
        "measure a place with features in every direction");
  if (1 - coarse.second < as_good)
    refuse("another placement explains the heights as well (" + percent_of(coarse.second) + ", the best " +
               percent_of(coarse.best.explained) + "): the surface repeats itself",
           "narrow the search with `angle` and `at_most`, or measure a place with distinct features");
}

// Smoothed heights need few samples.
int stride_of(const HeightMap& map) {
  constexpr double most_samples = 1 << 19;
  return std::max(
      1,
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(map.heights.size()) / most_samples) - 1e-9)));
}

std::string extent_of(const HeightMap& map, double cell) {
  return metres((map.extent_x() + map.hx) * cell) + " x " + metres((map.extent_y() + map.hy) * cell);
}

// Coarse maps: about 256² nodes; more for small or narrow maps.
double coarse_spacing(const HeightMap& before, const HeightMap& after, double widest) {
  const double longest = std::max({after.extent_x(), after.extent_y(), before.extent_x(), before.extent_y()});
  const double shortest =
      std::min({after.extent_x(), after.extent_y(), before.extent_x(), before.extent_y()});
  const double area = std::max(after.extent_x() * after.extent_y(), before.extent_x() * before.extent_y());
  return std::max({2 * widest, longest / (most_coarse_cells - 1),
                   std::min(std::sqrt(area) / (usual_coarse_cells - 1), shortest / least_coarse_cells)});
}

CoarseOptions coarse_options(const HeightMap& before, const HeightMap& after, const PlacementLimits& limits) {
  CoarseOptions search;
  search.greatest_turn = std::min(limits.greatest_turn, std::numbers::pi);
  search.greatest_shift = limits.greatest_shift;
  search.from_x = 0.5 * (after.extent_x() - before.extent_x());
  search.from_y = 0.5 * (after.extent_y() - before.extent_y());
  search.step = limits.greatest_turn >= std::numbers::pi ? degree : 0.75 * degree;
  // A small map resembles more places.
  const auto [smaller, area] =
      std::minmax({after.extent_x() * after.extent_y(), before.extent_x() * before.extent_y()});
  if (smaller < 0.25 * area) {
    search.candidates = 32;
    search.of_an_angle = 12;
  }
  return search;
}

}  // namespace

Placement find_placement(const HeightMap& before, const HeightMap& after, const PlacementLimits& limits,
                         Monitor& monitor) {
  const double widest = std::max({after.hx, after.hy, before.hx, before.hy});
  const double spacing = coarse_spacing(before, after, widest);
  const HeightMap coarse_before = coarser_map(before, spacing), coarse_after = coarser_map(after, spacing);
  const int fewest = std::min({coarse_after.nx(), coarse_after.ny(), coarse_before.nx(), coarse_before.ny()});
  const double ratio = std::max(after.hx, after.hy) / std::max(before.hx, before.hy);
  if (fewest < least_coarse_cells && spacing <= 2 * widest && ratio < 2 && ratio > 0.5)
    refuse("the search moves the maps in steps of " + metres(spacing * limits.cell) +
               ", twice their longest cell, and " + std::to_string(fewest) +
               " steps along a side are fewer than " + std::to_string(least_coarse_cells),
           "give the maps square cells with `resampled`, or measure on more cells");
  if (fewest < least_coarse_cells || known_count(coarse_after.heights.values()) == 0 ||
      known_count(coarse_before.heights.values()) == 0)
    refuse("the maps have too little in common: one is " + extent_of(after, limits.cell) + " and the other " +
               extent_of(before, limits.cell),
           "crop the larger one, or measure both with like cells");
  const CoarseOptions search = coarse_options(before, after, limits);
  const std::vector<Candidate> candidates = coarse_candidates(coarse_before, coarse_after, search, monitor);
  const Judged coarse = judged(coarse_before, coarse_after, candidates, search, monitor);

  // On large maps the coarse error may exceed the shortest waves.
  RefinementOptions options;
  options.least_overlap = least_overlap;
  Pose start = coarse.best.pose;
  for (double step = spacing / 3; step >= 2 * widest; step /= 3) {
    const HeightMap coarser_before = coarser_map(before, step), coarser_after = coarser_map(after, step);
    options.stride = stride_of(coarser_after);
    options.tolerance = 1e-3 * step;
    start = refined(smoothed_alike(coarser_before, coarser_after, 1.5 * step), start, options).pose;
  }
  const MapPair maps = smoothed_alike(before, after, widest);
  options.stride = stride_of(after);
  options.tolerance = 1e-5;
  options.most_steps = 60;
  Refined found = refined(maps, start, options);
  if (!found.possible)
    refuse("the best placement leaves " + percent_of(found.overlap) +
               " of the smaller map on the other, or no relief there",
           "measure more of the same place");
  refuse_what_is_not_decided(found, coarse);
  PoseUncertainty u = jackknifed(maps, found, options);
  if (!u.possible)
    refuse("the overlap of the maps is too small to estimate the uncertainty of the placement",
           "measure more of the same place");
  // Chance can explain few features; then the tiles disagree.
  const double radius = 0.5 * std::max(after.extent_x(), after.extent_y());
  const double loose = std::max({u.pose.x, u.pose.y, u.pose.turn * radius});
  if (found.explained < firmly_explained && loose > 0.25 * widest)
    refuse("the best placement explains " + percent_of(found.explained) +
               " of the heights, and the parts of the map disagree by " + metres(loose * limits.cell) +
               " about it",
           "measure a larger place with distinct features, or narrow the search with `angle` and `at_most`");
  const UnwornPlane unworn = plane_of_unworn_ground(maps, found, gaussian_reach * widest, options);
  if (unworn.possible) {
    found.plane = unworn.plane;
    u.plane = unworn.u;
  }
  return {found, u, coarse.second};
}

}  // namespace asperity::registration
