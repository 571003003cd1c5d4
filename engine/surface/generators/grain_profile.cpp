// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/grain_profile.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr int fewest_points = 7;  // the first term has three waves
constexpr int most_points = 1 << 24;

void check(const GrainProfileOptions& o) {
  require_positive("radius", o.radius, "", "give a finite length above zero");
  require(o.D > 1 && o.D < 2, "D", o.D, "", "give a dimension between 1 and 2, both excluded");
  require(o.amplitude >= 0 && o.amplitude < 1, "amplitude", o.amplitude, "",
          "give a fraction of the radius, from 0 to below 1");
  require(o.points >= fewest_points && o.points <= most_points, "points", o.points, "",
          "give a whole number from 7 to 16777216");
  require(o.gamma >= 1.01 && o.gamma <= 1e6, "gamma", o.gamma, "", "give a number from 1.01 to 1e6");
}

// 2π k i/K, reduced to one turn in integers.
double angle(std::int64_t waves, std::int64_t i, std::int64_t points) {
  return two_pi * static_cast<double>(waves * i % points) / static_cast<double>(points);
}

}  // namespace

std::vector<GrainTerm> grain_terms(const GrainProfileOptions& options) {
  check(options);
  const Stream stream(options.seed, "grain_profile");
  std::vector<GrainTerm> terms;
  for (int n = 0;; ++n) {
    const double waves = std::floor(3 * elementary::pow(options.gamma, n) + 0.5);
    if (2 * waves >= options.points) return terms;
    const auto k = static_cast<int>(waves);
    if (!terms.empty() && terms.back().waves == k) continue;
    terms.push_back({k, elementary::pow(options.gamma, (options.D - 2) * n),
                     two_pi * stream.uniform(static_cast<std::uint64_t>(n))});
  }
}

Array<double> grain_outline(const GrainProfileOptions& options, Monitor& monitor) {
  const std::vector<GrainTerm> terms = grain_terms(options);
  const std::int64_t points = options.points;
  Array<double> w(static_cast<std::size_t>(points));
  constexpr std::int64_t block = 4096;
  constexpr std::int64_t blocks_a_turn = 64;
  const std::int64_t blocks = (points + block - 1) / block;
  Task task(monitor, "grain outline", blocks);
  for (std::int64_t first = 0; first < blocks; first += blocks_a_turn) {
    const std::int64_t turn = std::min(blocks_a_turn, blocks - first);
    parallel_for(turn, [&](std::int64_t b) {
      const std::int64_t start = (first + b) * block;
      for (std::int64_t i = start; i < std::min(start + block, points); ++i) {
        double sum = 0;
        for (const GrainTerm& term : terms)
          sum += term.amplitude *
                 (elementary::cos(term.phase) - elementary::cos(angle(term.waves, i, points) + term.phase));
        w[static_cast<std::size_t>(i)] = sum;
      }
    });
    task.advance(turn);
  }
  return w;
}

Profile grain_profile(const GrainProfileOptions& options, Monitor& monitor) {
  Array<double> heights = grain_outline(options, monitor);
  const Range w = range(heights);
  const double largest = options.amplitude * options.radius;
  for (double& height : heights) height = largest * (2 * ((height - w.min) / w.span()) - 1);
  return Profile(two_pi * options.radius / options.points, std::move(heights), options.radius);
}

}  // namespace asperity
