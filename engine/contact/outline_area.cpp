// SPDX-License-Identifier: GPL-3.0-or-later
// Each edge between a touching and an open node adds to the counted nodes, in cells,
//   w(p'/p) + within t(E* g/(p h)) + beyond s(g'/g) + turns(edges of the touching node),
// with p' the pressure of the next node inside, g' the gap of the next node outside, t the share of h within
// the outline by p and g, s = 1/((g'/g)^(2/3) - 1) the cells beyond the outline by the gaps, at most 1, and
// w linear between the values below. Fitted to 84 scenes of seven kinds on 24 to 512 cells a side
// (bench/requested_error.lua, seeds 701 to 712) against 2048 x 2048 cells. With other seeds and resolved
// waves the rms error of N edges is 0.19 sqrt(N) cells; of State::corrected_area_fraction() 0.57 sqrt(N).
// Nodes flattened up to the outline count whole: the elastic fit makes capped blasted faces up to 4 % too
// small on 128 x 128 cells.
#include "engine/contact/outline_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {

struct Value {
  double at, w;
};
constexpr std::array<Value, 6> by_next_inside{
    {{0, -0.105}, {1, -0.062}, {1.4, -0.052}, {1.8, -0.060}, {2.5, -0.060}, {4, -0.136}}};
constexpr double within = 0.239, beyond = -0.165;
constexpr std::array<double, 3> turns{0, -0.004, 0.065};  // for one, two, three or more edges
// Nine errors in ten are below coefficient · edges^grows_with_edges cells: 84 scenes outside the fit
// (bench/requested_error.lua, seeds 901 to 906 and 1101 to 1106), 50 to 20,000 edges, resolved waves.
constexpr double grows_with_edges = 0.62, in_nine_of_ten_wrapped = 0.13, in_nine_of_ten_open = 0.20;

constexpr int fewest_cells = 8;
constexpr double longest_cell = 1.25, most_rising = 0.5, alike = 1e-6;

double between_values(double ratio) {
  const double x = std::clamp(ratio, by_next_inside.front().at, by_next_inside.back().at);
  std::size_t k = 1;
  while (k + 1 < by_next_inside.size() && by_next_inside[k].at < x) ++k;
  const Value &low = by_next_inside[k - 1], &high = by_next_inside[k];
  return low.w + (high.w - low.w) * (x - low.at) / (high.at - low.at);
}

// Solves 4/3 (1 - t)^(3/2) / sqrt(t) = r: with s = 1 - t and u = (3r/4)², s³ + u s - u = 0; Newton's steps
// from 1 fall to the root.
double share_within(double r) {
  constexpr double largest = 1e6, close = 1e-12;
  const double u = 0.5625 * std::min(r, largest) * std::min(r, largest);
  double s = 1;
  for (int step = 0; step < 60; ++step) {
    const double next = (2 * s * s * s + u) / (3 * s * s + u);
    const bool found = std::abs(next - s) < close;
    s = next;
    if (found) break;
  }
  return 1 - s;
}

double cells_beyond(double gap, double next) {
  constexpr double two_thirds = 2.0 / 3;
  if (!(gap > 0)) return next > 0 ? 0.0 : 1.0;
  const double grows = elementary::pow(next / gap, two_thirds) - 1;
  return grows > 1 ? 1 / grows : 1.0;
}

// Pressures of the touching node and the next inside, gaps of two outside, cell width.
struct Edge {
  double p, inside, g, further, width;
};

// In cells. Boxes: linear across the outline; each direction gives half the area.
double added_by(const Edge& edge, double modulus, OutlineLaw law) {
  if (law == OutlineLaw::boxes) return 0.5 * (edge.p / (edge.p + modulus * edge.g) - 0.5);
  return between_values(edge.inside / edge.p) +
         within * share_within(modulus * edge.g / (edge.p * edge.width)) +
         beyond * cells_beyond(edge.g, edge.further);
}

}  // namespace

std::optional<OutlineArea> outline_area(const Field& pressure, const Field& gap, const Grid& grid,
                                        double modulus, bool wraps, OutlineLaw law) {
  const int nx = grid.nx, ny = grid.ny;
  const double hx = grid.size_x / nx, hy = grid.size_y / ny;
  if (std::min(nx, ny) < fewest_cells || hx > longest_cell * hy || hy > longest_cell * hx) return {};
  const auto pressures = pressure.values(), gaps = gap.values();
  double counted = 0, edges = 0, capped = 0, added = 0, rising = 0;
  // -1: past the rim of an open tile.
  constexpr std::ptrdiff_t none = -1;
  const auto beside = [&](int i, int j, int steps_x, int steps_y) -> std::ptrdiff_t {
    int a = i + steps_x, b = j + steps_y;
    if (wraps) {
      a = (a + nx) % nx;
      b = (b + ny) % ny;
    }
    if (a < 0 || b < 0 || a >= nx || b >= ny) return none;
    return static_cast<std::ptrdiff_t>(b) * nx + a;
  };
  constexpr std::array<std::array<int, 2>, 4> ways{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double p = pressure(i, j);
      if (!(p > 0)) continue;
      counted += 1;
      std::size_t here = 0;
      for (const auto& [x, y] : ways) {
        const std::ptrdiff_t out = beside(i, j, x, y), in = beside(i, j, -x, -y);
        if (out == none || pressures[static_cast<std::size_t>(out)] > 0) continue;
        const std::ptrdiff_t next = beside(i, j, 2 * x, 2 * y);
        const double g = gaps[static_cast<std::size_t>(out)];
        const Edge edge{p, in == none ? 0.0 : pressures[static_cast<std::size_t>(in)], g,
                        next == none ? g : gaps[static_cast<std::size_t>(next)], x != 0 ? hx : hy};
        edges += 1;
        // Flat up to the outline: counts whole.
        if (law == OutlineLaw::capped && std::abs(edge.inside - p) <= alike * p) {
          capped += 1;
          continue;
        }
        added += added_by(edge, modulus, law);
        if (law == OutlineLaw::boxes) continue;
        if (edge.inside > 0 && edge.inside < p) rising += 1;
        ++here;
      }
      if (here > 0) added += static_cast<double>(here) * turns[std::min(here, turns.size()) - 1];
    }
  const double area = counted + added;
  if (!(edges > 0) || !(area > 0) || rising > most_rising * edges) return {};
  // A capped outline may be anywhere in the next cell: two to three times the elastic errors in 30 blasted
  // scenes (bench/requested_error.lua, seeds 11 to 40).
  const double doubt = (wraps ? in_nine_of_ten_wrapped : in_nine_of_ten_open) *
                       elementary::pow(edges, grows_with_edges) * (1 + 2 * capped / edges);
  return OutlineArea{area / (static_cast<double>(nx) * ny), doubt / area};
}

}  // namespace asperity
