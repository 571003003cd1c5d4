// SPDX-License-Identifier: GPL-3.0-or-later
// Unread quantities are never computed: the tests count transforms and bytes of the first and second reading.
// A state outlives its contact.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/specimen/counted_scenes.hpp"

namespace asperity::lazy_state_test {
namespace {

constexpr int cells = 48;
constexpr std::int64_t grid_bytes = 8LL * cells * cells;

struct LazyQuantity {
  const char* name;
  std::function<double(const State&)> read;
  bool transforms = false;  // applies the operator
  std::int64_t kept = 0;    // counted bytes after reading
  bool kept_answer = true;  // the second reading computes nothing
};

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

std::vector<LazyQuantity> lazy_quantities() {
  std::vector<LazyQuantity> all = {
      {"mean_gap", [](const State& s) { return s.mean_gap(); }},
      {"energy", [](const State& s) { return s.energy(); }},
      {"stiffness", [](const State& s) { return s.stiffness(); }, true},
      {"corrected_area_fraction", [](const State& s) { return s.corrected_area_fraction(); }},
      {"spots", [](const State& s) { return static_cast<double>(s.spots()); }},
      {"spots8", [](const State& s) { return static_cast<double>(s.spots8()); }},
      {"spot_areas", [](const State& s) { return sum_of(s.spot_areas()); }},
      {"plastic_volume", [](const State& s) { return s.plastic_volume(); }},
      {"algebraic_error", [](const State& s) { return s.algebraic_error().approach; }, true},
      {"deformed", [](const State& s) { return s.deformed("lower").heights()[5]; }, false, 0, false},
  };
  for (const std::string& name : State::field_names())
    all.push_back({name.c_str(), [name](const State& s) { return (*s.field(name))[5]; }, false, grid_bytes});
  return all;
}

Scene plastic_scene() {
  Scene scene{counted_scenes::rough(1, cells), counted_scenes::rough(2, cells), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{1e-8}};
  scene.effects.set(PlasticityOptions{0.05});
  return scene;
}
const PressRequest under = {PressBy::pressure, 0.01, {}};

struct Reading {
  Cost cost;
  std::int64_t kept;
  double value;
};
Reading read(const State& state, const LazyQuantity& quantity) {
  const std::int64_t before = memory::held();
  const CostScope scope;
  const double value = quantity.read(state);
  return {scope.so_far(), memory::held() - before, value};
}

class LazyState : public counted_scenes::OnOneThread {};

TEST_F(LazyState, EachQuantityIsWorkedOutWhenItIsReadAndOnce) {
  for (const LazyQuantity& quantity : lazy_quantities()) {
    SCOPED_TRACE(quantity.name);
    SpecimenPair pair(plastic_scene());
    // Fills the caches for this size.
    quantity.read(pair.press(under));
    SpecimenPair fresh(plastic_scene());
    const State state = fresh.press(under);
    const Reading first = read(state, quantity), second = read(state, quantity);
    EXPECT_GT(first.cost.bytes, 0);
    EXPECT_EQ(first.cost.transforms > 0, quantity.transforms);
    EXPECT_EQ(first.kept, quantity.kept);
    EXPECT_EQ(second.value, first.value);
    EXPECT_EQ(second.cost.transforms, 0);
    EXPECT_EQ(second.cost.bytes, quantity.kept_answer ? 0 : first.cost.bytes);
    EXPECT_EQ(second.kept, 0);
  }
}

// Reading one field computes no other.
TEST_F(LazyState, ReadingOneWorksOutNoField) {
  const std::vector<LazyQuantity> all = lazy_quantities();
  for (const LazyQuantity& quantity : all) {
    SpecimenPair pair(plastic_scene());
    const State state = pair.press(under);
    quantity.read(state);
    for (const std::string& name : State::field_names()) {
      if (name == quantity.name) continue;
      const std::int64_t before = memory::held();
      state.field(name);
      EXPECT_EQ(memory::held() - before, grid_bytes) << name << " after " << quantity.name;
    }
  }
}

TEST_F(LazyState, WhatTheSolveFoundIsThere) {
  SpecimenPair pair(plastic_scene());
  const State state = pair.press(under);
  const CostScope scope;
  EXPECT_GT(state.load() + state.pressure() + state.approach() + state.area() + state.area_fraction() +
                state.peak_pressure() + state.secant_stiffness() + state.residual() +
                static_cast<double>(state.contacts() + state.iterations()),
            0);
  EXPECT_TRUE(state.converged());
  EXPECT_EQ(scope.so_far().transforms, 0);
  EXPECT_EQ(scope.so_far().bytes, 0);
}

TEST_F(LazyState, ReadingIsNotInTheCostOfThePress) {
  SpecimenPair pair(plastic_scene());
  const State state = pair.press(under);
  const double transforms = state.cost().total.transforms;
  const std::int64_t bytes = state.cost().total.bytes;
  for (const LazyQuantity& quantity : lazy_quantities()) quantity.read(state);
  EXPECT_EQ(state.cost().total.transforms, transforms);
  EXPECT_EQ(state.cost().total.bytes, bytes);
}

TEST_F(LazyState, AStateOutlivesItsContact) {
  for (const LazyQuantity& quantity : lazy_quantities()) {
    SCOPED_TRACE(quantity.name);
    auto pair = std::make_unique<SpecimenPair>(plastic_scene());
    SpecimenPair twin(plastic_scene());
    const State state = pair->press(under), other = twin.press(under);
    pair->release();
    pair->place(3);
    pair->press(under);
    pair.reset();
    EXPECT_EQ(quantity.read(state), quantity.read(other));
    EXPECT_EQ(state.digest(), other.digest());
  }
}

TEST_F(LazyState, WithTheContactAndItsStatesAllMemoryGoes) {
  { SpecimenPair(plastic_scene()).press(under).stiffness(); }
  const std::int64_t before = memory::held();
  {
    std::optional<State> state = SpecimenPair(plastic_scene()).press(under);
    for (const LazyQuantity& quantity : lazy_quantities()) quantity.read(*state);
    EXPECT_GT(memory::held(), before + 5 * grid_bytes);
  }
  EXPECT_EQ(memory::held(), before);
}

}  // namespace
}  // namespace asperity::lazy_state_test
