// SPDX-License-Identifier: GPL-3.0-or-later
// What a state tells: regions, outline, deformed bodies, distributions, digests, and what it refuses.
#include "engine/contact/state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/quantities.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::state_test {
namespace {

using test::boxes;
using test::elastic;
using test::error_of;
using test::press;
using test::random_surface;
using test::row_of;
using test::scene_of;
using test::surface_of;

constexpr double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24;

TEST(State, SpotsAndTheirAreas) {
  // Two spots joined by a corner, one alone, on cells of 0.5 m x 0.25 m.
  const Surface blocks = surface_of(Grid{6, 4, 3, 1}, [](int i, int j) {
    return (i < 2 && j < 2) || (i == 2 && j == 2) || (i == 5 && j == 0) ? 1.0 : 0.0;
  });
  const State st = press(boxes(blocks, 1), PressBy::approach, 0.5);
  EXPECT_EQ(st.contacts(), 6);
  EXPECT_EQ(st.spots(), 3);
  EXPECT_EQ(st.spots8(), 2);
  EXPECT_EQ(st.spot_areas(), (std::vector<double>{0.5, 0.125, 0.125}));
  EXPECT_DOUBLE_EQ(st.area(), 0.75);
  EXPECT_EQ(st.area_fraction(), 0.25);
  // Edges inside the tile: block 2 + 2, single node 4, rim node 1 + 1.
  EXPECT_NEAR(st.corrected_area_fraction(), (6 - 10 * excess) / 24, 1e-15);
}

TEST(State, RegionsWrapOnlyOnAPeriodicBoundary) {
  const Surface rims = row_of({1, 0, 0, 1});
  const State open = press(scene_of(rims, rigid_material(), 1), PressBy::approach, 0.5);
  const State closed = press(scene_of(rims, rigid_material(), 1, Boundary::periodic), PressBy::approach, 0.5);
  EXPECT_EQ(open.spots(), 2);
  EXPECT_EQ(closed.spots(), 1);
  EXPECT_EQ(open.approach(), closed.approach());
}

TEST(State, FullContactNeedsNoPerimeterCorrection) {
  for (const Boundary boundary : {Boundary::free, Boundary::periodic}) {
    const State st =
        press(scene_of(random_surface(9, 9, 1), rigid_material(), 1, boundary), PressBy::indentation, 1.5);
    EXPECT_EQ(st.corrected_area_fraction(), 1);
  }
}

TEST(State, UnderARigidFlatTheLowerBodyIsCutByThePlane) {
  const Surface rough = random_surface(25, 14, 6).with_material(elastic(5));
  const State st = press(scene_of(rough, rigid_material()), PressBy::indentation, 0.4);
  const Surface after = st.deformed("lower");
  const double plane = rough.height_range().max - st.approach();
  for (int j = 0; j < 14; ++j)
    for (int i = 0; i < 25; ++i) EXPECT_EQ(after.height(i, j), std::min(rough.height(i, j), plane));
  EXPECT_EQ(after.material()->young, 5);
  EXPECT_EQ(range(st.deformed("upper").heights().values()).span(), 0);
}

TEST(State, TwoBodiesShareTheShorteningAndMeetWithoutGap) {
  const Surface lower = random_surface(16, 16, 1).with_material(elastic(1));
  const Surface upper = random_surface(16, 16, 2).with_material(elastic(4));
  const State st = press(scene_of(lower, upper), PressBy::indentation, 0.3);
  const Surface low = st.deformed("lower"), up = st.deformed("upper");
  const auto displacement = st.field("displacement"), gap = st.field("gap");
  double greatest = -1e300;
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) {
      EXPECT_NEAR(lower.height(i, j) - low.height(i, j), 0.8 * (*displacement)(i, j), 1e-14);
      EXPECT_NEAR(upper.height(15 - i, j) - up.height(15 - i, j), 0.2 * (*displacement)(i, j), 1e-14);
      greatest = std::max(greatest, low.height(i, j) + up.height(15 - i, j));
    }
  // The combined deformed heights are the undeformed ones cut by a plane, so the gap is zero in contact.
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i)
      EXPECT_NEAR(greatest - (low.height(i, j) + up.height(15 - i, j)), (*gap)(i, j), 1e-13);
}

TEST(State, ARigidRoughBodyKeepsItsShape) {
  const Surface lower = random_surface(8, 8, 1).with_material(elastic(1));
  const Surface upper = random_surface(8, 8, 2).with_material(rigid_material());
  const State st = press(scene_of(lower, upper), PressBy::indentation, 0.3);
  EXPECT_EQ(st.deformed("upper").digest(), upper.digest());
  EXPECT_NE(st.deformed("lower").digest(), lower.digest());
}

TEST(State, StiffnessesAreTangentAndSecant) {
  const auto solver = test::ready(boxes(random_surface(50, 50, 3), 6));
  const State st = solver->press({PressBy::pressure, 0.5, {}});
  EXPECT_EQ(st.stiffness(), 6 * st.area_fraction());
  EXPECT_EQ(st.secant_stiffness(), 0.5 / st.approach());
  const double step = 1e-9;
  const State more = solver->press({PressBy::approach, st.approach() + step, {}});
  EXPECT_NEAR((more.pressure() - 0.5) / step, st.stiffness(), 1e-5);
}

TEST(State, DistributionsCoverTheirNodes) {
  const State st = press(boxes(random_surface(60, 60, 3), 6), PressBy::indentation, 0.4);
  EXPECT_EQ(st.distribution("pressure").values, st.contacts());
  EXPECT_EQ(st.distribution("gap").values, 3600 - st.contacts());
  EXPECT_EQ(st.distribution("spot_area", {.bins = 7, .log = true}).values, st.spots());
  EXPECT_EQ(st.distribution("spot_area", {.bins = 7, .log = true}).edges.size(), 8U);
  EXPECT_NEAR(st.distribution("pressure").mean, st.pressure() / st.area_fraction(), 1e-13);
}

TEST(State, DistributionsOfNothingAreRefused) {
  const Scene scene = boxes(random_surface(5, 5, 3), 6);
  const State none = press(scene, PressBy::load, 0), full = press(scene, PressBy::indentation, 2);
  EXPECT_EQ(error_of([&] { none.distribution("pressure"); }),
            "no node touches, so there are no pressures to distribute");
  EXPECT_EQ(error_of([&] { none.distribution("spot_area"); }),
            "no node touches, so there are no spots to distribute");
  EXPECT_EQ(error_of([&] { full.distribution("gap"); }),
            "every node touches, so there are no gaps to distribute");
  EXPECT_NE(error_of([&] { full.distribution("gaps"); }).find("did you mean `gap`?"), std::string::npos);
}

TEST(State, UnknownFieldsAndBodiesAreRefused) {
  const State st = press(boxes(row_of({0, 1}), 1), PressBy::load, 1);
  EXPECT_EQ(error_of([&] { st.field("presure"); }),
            "a state has no field `presure` (did you mean `pressure`?); fields are pressure, gap, contact, "
            "displacement "
            "and plastic");
  EXPECT_NE(error_of([&] { st.deformed("middle"); }).find("a contact has no body `middle`"),
            std::string::npos);
  for (const auto& ask : std::vector<std::function<void()>>{
           [&] { st.field("plastic"); }, [&] { find_quantity("plastic_volume")->of(st); },
           [&] { find_quantity("plastic_fraction")->of(st); }})
    EXPECT_NE(error_of(ask).find("needs the effect `plasticity`, which this scene does not name"),
              std::string::npos);
}

TEST(State, DigestTellsLoadsApartAndRepeats) {
  const auto solver = test::ready(boxes(random_surface(20, 20, 3), 6));
  const State a = solver->press({PressBy::pressure, 0.5, {}}),
              again = solver->press({PressBy::pressure, 0.5, {}});
  const State b = solver->press({PressBy::pressure, std::nextafter(0.5, 1.0), {}});
  EXPECT_EQ(a.digest(), again.digest());
  EXPECT_NE(a.digest(), b.digest());
  EXPECT_EQ(a.digest().size(), 32U);
}

TEST(State, AnswersManyThreadsAtOnce) {
  const State st = press(boxes(random_surface(150, 150, 3), 6), PressBy::indentation, 0.3);
  std::vector<std::string> digests(8);
  std::vector<std::int64_t> spots(8);
  std::vector<const Field*> fields(8);
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        digests[t] = st.digest();
        spots[t] = st.spots();
        fields[t] = st.field("pressure").get();
      });
  }
  for (std::size_t t = 1; t < 8; ++t) {
    EXPECT_EQ(digests[t], digests[0]);
    EXPECT_EQ(spots[t], spots[0]);
    EXPECT_EQ(fields[t], fields[0]);
  }
}

TEST(State, TextTellsValuesWithTheirErrorsCostAndResidual) {
  const State st = press(boxes(row_of({0, 1}), 1), PressBy::load, 1);
  const std::string text = st.text();
  EXPECT_EQ(text.rfind("contact under 0.5 Pa (1 N): approach 1 ± ", 0), 0U) << text;
  EXPECT_NE(text.find(" m, area fraction 0.5 ± 0.5 of 2 nodes, energy 500 ± "), std::string::npos) << text;
  EXPECT_NE(text.find(" mJ; ± is the solver's alone: cells, seed and inputs are not in it; residual 0; "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(" 0 transforms, 0 MiB; closed form (sorted heights)"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_EQ(st.effects_run(), std::vector<std::string>{"elasticity"});
}

// A flat on all of a periodic tile carries any load and comes no nearer.
TEST(State, AFlatUnderLoadHasNoFiniteSecantStiffness) {
  const Surface flat = surface_of(Grid{8, 8, 1, 1}, [](int, int) { return 0.0; }).with_material(elastic(1e9));
  Scene scene = scene_of(flat, rigid_material(), {}, Boundary::periodic);
  scene.elasticity = HalfSpaceOptions{};
  const State loaded = press(scene, PressBy::pressure, 4e7);
  EXPECT_EQ(loaded.approach(), 0);
  EXPECT_EQ(loaded.secant_stiffness(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(loaded.stiffness(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(press(scene, PressBy::pressure, 0).secant_stiffness(), 0);
  // Any roughness gives way.
  scene.lower = random_surface(8, 8, 1).with_material(elastic(1e9));
  const State rough = press(scene, PressBy::pressure, 4e7);
  EXPECT_EQ(rough.secant_stiffness(), rough.pressure() / rough.approach());
}

}  // namespace
}  // namespace asperity::state_test
