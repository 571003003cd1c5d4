// SPDX-License-Identifier: GPL-3.0-or-later
// One whole numbered line per event, from any thread, until closed.
#include "engine/run/journal.hpp"

#include <limits>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/support/run_fixture.hpp"

namespace asperity::journal_test {
namespace {

using JournalTest = InFolder;
using namespace std::chrono_literals;

TEST_F(JournalTest, IsOnDiskAfterEachEvent) {
  Journal journal(folder / "j.jsonl");
  EXPECT_EQ(content_of(folder / "j.jsonl"), "");
  EXPECT_EQ(journal.write("press", Json::object({{"pressure", 0.1}, {"held", true}})), 1);
  EXPECT_EQ(content_of(folder / "j.jsonl"), "{\"n\":1,\"event\":\"press\",\"pressure\":0.1,\"held\":true}\n");
  EXPECT_EQ(journal.write("release"), 2);
  EXPECT_TRUE(content_of(folder / "j.jsonl").ends_with("\n{\"n\":2,\"event\":\"release\"}\n"));
}

TEST_F(JournalTest, NumbersReadBackExactly) {
  Journal journal(folder / "j.jsonl");
  journal.write("x", Json::object({{"v", 1.0 / 3}, {"bad", std::numeric_limits<double>::quiet_NaN()}}));
  const Json line = Json::parse(content_of(folder / "j.jsonl"), "line");
  EXPECT_EQ(line.find("v")->number(), 1.0 / 3);
  EXPECT_EQ(line.find("bad")->string(), "nan");
}

TEST_F(JournalTest, LinesOfManyThreadsStayWhole) {
  constexpr int threads = 4, each = 200;
  {
    Journal journal(folder / "j.jsonl");
    std::vector<std::thread> writers;
    for (int t = 0; t < threads; ++t)
      writers.emplace_back([&journal, t] {
        for (int k = 0; k < each; ++k)
          journal.write("w", Json::object({{"t", t}, {"text", std::string(100, 'a')}}));
      });
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(journal.count(), threads * each);
  }
  std::istringstream lines(content_of(folder / "j.jsonl"));
  std::int64_t expected = 0;
  for (std::string line; std::getline(lines, line);)
    EXPECT_EQ(Json::parse(line, "line").find("n")->number(), static_cast<double>(++expected));
  EXPECT_EQ(expected, threads * each);
}

TEST_F(JournalTest, RefusesEventsAfterTheEnd) {
  Journal journal(folder / "j.jsonl");
  EXPECT_TRUE(journal.close("end", Json::object({{"status", "done"}}), 1s));
  EXPECT_TRUE(journal.close("end", {}, 1s));
  EXPECT_EQ(content_of(folder / "j.jsonl"), "{\"n\":1,\"event\":\"end\",\"status\":\"done\"}\n");
  EXPECT_EQ(error_of([&] { journal.write("late"); }),
            "bad_state: the run is over; its journal takes no more events");
}

TEST_F(JournalTest, NeverWritesIntoAnother) {
  std::ofstream(folder / "j.jsonl") << "{}\n";
  EXPECT_EQ(error_of([&] { Journal again(folder / "j.jsonl"); }),
            "bad_file: cannot begin `" + (folder / "j.jsonl").string() + "`: file exists");
}

TEST(Journal, WithoutAFileOnlyCounts) {
  Journal journal;
  EXPECT_EQ(journal.write("a"), 1);
  EXPECT_EQ(journal.count(), 1);
}

// A resumed run does not write existing lines twice.
TEST_F(JournalTest, IsRepeatedUpToWhereItEndedAndThenGoesOn) {
  const auto first_lines = [](Journal& journal) {
    journal.write("begin", Json::object({{"seed", 1}}));
    journal.write("call",
                  Json::object({{"function", "press"}, {"inputs", Json::object({{"pressure", 0.1}})}}));
    journal.write("row", Json::object({{"row", Json::object({{"n", 1.0}})}, {"unhashed", 12}}));
  };
  {
    Journal journal(folder / "j.jsonl");
    first_lines(journal);
    journal.close("end", Json::object({{"status", "interrupted"}}), 1s);
  }
  std::string torn = content_of(folder / "j.jsonl");
  std::ofstream(folder / "torn.jsonl", std::ios::binary) << torn.substr(0, torn.size() - 5);
  for (const char* name : {"j.jsonl", "torn.jsonl"}) {
    const std::unique_ptr<Journal> journal = Journal::again(folder / name);
    EXPECT_TRUE(journal->repeating());
    first_lines(*journal);
    EXPECT_FALSE(journal->repeating());
    EXPECT_EQ(journal->count(), 3);
    EXPECT_EQ(journal->write("row", Json::object({{"row", Json::object({{"n", 2.0}})}})), 4);
    EXPECT_EQ(journal->departure(), "");
    journal->close("end", Json::object({{"status", "done"}}), 1s);
  }
  EXPECT_EQ(content_of(folder / "torn.jsonl"), content_of(folder / "j.jsonl"));
  EXPECT_TRUE(content_of(folder / "j.jsonl")
                  .ends_with("\"n\":1.0},\"unhashed\":12}\n"
                             "{\"n\":4,\"event\":\"row\",\"row\":{\"n\":2.0}}\n"
                             "{\"n\":5,\"event\":\"end\",\"status\":\"done\"}\n"));
}

TEST_F(JournalTest, AnotherValueIsWrittenAnewAndAnotherStepIsAnError) {
  const auto write = [](Journal& journal, double seconds, const char* function) {
    journal.write("row", Json::object({{"notebook", "times"}, {"row", Json::object({{"s", seconds}})}}));
    journal.write("call", Json::object({{"function", function}}));
  };
  {
    Journal journal(folder / "j.jsonl");
    write(journal, 1, "press");
  }
  {
    const auto journal = Journal::again(folder / "j.jsonl");
    write(*journal, 2, "press");
    EXPECT_EQ(journal->departure(),
              "from line 1 of the journal on it is written again: `row.s` was 1.0 and is now 2.0");
    EXPECT_EQ(journal->count(), 2);
  }
  EXPECT_EQ(content_of(folder / "j.jsonl"),
            "{\"n\":1,\"event\":\"row\",\"notebook\":\"times\",\"row\":{\"s\":2.0}}\n"
            "{\"n\":2,\"event\":\"call\",\"function\":\"press\"}\n");
  const std::string before = content_of(folder / "j.jsonl");
  const auto journal = Journal::again(folder / "j.jsonl");
  EXPECT_EQ(
      error_of([&] { write(*journal, 2, "scan"); }),
      "bad_state: the run differs from the resumed one: in line 2 of the journal `function` "
      "was \"press\" and is now \"scan\"; its inputs have changed; run the script again, with --reuse for "
      "unchanged results");
  EXPECT_EQ(content_of(folder / "j.jsonl"), before);
}

// A power cut leaves zeros; the run rewrites lines from there.
TEST_F(JournalTest, IsTakenUpToAHoleAndElseNamesWhatServes) {
  const auto lines = [](Journal& journal) {
    for (int k = 1; k <= 4; ++k) journal.write("row", Json::object({{"row", Json::object({{"k", k}})}}));
  };
  const std::filesystem::path file = folder / "j.jsonl";
  {
    Journal journal(file);
    lines(journal);
  }
  const std::string whole = content_of(file);
  for (std::size_t from = 0; from < whole.size(); from += 13) {
    std::string torn = whole;
    for (std::size_t k = from; k < std::min(from + 20, torn.size()); ++k) torn[k] = '\0';
    std::ofstream(file, std::ios::binary) << torn;
    EXPECT_NE(error_of([&] { (void)read_journal(file, false); })
                  .find("holds zeros, as a power cut leaves them; use its results by `asperity run " +
                        (folder / "script.lua").string() + " --reuse " + folder.string() + "`"),
              std::string::npos);
    const auto journal = Journal::again(file);
    lines(*journal);
    EXPECT_EQ(content_of(file), whole) << from;
  }
}

TEST_F(JournalTest, ALinkIsNotTakenUp) {
  {
    Journal journal(folder / "victim");
    journal.write("row");
    journal.close("end", {}, 1s);
  }
  const std::string before = content_of(folder / "victim");
  std::filesystem::create_symlink(folder / "victim", folder / "j.jsonl");
  EXPECT_NE(error_of([&] { Journal::again(folder / "j.jsonl"); }).find("is a link"), std::string::npos);
  EXPECT_EQ(content_of(folder / "victim"), before);
}

// A hard-linked copy stays unchanged; the journal is complete.
TEST_F(JournalTest, AnotherNameOfTheFileKeepsItsBytes) {
  const std::filesystem::path file = folder / "j.jsonl", copy = folder / "copy";
  {
    Journal journal(file);
    journal.write("row");
    journal.close("end", {}, 1s);
  }
  const std::string before = content_of(file);
  std::filesystem::create_hard_link(file, copy);
  {
    const auto journal = Journal::again(file);
    journal->write("row");
    journal->write("row");
    EXPECT_FALSE(journal->is_lost());
  }
  EXPECT_EQ(content_of(copy), before);
  const std::vector<Json> lines = read_journal(file, false).lines;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(*lines[1].find("n"), Json(2));
  EXPECT_EQ(std::filesystem::hard_link_count(file), 1U);
}

TEST_F(JournalTest, WhatIsNoJournalIsNotTakenUp) {
  EXPECT_NE(error_of([&] { Journal::again(folder / "none.jsonl"); }), "");
  std::ofstream(folder / "j.jsonl") << "{\"n\":2,\"event\":\"x\"}\n";
  EXPECT_NE(error_of([&] { Journal::again(folder / "j.jsonl"); }).find("has a wrong number"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::journal_test
