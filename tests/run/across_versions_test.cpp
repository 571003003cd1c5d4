// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/recorded_run.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace asperity::across_versions_test {
namespace {

RecordedRun run_of(const std::vector<std::string>& lines) {
  RecordedRun run;
  run.status = "done";
  for (const std::string& line : lines) run.journal.push_back(Json::parse(line, "line"));
  return run;
}

AcrossVersions compared(const std::vector<std::string>& then, const std::vector<std::string>& now) {
  return compare_across_versions(run_of(then), run_of(now));
}

std::string row(const std::string& cells, const std::string& notebook = "book") {
  return R"({"event":"row","notebook":")" + notebook + R"(","row":{)" + cells + "}}";
}

std::string verdict(const std::string& passed, const std::string& sentence) {
  return R"({"event":"expect","notebook":"book","passed":)" + passed + R"(,"sentence":")" + sentence + "\"}";
}

TEST(AcrossVersions, VersionsOfOneMinorNumberAreTheSame) {
  EXPECT_TRUE(same_minor_version("0.2.0", "0.2.0"));
  EXPECT_TRUE(same_minor_version("0.2.0", "0.2.11"));
  EXPECT_FALSE(same_minor_version("0.2.0", "0.20.0"));
  EXPECT_FALSE(same_minor_version("0.2.0", "1.2.0"));
  EXPECT_FALSE(same_minor_version("", "0.2.0"));
  EXPECT_FALSE(same_minor_version("0.2", "0.2.0"));
  EXPECT_FALSE(same_minor_version("0.2", "0.3"));
}

TEST(AcrossVersions, NumbersAreComparedInTheDigitsThatAreKept) {
  const AcrossVersions same = compared({row(R"("a":1.0,"b":3)")}, {row(R"("a":1.000009,"b":3)")});
  EXPECT_TRUE(same.differences.empty());
  EXPECT_EQ(same.compared, 2);
  const AcrossVersions other = compared({row(R"("a":1.0,"b":3)")}, {row(R"("a":1.00002,"b":3)")});
  ASSERT_EQ(other.differences.size(), 1U);
  EXPECT_EQ(other.differences[0].where, "book, row 1, a");
  EXPECT_EQ(other.differences[0].recorded, "1.0");
  EXPECT_EQ(other.differences[0].again, "1.00002");
}

// Rounding of a zero mean has no digits.
TEST(AcrossVersions, RoundingOfAColumnIsNotCompared) {
  const auto then_and_now = [&](const std::string& one, const std::string& other) {
    return compared({row(R"("z":2.0)"), row(R"("z":)" + one)}, {row(R"("z":2.0)"), row(R"("z":)" + other)})
        .differences.size();
  };
  EXPECT_EQ(then_and_now("1e-16", "-3e-16"), 0U);
  EXPECT_EQ(then_and_now("1e-11", "-3e-11"), 1U);
  EXPECT_EQ(compared({row(R"("z":1e-16)")}, {row(R"("z":-3e-16)")}).differences.size(), 1U);
}

TEST(AcrossVersions, TextsVerdictsAndColumnsOfTheRecordMustBeThere) {
  EXPECT_EQ(compared({row(R"("t":"worn")")}, {row(R"("t":"fresh")")}).differences.size(), 1U);
  EXPECT_EQ(compared({row(R"("t":1)")}, {row(R"("u":1)")}).differences.size(), 1U);
  EXPECT_EQ(compared({row(R"("t":1)")}, {row(R"("t":1,"u":1)")}).differences.size(), 0U);
  EXPECT_EQ(compared({verdict("true", "a")}, {verdict("true", "b")}).differences.size(), 0U);
  EXPECT_EQ(compared({verdict("true", "a")}, {verdict("false", "a")}).differences.size(), 1U);
  // A column and a verdict's member may share a name.
  EXPECT_EQ(compared({row(R"("passed":1,"a":1)")}, {row(R"("passed":1,"a":2)")}).differences.size(), 1U);
}

TEST(AcrossVersions, RowsAreCountedByNotebook) {
  const AcrossVersions fewer = compared({row("\"a\":1"), row("\"a\":2")}, {row("\"a\":1")});
  ASSERT_EQ(fewer.differences.size(), 1U);
  EXPECT_EQ(fewer.differences[0].where, "book, rows");
  EXPECT_EQ(fewer.differences[0].again, "1");
  EXPECT_EQ(compared({row("\"a\":1")}, {row("\"a\":1"), row("\"a\":2")}).differences.size(), 1U);
  EXPECT_EQ(compared({row("\"a\":1", "x")}, {row("\"a\":1", "y")}).differences.size(), 1U);
  // Warnings and calls may differ between versions.
  EXPECT_TRUE(
      compared({row("\"a\":1", "x"), row("\"a\":1", "y")},
               {R"({"event":"warning","sentence":"steep"})", row("\"a\":1", "y"), row("\"a\":1", "x")})
          .differences.empty());
}

TEST(AcrossVersions, ARunThatWasCutOffIsComparedAsFarAsItCame) {
  RecordedRun then = run_of({row("\"a\":1"), R"({"event":"end","status":"interrupted"})"});
  then.status = "interrupted";
  const AcrossVersions across =
      compare_across_versions(then, run_of({row("\"a\":1.0000001"), row("\"a\":2")}));
  EXPECT_TRUE(across.differences.empty());
  EXPECT_EQ(across.compared, 1);
}

}  // namespace
}  // namespace asperity::across_versions_test
