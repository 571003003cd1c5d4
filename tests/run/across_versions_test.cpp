// SPDX-License-Identifier: GPL-3.0-or-later
// A run of an earlier version beside one of this: what last digits are, what no digest can say, what a
// changed law explains, and what stays a difference.
#include "engine/run/across_versions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace asperity::across_versions_test {
namespace {

const std::string one_digest = "0123456789abcdef0123456789abcdef";
const std::string other_digest = "fedcba9876543210fedcba9876543210";

RecordedRun run_of(const std::vector<std::string>& lines, const std::string& manifest = "{}") {
  RecordedRun run;
  run.status = "done";
  run.manifest = Json::parse(manifest, "manifest");
  for (const std::string& line : lines) {
    Json json = Json::object({{"n", static_cast<std::int64_t>(run.journal.size()) + 1}});
    const Json fields = Json::parse(line, "line");
    for (const auto& [name, value] : fields.members()) json.set(name, value);
    run.journal.push_back(json);
  }
  return run;
}

AcrossVersions compared(const std::vector<std::string>& then, const std::vector<std::string>& now,
                        std::vector<LawMet> met = {}) {
  return compare_across_versions(run_of(then), run_of(now), met);
}

std::string row(const std::string& cells) {
  return R"({"event":"row","notebook":"book","row":{)" + cells + "}}";
}

TEST(AcrossVersions, NumbersAreComparedInTheDigitsThatAreKept) {
  const AcrossVersions same = compared({row(R"("a":1.0,"b":3)")}, {row(R"("a":1.000009,"b":3)")});
  EXPECT_TRUE(same.differences.empty());
  EXPECT_EQ(same.in_last_digits, 1);
  EXPECT_EQ(same.lines, 1);
  const AcrossVersions other = compared({row(R"("a":1.0,"b":3)")}, {row(R"("a":1.00002,"b":3)")});
  ASSERT_EQ(other.differences.size(), 1U);
  EXPECT_EQ(other.differences[0].where, "line 1, book, row.a");
  EXPECT_EQ(other.differences[0].recorded, "1.0");
  EXPECT_EQ(other.differences[0].again, "1.00002");
  EXPECT_TRUE(other.explained.empty());
}

// A mean of heights that is 0 but for rounding has no digits to compare.
TEST(AcrossVersions, WhatIsRoundingBesideItsColumnIsNothing) {
  const std::vector<std::string> large = {row(R"("z":2.0)")};
  const auto then_and_now = [&](const std::string& one, const std::string& other) {
    return compared({large[0], row(R"("z":)" + one)}, {large[0], row(R"("z":)" + other)}).differences.size();
  };
  EXPECT_EQ(then_and_now("1e-16", "-3e-16"), 0U);
  EXPECT_EQ(then_and_now("1e-11", "-3e-11"), 1U);
  EXPECT_EQ(compared({row(R"("z":1e-16)")}, {row(R"("z":-3e-16)")}).differences.size(), 1U);
}

TEST(AcrossVersions, TextsAreComparedWithTheirNumbers) {
  const auto differ = [](const std::string& one, const std::string& other) {
    return compared({row("\"t\":\"" + one + "\"")}, {row("\"t\":\"" + other + "\"")}).differences.size();
  };
  EXPECT_EQ(differ("{0.001, 5e+07} of A1", "{0.001000000001, 5.0000001e+07} of A1"), 0U);
  EXPECT_EQ(differ("1.5 um", "1.5 mm"), 1U);
  EXPECT_EQ(differ("1.5 um", "1.6 um"), 1U);
  EXPECT_EQ(differ("A1", "A2"), 1U);
  EXPECT_EQ(differ("1, 2", "1, 2, 3"), 1U);
  EXPECT_EQ(differ("worn", "fresh"), 1U);
}

TEST(AcrossVersions, DigestsSayNothingAndAreCounted) {
  const auto call = [](const std::string& digest, const std::string& pressure) {
    return R"({"event":"call","function":"contact:press","self":")" + digest + "+" + digest +
           R"(","inputs":{"pressure":")" + pressure + R"("},"result":")" + digest + "\"}";
  };
  const AcrossVersions same = compared({call(one_digest, "5e+07")}, {call(other_digest, "5e+07")});
  EXPECT_TRUE(same.differences.empty());
  EXPECT_EQ(same.digests, 3);
  EXPECT_EQ(compared({call(one_digest, "5e+07")}, {call(other_digest, "6e+07")}).differences.size(), 1U);
  // A result that is gone is no digest that differs.
  EXPECT_EQ(compared({call(one_digest, "1")}, {R"({"event":"call","function":"contact:press"})"})
                .differences.size(),
            1U);
}

TEST(AcrossVersions, TheScriptAndTheStepsAreTheSameToTheByte) {
  const auto begin = [](const std::string& digest, int seed) {
    return R"({"event":"begin","script":"a.lua","digest":")" + digest + R"(","seed":)" +
           std::to_string(seed) + "}";
  };
  EXPECT_EQ(compared({begin(one_digest, 1000000)}, {begin(one_digest, 1000000)}).differences.size(), 0U);
  EXPECT_EQ(compared({begin(one_digest, 1000000)}, {begin(other_digest, 1000000)}).differences.size(), 1U);
  EXPECT_EQ(compared({begin(one_digest, 1000000)}, {begin(one_digest, 1000001)}).differences.size(), 1U);
  EXPECT_EQ(compared({R"({"event":"call","function":"state:write"})"},
                     {R"({"event":"call","function":"surface:write"})"})
                .differences.size(),
            1U);
  EXPECT_EQ(compared({row("\"a\":1")}, {}).differences.size(), 1U);
  EXPECT_EQ(compared({}, {row("\"a\":1")}).differences.size(), 1U);
}

TEST(AcrossVersions, WarningsSentencesAndNewKeysAreLeftOut) {
  const std::string press = R"({"event":"call","function":"contact:press","inputs":{"pressure":"1"}})";
  const std::string with_key =
      R"({"event":"call","function":"contact:press","inputs":{"pressure":"1","dwell":"0"}})";
  const std::string warning = R"({"event":"warning","sentence":"steep"})";
  EXPECT_TRUE(compared({press, row("\"a\":1")}, {warning, with_key, row("\"a\":1")}).differences.empty());
  EXPECT_EQ(compared({with_key}, {press}).differences.size(), 1U);
  const auto verdict = [](const std::string& passed, const std::string& sentence) {
    return R"({"event":"expect","notebook":"book","passed":)" + passed + R"(,"sentence":")" + sentence +
           "\"}";
  };
  EXPECT_TRUE(
      compared({verdict("true", "at most 1e7")}, {verdict("true", "at most 10 MPa")}).differences.empty());
  EXPECT_EQ(compared({verdict("true", "a")}, {verdict("false", "a")}).differences.size(), 1U);
}

TEST(AcrossVersions, ALawThatWasMetBeforeExplains) {
  const std::vector<LawMet> met = {{&told(Law::overlap), 2}, {&told(Law::plastic_shares), 3}};
  const AcrossVersions across = compared({row("\"a\":1"), row("\"a\":2"), row("\"a\":3")},
                                         {row("\"a\":1.1"), row("\"a\":2.1"), row("\"a\":3.1")}, met);
  ASSERT_EQ(across.differences.size(), 1U);
  EXPECT_EQ(across.differences[0].where, "line 1, book, row.a");
  ASSERT_EQ(across.explained.size(), 2U);
  EXPECT_EQ(across.explained[0].difference.where, "line 2, book, row.a");
  EXPECT_EQ(across.explained[0].laws, (std::vector{&told(Law::overlap)}));
  EXPECT_EQ(across.explained[1].laws, (std::vector{&told(Law::overlap), &told(Law::plastic_shares)}));
}

TEST(AcrossVersions, FilesAreThereOrNotAndInputsTheSame) {
  const auto manifest = [](const std::string& input, const std::string& outputs, const std::string& passed) {
    return R"({"inputs":[{"file":"in.csv","digest":")" + input + R"("}],"outputs":[)" + outputs +
           R"(],"expectations":[{"passed":)" + passed + R"(,"sentence":"s"}]})";
  };
  const auto file = [](const std::string& name, const std::string& digest) {
    return R"({"file":")" + name + R"(","digest":")" + digest + "\"}";
  };
  const RecordedRun then = run_of({}, manifest("d", file("a.csv", "1") + "," + file("b.csv", "1"), "true"));
  const auto with = [&](const std::string& now) {
    return compare_across_versions(then, run_of({}, now), {});
  };
  const AcrossVersions same =
      with(manifest("d", file("a.csv", "1") + "," + file("b.csv", "2") + "," + file("b.xdmf", "3"), "true"));
  EXPECT_TRUE(same.differences.empty());
  EXPECT_EQ(same.outputs, std::vector<std::string>{"b.csv"});
  EXPECT_EQ(with(manifest("e", file("a.csv", "1") + "," + file("b.csv", "1"), "true")).differences.size(),
            1U);
  EXPECT_EQ(with(manifest("d", file("a.csv", "1"), "true")).differences.size(), 1U);
  EXPECT_EQ(with(manifest("d", file("a.csv", "1") + "," + file("b.csv", "1"), "false")).differences.size(),
            1U);
}

TEST(AcrossVersions, ARunThatWasCutOffIsComparedAsFarAsItCame) {
  RecordedRun then = run_of({row("\"a\":1"), R"({"event":"end","status":"interrupted"})"});
  then.status = "interrupted";
  const RecordedRun now = run_of({row("\"a\":1.0000001"), row("\"a\":2")});
  const AcrossVersions across = compare_across_versions(then, now, {});
  EXPECT_TRUE(across.differences.empty());
  EXPECT_EQ(across.lines, 1);
}

}  // namespace
}  // namespace asperity::across_versions_test
