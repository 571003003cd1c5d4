// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds on the algebraic error: valid for any feasible pressures, and tight.
#include "engine/contact/solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <thread>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/error/half_space_error.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::algebraic_error_test {
namespace {

using half_space_test::rough_problem;
using half_space_test::solve;
using test::boxes;
using test::elastic;
using test::random_surface;
using test::ready;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Trial {
  Scene scene;
  PressRequest request;
};

State press(const Trial& trial) { return ready(trial.scene)->press(trial.request); }

class Draws {
 public:
  explicit Draws(std::uint64_t scene) : stream_(scene, "scenes of bounds") {}
  double uniform(double low, double high) { return stream_.uniform(next_++, low, high); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int below(int n) { return static_cast<int>(stream_.below(next_++, static_cast<std::uint64_t>(n))); }

 private:
  Stream stream_;
  std::uint64_t next_ = 0;
};

// Ten kinds of scene: 8² to 48² nodes, smooth or white heights of slope about 0.1, loads from a thousandth of
// full contact to full contact.
Trial trial_of(std::uint64_t scene) {
  Draws draw(scene);
  const int nx = 8 + draw.below(41), ny = draw.below(3) == 0 ? 8 + draw.below(41) : nx;
  const double hx = 1e-6, hy = draw.below(4) == 0 ? draw.uniform(0.5, 2) * hx : hx;
  Material material = elastic(1e9, 0.3);
  const double full = 0.1 * 1e9 / (1 - 0.09), pressure = full * draw.log_uniform(1e-3, 1);
  material.hardness = pressure * draw.log_uniform(1.4, 16);
  const Surface heights = [&] {
    if (draw.below(3) == 0) {
      Field white = random_surface(nx, ny, scene + 1).heights();
      for (double& z : white.values()) z *= 1e-7;
      return Surface(make_grid(nx, ny, nx * hx, ny * hy), std::move(white));
    }
    SelfAffineOptions options;
    options.grid = make_grid(nx, ny, nx * hx, ny * hy);
    options.hurst = draw.uniform(0.3, 1);
    options.rms_slope = 0.1;
    options.short_wave = std::max(hx, hy) * draw.uniform(2, 5);
    options.seed = scene + 1;
    return self_affine_surface(options);
  }();
  const double height = heights.height_range().span();

  enum {
    elastic_one,
    elastic_free,
    capped,
    capped_free,
    hardening,
    hardening_free,
    box,
    deep,
    deep_free,
    deep_plastic
  };
  const auto kind = scene % 10;
  const bool free = kind == elastic_free || kind == capped_free || kind == hardening_free || kind == box ||
                    kind == deep_free;
  Trial trial{{heights.with_material(material), rigid_material(), free ? Boundary::free : Boundary::periodic,
               HalfSpaceOptions{}, Accuracy{}},
              {PressBy::pressure, pressure, {}}};
  trial.scene.accuracy.tolerance = draw.log_uniform(1e-9, 1e-3);
  trial.scene.accuracy.on_failure = Accuracy::OnFailure::best;
  if (kind == box) trial.scene.elasticity = BoxOptions{};
  if (kind == capped || kind == capped_free || kind == hardening || kind == hardening_free ||
      kind == deep_plastic)
    trial.scene.effects.set(PlasticityOptions{});
  if (kind == hardening || kind == hardening_free || (kind == deep_plastic && draw.below(2) == 0))
    trial.scene.effects.find<PlasticityOptions>()->hardening =
        *material.hardness / height * draw.log_uniform(0.1, 10);
  if (kind >= deep) trial.request = {PressBy::indentation, draw.uniform(0.02, 0.35), {}};
  return trial;
}

struct Compared {
  const char* name;
  double value, exact, bound, bound_of_exact;
};

std::vector<Compared> compare(const State& st, const State& exact) {
  const AlgebraicError &e = st.algebraic_error(), &f = exact.algebraic_error();
  std::vector<Compared> all = {
      {"load", st.load(), exact.load(), e.load.value(), f.load.value()},
      {"pressure", st.pressure(), exact.pressure(), e.pressure.value(), f.pressure.value()},
      {"approach", st.approach(), exact.approach(), e.approach, f.approach},
      {"indentation", st.indentation(), exact.indentation(), e.indentation, f.indentation},
      {"separation", st.separation(), exact.separation(), e.separation, f.separation},
      {"mean gap", st.mean_gap(), exact.mean_gap(), e.mean_gap, f.mean_gap},
      {"energy", st.energy(), exact.energy(), e.energy, f.energy},
      {"peak pressure", st.peak_pressure(), exact.peak_pressure(), e.peak_pressure, f.peak_pressure},
      {"secant stiffness", st.secant_stiffness(), exact.secant_stiffness(), e.secant_stiffness.value(),
       f.secant_stiffness.value()},
      {"contacts", static_cast<double>(st.contacts()), static_cast<double>(exact.contacts()), e.contacts,
       f.contacts},
      {"area fraction", st.area_fraction(), exact.area_fraction(), e.area_fraction, f.area_fraction},
      {"area", st.area(), exact.area(), e.area, f.area},
      {"corrected area fraction", st.corrected_area_fraction(), exact.corrected_area_fraction(),
       e.corrected_area_fraction, f.corrected_area_fraction},
  };
  if (e.plastic_volume) {
    all.push_back({"plastic volume", st.plastic_volume(), exact.plastic_volume(), *e.plastic_volume,
                   *f.plastic_volume});
    all.push_back({"plastic fraction", st.plastic_fraction(), exact.plastic_fraction(), *e.plastic_fraction,
                   *f.plastic_fraction});
  }
  return all;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(AlgebraicError, BoundsHoldAgainstSolvesToTheLastDigitsInAHundredRandomScenes) {
  for (std::uint64_t scene = 0; scene < 100; ++scene) {
    Trial trial = trial_of(scene);
    const State st = press(trial);
    trial.scene.accuracy.tolerance = 1e-13;
    const State exact = press(trial);
    for (const Compared& c : compare(st, exact))
      // The reference has its own bound; both round in the last digit.
      EXPECT_LE(std::abs(c.value - c.exact), c.bound + c.bound_of_exact + 2 * epsilon * std::abs(c.value))
          << c.name << " in scene " << scene;
    const NodeBracket contacts = st.algebraic_error().contact_bracket;
    EXPECT_LE(contacts.low, exact.contacts()) << scene;
    EXPECT_GE(contacts.high, exact.contacts()) << scene;
    if (const auto yielded = st.algebraic_error().yielded_bracket) {
      const double n = static_cast<double>(st.algebraic_error().nodes);
      EXPECT_LE(static_cast<double>(yielded->low), exact.plastic_fraction() * n + 0.5) << scene;
      EXPECT_GE(static_cast<double>(yielded->high), exact.plastic_fraction() * n - 0.5) << scene;
    }
  }
}

TEST(AlgebraicError, BoundsOfAnOrdinarySolveAreMillionths) {
  std::map<std::string, std::vector<double>> relative, over_truth;
  for (std::uint64_t scene = 100; scene < 200; ++scene) {
    Trial trial = trial_of(scene);
    trial.scene.accuracy.tolerance = 1e-6;
    const State st = press(trial);
    trial.scene.accuracy.tolerance = 1e-13;
    for (const Compared& c : compare(st, press(trial))) {
      if (c.value > 0) relative[c.name].push_back(c.bound / c.value);
      const double off = std::abs(c.value - c.exact);
      if (off > 10 * c.bound_of_exact + 10 * epsilon * c.value) over_truth[c.name].push_back(c.bound / off);
    }
  }
  const std::map<std::string, double> most = {
      {"load", 1e-14},         {"approach", 5e-7},         {"separation", 1e-6},
      {"mean gap", 2e-6},      {"energy", 4e-6},           {"area", 0},
      {"peak pressure", 5e-6}, {"secant stiffness", 1e-6}, {"plastic volume", 1e-5}};
  for (const auto& [name, bound] : most) EXPECT_LE(median(relative[name]), bound) << name;
  for (const char* name : {"approach", "energy", "mean gap", "peak pressure", "plastic volume"}) {
    EXPECT_GE(over_truth[name].size(), 20U) << name;
    EXPECT_LE(median(over_truth[name]), 200) << name;
  }
}

TEST(AlgebraicError, WhatRoundingLeavesIsSmall) {
  for (std::uint64_t scene = 200; scene < 230; ++scene) {
    Trial trial = trial_of(scene);
    trial.scene.accuracy.tolerance = 1e-13;
    const State st = press(trial);
    const AlgebraicError& error = st.algebraic_error();
    EXPECT_LE(error.approach, 1e-11 * st.approach()) << scene;
    EXPECT_LE(error.energy, 1e-10 * st.energy()) << scene;
    EXPECT_GT(error.approach, 0) << scene;
  }
}

TEST(AlgebraicError, HoldsForPressuresThatWereNeverSolved) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const HalfSpaceProblem problem = rough_problem(32, boundary, 5, 1e-13);
    const HalfSpaceAnswer exact = solve(problem, 0.01);
    for (const double amount : {1e-6, 1e-3, 0.1, 0.5}) {
      const Stream noise(7, "noise");
      HalfSpaceAnswer answer = exact;
      double sum = 0;
      for (std::size_t k = 0; k < answer.pressure.size(); ++k) {
        double& p = answer.pressure[k];
        p = p * (1 + amount * noise.normal(k)) + (noise.uniform(k + 5000) < 0.1 ? 0.01 * amount : 0.0);
        p = std::max(0.0, p);
        sum += p;
      }
      for (double& p : answer.pressure.values())
        p *= 0.01 * static_cast<double>(answer.pressure.size()) / sum;
      certify(problem, answer);
      const auto gap_and_energy = [&](const HalfSpaceAnswer& at) {
        Reported reported;
        reported.mean_gap = half_space_test::mean_gap(at);
        const std::vector<double> u = half_space_test::dense_displacement(problem, at.pressure);
        for (std::size_t k = 0; k < u.size(); ++k)
          reported.energy += 0.5 * at.pressure[k] * u[k] * problem.grid.cell_area();
        return reported;
      };
      const Reported here = gap_and_energy(answer), there = gap_and_energy(exact);
      const SolutionError error = half_space_error(problem, answer, here);
      EXPECT_LE(std::abs(here.energy - there.energy), error.energy) << amount;
      EXPECT_LE(std::abs(here.mean_gap - there.mean_gap), error.mean_gap) << amount;
      EXPECT_LE(std::abs(answer.peak_pressure - exact.peak_pressure), error.peak_pressure) << amount;
      EXPECT_LE(error.contacts.low, exact.contacts) << amount;
      EXPECT_GE(error.contacts.high, exact.contacts) << amount;
      answer.approach *= 1 + 0.1 * amount;
      const SolutionError moved = half_space_error(problem, answer, here);
      EXPECT_LE(std::abs(answer.approach - exact.approach), moved.approach) << amount;
      if (amount <= 1e-3) {  // pressure at wide gaps enters through its work: a square root
        EXPECT_LE(moved.approach, std::sqrt(amount) * exact.approach);
      }
    }
  }
}

TEST(AlgebraicError, AnApproachThatTheLoadDoesNotFixIsBracketed) {
  const Surface steps = test::surface_of(make_grid(16, 16, 16e-6, 16e-6),
                                         [](int i, int j) { return i < 4 && j < 4 ? 5e-6 : 0.0; });
  Material material = elastic(1e9, 0.3);
  material.hardness = 1e6;
  Scene scene{steps.with_material(material), rigid_material(), Boundary::periodic, HalfSpaceOptions{},
              Accuracy{}};
  scene.effects.set(PlasticityOptions{});
  const auto solver = ready(scene);
  const State half = solver->press({PressBy::approach, 2.5e-6, {}});
  ASSERT_EQ(half.contacts(), 16);
  // One ulp more needs a seventeenth node.
  const double all = 1e6 * 16 / 256;
  EXPECT_NEAR(half.pressure(), all, 1e-12 * all);
  const State st = solver->press({PressBy::pressure, all, {}});
  ASSERT_EQ(st.contacts(), 16);
  EXPECT_GE(st.algebraic_error().approach, std::abs(st.approach() - 2.5e-6));
  EXPECT_GE(st.algebraic_error().approach, 1e-6);
  EXPECT_LE(st.algebraic_error().approach, 6e-6);
  EXPECT_EQ(st.algebraic_error().contact_bracket.low, 16);
}

TEST(AlgebraicError, OfAFirstTouchAndOfAFlatIsNone) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    Scene scene{random_surface(9, 9, 1).with_material(elastic(1)), rigid_material(), boundary,
                HalfSpaceOptions{}, Accuracy{}};
    const AlgebraicError touch = ready(scene)->press({PressBy::pressure, 0, {}}).algebraic_error();
    EXPECT_EQ(touch.approach, 0);
    EXPECT_EQ(touch.contact_bracket.high, 0);
    scene.lower =
        test::surface_of(make_grid(8, 8, 1, 1), [](int, int) { return 2.0; }).with_material(elastic(1));
    const State flat = ready(scene)->press({PressBy::pressure, 1e-3, {}});
    EXPECT_LE(flat.algebraic_error().approach, 1e-5 * 1e-3);
    EXPECT_EQ(flat.algebraic_error().indentation, std::numeric_limits<double>::infinity());
    EXPECT_EQ(flat.algebraic_error().contact_bracket.low, 64);
  }
}

TEST(AlgebraicError, OfBoxesIsRounding) {
  const State st = ready(boxes(random_surface(40, 40, 3), 6))->press({PressBy::pressure, 0.5, {}});
  const AlgebraicError& error = st.algebraic_error();
  EXPECT_GT(error.approach, 0);
  EXPECT_LE(error.approach, 100 * epsilon * st.approach());
  EXPECT_LE(error.energy, 100 * epsilon * st.energy());
  EXPECT_EQ(error.contacts, 0);
  EXPECT_FALSE(error.plastic_volume);
  EXPECT_EQ(error.cost.transforms, 0);
}

TEST(AlgebraicError, APressByFlatteningHasNoneOfItsLoadAndBoundsAtTheLoadFound) {
  Trial trial = trial_of(1);
  trial.scene.accuracy.tolerance = 1e-4;
  trial.request = {PressBy::flatten, 0.1, {}};
  const State st = press(trial);
  EXPECT_FALSE(st.algebraic_error().load || st.algebraic_error().pressure ||
               st.algebraic_error().secant_stiffness);
  trial.request = {PressBy::pressure, st.pressure(), {}};
  trial.scene.accuracy.tolerance = 1e-13;
  const State exact = press(trial);
  EXPECT_LE(std::abs(st.approach() - exact.approach()), st.algebraic_error().approach);
  EXPECT_LE(std::abs(st.energy() - exact.energy()), st.algebraic_error().energy);
}

TEST(AlgebraicError, IsFoundWhenReadAndNotPaidByThePress) {
  const State st = press(trial_of(2));
  const double transforms = st.cost().total.transforms;
  const CostScope before;
  st.area();
  EXPECT_EQ(before.so_far().transforms, 0);
  const double counted = st.algebraic_error().cost.transforms;
  EXPECT_GE(counted, 4);
  EXPECT_LE(counted, 12);
  EXPECT_EQ(before.so_far().transforms, counted);
  EXPECT_EQ(st.cost().total.transforms, transforms);
  EXPECT_EQ(&State(st).algebraic_error(), &st.algebraic_error());
  EXPECT_EQ(before.so_far().transforms, counted);
}

TEST(AlgebraicError, IsTheSameForEveryReader) {
  const State st = press(trial_of(4));
  std::vector<const AlgebraicError*> seen(4);
  std::vector<std::thread> readers;
  for (std::size_t t = 0; t < seen.size(); ++t)
    readers.emplace_back([&, t] { seen[t] = &st.algebraic_error(); });
  for (std::thread& reader : readers) reader.join();
  for (const AlgebraicError* error : seen) EXPECT_EQ(error, seen[0]);
  EXPECT_EQ(press(trial_of(4)).algebraic_error().energy, seen[0]->energy);
}

}  // namespace
}  // namespace asperity::algebraic_error_test
