// SPDX-License-Identifier: GPL-3.0-or-later
// Registration problems with known answers: a sum of plane waves, sampled before and, turned and shifted,
// after; then wear, tilt, noise and holes. Draws by key are equal on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::testing {

struct WornPairKind {
  std::string name;  // of the random stream
  int nx = 256, ny = 256;
  double cell_x = 1e-6, cell_y = 1e-6;            // m
  double rms = 1e-6;                              // m
  double turn = 5 * pi / 180;                     // rad, largest
  double shift = 20;                              // cells, largest along each axis
  double least_worn = 0.03, most_worn = 0.3;      // share of the nodes
  double least_noise = 0.005, most_noise = 0.05;  // of the rms height
  double least_holes = 0.01, most_holes = 0.06;   // share of the nodes
  double lay = 1;                                 // ratio of wave vectors along x to y
  int waves = 500;
};

struct WornPair {
  Surface before, after;
  double shift_x, shift_y, angle;  // m, rad, as in Registration
  double lift;                     // m
};

// Heights at R(angle)(p - c) + c + shift; c: centre of the nodes.
class WaveSurface {
 public:
  WaveSurface(const WornPairKind& kind, std::uint64_t seed) : kind_(kind) {
    const Stream draw(seed, kind.name + " waves");
    const double hurst = draw.uniform(0, 0.5, 0.95), cell = std::sqrt(kind.cell_x * kind.cell_y);
    double squares = 0;
    for (int k = 0; k < kind.waves; ++k) {
      const auto at = [&](int which) { return draw.uniform(static_cast<std::uint64_t>(4 * k + which + 1)); };
      const double length = 4 * cell * elementary::pow(32, at(0));
      const auto [sine, cosine] = elementary::sincos(two_pi * at(1));
      const double q = two_pi / length;
      waves_.push_back(
          {q * cosine, q * sine / kind.lay, two_pi * at(2), elementary::pow(length / cell, hurst)});
      squares += 0.5 * waves_.back().amplitude * waves_.back().amplitude;
    }
    for (Wave& wave : waves_) wave.amplitude *= kind.rms / std::sqrt(squares);
  }

  Field sampled(double shift_x, double shift_y, double angle) const {
    const auto [sine, cosine] = elementary::sincos(angle);
    const double cx = 0.5 * (kind_.nx - 1) * kind_.cell_x, cy = 0.5 * (kind_.ny - 1) * kind_.cell_y;
    Field z(kind_.nx, kind_.ny);
    std::vector<double> cosines(static_cast<std::size_t>(kind_.nx)), sines(cosines.size());
    for (const Wave& wave : waves_) {
      // The phase is a sum over columns and rows.
      const double qx = wave.qx * cosine + wave.qy * sine, qy = -wave.qx * sine + wave.qy * cosine;
      const double start =
          wave.phase + wave.qx * (cx + shift_x) + wave.qy * (cy + shift_y) - qx * cx - qy * cy;
      for (int i = 0; i < kind_.nx; ++i) {
        const auto of = elementary::sincos(qx * i * kind_.cell_x);
        cosines[static_cast<std::size_t>(i)] = wave.amplitude * of.cosine;
        sines[static_cast<std::size_t>(i)] = wave.amplitude * of.sine;
      }
      for (int j = 0; j < kind_.ny; ++j) {
        const auto of = elementary::sincos(start + qy * j * kind_.cell_y);
        double* row = z.row(j).data();
        for (int i = 0; i < kind_.nx; ++i)
          row[i] +=
              of.cosine * cosines[static_cast<std::size_t>(i)] - of.sine * sines[static_cast<std::size_t>(i)];
      }
    }
    return z;
  }

 private:
  struct Wave {
    double qx, qy, phase, amplitude;
  };
  const WornPairKind& kind_;
  std::vector<Wave> waves_;
};

inline void wear(Field& z, double share, double rms, const WornPairKind& kind, std::uint64_t seed) {
  std::vector<double> sorted(z.values().begin(), z.values().end());
  const auto place =
      sorted.begin() + static_cast<std::ptrdiff_t>((1 - share) * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), place, sorted.end());
  const double limit = *place;
  WornPairKind fine = kind;
  fine.name += " texture";
  fine.waves = 30;
  fine.rms = 0.03 * rms;
  fine.lay = 1;
  const Field texture = WaveSurface(fine, seed).sampled(0, 0, 0);
  for (std::size_t k = 0; k < z.size(); ++k)
    if (z[k] > limit) z[k] = limit + 0.1 * (z[k] - limit) + texture[k];
}

inline void add_noise(Field& z, double size, std::uint64_t seed, const std::string& name) {
  const Stream draw(seed, name);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] += size * draw.normal(k);
}

inline void punch_holes(Field& z, double share, std::uint64_t seed, const std::string& name) {
  const Stream draw(seed, name);
  std::size_t missing = 0;
  for (std::uint64_t k = 0; static_cast<double>(missing) < share * static_cast<double>(z.size()); ++k) {
    const double x = draw.uniform(3 * k, 0, z.nx()), y = draw.uniform(3 * k + 1, 0, z.ny());
    const double radius = draw.uniform(3 * k + 2, 2, 9);
    for (int j = std::max(0, static_cast<int>(y - radius)); j < std::min<double>(z.ny(), y + radius + 1); ++j)
      for (int i = std::max(0, static_cast<int>(x - radius)); i < std::min<double>(z.nx(), x + radius + 1);
           ++i)
        if ((i - x) * (i - x) + (j - y) * (j - y) < radius * radius && !std::isnan(z(i, j))) {
          z(i, j) = std::numeric_limits<double>::quiet_NaN();
          ++missing;
        }
  }
}

inline void tilt(Field& z, double across_x, double across_y) {
  for (int j = 0; j < z.ny(); ++j)
    for (int i = 0; i < z.nx(); ++i) z(i, j) += across_x * i / z.nx() + across_y * j / z.ny();
}

inline WornPair worn_pair(const WornPairKind& kind, std::uint64_t seed, double shift_x, double shift_y,
                          double angle) {
  const Stream draw(seed, kind.name);
  const WaveSurface waves(kind, seed);
  Field before = waves.sampled(0, 0, 0), after = waves.sampled(shift_x, shift_y, angle);
  const double noise = draw.uniform(4, kind.least_noise, kind.most_noise) * kind.rms;
  if (kind.most_worn > 0) wear(after, draw.uniform(3, kind.least_worn, kind.most_worn), kind.rms, kind, seed);
  const double across_x = draw.uniform(5, -0.5, 0.5) * kind.rms,
               across_y = draw.uniform(6, -0.5, 0.5) * kind.rms;
  tilt(after, across_x, across_y);
  add_noise(before, noise, seed, kind.name + " noise before");
  add_noise(after, noise, seed, kind.name + " noise after");
  if (kind.most_holes > 0) {
    punch_holes(before, draw.uniform(7, kind.least_holes, kind.most_holes), seed,
                kind.name + " holes before");
    punch_holes(after, draw.uniform(8, kind.least_holes, kind.most_holes), seed, kind.name + " holes after");
  }
  const Grid grid = make_grid(kind.nx, kind.ny, kind.nx * kind.cell_x, kind.ny * kind.cell_y);
  const double lift = 0.5 * (across_x * (kind.nx - 1) / kind.nx + across_y * (kind.ny - 1) / kind.ny);
  return {Surface::with_holes(grid, std::move(before)),
          Surface::with_holes(grid, std::move(after)),
          shift_x,
          shift_y,
          angle,
          lift};
}

inline WornPair worn_pair(const WornPairKind& kind, std::uint64_t seed) {
  const Stream draw(seed, kind.name);
  return worn_pair(kind, seed, draw.uniform(0, -kind.shift, kind.shift) * kind.cell_x,
                   draw.uniform(1, -kind.shift, kind.shift) * kind.cell_y,
                   draw.uniform(2, -kind.turn, kind.turn));
}

}  // namespace asperity::testing
