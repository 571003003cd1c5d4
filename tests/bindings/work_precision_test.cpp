// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::work_precision_test {
namespace {

class PartsMonitor final : public Monitor {
 public:
  void progress(std::string_view what, double) override { titles.emplace_back(what); }
  void progress_of_parts(std::string_view what, double done, std::string_view part, double) override {
    titles.emplace_back(what);
    parts.emplace_back(part);
    last_done = done;
  }
  void warn(std::string_view) override {}
  void inform(std::string_view sentence) override { sentences.emplace_back(sentence); }
  std::vector<std::string> titles, parts, sentences;
  double last_done = 0;
};

class WorkPrecisionTest : public LuaTest {
 protected:
  testing::AssertionResult refuses(const std::string& code, const std::string& part) {
    const std::string text = run(code);
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "\"" << text << "\" does not hold \"" << part << "\"";
  }
  void make_study(const std::string& more = "truth=1, repeats=2") {
    ASSERT_EQ(
        run("calls = 0 study = lab.work_precision{ ask=function(k) calls = calls + 1 return 1 + 1/k.n end, "
            "try={ { name=\"terms\", n={ 2, 4, 8 } } }, " +
            more + " }"),
        "");
  }
  static long count(const std::string& text, const std::string& part) {
    long found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  }
};

TEST_F(WorkPrecisionTest, AsksOnceAndThenAsOftenAsItTimes) {
  make_study();
  EXPECT_TRUE(holds("calls == 3 * (1 + 2) and study.calls == calls"));
  EXPECT_TRUE(holds("study.truth == 1 and study.truth_seconds == 0 and study.relative"));
  EXPECT_TRUE(holds("study.seconds > 0 and study.overhead >= 0"));
  make_study("truth={ n=1000 }, repeats=3");
  EXPECT_TRUE(holds("calls == 1 + 3 * (1 + 3) and study.truth == 1 + 1/1000"));
}

TEST_F(WorkPrecisionTest, RowsHaveTheKnobsAndWhatCameOfThem) {
  make_study();
  EXPECT_EQ(run("rows = study:rows() row = rows[2]"), "");
  EXPECT_TRUE(holds("#rows == 3 and row.way == 'terms' and row.n == 4 and math.type(row.n) == 'integer'"));
  EXPECT_TRUE(holds("row.value == 1.25 and row.error == 0.25 and row.absolute_error == 0.25"));
  EXPECT_TRUE(
      holds("row.runs == 2 and row.steady and not row.failed and not row.left_out and row.reason == nil"));
  EXPECT_TRUE(holds("row.seconds_low <= row.seconds and row.seconds <= row.seconds_high"));
  EXPECT_TRUE(holds("rows[3].pareto"));
}

TEST_F(WorkPrecisionTest, KnobsReachTheFunctionAsTheyAreWritten) {
  EXPECT_EQ(
      run("seen = {} lab.work_precision{ repeats=1, truth=1, ask=function(k) seen[#seen+1] = k return 1 end, "
          "try={ { name='a', model='box', exact=true, x=1.5, n={1, 2} } } }"),
      "");
  EXPECT_TRUE(
      holds("seen[1].model == 'box' and seen[1].exact == true and seen[1].x == 1.5 and seen[1].n == 1"));
  EXPECT_TRUE(holds("seen[1].name == nil"));
}

TEST_F(WorkPrecisionTest, AnErrorAndNoAnswerAreFailedRows) {
  EXPECT_EQ(run("study = lab.work_precision{ truth=1, repeats=1, try={ { name='a', n={1, 2, 3} } }, "
                "ask=function(k) if k.n == 1 then error('too coarse') end "
                "if k.n == 2 then return nil, 'not carried' end return 1.5 end } rows = study:rows()"),
            "");
  EXPECT_TRUE(holds("rows[1].failed and rows[1].reason:find('too coarse', 1, true) ~= nil"));
  EXPECT_TRUE(holds("rows[2].failed and rows[2].reason == 'not carried' and rows[2].error == nil"));
  EXPECT_TRUE(holds("not rows[3].failed and rows[3].error == 0.5"));
  EXPECT_TRUE(holds("tostring(study):find('failed', 1, true) ~= nil"));
}

TEST_F(WorkPrecisionTest, RefusesAnAnswerThatIsNoNumber) {
  const std::string head = "lab.work_precision{ truth=1, try={ { name='a', n=1 } }, ask=function() return ";
  EXPECT_TRUE(refuses(head + "{ 1, 2 } end }", "`ask` returned a list of 2 for { n=1 }; return one number"));
  EXPECT_TRUE(refuses(head + "'1' end }", "`ask` returned the string \"1\""));
  EXPECT_TRUE(refuses(head + "true end }", "`ask` returned the boolean true"));
  EXPECT_TRUE(refuses(head + "lab.rigid end }", "`ask` returned a material"));
}

TEST_F(WorkPrecisionTest, RefusesWrongKeys) {
  const std::string ask = "ask=function() return 1 end";
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, tri={} }", "did you mean `try`?"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", try={ { name='a' } } }", "`truth` is missing"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, try={} }",
                      "`try` is an empty table; give a list of ways"));
  EXPECT_TRUE(
      refuses("lab.work_precision{ " + ask + ", truth=1, try={ { n=1 } } }", "`try[1]` has no `name`"));
  EXPECT_TRUE(
      refuses("lab.work_precision{ " + ask + ", truth=1, try={ { name='a', n={1, 2}, m={1, 2, 3} } } }",
              "the way `a` lists 3 values of `m` and 2 of `n`"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, try={ { name='a', n={ {1, 2} } } } }",
                      "`try[1].n[1]` is a list of 2; give a number, a string or a boolean"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, try={ { name='a', n={ x=1 } } } }",
                      "`try[1].n` is not a list"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, try={ { name='a', seconds=1 } } }",
                      "the rows of a study have a column of that name"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, repeats=0, try={ { name='a' } } }",
                      "`repeats` is 0; give a whole number from 1"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=1, at_most='3 kg', try={ { name='a' } } }",
                      "`at_most`"));
  EXPECT_TRUE(refuses("lab.work_precision{ " + ask + ", truth=0/0, try={ { name='a' } } }", "`truth` is "));
}

TEST_F(WorkPrecisionTest, TheTruthMayBeAQuantity) {
  make_study("truth='1.5 m', repeats=1");
  EXPECT_TRUE(holds("study.truth == 1.5"));
}

TEST_F(WorkPrecisionTest, TheCheapestSettingCanBePasted) {
  make_study();
  EXPECT_EQ(run("best = study:cheapest{ error=0.2 }"), "");
  EXPECT_TRUE(
      holds("best.knobs.n == 8 and best.way == 'terms' and best.error == 0.125 and best.seconds > 0"));
  EXPECT_EQ(value("best"), "{ n=8 }");
  EXPECT_TRUE(holds("load('return ' .. tostring(best))().n == 8"));
  EXPECT_TRUE(refuses("study:cheapest{ error=0.01 }", "the best reached is 12.5 %, by terms { n=8 }"));
  EXPECT_TRUE(refuses("study:cheapest{ eror=0.01 }", "did you mean `error`?"));
}

TEST_F(WorkPrecisionTest, IsKeptInTheRunDirectory) {
  make_study();
  make_study("truth={ n=16 }, repeats=1");
  const std::string journal = content_of(run_folder() / "journal.jsonl");
  EXPECT_EQ(count(journal, "\"event\":\"study\""), 2);
  EXPECT_EQ(count(journal, "\"event\":\"study run\""), 3 * 3 + 1 + 3 * 2);
  EXPECT_EQ(count(journal, "\"event\":\"study end\""), 2);
  EXPECT_NE(journal.find("\"knobs\":{\"n\":8},\"round\":2,\"value\":1.125"), std::string::npos);
  const std::string csv = content_of(run_folder() / "work_precision.csv");
  EXPECT_EQ(csv.find("way,n,end,value,error"), 0U);
  EXPECT_NE(csv.find("\nterms,8,measured,1.125,0.125"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(run_folder() / "work_precision-2.csv"));
}

TEST_F(WorkPrecisionTest, DrawsItsChart) {
  make_study();
  EXPECT_EQ(run("file = study:chart 'cost.svg'"), "");
  EXPECT_NE(content_of(run_folder() / "cost.svg").find("<svg"), std::string::npos);
  EXPECT_TRUE(refuses("study:chart 'cost.gif'", "pictures are .svg, .png or .pdf"));
}

TEST_F(WorkPrecisionTest, NativeWorkReportsAsAPartOfTheStudy) {
  PartsMonitor monitor;
  const Session::Reporting reporting(session, monitor);
  EXPECT_EQ(run("lab.work_precision{ truth=1, repeats=1, try={ { name='grid', cells={ 256, 512 } } }, "
                "ask=function(k) "
                "return lab.surface.weierstrass_mandelbrot{ cells=k.cells, D=2.5 }:roughness().Ra end }"),
            "");
  EXPECT_EQ(std::count(monitor.titles.begin(), monitor.titles.end(), "work and precision"),
            static_cast<std::ptrdiff_t>(monitor.titles.size()));
  ASSERT_FALSE(monitor.parts.empty());
  EXPECT_EQ(monitor.parts[0], "grid { cells=256 }");
  ASSERT_EQ(monitor.sentences.size(), 1U);
  EXPECT_EQ(monitor.sentences[0].find(
                "work and precision: 2 settings, each timed 1 time after a first run: about "),
            0U);
}

TEST_F(WorkPrecisionTest, AStopKeepsTheRowsThatThereAre) {
  lua_pushcfunction(L, [](lua_State* s) {
    stop_flag().raise(StopReason::interrupt);
    return luaL_error(s, "interrupted");
  });
  lua_setglobal(L, "stop");
  EXPECT_TRUE(refuses(
      "n = 0 lab.work_precision{ name='stopped', truth=1, repeats=9, try={ { name='a', n={ 1, 2 } } }, "
      "ask=function(k) n = n + 1 if n == 6 then stop() end return 1 + 1/k.n end }",
      "interrupted"));
  stop_flag().clear();
  const std::string csv = content_of(run_folder() / "stopped.csv");
  EXPECT_NE(csv.find("a,1,measured,2,1,"), std::string::npos);
  EXPECT_NE(csv.find("a,2,measured,1.5,0.5,"), std::string::npos);
  EXPECT_NE(content_of(run_folder() / "journal.jsonl").find("\"complete\":false"), std::string::npos);
}

TEST_F(WorkPrecisionTest, ADryRunAsksOnce) {
  open_dry();
  EXPECT_EQ(run("calls = 0 study = lab.work_precision{ truth={ n=9 }, try={ { name='a', n={ 4, 8 } } }, "
                "ask=function(k) calls = calls + 1 return lab.surface.sine{ cells=k.n, size=1, amplitude=1 }"
                ":roughness().Ra end } best = study:cheapest{ error=0.1 } print(best.knobs, "
                "study:rows()[1].error)"),
            "");
  EXPECT_TRUE(holds("calls == 1"));
  EXPECT_TRUE(
      refuses("lab.work_precision{ truth=1, try={ { name='a', n=1 } }, ask=function(k) return "
              "lab.surface.sin{ cells=k.n } end }",
              "did you mean `sine`?"));
  EXPECT_TRUE(refuses("study:cheapest{ eror=0.1 }", "did you mean `error`?"));
  EXPECT_TRUE(refuses("study:cheapst{ error=0.1 }", "did you mean `cheapest`?"));
}

TEST_F(WorkPrecisionTest, ACaseOfAnEnsembleTimesNothing) {
  EXPECT_TRUE(refuses(
      "lab.ensemble{ over={ n={ 1 } }, run=function() lab.work_precision{ truth=1, ask=function() "
      "return 1 end, try={ { name='a' } } } end }",
      "a case of an ensemble cannot measure the times of a study: other cases run at the same time; go over "
      "the cases in a `for` loop, one study after the other"));
}

}  // namespace
}  // namespace asperity::lua::work_precision_test
