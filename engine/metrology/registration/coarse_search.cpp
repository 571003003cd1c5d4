// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration/coarse_search.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::registration {

namespace {

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

}  // namespace

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

}  // namespace asperity::registration
