// SPDX-License-Identifier: GPL-3.0-or-later
// The Pareto front, the cheapest setting for an error; text.
#include "engine/study/study_result.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"
#include "tests/study/study_fixture.hpp"

namespace asperity::study_result_test {
namespace {

// Method `grid`: 64 cells, doubled for each error.
StudyResult result_of(const std::vector<double>& errors, const std::vector<double>& seconds) {
  StudyResult result;
  std::vector<std::int64_t> list;
  for (std::size_t k = 0; k < errors.size(); ++k) list.push_back(std::int64_t{64} << k);
  result.request.ways = {way_of_cells("grid", list)};
  result.request.truth = 1.0;
  result.truth = 1.0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    StudyRow row;
    row.setting = k;
    row.end = StudyRow::End::measured;
    row.value = 1 + errors[k];
    row.first_seconds = seconds[k];
    row.runs = {seconds[k]};
    result.rows.push_back(row);
  }
  result.complete = true;
  conclude(result);
  return result;
}

std::string refusal(const StudyResult& result, double error) {
  try {
    cheapest(result, error);
  } catch (const Error& refused) {
    return refused.what();
  }
  return "";
}

TEST(ParetoFront, HasWhatNothingBeats) {
  const StudyResult result = result_of({0.5, 0.25, 0.375, 0.125}, {1, 2, 3, 4});
  EXPECT_TRUE(result.rows[0].pareto);
  EXPECT_TRUE(result.rows[1].pareto);
  EXPECT_FALSE(result.rows[2].pareto);
  EXPECT_TRUE(result.rows[3].pareto);
}

TEST(ParetoFront, HasBothOfTwoEquals) {
  const StudyResult result = result_of({0.5, 0.5, 0.5}, {1, 1, 2});
  EXPECT_TRUE(result.rows[0].pareto);
  EXPECT_TRUE(result.rows[1].pareto);
  EXPECT_FALSE(result.rows[2].pareto);
}

TEST(Cheapest, IsTheFastestUnderTheBound) {
  const StudyResult result = result_of({0.25, 0.0625, 0.015625}, {1, 2, 4});
  EXPECT_EQ(cheapest(result, 0.1).setting, 1U);
  EXPECT_EQ(cheapest(result, 0.0625).setting, 1U);
  EXPECT_EQ(cheapest(result, std::nextafter(0.0625, 0)).setting, 2U);
  EXPECT_EQ(cheapest(result, 1).setting, 0U);
}

// Rows 1 and 2 have equal answers: row 1 represents both.
TEST(Cheapest, OfTheSameBitsIsTheOneListedFirst) {
  StudyResult result = result_of({0.25, 0.0625, 0.0625, 0.015625}, {1, 2, 1.9, 4});
  EXPECT_EQ(cheapest(result, 0.1).setting, 1U);
  EXPECT_TRUE(tied_with(result, cheapest(result, 0.1), 0.1).empty());
  result = result_of({0.25, 0.0625, 0.0625, 0.015625}, {1, 2, 0.9, 4});
  EXPECT_EQ(cheapest(result, 0.1).setting, 2U);
}

TEST(Cheapest, IsTiedWithWhatMayBeAsFast) {
  StudyResult result = result_of({0.25, 0.0625, 0.03125, 0.015625}, {1, 2, 2.5, 4});
  result.rows[1].runs = {1.8, 2, 2.2};
  result.rows[2].runs = {2.1, 2.5, 2.6};
  result.rows[3].runs = {3.9, 4, 4.1};
  conclude(result);
  const StudyRow& chosen = cheapest(result, 0.1);
  EXPECT_EQ(chosen.setting, 1U);
  const auto tied = tied_with(result, chosen, 0.1);
  ASSERT_EQ(tied.size(), 1U);
  EXPECT_EQ(tied[0]->setting, 2U);
  EXPECT_NE(study_text(result).find("; as fast within the scatter: grid { cells=256 } (held to 3.12 %)"),
            std::string::npos)
      << study_text(result);
}

TEST(Cheapest, IsNeverComparedWithItself) {
  StudyResult result = result_of({0.25, 0.0625, 0}, {1, 2, 4});
  Knobs knobs = result.request.ways[0].settings[2];
  knobs[0].value = std::int64_t{4096};
  result.request.truth = knobs;
  conclude(result);
  EXPECT_TRUE(std::isnan(result.rows[2].error));
  EXPECT_EQ(cheapest(result, 0.1).setting, 1U);
}

TEST(Cheapest, PassesByAnAccidentalCrossing) {
  // The second setting is accurate by chance.
  const StudyResult result = result_of({0.25, 0.0009765625, 0.0625, 0.015625}, {1, 2, 4, 8});
  EXPECT_EQ(result.rows[1].held_error, 0.0625);
  EXPECT_EQ(result.rows[1].confirmed, 2);
  EXPECT_EQ(cheapest(result, 0.02).setting, 3U);
  EXPECT_EQ(
      refusal(result, 0.002),
      "no setting of the study holds an error of 0.2 %: the best reached is 1.56 %, by grid { cells=512 }; "
      "grid { cells=128 } reaches 0.0977 % by accident: finer settings of its way do not; "
      "add finer settings to a way, or ask for less");
}

TEST(Cheapest, SaysWhatTheBestReachedWas) {
  EXPECT_EQ(
      refusal(result_of({0.25, 0.0625}, {1, 2}), 1e-3),
      "no setting of the study holds an error of 0.1 %: the best reached is 6.25 %, by grid { cells=128 }; "
      "add finer settings to a way, or ask for less");
  StudyResult nothing = result_of({0.25}, {1});
  nothing.rows[0].end = StudyRow::End::failed;
  conclude(nothing);
  EXPECT_EQ(refusal(nothing, 1e-3),
            "no setting of the study holds an error of 0.1 %; none of them was measured");
}

TEST(Cheapest, RefusesABoundThatIsNone) {
  const StudyResult result = result_of({0.25}, {1});
  EXPECT_EQ(refusal(result, 0), "`error` is 0; give a number above 0");
  EXPECT_EQ(refusal(result, -1), "`error` is -1; give a number above 0");
}

TEST(Cheapest, SkipsFailedSettingsOfTheWay) {
  StudyResult result = result_of({0.25, 0.0625, 0.015625}, {1, 2, 4});
  result.rows[2].end = StudyRow::End::failed;
  conclude(result);
  EXPECT_EQ(cheapest(result, 0.1).setting, 1U);
  EXPECT_EQ(result.rows[1].confirmed, 0);
}

TEST(StudyText, ShowsRowsTheFrontAndWhatToTake) {
  StudyResult result = result_of({0.25, 0.0078125, 0.015625}, {0.001, 0.002, 0.004});
  result.rows[0].runs = {0.0005, 0.001, 0.002};
  result.rows.push_back({});
  result.request.ways[0].settings.push_back(cells(1024));
  result.rows[3].setting = 3;
  result.rows[3].end = StudyRow::End::left_out;
  result.rows[3].reason = "budget: about 2 s needed, 1 s left";
  result.calls = 12;
  result.asked_seconds = 0.03;
  result.total_seconds = 0.0303;
  conclude(result);
  EXPECT_EQ(
      study_text(result),
      "work and precision: 4 settings of 1 way, truth 1\n"
      "  way   setting         value     error    seconds (fastest to slowest)\n"
      "  grid  { cells=64 }    1.25      25 %     1 ms (500 us to 2 ms)         *\n"
      "        { cells=128 }   1.007812  0.781 %  2 ms (2 ms to 2 ms)           *\n"
      "        { cells=256 }   1.015625  1.56 %   4 ms (4 ms to 4 ms)\n"
      "        { cells=1024 }  left out                                         budget: about 2 s needed, "
      "1 s left\n"
      "  * nothing measured is both faster and closer\n"
      "cheapest for 10 %: grid { cells=128 }, 2 ms, held to 1.56 %\n"
      "cheapest for 1 %: none of these; the best reached is 1.56 %, by grid { cells=256 }\n"
      "cheapest for 0.1 %: none of these; the best reached is 1.56 %, by grid { cells=256 }\n"
      "12 calls took 30 ms, the study itself 1 % more");
}

TEST(StudyText, TimesReadAsPeopleSayThem) {
  EXPECT_EQ(seconds_text(2.5e-6), "2.5 us");
  EXPECT_EQ(seconds_text(0.0123), "12.3 ms");
  EXPECT_EQ(seconds_text(4.2), "4.2 s");
  EXPECT_EQ(seconds_text(200), "3 min 20 s");
  EXPECT_EQ(seconds_text(300), "5 min");
  EXPECT_EQ(seconds_text(7500), "2 h 5 min");
  EXPECT_EQ(share_text(0.01234), "1.23 %");
  EXPECT_EQ(share_text(12.344), "1234 %");
}

TEST(StudyTable, HasAColumnForEachKnob) {
  const StudyResult result = result_of({0.25, 0.0625}, {1, 2});
  const Table table = study_table(result);
  EXPECT_EQ(
      table.csv(),
      "way,cells,end,value,error,absolute_error,held_error,seconds [s],seconds_low [s],seconds_high [s],"
      "first_seconds [s],runs,pareto,steady,reason\n"
      "grid,64,measured,1.25,0.25,0.25,0.25,1,1,1,1,1,true,true,\n"
      "grid,128,measured,1.0625,0.0625,0.0625,0.0625,2,2,2,2,1,true,true,\n");
}

}  // namespace
}  // namespace asperity::study_result_test
