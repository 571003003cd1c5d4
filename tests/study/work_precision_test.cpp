// SPDX-License-Identifier: GPL-3.0-or-later
// The course of a study: runs, order, budget, failures, stops.
#include "engine/study/work_precision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/study/study_fixture.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::work_precision_test {
namespace {

class Study : public testing::Test {
 protected:
  void TearDown() override { stop_flag().clear(); }
  StudyResult run(const StudyRequest& request) {
    WorkPrecision study(request, work, monitor, work.clock());
    study.run();
    return study.result();
  }
  static std::string failure_of(const std::function<void()>& action) {
    return test::error_of([&] { action(); });
  }
  WrittenWork work;
  NotingMonitor monitor;
};

TEST_F(Study, AsksEverySettingOnceAndThenInRounds) {
  const StudyRequest request{{way_of_cells("grid", {64, 128})}, 1.0, 2, {}};
  const StudyResult result = run(request);
  const std::vector<std::string> order = {"{ cells=64 }",  "{ cells=128 }", "{ cells=64 }",
                                          "{ cells=128 }", "{ cells=64 }",  "{ cells=128 }"};
  EXPECT_EQ(work.asked, order);
  EXPECT_EQ(result.calls, 6);
  EXPECT_TRUE(result.complete);
  ASSERT_EQ(result.rows.size(), 2U);
  EXPECT_EQ(result.rows[0].end, StudyRow::End::measured);
  EXPECT_EQ(result.rows[0].runs.size(), 2U);
  EXPECT_NEAR(result.rows[1].seconds, 128 * 128 * 1e-6, 1e-12);
  EXPECT_DOUBLE_EQ(result.rows[1].error, 1.0 / 128);
  EXPECT_TRUE(result.rows[1].steady);
}

TEST_F(Study, ItselfTakesNoTimeOnAClockThatItDoesNotMove) {
  const StudyResult result = run({{way_of_cells("grid", {64, 128})}, cells(512), 3, {}});
  EXPECT_EQ(result.calls, 1 + 2 * (1 + 3));
  EXPECT_NEAR(result.asked_seconds, result.total_seconds, 1e-12);
  EXPECT_NEAR(result.overhead(), 0, 1e-9);
}

TEST_F(Study, LooksAtTheClockAFewTimesACall) {
  int looks = 0;
  WorkPrecision study({{way_of_cells("grid", {64, 128, 256})}, 1.0, 20, {}}, work, monitor, [&] {
    ++looks;
    return work.time;
  });
  study.run();
  EXPECT_EQ(study.result().calls, 3 * 21);
  EXPECT_LE(looks, 3 * study.result().calls + 2);
}

TEST_F(Study, SecondsAreTheMedianWithTheFastestAndTheSlowest) {
  work.takes = [](const Knobs&, int call) {
    return std::vector<double>{9, 3, 1, 2, 8, 4}[static_cast<std::size_t>(call)];
  };
  const StudyRow row = run({{way_of_cells("grid", {64})}, 1.0, 5, {}}).rows[0];
  EXPECT_DOUBLE_EQ(row.first_seconds, 9);
  EXPECT_NEAR(row.seconds, 3, 1e-12);
  EXPECT_NEAR(row.seconds_low, 1, 1e-12);
  EXPECT_NEAR(row.seconds_high, 8, 1e-12);
}

TEST_F(Study, AnEvenNumberOfRunsHasTheMeanOfTheMiddleTwo) {
  work.takes = [](const Knobs&, int call) {
    return std::vector<double>{9, 3, 1, 2, 8}[static_cast<std::size_t>(call)];
  };
  EXPECT_NEAR(run({{way_of_cells("grid", {64})}, 1.0, 4, {}}).rows[0].seconds, 2.5, 1e-12);
}

TEST_F(Study, TakesTheTruthFromItsKnobs) {
  const StudyResult result = run({{way_of_cells("grid", {64})}, cells(512), 1, {}});
  ASSERT_TRUE(result.truth);
  EXPECT_EQ(*result.truth, 1 + 1.0 / 512);
  EXPECT_NEAR(result.truth_seconds, 512 * 512 * 1e-6, 1e-12);
  EXPECT_EQ(std::count(work.asked.begin(), work.asked.end(), "{ cells=512 }"), 1);
  EXPECT_EQ(result.rows[0].absolute_error, std::abs(1 + 1.0 / 64 - (1 + 1.0 / 512)));
}

TEST_F(Study, TheTruthItselfHasNoError) {
  const StudyResult result = run({{way_of_cells("grid", {64, 512})}, cells(512), 1, {}});
  EXPECT_TRUE(std::isnan(result.rows[1].error));
  EXPECT_FALSE(result.rows[1].pareto);
  EXPECT_EQ(result.rows[1].reason, "the truth itself, so without an error");
  EXPECT_TRUE(result.rows[0].pareto);
}

TEST_F(Study, ErrorsAreAbsoluteWhereTheTruthIsNought) {
  const StudyResult result = run({{way_of_cells("grid", {64})}, 0.0, 1, {}});
  EXPECT_FALSE(result.relative());
  EXPECT_EQ(result.rows[0].error, 1 + 1.0 / 64);
}

TEST_F(Study, AFailedSettingKeepsItsRowAndIsNotAskedAgain) {
  work.answer = [](const Knobs& knobs, int) {
    return number_of(knobs, "cells") == 128 ? StudyAnswer{{}, "the load cannot be carried"}
                                            : StudyAnswer{1.5, ""};
  };
  const StudyResult result = run({{way_of_cells("grid", {64, 128, 256})}, 1.0, 3, {}});
  EXPECT_EQ(result.rows[1].end, StudyRow::End::failed);
  EXPECT_EQ(result.rows[1].reason, "the load cannot be carried");
  EXPECT_EQ(result.rows[2].end, StudyRow::End::measured);
  EXPECT_EQ(std::count(work.asked.begin(), work.asked.end(), "{ cells=128 }"), 1);
  EXPECT_EQ(result.calls, 2 * 4 + 1);
}

TEST_F(Study, NoAnswerAndNoNumberAreFailures) {
  work.answer = [](const Knobs& knobs, int) {
    if (number_of(knobs, "cells") == 64) return StudyAnswer{};
    return StudyAnswer{number_of(knobs, "cells") == 128 ? std::numeric_limits<double>::quiet_NaN()
                                                        : std::numeric_limits<double>::infinity(),
                       ""};
  };
  const StudyResult result = run({{way_of_cells("grid", {64, 128, 256})}, 1.0, 1, {}});
  EXPECT_EQ(result.rows[0].reason, "no answer (nil)");
  EXPECT_EQ(result.rows[1].reason, "the answer is nan");
  EXPECT_EQ(result.rows[2].reason, "the answer is inf");
}

TEST_F(Study, ASettingThatFailsLaterHasFailed) {
  work.answer = [](const Knobs&, int call) {
    return call == 2 ? StudyAnswer{{}, "lost"} : StudyAnswer{1.0, ""};
  };
  const StudyRow row = run({{way_of_cells("grid", {64})}, 1.0, 5, {}}).rows[0];
  EXPECT_EQ(row.end, StudyRow::End::failed);
  EXPECT_EQ(row.reason, "run 2: lost");
  EXPECT_TRUE(std::isnan(row.error));
}

TEST_F(Study, AnswersThatDifferInTheLastBitAreToldApart) {
  work.answer = [](const Knobs&, int call) {
    return StudyAnswer{call == 3 ? std::nextafter(1.5, 2) : 1.5, ""};
  };
  const StudyRow row = run({{way_of_cells("grid", {64})}, 1.0, 5, {}}).rows[0];
  EXPECT_FALSE(row.steady);
  EXPECT_EQ(row.value, 1.5);
  EXPECT_EQ(row.reason, "run 3 gave 1.5000000000000002");
  EXPECT_EQ(row.runs.size(), 5U);
}

TEST_F(Study, MinusNoughtIsNotNought) {
  work.answer = [](const Knobs&, int call) { return StudyAnswer{call == 1 ? -0.0 : 0.0, ""}; };
  EXPECT_FALSE(run({{way_of_cells("grid", {64})}, 1.0, 2, {}}).rows[0].steady);
}

// --- the budget

TEST_F(Study, ABudgetIsQuotedAndObeyed) {
  // A run takes 0.004, 0.016, 0.066, 0.26, 1.05 s, a setting four runs.
  const StudyRequest request{{way_of_cells("grid", {64, 128, 256, 512, 1024})}, 1.0, 3, 2.0};
  const StudyResult result = run(request);
  EXPECT_LE(result.total_seconds, 2.0);
  EXPECT_EQ(result.rows[3].end, StudyRow::End::measured);
  EXPECT_EQ(result.rows[3].runs.size(), 3U);
  EXPECT_EQ(result.rows[4].end, StudyRow::End::left_out);
  EXPECT_TRUE(result.rows[4].reason.starts_with("budget: about ")) << result.rows[4].reason;
  EXPECT_NEAR(result.rows[4].expected_seconds.value_or(0), 1.05, 0.4);
  ASSERT_EQ(monitor.sentences.size(), 1U);
  EXPECT_NE(monitor.sentences[0].find("at most 2 s, which leaves out"), std::string::npos)
      << monitor.sentences[0];
  EXPECT_NE(monitor.sentences[0].find("grid { cells=1024 }"), std::string::npos) << monitor.sentences[0];
}

TEST_F(Study, WithoutABudgetTheQuoteSaysWhatItTakes) {
  run({{way_of_cells("grid", {64, 128})}, cells(256), 3, {}});
  ASSERT_EQ(monitor.sentences.size(), 1U);
  EXPECT_TRUE(monitor.sentences[0].starts_with(
      "work and precision: 2 settings, each timed 3 times after a first run: about "))
      << monitor.sentences[0];
  EXPECT_NE(monitor.sentences[0].find("the truth { cells=256 } takes about "), std::string::npos);
}

TEST_F(Study, TheTruthHasTheFirstCallOnTheBudget) {
  // The truth takes 1.05 s.
  const StudyResult result = run({{way_of_cells("grid", {64, 128, 256, 512})}, cells(1024), 5, 2.0});
  EXPECT_TRUE(result.truth);
  EXPECT_EQ(result.rows[0].end, StudyRow::End::measured);
  EXPECT_EQ(result.rows[3].end, StudyRow::End::left_out);
  EXPECT_LE(result.total_seconds, 2.0);
}

TEST_F(Study, ATruthBeyondTheBudgetIsAnError) {
  EXPECT_EQ(failure_of([&] {
              run({{way_of_cells("grid", {64})}, cells(4096), 5, 2.0});
            }).find("the truth { cells=4096 } would take about "),
            0U);
  EXPECT_EQ(work.asked.size(), 1U);  // forecast only
}

TEST_F(Study, ATruthThatFailsIsAnError) {
  work.answer = [](const Knobs& knobs, int) {
    return number_of(knobs, "cells") == 256 ? StudyAnswer{{}, "no memory"} : StudyAnswer{1.0, ""};
  };
  EXPECT_EQ(failure_of([&] {
              run({{way_of_cells("grid", {64})}, cells(256), 5, {}});
            }),
            "the truth { cells=256 } failed: no memory; give other knobs for it, or an exact value");
}

TEST_F(Study, RunsThatGrowSlowerThanTheBudgetAreCutShort) {
  // Ten times as long after the first runs.
  work.takes = [](const Knobs&, int call) { return call < 2 ? 0.1 : 1.0; };
  const StudyResult result = run({{way_of_cells("grid", {64, 128})}, 1.0, 5, 4.5});
  EXPECT_LE(result.total_seconds, 4.5 + 1.0);
  EXPECT_EQ(result.rows[0].runs.size(), 2U);
  EXPECT_EQ(result.rows[0].reason, "budget: 2 of 5 runs");
  EXPECT_EQ(result.rows[0].end, StudyRow::End::measured);
}

TEST_F(Study, AnUnknownKnobIsForecastByItsGrowth) {
  work.takes = [](const Knobs& knobs, int) {
    return std::pow(number_of(knobs, "terms").value_or(0), 2) * 1e-4;
  };
  work.answer = [](const Knobs&, int) { return StudyAnswer{1.0, ""}; };
  const StudyWay way = make_way(
      "terms", {{"terms", {std::int64_t{10}, std::int64_t{20}, std::int64_t{40}, std::int64_t{80}}, true}});
  // A run takes 0.01, 0.04, 0.16, 0.64 s, a setting two runs.
  const StudyResult result = run({{way}, 1.0, 1, 0.5});
  EXPECT_EQ(result.rows[2].end, StudyRow::End::measured);
  EXPECT_EQ(result.rows[3].end, StudyRow::End::left_out);
  EXPECT_NEAR(result.rows[3].expected_seconds.value_or(0), 0.64, 1e-9);
}

// --- stops

TEST_F(Study, AStopKeepsWhatWasMeasured) {
  work.answer = [](const Knobs&, int call) -> StudyAnswer {
    if (call == 5) {
      stop_flag().raise(StopReason::interrupt);
      stop_flag().check();
    }
    return {1.25, ""};
  };
  WorkPrecision study({{way_of_cells("grid", {64, 128})}, 1.0, 5, {}}, work, monitor, work.clock());
  EXPECT_THROW(study.run(), Error);
  const StudyResult& result = study.result();
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.rows[0].runs.size(), 2U);
  EXPECT_EQ(result.rows[1].runs.size(), 1U);
  EXPECT_EQ(result.rows[1].error, 0.25);
  EXPECT_EQ(work.recorded.size(), 5U);
}

TEST_F(Study, EveryCallIsRecordedOnce) {
  run({{way_of_cells("grid", {64, 128})}, cells(256), 1, {}});
  const std::vector<std::string> expected = {"grid { cells=64 } 0", "truth { cells=256 } 0",
                                             "grid { cells=128 } 0", "grid { cells=64 } 1",
                                             "grid { cells=128 } 1"};
  EXPECT_EQ(work.recorded, expected);
}

TEST_F(Study, ProgressNeverFalls) {
  run({{way_of_cells("grid", {64, 128, 256, 512})}, cells(1024), 5, {}});
  EXPECT_GT(monitor.shares.size(), 3U);
  EXPECT_TRUE(std::is_sorted(monitor.shares.begin(), monitor.shares.end()));
  EXPECT_LE(monitor.shares.back(), 1.0);
}

TEST_F(Study, RefusesWhatCannotBeStudied) {
  const StudyWay way = way_of_cells("grid", {64});
  EXPECT_EQ(failure_of([&] { run({{}, 1.0, 1, {}}); }).find("there is no setting to try"), 0U);
  EXPECT_EQ(failure_of([&] { run({{way}, 1.0, 0, {}}); }), "`repeats` is 0; give at least 1");
  EXPECT_EQ(failure_of([&] {
              run({{way, way}, 1.0, 1, {}});
            }),
            "two ways are called `grid`; give each a name of its own");
  EXPECT_EQ(failure_of([&] {
              run({{way}, std::numeric_limits<double>::infinity(), 1, {}});
            }).find("`truth` is inf"),
            0U);
  EXPECT_TRUE(work.asked.empty());
}

}  // namespace
}  // namespace asperity::work_precision_test
