// SPDX-License-Identifier: GPL-3.0-or-later
// Stops, too little memory, impossible values and tolerances below double precision leave the pair
// unchanged; the next press returns the same bits as without a refusal.
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/memory.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::refusal_test {
namespace {

constexpr double hardness = 1.1e9, megapascal = 1e6;

Surface specimen(std::uint64_t seed) {
  SelfAffineOptions options = test::self_affine(make_grid(128, 96, 200e-6, 150e-6), 0.8, 10e-6, seed);
  options.ra = 1e-6;
  Material metal = test::elastic(70e9, 0.33);
  metal.hardness = hardness;
  return self_affine_surface(options).with_material(metal);
}

struct Path {
  std::string name;
  Scene scene;
  PressRequest request;
};

void PrintTo(const Path& path, std::ostream* out) { *out << path.name; }

std::vector<Path> paths() {
  const auto scene = [](Boundary boundary, Elasticity elasticity) {
    return Scene{specimen(1), specimen(2), boundary, elasticity, Accuracy{1e-8}};
  };
  const auto yielding = [&](Boundary boundary, double hardening) {
    Scene result = scene(boundary, HalfSpaceOptions{});
    result.effects.set(PlasticityOptions{{}, hardening});
    return result;
  };
  const auto adhering = [&](Boundary boundary, GapLaw model) {
    Scene result = scene(boundary, HalfSpaceOptions{});
    result.effects.set(AdhesionOptions{10, 1e-6, model});
    return result;
  };
  const Scene elastic = scene(Boundary::periodic, HalfSpaceOptions{});
  const PressRequest pressure{PressBy::pressure, 100 * megapascal, {}};
  return {{"box elements", scene(Boundary::free, BoxOptions{}), pressure},
          {"elastic, periodic", elastic, pressure},
          {"elastic, free", scene(Boundary::free, HalfSpaceOptions{}), pressure},
          {"full contact", elastic, {PressBy::pressure, 1e6 * megapascal, {}}},
          {"capped, periodic", yielding(Boundary::periodic, infinity), pressure},
          {"capped, free", yielding(Boundary::free, infinity), pressure},
          {"hardening", yielding(Boundary::periodic, 1e15), pressure},
          {"by approach", elastic, {PressBy::approach, 1e-6, {}}},
          {"capped, by approach", yielding(Boundary::periodic, infinity), {PressBy::approach, 1e-6, {}}},
          {"by flattening", elastic, {PressBy::flatten, 0.2, {}}},
          {"adhering", adhering(Boundary::periodic, GapLaw::exponential), pressure},
          {"adhering, drawn back",
           adhering(Boundary::free, GapLaw::dugdale),
           {PressBy::approach, 1e-6, {}, {2e-6}}}};
}

// Raises the stop flag after a delay; the destructor lowers it.
class Stopper {
 public:
  explicit Stopper(double seconds)
      : thread_([seconds] {
          std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
          stop_flag().raise(StopReason::interrupt);
        }) {}
  ~Stopper() {
    thread_.join();
    stop_flag().clear();
  }

 private:
  std::thread thread_;
};

class MemoryLimit {
 public:
  explicit MemoryLimit(std::int64_t bytes) { memory::set_limit(bytes); }
  ~MemoryLimit() { memory::set_limit(0); }
};

class Refusals : public testing::TestWithParam<Path> {
 protected:
  Refusals() : pair_(GetParam().scene) {
    SpecimenPair untouched(GetParam().scene);
    const std::int64_t before = memory::held();
    const State state = untouched.press(GetParam().request);
    need_ = state.cost().total.bytes;
    seconds_ = state.cost().total.seconds;
    expected_ = state.digest();
    EXPECT_GT(memory::held(), before);
  }

  std::optional<ErrorCode> refused(const PressRequest& request, Monitor& monitor) {
    const std::string lower = pair_.lower().digest(), upper = pair_.upper().digest();
    const bool under_load = pair_.under_load();
    const std::int64_t held = memory::held();
    std::optional<ErrorCode> code;
    try {
      pair_.press(request, monitor);
    } catch (const Error& error) {
      code = error.code();
      EXPECT_GT(std::string(error.what()).size(), code == ErrorCode::interrupted ? 0U : 20U);
      EXPECT_EQ(memory::held(), held) << error.what();
      EXPECT_EQ(pair_.lower().digest(), lower);
      EXPECT_EQ(pair_.upper().digest(), upper);
      EXPECT_EQ(pair_.under_load(), under_load);
    }
    return code;
  }
  void expect_unharmed() { EXPECT_EQ(pair_.press(GetParam().request).digest(), expected_); }

  SpecimenPair pair_;
  std::int64_t need_ = 0;
  double seconds_ = 0;
  std::string expected_;
};

TEST_P(Refusals, AStopAskedForBefore) {
  stop_flag().raise(StopReason::interrupt);
  const auto code = refused(GetParam().request, Monitor::silent());
  stop_flag().clear();
  EXPECT_EQ(code, ErrorCode::interrupted);
  expect_unharmed();
}

TEST_P(Refusals, AStopAskedForOnTheWay) {
  // On a busy machine the press may end before the stop: retry.
  constexpr std::array shares = {0.05, 0.2, 0.4, 0.6, 0.8};
  constexpr std::size_t tries = 20 * shares.size();
  int times = 0;
  for (std::size_t k = 0; k < shares.size() || (times == 0 && k < tries); ++k) {
    const double share = shares[k % shares.size()];
    SpecimenPair fresh(GetParam().scene);
    std::swap(pair_, fresh);
    std::optional<ErrorCode> code;
    {
      const Stopper stopper(share * seconds_);
      code = refused(GetParam().request, Monitor::silent());
    }
    if (!code) continue;
    EXPECT_EQ(code, ErrorCode::interrupted) << share;
    expect_unharmed();
    ++times;
  }
  // A small box contact ends before a thread starts.
  const bool boxes = GetParam().scene.elasticity.is<BoxOptions>();
  EXPECT_GE(times, boxes ? 0 : 1);
}

TEST_P(Refusals, TooLittleMemory) {
  int times = 0;
  for (const double share : {0.0, 0.05, 0.2, 0.5, 0.8, 0.95}) {
    SpecimenPair fresh(GetParam().scene);
    std::swap(pair_, fresh);
    std::optional<ErrorCode> code;
    {
      const MemoryLimit limit(memory::held() + 1 +
                              static_cast<std::int64_t>(share * static_cast<double>(need_)));
      code = refused(GetParam().request, Monitor::silent());
    }
    if (!code) continue;
    EXPECT_EQ(code, ErrorCode::out_of_memory) << share;
    expect_unharmed();
    ++times;
  }
  EXPECT_GE(times, 3);
}

TEST_P(Refusals, WhatCannotBeAskedFor) {
  const PressBy by = GetParam().request.by;
  for (const double value : {-1.0, std::nan(""), infinity, -infinity}) {
    if (value == -1 && GetParam().scene.effects.find<AdhesionOptions>()) continue;  // tension
    EXPECT_TRUE(refused({by, value, {}}, Monitor::silent())) << value;
  }
  if (GetParam().scene.effects.find<PlasticityOptions>() &&
      !(GetParam().scene.effects.find<PlasticityOptions>()->hardening < infinity)) {
    EXPECT_EQ(refused({PressBy::pressure, hardness, {}}, Monitor::silent()), ErrorCode::infeasible);
    EXPECT_TRUE(refused({PressBy::approach, 1.0, {}}, Monitor::silent()));
  }
  if (GetParam().scene.effects.find<AdhesionOptions>()) {
    EXPECT_EQ(refused({PressBy::pressure, -1e9, {}}, Monitor::silent()), ErrorCode::infeasible);
    EXPECT_TRUE(refused({PressBy::flatten, 0.1, {}}, Monitor::silent()));
  }
  expect_unharmed();
}

TEST_P(Refusals, AToleranceThatNoDoubleMeets) {
  if (GetParam().scene.elasticity.is<BoxOptions>()) GTEST_SKIP() << "box contacts are exact to rounding";
  Scene scene = GetParam().scene;
  scene.accuracy.tolerance = 1e-15;
  pair_ = SpecimenPair(scene);
  if (const auto code = refused(GetParam().request, Monitor::silent())) {
    EXPECT_EQ(code, ErrorCode::not_converged);
    scene.accuracy.on_failure = Accuracy::OnFailure::best;
    const State best = SpecimenPair(scene).press(GetParam().request);
    EXPECT_FALSE(best.converged());
    EXPECT_LT(best.certificate().worst(), 1e-9);
    EXPECT_FALSE(best.solver().empty());
  }
  pair_ = SpecimenPair(GetParam().scene);
  expect_unharmed();
}

std::string name_of(const testing::TestParamInfo<Path>& path) {
  std::string name = path.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Dignity, Refusals, testing::ValuesIn(paths()), name_of);

}  // namespace
}  // namespace asperity::refusal_test
