// SPDX-License-Identifier: GPL-3.0-or-later
// Solves recalled from a store have the same bits; the key contains every number.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/contact/elasticity/half_space/half_space_solver.hpp"
#include "engine/contact/scene/scene.hpp"
#include "tests/core/shelf.hpp"

namespace asperity::half_space_solver_test {
namespace {

HalfSpaceProblem waves() {
  HalfSpaceProblem problem;
  problem.grid = make_grid(24, 16, 1.5, 1.0);
  problem.modulus = 2;
  Field heights(24, 16);
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 24; ++i)
      heights(i, j) = 0.01 * std::cos(2 * M_PI * i / 24) * std::cos(2 * M_PI * (j + 0.3 * i) / 16);
  problem.rms = 0.005;
  problem.heights = std::make_shared<const Field>(std::move(heights));
  return problem;
}

TEST(RecalledSolve, GivesTheBitsAndTheCostOfTheSolve) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  const HalfSpaceProblem problem = waves();
  int solves = 0;
  const auto solve = [&] {
    ++solves;
    return solve_at_pressure(problem, 0.004, nullptr, monitor);
  };
  const Costed<HalfSpaceAnswer> first = recall_or_solve(problem, "pressure", 0.004, nullptr, monitor, solve);
  const CostScope scope;
  const Costed<HalfSpaceAnswer> again = recall_or_solve(problem, "pressure", 0.004, nullptr, monitor, solve);
  EXPECT_EQ(solves, 1);
  EXPECT_EQ(scope.so_far().transforms, first.cost.transforms);
  EXPECT_GT(first.cost.transforms, 0);
  EXPECT_EQ(again.cost.transforms, first.cost.transforms);
  EXPECT_EQ(again.cost.seconds, first.cost.seconds);
  EXPECT_EQ(again.cost.bytes, first.cost.bytes);
  const HalfSpaceAnswer &one = first.result, &other = again.result;
  EXPECT_TRUE(std::ranges::equal(one.pressure.values(), other.pressure.values()));
  EXPECT_TRUE(std::ranges::equal(one.gap.values(), other.gap.values()));
  EXPECT_EQ(one.offset, other.offset);
  EXPECT_EQ(one.mean_pressure, other.mean_pressure);
  EXPECT_EQ(one.approach, other.approach);
  EXPECT_EQ(one.contacts, other.contacts);
  EXPECT_EQ(one.yielded, other.yielded);
  EXPECT_EQ(one.peak_pressure, other.peak_pressure);
  EXPECT_EQ(one.certificate.worst(), other.certificate.worst());
  EXPECT_EQ(one.converged, other.converged);
  EXPECT_EQ(one.iterations, other.iterations);
  EXPECT_EQ(one.solver, other.solver);
}

TEST(RecalledSolve, EveryNumberOfTheProblemIsInItsKey) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  const HalfSpaceProblem problem = waves();
  int solves = 0;
  const auto solve = [&] { return ++solves, HalfSpaceAnswer{}; };
  const auto differs = [&](const char* what, const HalfSpaceProblem& other, std::string_view by = "pressure",
                           double value = 0.004) {
    const int before = solves;
    recall_or_solve(other, by, value, nullptr, monitor, solve);
    EXPECT_EQ(solves, before + 1) << what;
  };
  differs("itself", problem);
  differs("by", problem, "approach");
  differs("value", problem, "pressure", std::nextafter(0.004, 1));
  const auto changed = [&](const char* what, auto change) {
    HalfSpaceProblem other = problem;
    change(other);
    differs(what, other);
  };
  changed("cells", [](auto& p) { p.grid = make_grid(16, 24, 1.5, 1.0); });
  changed("size_x", [](auto& p) { p.grid.size_x = 1.6; });
  changed("size_y", [](auto& p) { p.grid.size_y = 1.6; });
  changed("boundary", [](auto& p) { p.boundary = Boundary::free; });
  changed("modulus", [](auto& p) { p.modulus = 3; });
  changed("rms", [](auto& p) { p.rms = 0.006; });
  changed("tolerance", [](auto& p) { p.tolerance = 1e-7; });
  changed("best_effort", [](auto& p) { p.best_effort = true; });
  changed("single", [](auto& p) { p.single = true; });
  changed("cap", [](auto& p) { p.yield.cap = 0.1; });
  changed("hardening", [](auto& p) { p.yield.hardening = 1; });
  changed("yield", [](auto& p) { p.yield.yield = std::make_shared<const Field>(24, 16, 0.1); });
  changed("one height", [](auto& p) {
    Field heights = *p.heights;
    heights(23, 15) = std::nextafter(heights(23, 15), 1);
    p.heights = std::make_shared<const Field>(heights);
  });
  EXPECT_EQ(shelf.found, 0);
  recall_or_solve(problem, "pressure", 0.004, nullptr, monitor, solve);
  EXPECT_EQ(shelf.found, 1);
}

TEST(RecalledSolve, AttractionAndItsBranchAreInTheKey) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  AdhesiveProblem problem{waves(), {{"adhesion", GapLaw::exponential, 1e-4, 1e-3}}};
  const auto solve = [&](double approach, const AdhesiveAnswer* start) {
    return recall_or_adhere(problem, "approach", approach, start, monitor,
                            [&] { return adhere_at_approach(problem, approach, start, monitor); });
  };
  const AdhesiveAnswer deep = solve(0.002, nullptr).result;
  const AdhesiveAnswer from_apart = solve(0.001, nullptr).result, retracted = solve(0.001, &deep).result;
  EXPECT_EQ(shelf.results.size(), 3U);
  const Costed<AdhesiveAnswer> again = solve(0.001, &deep);
  EXPECT_EQ(shelf.found, 1);
  EXPECT_TRUE(std::ranges::equal(again.result.attraction.values(), retracted.attraction.values()));
  EXPECT_EQ(again.result.mean_attraction, retracted.mean_attraction);
  EXPECT_EQ(again.result.shares, retracted.shares);
  EXPECT_EQ(again.result.steps, retracted.steps);
  EXPECT_EQ(again.result.stationarity, retracted.stationarity);
  EXPECT_EQ(again.result.first_contact.transforms, retracted.first_contact.transforms);
  const int found = shelf.found;
  for (auto change :
       {+[](GapTerm& t) { t.work *= 2; }, +[](GapTerm& t) { t.range *= 2; },
        +[](GapTerm& t) { t.law = GapLaw::dugdale; }, +[](GapTerm& t) { t.effect = "capillarity"; }}) {
    const GapTerm before = problem.attraction.front();
    change(problem.attraction.front());
    solve(0.001, nullptr);
    problem.attraction.front() = before;
  }
  EXPECT_EQ(shelf.found, found);
}

TEST(RecalledSolve, WithoutAStoreNoKeyIsMade) {
  const ResultForm<int> form = {"a number", nullptr, nullptr};
  const auto key = []() -> std::string { throw std::logic_error("a key was asked for"); };
  EXPECT_EQ(recall_or(Monitor::silent(), form, key, [] { return 7; }).result, 7);
}

}  // namespace
}  // namespace asperity::half_space_solver_test
