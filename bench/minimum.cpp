// SPDX-License-Identifier: GPL-3.0-or-later
// Overhead of SpecimenPair, State and the friction law in three scenes, against minimal code with the same
// solver.
//
//   bench_minimum                          the three scenes, 15 pairs each
//   bench_minimum pairs=41 threads=2       other settings
//
//   box friction         sort the heights, find the depth of a load, count the contacts, sum the law
//   elastic half-space   combine two bodies, solve, read area fraction and approach
//   capped event         combine, solve below a hardness, subtract the plastic volume from both bodies
//
// Both alternate and must give the same bits. Processor times over all threads; median ratio of the pairs.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/parallel.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"

namespace {

using namespace asperity;

constexpr double stiffness = 3, tau0 = 0.01, alpha = 0.2, tolerance = 1e-6, hardness = 0.15;
constexpr double young = 1, poisson = 0.3, pressed = 0.01;

// Results of a scene.
using Numbers = std::vector<double>;

struct Scenario {
  const char* name;
  int cells;
  std::function<Numbers()> laboratory, by_hand;
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Surface rough(int cells, std::uint64_t seed) {
  Material metal;
  metal.young = young;
  metal.poisson = poisson;
  metal.hardness = hardness;
  SelfAffineOptions options;
  options.grid = make_grid(cells, cells, 1, 1);
  options.hurst = 0.8;
  options.rms_slope = 0.1;
  options.short_wave = 16.0 / cells;
  options.seed = seed;
  return self_affine_surface(options).with_material(metal);
}

Scenario box_friction(int cells) {
  const Surface surface = rough(cells, 1);
  const Scene scene{surface, rigid_material(), Boundary::free, BoxOptions{stiffness}, Accuracy{tolerance}};
  return {"box friction", cells,
          [scene]() -> Numbers {
            SpecimenPair pair(scene);
            const State state = pair.press({PressBy::pressure, pressed, {}});
            const FrictionResult friction = JunctionLaw({.tau0 = tau0, .alpha = alpha}).on(state);
            return {state.approach(), friction.force};
          },
          [surface]() -> Numbers {
            const Grid& grid = surface.grid();
            const SortedDrops drops(surface.heights().values());
            const double depth = drops.depth(pressed / stiffness * static_cast<double>(drops.size()));
            const double area = static_cast<double>(drops.touched(depth)) * grid.cell_area();
            return {depth, tau0 * area + alpha * (pressed * grid.area())};
          }};
}

// Without placement: lower node (i, j) meets upper node (nx-1-i, j).
HalfSpaceProblem problem_of(const Surface& lower, const Surface& upper) {
  const Grid& grid = lower.grid();
  Field combined = lower.heights();
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) combined(i, j) += upper.heights()(grid.nx - 1 - i, j);
  HalfSpaceProblem problem;
  problem.grid = grid;
  problem.boundary = Boundary::periodic;
  const double compliance = 1 / (young / ((1 - poisson) * (1 + poisson)));
  problem.modulus = 1 / (compliance + compliance);
  const double middle = mean(combined.values());
  Array<double> squares(combined.size());
  for (std::size_t k = 0; k < squares.size(); ++k)
    squares[k] = (combined[k] - middle) * (combined[k] - middle);
  problem.rms = std::sqrt(block_sum(squares) / static_cast<double>(squares.size()));
  problem.heights = std::make_shared<const Field>(std::move(combined));
  problem.tolerance = tolerance;
  return problem;
}

Scenario elastic_half_space(int cells) {
  const Surface lower = rough(cells, 1), upper = rough(cells, 2);
  const Scene scene{lower, upper, Boundary::periodic, HalfSpaceOptions{}, Accuracy{tolerance}};
  return {"elastic half-space", cells,
          [scene]() -> Numbers {
            SpecimenPair pair(scene);
            const State state = pair.press({PressBy::pressure, pressed, {}});
            return {state.approach(), state.area_fraction()};
          },
          [lower, upper]() -> Numbers {
            const HalfSpaceAnswer answer =
                solve_at_pressure(problem_of(lower, upper), pressed, nullptr, Monitor::silent());
            return {answer.approach,
                    static_cast<double>(answer.contacts) / static_cast<double>(answer.pressure.size())};
          }};
}

Scenario capped_event(int cells) {
  const Surface lower = rough(cells, 1), upper = rough(cells, 2);
  Scene scene{lower, upper, Boundary::periodic, HalfSpaceOptions{}, Accuracy{tolerance}};
  scene.effects.set(PlasticityOptions{});
  return {"capped event", cells,
          [scene]() -> Numbers {
            SpecimenPair pair(scene);
            const State state = pair.press({PressBy::pressure, pressed, {}});
            pair.release();
            const Field &a = pair.lower().heights(), b = pair.upper().heights();
            return {state.approach(), a[a.size() / 2], b[b.size() / 3]};
          },
          [lower, upper]() -> Numbers {
            HalfSpaceProblem problem = problem_of(lower, upper);
            problem.yield.cap = hardness;
            const HalfSpaceAnswer answer = solve_at_pressure(problem, pressed, nullptr, Monitor::silent());
            const Grid& grid = problem.grid;
            Field a = lower.heights(), b = upper.heights();
            for (int j = 0; j < grid.ny; ++j)
              for (int i = 0; i < grid.nx; ++i)
                if (const double w = -answer.gap(i, j); answer.pressure(i, j) >= hardness && w > 0) {
                  a(i, j) -= 0.5 * w;
                  b(grid.nx - 1 - i, j) -= 0.5 * w;
                }
            return {answer.approach, a[a.size() / 2], b[b.size() / 3]};
          }};
}

// Processor seconds a run, mean over `turns`.
double seconds_of(const std::function<Numbers()>& way, int turns, Numbers& numbers) {
  const double start = processor_seconds();
  for (int k = 0; k < turns; ++k) numbers = way();
  return (processor_seconds() - start) / turns;
}

bool run(const Scenario& scenario, int pairs) {
  // Untimed: fills the caches of this grid size.
  Numbers laboratory_numbers = scenario.laboratory(), numbers;
  const double once = seconds_of(scenario.by_hand, 1, numbers);
  const bool same = laboratory_numbers == numbers;
  const int turns = std::max(1, static_cast<int>(std::ceil(0.02 / std::max(once, 1e-6))));
  std::vector<double> laboratory, by_hand, ratios;
  for (int k = 0; k < pairs; ++k) {
    double mine = 0;
    if (k % 2 == 0) mine = seconds_of(scenario.laboratory, turns, laboratory_numbers);
    by_hand.push_back(seconds_of(scenario.by_hand, turns, numbers));
    if (k % 2 != 0) mine = seconds_of(scenario.laboratory, turns, laboratory_numbers);
    laboratory.push_back(mine);
    ratios.push_back(mine / by_hand.back());
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("%-20s %6d %14.3f %12.3f %8.3f   %.3f to %.3f%s\n", scenario.name, scenario.cells,
              1e3 * median(laboratory), 1e3 * median(by_hand), median(ratios), ratios[ratios.size() / 4],
              ratios[3 * ratios.size() / 4], same ? "" : "   DIFFERENT NUMBERS");
  std::fflush(stdout);
  return same;
}

}  // namespace

int main(int count, char** words) {
  int pairs = 15, threads = 1;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    const int number = std::atoi(word.substr(word.find('=') + 1).c_str());
    if (word.starts_with("pairs=") && number > 0) {
      pairs = number;
    } else if (word.starts_with("threads=") && number > 0) {
      threads = number;
    } else {
      std::fprintf(stderr, "%s is none of pairs=, threads=\n", word.c_str());
      return 2;
    }
  }
  set_thread_count(threads);
  std::printf("%d pairs of runs, %d thread(s), milliseconds of the processor\n", pairs, threads);
  std::printf("%-20s %6s %14s %12s %8s   %s\n", "scene", "cells", "laboratory", "by hand", "ratio",
              "middle half");
  bool same = true;
  for (const int cells : {256, 1024}) same = run(box_friction(cells), pairs) && same;
  for (const int cells : {128, 512}) same = run(elastic_half_space(cells), pairs) && same;
  for (const int cells : {128, 512}) same = run(capped_event(cells), pairs) && same;
  return same ? 0 : 1;
}
