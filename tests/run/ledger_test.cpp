// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/ledger.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <regex>
#include <thread>

namespace asperity::ledger_test {
namespace {

using Effects = std::vector<std::pair<std::string, Cost>>;

const LedgerLine* line_of(const LedgerReport& report, std::string_view call, bool in_case = false) {
  for (const LedgerLine& line : report.lines)
    if (line.call == call && line.in_case == in_case) return &line;
  return nullptr;
}

void work(double transforms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  cost::count_transforms(transforms);
}

TEST(Ledger, ACallIsChargedWhatItDidItself) {
  Ledger ledger;
  {
    const LedgerScope outer(ledger, "", "outer", false, true);
    work(1);
    for (int k = 0; k < 3; ++k) {
      const LedgerScope inner(ledger, "value", "inner", false, true);
      work(10);
    }
  }
  const LedgerReport report = ledger.report();
  ASSERT_EQ(report.lines.size(), 2U);
  const LedgerLine &outer = *line_of(report, "outer"), &inner = *line_of(report, "value.inner");
  EXPECT_EQ(outer.calls, 1);
  EXPECT_EQ(outer.cost.transforms, 1);
  EXPECT_GE(outer.cost.seconds, 2e-3);
  EXPECT_EQ(inner.calls, 3);
  EXPECT_EQ(inner.cost.transforms, 30);
  EXPECT_GE(inner.cost.seconds, 6e-3);
  EXPECT_EQ(report.transforms, 31);
}

// Lines and remainder sum to the total.
TEST(Ledger, NothingIsLostOrCountedTwice) {
  Ledger ledger;
  for (int k = 0; k < 4; ++k) {
    const LedgerScope scope(ledger, "", "call", false, true);
    const LedgerScope nested(ledger, "", "nested", false, true);
    work(0);
  }
  work(0);
  const LedgerReport report = ledger.report();
  const double lines =
      std::accumulate(report.lines.begin(), report.lines.end(), 0.0,
                      [](double sum, const LedgerLine& line) { return sum + line.cost.seconds; });
  EXPECT_NEAR(lines + report.unaccounted(), report.seconds, 1e-12);
  EXPECT_GE(report.unaccounted(), 2e-3);
  EXPECT_GE(line_of(report, "nested")->cost.seconds, 8e-3);
}

TEST(Ledger, AShortCallHasNoLineUnlessItLasts) {
  Ledger ledger;
  {
    const LedgerScope outer(ledger, "", "outer", false, true);
    { const LedgerScope brief(ledger, "", "brief", false, false); }
    { const LedgerScope lasting(ledger, "", "lasting", false, true); }
    {
      LedgerScope kept(ledger, "", "kept", false, false), forgotten(ledger, "", "forgotten", false, true);
      kept.keep();
      forgotten.forget();
    }
  }
  const LedgerReport report = ledger.report();
  EXPECT_EQ(line_of(report, "brief"), nullptr);
  EXPECT_NE(line_of(report, "lasting"), nullptr);
  EXPECT_NE(line_of(report, "kept"), nullptr);
  EXPECT_EQ(line_of(report, "forgotten"), nullptr);
}

TEST(Ledger, CasesAreKeptApartWhateverThreadRunsThem) {
  Ledger ledger;
  {
    const LedgerScope ensemble(ledger, "", "lab.ensemble", false, true);
    const auto one_case = [&] {
      const LedgerScope press(ledger, "", "contact:press", true, true);
      work(5);
    };
    std::jthread other(one_case);
    one_case();
  }
  const LedgerReport report = ledger.report();
  EXPECT_EQ(line_of(report, "contact:press", true)->calls, 2);
  EXPECT_EQ(line_of(report, "contact:press"), nullptr);
  // The ensemble waits while its cases run.
  EXPECT_GE(line_of(report, "lab.ensemble")->cost.seconds, 2e-3);
  EXPECT_EQ(line_of(report, "lab.ensemble")->cost.transforms, 0);
  EXPECT_EQ(report.transforms, 10);
  EXPECT_NE(report.text().find("inside cases, all threads together\n    contact:press"), std::string::npos)
      << report.text();
}

TEST(Ledger, EffectsAddUpAndTheOthersAreNamed) {
  Ledger ledger;
  ledger.add_effects(Effects{{"elasticity", {2, 10, 100}}, {"plasticity", {1, 0, 50}}});
  ledger.add_effects(Effects{{"elasticity", {3, 20, 80}}});
  const LedgerReport report = ledger.report();
  ASSERT_EQ(report.by_effect.size(), 2U);
  EXPECT_EQ(report.by_effect[0].first, "elasticity");
  EXPECT_EQ(report.by_effect[0].second.seconds, 5);
  EXPECT_EQ(report.by_effect[0].second.transforms, 30);
  EXPECT_EQ(report.by_effect[0].second.bytes, 100);
  EXPECT_EQ(std::count(report.effects_off.begin(), report.effects_off.end(), "plasticity"), 0);
  EXPECT_EQ(std::count(report.effects_off.begin(), report.effects_off.end(), "creep"), 1);
  EXPECT_NE(report.text().find("off, and nothing done for them: creep, "), std::string::npos)
      << report.text();
}

TEST(Ledger, TextAndJsonSayTheSame) {
  Ledger ledger;
  ledger.add("contact:press", false, {1.5, 48, 3 << 20});
  ledger.add_effects(Effects{{"elasticity", {1.5, 48, 3 << 20}}});
  const LedgerReport report = ledger.report();
  // The total time sets the column width.
  EXPECT_TRUE(std::regex_search(report.text(), std::regex("\n  contact:press +1 +1.5 s +48 +3 MiB\n")))
      << report.text();
  const Json json = Json::parse(report.json().text(), "ledger");
  const Json& line = json.find("calls")->list().front();
  EXPECT_EQ(line.find("call")->string(), "contact:press");
  EXPECT_EQ(line.find("cost")->find("transforms")->number(), 48);
  EXPECT_EQ(json.find("by_effect")->find("elasticity")->find("bytes")->number(), 3 << 20);
  EXPECT_EQ(json.find("unaccounted_seconds")->number(), report.unaccounted());
}

}  // namespace
}  // namespace asperity::ledger_test
