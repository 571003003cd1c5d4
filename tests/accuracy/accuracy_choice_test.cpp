// SPDX-License-Identifier: GPL-3.0-or-later
// Cells chosen for a requested error: choice, error, cost, failures. Other seeds:
// tests/accuracy/distributions.
#include "engine/accuracy/accuracy_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/quantity.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "tests/accuracy/asked_scenes.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::accuracy_choice_test {
namespace {

using test::asking;
using test::measured;
using test::rough;

using test::error_of;

TEST(AccuracyChoice, StopsAtTheFirstGridThatIsGoodEnough) {
  SpecimenPair pair(asking(rough(512), rigid_material(), Boundary::periodic, 0.05));
  EXPECT_EQ(pair.lower().grid().nx, 512);
  EXPECT_NE(pair.plan().text().find(
                "the first press chooses cells and tolerance for an error of 5 % of "
                "corrected_area_fraction, from 16 x 16 cells on; 4096 x 4096 cells are the most "
                "within 4 GiB of memory, the grid of the memory and time below"),
            std::string::npos)
      << pair.plan().text();
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  const ChosenAccuracy& chosen = *state.chosen();
  EXPECT_LT(chosen.nx, 512);
  EXPECT_TRUE(chosen.met());
  EXPECT_LE(chosen.error, 0.05);
  EXPECT_EQ(chosen.tried.back().nx, chosen.nx);
  EXPECT_EQ(pair.lower().grid().nx, chosen.nx);
  EXPECT_EQ(state.geometry().grid().nx, chosen.nx);
  EXPECT_EQ(pair.plan().accuracy.tolerance, chosen.tolerance);
  EXPECT_NE(pair.plan().text().find("cells and tolerance as the first press chose them"), std::string::npos);
  EXPECT_NE(chosen.text().find("5 % of corrected_area_fraction was requested"), std::string::npos)
      << chosen.text();
  EXPECT_GT(discretisation_estimate(state, "corrected_area_fraction").error, 0);
}

TEST(AccuracyChoice, IsCheaperThanTheDefaultOnTheCellsGiven) {
  const Surface surface = rough(512, 11);
  SpecimenPair usual({surface, rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}});
  const State by_default = usual.press({PressBy::pressure, 1e7, {}});
  SpecimenPair pair(asking(surface, rigid_material(), Boundary::periodic, 0.01));
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  const double cells = static_cast<double>(state.chosen()->nx) / 512;
  // In transforms of 512 x 512 cells.
  const double weight = cells * cells * std::log2(state.chosen()->nx) / 9;
  const double chosen_cost = state.cost().total.transforms * weight;
  EXPECT_LT(chosen_cost, 0.5 * by_default.cost().total.transforms);
  EXPECT_NEAR(state.corrected_area_fraction(), by_default.corrected_area_fraction(),
              0.01 * by_default.corrected_area_fraction());
  std::printf("asked for 1 %%: %d cells, %.1f transforms of 512 cells and %.3f s against %.1f and %.3f s\n",
              state.chosen()->nx, chosen_cost, state.cost().total.seconds, by_default.cost().total.transforms,
              by_default.cost().total.seconds);
}

TEST(AccuracyChoice, TheCorrectedAreaIsWithinAnOutlineBetweenTheNodes) {
  Scene scene = asking(rough(256), rigid_material(), Boundary::periodic, 0.03);
  SpecimenPair pair(scene);
  for (const double pressure : {1e7, 1.1e7}) {
    const State state = pair.press({PressBy::pressure, pressure, {}});
    ASSERT_TRUE(state.outline());
    EXPECT_EQ(state.corrected_area_fraction(), state.outline()->fraction);
    EXPECT_NE(state.chosen()->text().find(", with the outline between the nodes, it comes to "),
              std::string::npos)
        << state.chosen()->text();
    const DiscretisationEstimate estimate = discretisation_estimate(state, "corrected_area_fraction");
    EXPECT_NEAR(estimate.margin * estimate.relative(), state.chosen()->error, 1e-12);
    EXPECT_GE(state.chosen()->error, state.outline()->doubt);
    pair.release();
  }
}

// Cells as wide as the dents give 1.2 to 2.6 times the requested error.
TEST(AccuracyChoice, CellsThatMissTheShortestWavesDoNotCount) {
  const PressRequest request{PressBy::pressure, 1e7, {}};
  for (const char* of : {"corrected_area_fraction", "approach"}) {
    const ChosenAccuracy chosen =
        *SpecimenPair(asking(rough(256, 7, 64), rigid_material(), Boundary::periodic, 0.3, {of}))
             .press(request)
             .chosen();
    EXPECT_EQ(chosen.tried[2].nx, 64);
    EXPECT_EQ(chosen.tried[2].note, "waves have fewer than four cells") << of;
    EXPECT_GT(chosen.nx, 64) << of;
  }
}

// Two cells a shortest wave lose the highest peak: 64 cells have an error of 6.8 %.
TEST(AccuracyChoice, AnApproachIsNotReadFromCellsThatMissThePeak) {
  SelfAffineOptions o = test::self_affine(Grid{512, 512, 1e-3, 1e-3}, 0.7, 1e-3 / 32, 4403);
  o.rms_slope = 0.1;
  Material material;
  material.young = 1e11;
  material.poisson = 0;
  SpecimenPair pair(asking(self_affine_surface(o).with_material(material), rigid_material(),
                           Boundary::periodic, 0.03, {"approach"}));
  const double truth = 5.881e-6;
  EXPECT_NEAR(pair.press({PressBy::pressure, 1e8, {}}).approach(), truth, 0.03 * truth);
}

TEST(AccuracyChoice, AnOutlineNeedsACorrectedAreaAndAKnownLaw) {
  const State energy = SpecimenPair(asking(rough(128), rigid_material(), Boundary::periodic, 0.3, {"energy"}))
                           .press({PressBy::pressure, 1e7, {}});
  EXPECT_FALSE(energy.outline());
  EXPECT_EQ(energy.chosen()->text().find("outline"), std::string::npos);
  Scene boxes = asking(rough(128), rigid_material(), Boundary::periodic, 0.3);
  boxes.elasticity = BoxOptions{};
  const State of_boxes = SpecimenPair(boxes).press({PressBy::indentation, 0.1, {}});
  ASSERT_TRUE(of_boxes.outline());
  Scene layer = asking(rough(128), rigid_material(), Boundary::periodic, 0.3);
  layer.elasticity = LayerOptions{.thickness = 1};
  EXPECT_FALSE(SpecimenPair(layer).press({PressBy::pressure, 1e7, {}}).outline());
}

TEST(AccuracyChoice, CostsAreNamedAndAddUp) {
  SpecimenPair pair(asking(rough(128), rigid_material(), Boundary::periodic, 0.03));
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  double transforms = 0, of_choice = -1;
  for (const auto& [effect, cost] : state.cost().by_effect) {
    transforms += cost.transforms;
    if (effect == "choice") of_choice = cost.transforms;
  }
  EXPECT_GE(of_choice, 0);
  EXPECT_NEAR(transforms, state.cost().total.transforms, 1e-6);
}

TEST(AccuracyChoice, RefinesBeyondTheCellsGiven) {
  SpecimenPair pair(asking(rough(64, 3), rigid_material(), Boundary::periodic, 0.005));
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  EXPECT_GT(state.chosen()->nx, 64);
  EXPECT_EQ(state.chosen()->source, "generated again");
}

TEST(AccuracyChoice, NeverRefinesBeyondWhatWasMeasured) {
  Scene scene = asking(measured(rough(64, 3)).with_material(test::elastic_to_yield()), rigid_material(),
                       Boundary::periodic, 0.001);
  const std::string refused = error_of([&] { SpecimenPair(scene).press({PressBy::pressure, 1e7, {}}); });
  EXPECT_NE(refused.find(" on 64 x 64 cells it comes to "), std::string::npos) << refused;
  EXPECT_NE(refused.find(" cells a side, and 64 x 64 cells are the most with known heights; "),
            std::string::npos)
      << refused;
  scene.accuracy.on_failure = Accuracy::OnFailure::best;
  const State best = SpecimenPair(scene).press({PressBy::pressure, 1e7, {}});
  EXPECT_EQ(best.chosen()->nx, 64);
  EXPECT_FALSE(best.chosen()->met());
}

// One node in contact on any grid up to 4096 cells.
TEST(AccuracyChoice, NamesTheCellsItWouldNeed) {
  const Surface sphere = sphere_surface({Grid{128, 128, 1e-3, 1e-3}, 0.01, SphereShape::paraboloid})
                             .with_material(test::elastic_to_yield());
  Scene scene = asking(sphere, rigid_material(), Boundary::free, 0.01);
  scene.accuracy.asked->most_cells = 512;
  SpecimenPair pair(scene);
  EXPECT_NE(pair.plan().text().find("; 512 x 512 cells are the most within 512 cells a side"),
            std::string::npos)
      << pair.plan().text();
  const std::string refused = error_of([&] { pair.press({PressBy::load, 1e-9, {}}); });
  EXPECT_NE(refused.find("it needs about "), std::string::npos) << refused;
  EXPECT_NE(refused.find(" cells a side, and 512 x 512 cells are the most within 512 cells a side; "),
            std::string::npos)
      << refused;
  scene.accuracy.on_failure = Accuracy::OnFailure::best;
  EXPECT_EQ(SpecimenPair(scene).press({PressBy::load, 1e-9, {}}).chosen()->nx, 512);
}

TEST(AccuracyChoice, TakesNoMoreExpectedTimeOrMemoryThanAllowed) {
  Scene scene = asking(rough(64), rigid_material(), Boundary::periodic, 1e-4);
  scene.accuracy.asked->most_seconds = 1e-3;
  EXPECT_NE(SpecimenPair(scene).plan().text().find("are the most within an expected 1 ms"),
            std::string::npos);
  scene.accuracy.asked->most_bytes = 1 << 20;
  scene.accuracy.asked->most_seconds = 600;
  const Plan plan = SpecimenPair(scene).plan();
  EXPECT_NE(plan.text().find("are the most within 1 MiB of memory"), std::string::npos) << plan.text();
  EXPECT_LE(plan.bytes_peak(), 1 << 20);
}

TEST(AccuracyChoice, NamesTheRequestedQuantitiesWithTheirError) {
  SpecimenPair pair(
      asking(rough(64), rigid_material(), Boundary::periodic, 0.1, {"corrected_area_fraction", "energy"}));
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  ASSERT_NE(state.chosen(), nullptr);
  EXPECT_TRUE(state.chosen()->values_text().starts_with(
      "requested: corrected_area_fraction " +
      format_quantity(state.corrected_area_fraction(), dimension::number) + ", energy " +
      format_quantity(state.energy(), dimension::energy) + ", within "))
      << state.chosen()->values_text();
}

TEST(AccuracyChoice, CoarseCellsThatMissTheWavesDoNotCount) {
  // 64 cells have every node on a crest: coarse grids see a flat.
  const Surface waves =
      sine_surface({Grid{512, 512, 1, 1}, 1e-4, 1.0 / 64, 2}).with_material(test::elastic_to_yield());
  SpecimenPair pair(asking(waves, rigid_material(), Boundary::periodic, 0.1, {"area_fraction", "energy"}));
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  EXPECT_GT(state.chosen()->nx, 128);
  EXPECT_EQ(state.chosen()->tried.front().note, "the heights were not carried");
}

// Contact 13 cells wide: 1.5 % error on 64 cells. Reference: 2048 cells.
TEST(AccuracyChoice, ABallAFewCellsWideIsMet) {
  const Surface ball =
      sphere_surface({Grid{1024, 1024, 1e-3, 1e-3}, 0.03, SphereShape::sphere}).with_material([] {
        Material material;
        material.young = 1e11;
        material.poisson = 0;
        return material;
      }());
  const double truth = 0.13591;
  for (const double error : {0.1, 0.03, 0.01}) {
    SpecimenPair pair(asking(ball, rigid_material(), Boundary::free, error));
    const State state = pair.press({PressBy::pressure, 4e7, {}});
    EXPECT_NEAR(state.corrected_area_fraction(), truth, error * truth) << state.chosen()->text();
    EXPECT_TRUE(state.chosen()->met());
  }
}

// Coarser grids are too few to compare.
TEST(AccuracyChoice, CoarseCellsAreNotBelievedAlone) {
  for (const auto& [of, fewest] : {std::pair{"corrected_area_fraction", 32}, std::pair{"energy", 64}}) {
    SpecimenPair pair(asking(rough(256, 5, 8), rigid_material(), Boundary::periodic, 0.9, {of}));
    const ChosenAccuracy& chosen = *pair.press({PressBy::pressure, 3e7, {}}).chosen();
    EXPECT_EQ(chosen.nx, fewest) << of;
    for (const TriedGrid& tried : chosen.tried)
      if (tried.nx < fewest) {
        EXPECT_EQ(tried.note, "too few grids to compare") << of;
      }
  }
}

TEST(AccuracyChoice, HertzIsMet) {
  const Surface cap = sphere_surface({Grid{128, 128, 1, 1}, 10, SphereShape::paraboloid})
                          .with_material(test::elastic_to_yield());
  const double a = 0.23, load = 4.0 / 3 * 1e9 * a * a * a / 10;
  SpecimenPair pair(asking(cap, rigid_material(), Boundary::free, 0.02,
                           {"corrected_area_fraction", "approach", "peak_pressure"}));
  const State state = pair.press({PressBy::load, load, {}});
  const double area = std::numbers::pi * a * a;
  EXPECT_NEAR(state.corrected_area_fraction(), area, 0.02 * area);
  EXPECT_NEAR(state.approach(), a * a / 10, 0.02 * a * a / 10);
  EXPECT_NEAR(state.peak_pressure(), 1.5 * load / area, 0.02 * 1.5 * load / area);
}

TEST(AccuracyChoice, NoLoadChoosesNothing) {
  SpecimenPair pair(asking(rough(128), rigid_material(), Boundary::periodic, 0.05));
  const State none = pair.press({PressBy::pressure, 0, {}});
  EXPECT_EQ(none.chosen(), nullptr);
  EXPECT_EQ(pair.lower().grid().nx, 128);
  EXPECT_NE(pair.press({PressBy::pressure, 1e7, {}}).chosen(), nullptr);
}

TEST(AccuracyChoice, LaterPressesAreHeldToIt) {
  const Scene scene = asking(rough(256, 1, 32), rigid_material(), Boundary::periodic, 0.1);
  SpecimenPair pair(scene);
  const State heavy = pair.press({PressBy::pressure, 7e7, {}});
  const int cells = heavy.chosen()->nx;
  ASSERT_LT(cells, 256);
  const std::string digest = pair.lower().digest();
  const std::string refused = error_of([&] { pair.press({PressBy::pressure, 1e5, {}}); });
  EXPECT_NE(refused.find("`error` = 0.1 of `corrected_area_fraction` was requested, and on the " +
                         std::to_string(cells) + " x " + std::to_string(cells) +
                         " cells that the first press of this contact chose it comes to "),
            std::string::npos)
      << refused;
  EXPECT_EQ(pair.lower().digest(), digest);
  const State again = pair.press({PressBy::pressure, 7.5e7, {}});
  EXPECT_TRUE(again.chosen()->met());
  EXPECT_EQ(again.chosen()->nx, cells);
  EXPECT_EQ(again.chosen()->tried.size(), heavy.chosen()->tried.size());

  Scene lenient = scene;
  lenient.accuracy.on_failure = Accuracy::OnFailure::best;
  SpecimenPair best(lenient);
  best.press({PressBy::pressure, 7e7, {}});
  const State light = best.press({PressBy::pressure, 1e5, {}});
  EXPECT_FALSE(light.chosen()->met());
  EXPECT_GT(light.chosen()->error, 0.1);
}

TEST(AccuracyChoice, RefusedWhereMemoryEnds) {
  struct Limit {
    explicit Limit(std::int64_t bytes) { memory::set_limit(bytes); }
    ~Limit() { memory::set_limit(0); }
  };
  Scene scene = asking(rough(64), rigid_material(), Boundary::periodic, 1e-5);
  SpecimenPair pair(scene);
  const std::string plan = pair.plan().text(), digest = pair.lower().digest();
  {
    const Limit limit(memory::held() + (8 << 20));
    const std::string refused = error_of([&] { pair.press({PressBy::pressure, 1e7, {}}); });
    EXPECT_NE(refused.find("`error` = 1e-05 of `corrected_area_fraction` was requested, and on "),
              std::string::npos)
        << refused;
    EXPECT_NE(refused.find(" cells a side, and "), std::string::npos);
    EXPECT_NE(refused.find("on_failure=\"best\""), std::string::npos);
  }
  EXPECT_EQ(pair.plan().text(), plan);
  EXPECT_EQ(pair.lower().digest(), digest);
  EXPECT_FALSE(pair.under_load());
  const Limit limit(memory::held() + (8 << 20));
  scene.accuracy.on_failure = Accuracy::OnFailure::best;
  SpecimenPair best(scene);
  const State reached = best.press({PressBy::pressure, 1e7, {}});
  EXPECT_FALSE(reached.chosen()->met());
  EXPECT_NE(reached.chosen()->reason().find(" are the most within "), std::string::npos);
}

TEST(AccuracyChoice, PeakWithoutALimitIsRefusedEarly) {
  const Surface flat = flat_surface({Grid{64, 64, 1, 1}}).with_material(test::elastic_to_yield());
  SpecimenPair pair(asking(flat, rigid_material(), Boundary::free, 0.01, {"peak_pressure"}));
  const std::string refused = error_of([&] { pair.press({PressBy::pressure, 1e6, {}}); });
  EXPECT_NE(refused.find("256 x 256 cells it comes to no limit; it grows without limit on finer grids"),
            std::string::npos)
      << refused;
}

TEST(AccuracyChoice, StopsWhenAskedAndLeavesThePair) {
  class StopLater final : public Monitor {
   public:
    void progress(std::string_view, double) override {}
    void progress_of_parts(std::string_view, double, std::string_view part, double) override {
      if (part != first_ && !first_.empty()) stop_flag().raise(StopReason::interrupt);
      if (first_.empty()) first_ = part;
    }
    void warn(std::string_view) override {}

   private:
    std::string first_;
  };
  SpecimenPair pair(asking(rough(256), rigid_material(), Boundary::periodic, 0.002));
  const std::string digest = pair.lower().digest();
  StopLater monitor;
  const std::string stopped = error_of([&] { pair.press({PressBy::pressure, 1e7, {}}, monitor); });
  stop_flag().clear();
  EXPECT_EQ(stopped, "interrupted");
  EXPECT_EQ(pair.lower().digest(), digest);
  EXPECT_FALSE(pair.under_load());
}

TEST(SpecimenPair, AnEstimateIsPartOfThePress) {
  class Watcher final : public Monitor {
   public:
    void progress(std::string_view, double) override {}
    void progress_of_parts(std::string_view, double done, std::string_view, double) override {
      falls_ = falls_ || done < last_;
      last_ = done;
    }
    void warn(std::string_view) override {}
    bool falls_ = false;
    double last_ = 0;
  };
  Scene scene{rough(128), rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  const State bare = SpecimenPair(scene).press({PressBy::pressure, 1e7, {}});
  scene.accuracy.estimate = Accuracy::Estimate::coarser;
  Watcher watcher;
  const State state = SpecimenPair(scene).press({PressBy::pressure, 1e7, {}}, watcher);
  EXPECT_FALSE(watcher.falls_);
  EXPECT_GE(watcher.last_, 0.75);
  EXPECT_EQ(state.digest(), bare.digest());
  EXPECT_EQ(bare.companion_grids(), nullptr);
  ASSERT_EQ(state.cost().by_effect.size(), 2u);
  EXPECT_EQ(state.cost().by_effect[1].first, "estimate");
  EXPECT_EQ(state.cost().by_effect[0].second.transforms, bare.cost().total.transforms);
  const std::int64_t bytes = bytes_held_with_other_grids(state);
  EXPECT_GT(bytes, bare.bytes_held());
  EXPECT_LT(static_cast<double>(bytes), 1.32 * static_cast<double>(bare.bytes_held()));
}

TEST(SpecimenPair, AnEstimateFromAFinerGridIsPartOfThePress) {
  Scene scene{rough(64, 1, 8), rough(64, 2, 8), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  const State bare = SpecimenPair(scene).press({PressBy::pressure, 1e7, {}});
  scene.accuracy.estimate = Accuracy::Estimate::finer;
  SpecimenPair pair(scene);
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  EXPECT_EQ(state.digest(), bare.digest());
  EXPECT_EQ(pair.lower().grid().nx, 64);
  ASSERT_EQ(state.cost().by_effect.size(), 2u);
  EXPECT_EQ(state.cost().by_effect[1].first, "estimate");
  EXPECT_EQ(state.cost().by_effect[0].second.transforms, bare.cost().total.transforms);
  EXPECT_GT(state.cost().by_effect[1].second.transforms, 7 * bare.cost().total.transforms);
  EXPECT_EQ(state.companion_grids()->levels()[0].state.geometry().grid().nx, 192);
}

TEST(SpecimenPair, APressWhoseFinerGridFailsLeavesThePair) {
  class StopLater final : public Monitor {
   public:
    void progress(std::string_view, double) override {}
    void progress_of_parts(std::string_view, double, std::string_view part, double) override {
      if (part == "finer grid") stop_flag().raise(StopReason::interrupt);
    }
    void warn(std::string_view) override {}
  };
  Scene scene{rough(128, 1, 8), rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.estimate = Accuracy::Estimate::finer;
  scene.effects.set(PlasticityOptions{});
  SpecimenPair pair(scene);
  const std::string digest = pair.lower().digest();
  StopLater monitor;
  const std::string stopped = error_of([&] { pair.press({PressBy::pressure, 1e7, {}}, monitor); });
  stop_flag().clear();
  EXPECT_EQ(stopped, "interrupted");
  EXPECT_EQ(pair.lower().digest(), digest);
  EXPECT_FALSE(pair.under_load());
  {
    // Enough memory for the press, but not for nine times as much.
    Scene bare = scene;
    bare.accuracy.estimate = Accuracy::Estimate::none;
    memory::set_limit(memory::held() + 2 * SpecimenPair(bare).plan().bytes_peak());
    EXPECT_EQ(error_of([&] { SpecimenPair(bare).press({PressBy::pressure, 1e7, {}}); }), "");
    EXPECT_NE(error_of([&] { pair.press({PressBy::pressure, 1e7, {}}); }), "");
    memory::set_limit(0);
  }
  EXPECT_EQ(pair.lower().digest(), digest);
  EXPECT_FALSE(pair.under_load());
  EXPECT_GT(pair.press({PressBy::pressure, 1e7, {}}).plastic_volume(), 0);
  EXPECT_NE(pair.lower().digest(), digest);
  // Interpolated plastic volume does not yield again.
  pair.release();
  const State again = pair.press({PressBy::pressure, 0.5e7, {}});
  EXPECT_LT(discretisation_estimate(again, "area_fraction").relative(), 0.5);
}

TEST(AccuracyChoice, CopiesChooseForThemselves) {
  SpecimenPair pair(asking(rough(256), rigid_material(), Boundary::periodic, 0.05));
  SpecimenPair before = pair;
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  EXPECT_EQ(before.lower().grid().nx, 256);
  SpecimenPair after = pair;
  EXPECT_EQ(after.lower().grid().nx, state.chosen()->nx);
  EXPECT_EQ(before.press({PressBy::pressure, 1e7, {}}).digest(), state.digest());
}

TEST(AccuracyChoice, PlasticBodiesYieldOnTheCellsChosen) {
  Scene scene = asking(rough(256), rigid_material(), Boundary::periodic, 0.1, {"plastic_volume"});
  scene.effects.set(PlasticityOptions{});
  SpecimenPair pair(scene);
  const State state = pair.press({PressBy::pressure, 1e7, {}});
  ASSERT_GT(state.plastic_volume(), 0);
  const int cells = state.chosen()->nx;
  ASSERT_EQ(pair.lower().grid().nx, cells);
  EXPECT_EQ(pair.lower().recipe(), nullptr);
  pair.release();
  const State again = pair.press({PressBy::pressure, 0.5e7, {}});
  EXPECT_EQ(again.geometry().grid().nx, cells);
  EXPECT_LT(again.plastic_volume(), 1e-6 * state.plastic_volume());
}

double off_at_shared_nodes(const Field& coarse, const Field& fine) {
  const int step = fine.nx() / coarse.nx();
  double worst = 0;
  for (int j = 0; j < coarse.ny(); ++j)
    for (int i = 0; i < coarse.nx(); ++i)
      worst = std::max(worst, std::abs(coarse(i, j) - fine(step * i, step * j)));
  return worst / range(fine.values()).span();
}

TEST(AccuracyChoice, TwoRoughBodiesLieAsTheyDid) {
  for (int k = 0; k < 8; ++k) {
    const Boundary boundary = k < 4 ? Boundary::periodic : Boundary::free;
    const int quarters = k % 4;
    const Scene scene = asking(rough(128, 1), rough(128, 2), boundary, 0.1);
    const LatticeIsometry turned = LatticeIsometry(128, 128).turned(quarters);
    const LatticeIsometry pose = boundary == Boundary::free ? turned : turned.shifted(7, 30);
    const ContactGeometry as_given(scene, pose);
    const AccuracyChoice coarse = choose_accuracy(scene, as_given, {PressBy::pressure, 2e7, {}});
    ASSERT_LT(coarse.geometry->grid().nx, 128) << coarse.state.chosen()->text();
    EXPECT_EQ(off_at_shared_nodes(coarse.geometry->combined(), as_given.combined()), 0) << quarters;
    Scene close = scene;
    close.accuracy.asked->error = 0.0005;
    const AccuracyChoice fine = choose_accuracy(close, as_given, {PressBy::pressure, 2e7, {}});
    ASSERT_GT(fine.geometry->grid().nx, 128);
    EXPECT_LT(off_at_shared_nodes(as_given.combined(), fine.geometry->combined()), 1e-12) << quarters;
  }
}

Surface waves(int nx, int ny, std::uint64_t seed = 1) {
  SelfAffineOptions o = test::self_affine(Grid{nx, ny, 1, 1}, 0.8, 1.0 / 8, seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  Material material;
  material.young = 1e9;
  material.poisson = 0;
  return self_affine_surface(o).with_material(material);
}

// Single precision saves no steps, so the precision is not chosen.
TEST(AccuracyChoice, EitherPrecisionTakesAsManySteps) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const std::uint64_t seed : {1, 2, 3})
      for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        const auto transforms = [&](Accuracy::Precision precision) {
          Scene scene{waves(128, 128, seed), rigid_material(), boundary, HalfSpaceOptions{}, Accuracy{}};
          scene.accuracy.precision = precision;
          scene.accuracy.tolerance = tolerance;
          return SpecimenPair(scene).press({PressBy::pressure, 1e7, {}}).cost().total.transforms;
        };
        EXPECT_NEAR(transforms(Accuracy::Precision::single) / transforms(Accuracy::Precision::double_), 1,
                    0.05)
            << seed << " " << tolerance;
      }
}

State chosen_press(Surface surface, std::optional<Accuracy::Precision> named) {
  Scene scene = asking(std::move(surface), rigid_material(), Boundary::periodic, 0.1);
  scene.accuracy.precision_named = named.has_value();
  scene.accuracy.precision = named.value_or(Accuracy::Precision::double_);
  SpecimenPair pair(scene);
  State state = pair.press({PressBy::pressure, 2e7, {}});
  EXPECT_EQ(pair.plan().accuracy.precision, state.chosen()->precision);
  const bool single = state.chosen()->precision == Accuracy::Precision::single;
  EXPECT_EQ(state.solver().find(" in single precision") != std::string_view::npos, single);
  return state;
}

TEST(AccuracyChoice, KeepsThePrecisionAndSaysWhy) {
  const std::string chosen = chosen_press(waves(64, 64), {}).chosen()->text();
  EXPECT_NE(chosen.find(", double precision (single saves no time): "), std::string::npos) << chosen;
  const std::string named = chosen_press(waves(64, 63), Accuracy::Precision::single).chosen()->text();
  EXPECT_NE(named.find(", single precision (as named): "), std::string::npos) << named;
}

}  // namespace
}  // namespace asperity::accuracy_choice_test
