// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation error estimates on seeds without tuning, against exact answers (Hertz, Westergaard) or eight
// times the cells a side. Most of the error is random; required is a true error within three estimates.
// Estimates above three true errors are bounded for the area fraction (not random) and for estimates from a
// finer grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::discretisation_estimates_test {
namespace {

constexpr int cells = 128, true_cells = 1024;
constexpr double modulus = 1e9;

using Values = std::map<std::string, double>;

Scene scene_on(const Surface& surface, int n, Boundary boundary, double hardness) {
  Material material;
  material.young = modulus;
  material.poisson = 0;
  if (hardness > 0) material.hardness = hardness;
  Scene scene{at_cells(surface, n, n).surface.with_material(material), rigid_material(), boundary,
              HalfSpaceOptions{}, Accuracy{}};
  if (hardness > 0) scene.effects.set(PlasticityOptions{});
  return scene;
}

class Survey {
 public:
  explicit Survey(std::string from) : from_(std::move(from)) {}

  void hold(const State& state, const Values& truth) {
    ++scenes_;
    for (const auto& [quantity, value] : truth) {
      const DiscretisationEstimate estimate = discretisation_estimate(state, quantity);
      const double off = std::abs(estimate.value - value);
      if (off <= 1e-9 * std::abs(value) && estimate.error <= 1e-6 * std::abs(value)) continue;
      ratios_[quantity].push_back(estimate.error / off);
    }
  }

  double covered(const std::string& quantity) const {
    return share(quantity, [](double ratio) { return ratio >= 1.0 / 3; });
  }
  double not_over(const std::string& quantity) const {
    return share(quantity, [](double ratio) { return ratio <= 3; });
  }
  double within(const std::string& quantity) const {
    return share(quantity, [](double ratio) { return ratio >= 1.0 / 3 && ratio <= 3; });
  }

  void print() const {
    std::printf("%d scenes of %d x %d cells; estimate from %s over true error:\n", scenes_, cells, cells,
                from_.c_str());
    for (const auto& [quantity, found] : ratios_) {
      std::vector<double> sorted = found;
      std::sort(sorted.begin(), sorted.end());
      const auto at = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
      };
      std::printf(
          "  %-24s %3zu: 5 %% %-7.2g 10 %% %-7.2g median %-7.2g 90 %% %-7.2g true error within 3 "
          "estimates %.2f, estimate within 3 true errors %.2f, both %.2f\n",
          quantity.c_str(), sorted.size(), at(0.05), at(0.1), at(0.5), at(0.9), covered(quantity),
          not_over(quantity), within(quantity));
    }
  }

 private:
  template <class Test>
  double share(const std::string& quantity, Test test) const {
    const std::vector<double>& found = ratios_.at(quantity);
    return static_cast<double>(std::count_if(found.begin(), found.end(), test)) /
           static_cast<double>(found.size());
  }

  std::string from_;
  std::map<std::string, std::vector<double>> ratios_;
  int scenes_ = 0;
};

struct Surveys {
  Survey coarser{"half and a quarter of the cells"}, finer{"thrice the cells"};

  // Without `exact`, also on the fine grid.
  void scene(const Surface& surface, Boundary boundary, const PressRequest& request, double hardness = 0,
             Values exact = {}) {
    if (exact.empty()) {
      const State fine = SpecimenPair(scene_on(surface, true_cells, boundary, hardness)).press(request);
      // The first touch is between the nodes on this grid, too.
      const double rise = rise_between_nodes(fine.geometry().combined(), boundary == Boundary::periodic);
      exact = {{"corrected_area_fraction", fine.corrected_area_fraction()},
               {"area_fraction", fine.corrected_area_fraction()},
               {"approach", fine.approach() + rise},
               {"separation", fine.separation()},
               {"mean_gap", fine.mean_gap()},
               {"energy", fine.energy()},
               {"stiffness", fine.stiffness()}};
      if (hardness > 0) {
        exact["plastic_volume"] = fine.plastic_volume();
        exact["plastic_fraction"] = fine.plastic_fraction();
      }
    }
    hold(scene_on(surface, cells, boundary, hardness), request, exact);
  }

  void at_approach(const Surface& surface, Boundary boundary, double share) {
    const double approach = share * range(surface.heights().values()).span();
    const double rise = rise_between_nodes(surface.heights(), boundary == Boundary::periodic);
    const State fine = SpecimenPair(scene_on(surface, true_cells, boundary, 0))
                           .press({PressBy::approach, approach - rise, {}});
    hold(scene_on(surface, cells, boundary, 0), {PressBy::approach, approach, {}},
         {{"load", fine.load()},
          {"secant_stiffness", fine.pressure() / approach},
          {"separation", fine.separation()},
          {"mean_gap", fine.mean_gap()},
          {"energy", fine.energy()}});
  }

  void hold(Scene scene, const PressRequest& request, const Values& exact) {
    for (Survey* survey : {&coarser, &finer}) {
      scene.accuracy.estimate = survey == &coarser ? Accuracy::Estimate::coarser : Accuracy::Estimate::finer;
      survey->hold(SpecimenPair(scene).press(request), exact);
    }
  }
};

void add_exact(Surveys& survey) {
  const Surface cap = sphere_surface({Grid{true_cells, true_cells, 1, 1}, 10, SphereShape::paraboloid});
  for (const double a : {0.07, 0.11, 0.17, 0.25, 0.37}) {
    const double load = 4.0 / 3 * modulus * a * a * a / 10, area = std::numbers::pi * a * a;
    survey.scene(cap, Boundary::free, {PressBy::load, load, {}}, 0,
                 {{"area_fraction", area},
                  {"corrected_area_fraction", area},
                  {"approach", a * a / 10},
                  {"energy", 0.4 * load * a * a / 10},
                  {"stiffness", 2 * modulus * a}});
  }
  const Surface wave = sine_surface({Grid{true_cells, true_cells, 1, 1}, 0.01, {}, 1});
  for (const double share : {0.04, 0.12, 0.27, 0.55, 0.8}) {
    const double area = 2 / std::numbers::pi * std::asin(std::sqrt(share));
    survey.scene(wave, Boundary::periodic, {PressBy::pressure, share * std::numbers::pi * modulus * 0.01, {}},
                 0, {{"area_fraction", area}, {"corrected_area_fraction", area}});
  }
  const Surface waves = sine_surface({Grid{true_cells, true_cells, 1, 1}, 0.01, {}, 2});
  for (const double share : {0.03, 0.3})
    survey.scene(waves, Boundary::periodic,
                 {PressBy::pressure, share * std::numbers::pi * modulus * 0.01, {}});
}

void add_self_affine(Surveys& survey, std::uint64_t seed) {
  SelfAffineOptions o = test::self_affine(Grid{true_cells, true_cells, 1, 1}, 0.8, 1.0 / 16, seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  const Surface surface = self_affine_surface(o);
  for (const double p : {0.005, 0.02, 0.05, 0.1, 0.3})
    survey.scene(surface, Boundary::periodic, {PressBy::pressure, 0.1 * p * modulus, {}});
  survey.scene(surface, Boundary::free, {PressBy::pressure, 0.005 * modulus, {}});
  for (const double p : {0.02, 0.1})
    survey.scene(surface, Boundary::periodic, {PressBy::pressure, 0.1 * p * modulus, {}}, 0.05 * modulus);
}

void add_blasted(Surveys& survey, std::uint64_t seed) {
  BeadBlastedOptions o;
  o.grid = Grid{true_cells, true_cells, 0.25e-3, 0.25e-3};
  o.ra = 2e-6;
  o.seed = seed;
  const Surface surface = bead_blasted_surface(o);
  for (const double p : {0.003, 0.015, 0.06})
    survey.scene(surface, Boundary::periodic, {PressBy::pressure, p * modulus, {}});
}

void add_at_approach(Surveys& survey, std::uint64_t seed) {
  SelfAffineOptions o = test::self_affine(Grid{true_cells, true_cells, 1, 1}, 0.8, 1.0 / 16, seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  const Surface surface = self_affine_surface(o);
  for (const double share : {0.1, 0.25}) survey.at_approach(surface, Boundary::periodic, share);
  survey.at_approach(surface, Boundary::free, 0.2);
  BeadBlastedOptions b;
  b.grid = Grid{true_cells, true_cells, 0.25e-3, 0.25e-3};
  b.ra = 2e-6;
  b.seed = seed;
  survey.at_approach(bead_blasted_surface(b), Boundary::periodic, 0.3);
}

void add_fractal(Surveys& survey, std::uint64_t seed) {
  WeierstrassMandelbrotOptions o;
  o.nx = o.ny = true_cells;
  o.D = 2.3;
  o.L = 1;
  o.G = 1e-3;
  o.n_max = 6;
  o.seed = seed;
  const Surface surface = weierstrass_mandelbrot(o);
  for (const double p : {0.003, 0.02, 0.1})
    survey.scene(surface, Boundary::free, {PressBy::pressure, 0.1 * p * modulus, {}});
}

const Surveys& surveys() {
  static const Surveys all = [] {
    Surveys made;
    add_exact(made);
    for (const std::uint64_t seed : {101, 102, 103, 104, 301, 302, 303, 304}) add_self_affine(made, seed);
    for (const std::uint64_t seed : {105, 106, 305, 306}) add_blasted(made, seed);
    for (const std::uint64_t seed : {107, 108, 307, 308}) add_fractal(made, seed);
    return made;
  }();
  return all;
}

// Dominated by the known first touch. Within three estimates: 94 %; within a factor of three: 75 to 81 %;
// from the finer grid 100 %.
TEST(DiscretisationEstimates, OfAPrescribedApproach) {
  Surveys survey;
  for (const std::uint64_t seed : {309, 310, 311, 312}) add_at_approach(survey, seed);
  survey.coarser.print();
  survey.finer.print();
  for (const char* quantity : {"load", "secant_stiffness", "separation", "mean_gap", "energy"}) {
    EXPECT_GE(survey.coarser.covered(quantity), 0.9) << quantity;
    EXPECT_GE(survey.coarser.within(quantity), 0.7) << quantity;
    EXPECT_GE(survey.finer.within(quantity), 0.9) << quantity;
  }
}

TEST(DiscretisationEstimates, AreHonestOverManyScenes) {
  const Survey& survey = surveys().coarser;
  survey.print();
  for (const char* quantity : {"area_fraction", "corrected_area_fraction", "approach", "energy"})
    EXPECT_GE(survey.covered(quantity), 0.9) << quantity;
  for (const char* quantity : {"separation", "mean_gap", "stiffness", "plastic_volume", "plastic_fraction"})
    EXPECT_GE(survey.covered(quantity), 0.85) << quantity;
  // 98, 87 and 82 %; energy 54 %, mostly random: two errors from equal normal laws agree within a factor of
  // three in 59 %.
  EXPECT_GE(survey.within("area_fraction"), 0.9);
  EXPECT_GE(survey.within("approach"), 0.85);
  EXPECT_GE(survey.within("corrected_area_fraction"), 0.8);
  EXPECT_GE(survey.not_over("energy"), 0.5);
}

TEST(DiscretisationEstimates, FromAFinerGridAreSharp) {
  const Survey& survey = surveys().finer;
  survey.print();
  // Measured: 100, 93, 98, 97, 96, 93, 100 and 100 %.
  for (const char* quantity : {"area_fraction", "corrected_area_fraction", "approach", "energy", "separation",
                               "mean_gap", "plastic_volume", "plastic_fraction"})
    EXPECT_GE(survey.within(quantity), 0.9) << quantity;
  EXPECT_GE(survey.within("stiffness"), 0.85);  // 88 %
  for (const char* quantity : {"area_fraction", "corrected_area_fraction", "approach", "energy", "separation",
                               "mean_gap", "stiffness", "plastic_volume", "plastic_fraction"})
    EXPECT_GE(survey.covered(quantity), 0.95) << quantity;  // at least 97 % of each
}

}  // namespace
}  // namespace asperity::discretisation_estimates_test
