// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bindings/lua_test.hpp"

#include "engine/core/error.hpp"
#include "engine/run/result_files.hpp"

namespace asperity::lua::knob_test {
namespace {

constexpr const char* pressure =
    "lab.knob{ name='pressure', from='1 MPa', to='200 MPa', value='20 MPa', log=true }";

class KnobTest : public LuaTest {
 protected:
  void give(const GivenKnobs& given) { session.knobs = std::make_shared<RunKnobs>(given); }
  std::string refusal(const std::string& keys) { return run("lab.knob{ " + keys + " }"); }
};

TEST_F(KnobTest, GivesItsValueInSiUnits) {
  EXPECT_EQ(value(pressure), "20000000.0");
  EXPECT_EQ(value("lab.knob{ name='n', from=1, to=9, value=3 }"), "3.0");
  EXPECT_EQ(value("lab.knob{ name='depth', from=0, to='1 mm', value='20 um' }"), "2e-05");
}

TEST_F(KnobTest, TakesWhatWasGiven) {
  give({{"pressure", "50 MPa"}, {"n", "4.5"}});
  EXPECT_TRUE(holds(std::string(pressure) + " == 50e6"));
  EXPECT_TRUE(holds("lab.knob{ name='n', from=1, to=9, value=3 } == 4.5"));
  session.knobs->check_all_made();
}

TEST_F(KnobTest, TakesTheBoundsThemselvesAndNothingPastThem) {
  give({{"n", "9"}});
  EXPECT_TRUE(holds("lab.knob{ name='n', from=1, to=9, value=1 } == 9"));
  give({{"n", "9.000000000000002"}});
  EXPECT_EQ(
      refusal("name='n', from=1, to=9, value=1"),
      "script.lua:1: lab.knob: the knob `n` is given as `9.000000000000002`, out of its bounds; give 1 to 9");
}

TEST_F(KnobTest, APlainNumberThatIsGivenIsSi) {
  give({{"pressure", "5e7"}});
  EXPECT_TRUE(holds(std::string(pressure) + " == 50e6"));
}

TEST_F(KnobTest, RefusesAnotherKindThanItsOwn) {
  give({{"pressure", "5 um"}, {"n", "3 um"}});
  EXPECT_EQ(run(pressure),
            "script.lua:1: lab.knob: the knob `pressure` is given as `5 um`, a length, and it is a pressure; "
            "give 1 MPa to 200 MPa");
  EXPECT_EQ(
      refusal("name='n', from=1, to=9, value=1"),
      "script.lua:1: lab.knob: the knob `n` is given as `3 um`, a length, and it is a plain number; give 1 "
      "to 9");
}

TEST_F(KnobTest, RefusesKeysThatMakeNoKnob) {
  EXPECT_EQ(refusal("name='n', from=1, to='2 mm', value='1 MPa'"),
            "script.lua:1: lab.knob: `value` is `1 MPa`, a pressure, and `to` is `2 mm`, a length; give "
            "quantities of one kind");
  EXPECT_EQ(refusal("name='n', from=2, to=1, value=1"),
            "script.lua:1: lab.knob: `from` is 2 and `to` is 1; give the lower bound first, and another one "
            "above it");
  EXPECT_EQ(refusal("name='n', from=1, to=2, value=3"),
            "script.lua:1: lab.knob: `value` is 3; give one from 1 to 2");
  EXPECT_EQ(refusal("name='n', from=0, to=2, value=1, log=true"),
            "script.lua:1: lab.knob: `from` is 0 with log=true; give `from` above 0, or leave `log` out");
  EXPECT_NE(refusal("name='', from=0, to=2, value=1"), "");
  EXPECT_NE(refusal("name='a=b', from=0, to=2, value=1"), "");
  EXPECT_NE(refusal("name='n', from=0, to=math.huge, value=1"), "");
  EXPECT_NE(refusal("name='n', from=0, to=1, value=0/0"), "");
  EXPECT_EQ(refusal("nam='n', from=0, to=2, value=1").find("did you mean `name`?") == std::string::npos,
            false);
}

TEST_F(KnobTest, AskedForAgainIsTheSameOne) {
  EXPECT_EQ(run(std::string("for k = 1, 3 do assert(") + pressure + " == 20e6) end"), "");
  EXPECT_EQ(session.knobs->made().size(), 1U);
  EXPECT_EQ(
      refusal("name='pressure', from='1 MPa', to='100 MPa', value='20 MPa'"),
      "script.lua:1: lab.knob: the knob `pressure` was made before with other keys: 1 MPa to 200 MPa, 20 "
      "MPa, log, and now 1 MPa to 100 MPa, 20 MPa; make it once and use its value, or give the other one "
      "another name");
}

TEST_F(KnobTest, OneThatWasGivenAndNotMadeIsAnError) {
  give({{"presure", "5 MPa"}});
  EXPECT_EQ(run(pressure), "");
  try {
    session.knobs->check_all_made();
    FAIL() << "it was passed over";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "the knob `presure` was set, and the script makes no such knob (did you mean `pressure`?); "
                 "its knobs are pressure (1 MPa to 200 MPa)");
  }
}

TEST_F(KnobTest, OfALineThatFailedMayBeMadeOtherwise) {
  ASSERT_EQ(
      run("a = lab.knob{ name='a', from=0, to=1, value=1 } b = lab.knob{ name='b', from=0, to=1, value=1 }"),
      "");
  session.knobs->keep_first(1);
  EXPECT_EQ(run("b = lab.knob{ name='b', from=0, to=2, value=2 }"), "");
  EXPECT_NE(refusal("name='a', from=0, to=2, value=1"), "");
}

TEST_F(KnobTest, OfADryRunMayHangOnAResultItDoesNotKnow) {
  open_dry();
  give({{"n", "0.5"}});
  EXPECT_EQ(
      run("local s = lab.surface.self_affine{ cells=8, size=1, hurst=0.8, rms_height=1, short_wave=0.5 }\n"
          "local n = lab.knob{ name='n', from=0, to=1, value=s:roughness().Ra }\n"
          "local twice = 2 * n"),
      "");
  session.knobs->check_all_made();
}

TEST_F(KnobTest, IsMovedByNoScript) {
  EXPECT_NE(run(std::string(pressure) + " lab.knob.set('pressure', '5 MPa')").find("does not move its knobs"),
            std::string::npos);
}

TEST_F(KnobTest, IsReadByTheCasesOfAnEnsemble) {
  give({{"n", "7"}});
  EXPECT_TRUE(
      holds("lab.ensemble{ over={ k={1, 2} }, run=function(case) return { v = case.k * lab.knob{ name='n', "
            "from=1, to=9, value=3 } } end }[2].v == 14"));
  session.knobs->check_all_made();
}

class StoreMonitor final : public Monitor {
 public:
  explicit StoreMonitor(ResultStore& store) : store_(store) {}
  void progress(std::string_view, double) override {}
  void warn(std::string_view) override {}
  ResultStore* results() override { return &store_; }

 private:
  ResultStore& store_;
};

TEST_F(KnobTest, AKeptCaseHoldsForTheKnobsItAskedForAlone) {
  ResultMemory store(1 << 24);
  StoreMonitor monitor(store);
  const Session::Reporting reporting(session, monitor);
  const std::string asks = "return { v = case.k * lab.knob{ name='n', from=1, to=9, value=3 } } end }[1].v";
  const std::string asks_nothing = "return { v = case.k * 2 } end }[1].v";
  const auto ensemble = [&](const std::string& body) {
    return value("lab.ensemble{ over={ k={1} }, run=function(case) " + body);
  };
  EXPECT_EQ(ensemble(asks), "3.0");
  EXPECT_EQ(ensemble(asks_nothing), "2");
  EXPECT_EQ(store.counts().found, 0);
  give({{"n", "5"}});
  EXPECT_EQ(ensemble(asks), "5.0");
  EXPECT_EQ(store.counts().found, 0);
  EXPECT_EQ(ensemble(asks_nothing), "2");
  EXPECT_EQ(store.counts().found, 1);
  // A stored case has made its knobs too.
  give({{"n", "5"}});
  EXPECT_EQ(ensemble(asks), "5.0");
  EXPECT_EQ(store.counts().found, 2);
  session.knobs->check_all_made();
}

TEST_F(KnobTest, IsRecordedWithItsBounds) {
  give({{"pressure", "50 MPa"}});
  ASSERT_EQ(run(pressure), "");
  session.run->finish(RunStatus::done);
  const std::string manifest = content_of(run_folder() / "manifest.json");
  const Json json = Json::parse(manifest, "the manifest");
  const Json* knobs = json.find("knobs");
  ASSERT_NE(knobs, nullptr);
  EXPECT_EQ(knobs->text(),
            "{\"pressure\":{\"value\":50000000.0,\"from\":1000000.0,\"to\":200000000.0,\"log\":true,"
            "\"unit\":\"Pa\"}}");
  EXPECT_EQ(given_knobs(*knobs), (GivenKnobs{{"pressure", "5e+07"}}));
}

TEST(GivenKnobTest, HasANameAndAQuantity) {
  GivenKnobs given;
  give_knob(given, "pressure", "\"50 MPa\"");
  give_knob(given, "n", "3");
  EXPECT_EQ(given, (GivenKnobs{{"n", "3"}, {"pressure", "50 MPa"}}));
  const auto refusal = [&](const std::string& name, const std::string& text) -> std::string {
    try {
      give_knob(given, name, text);
      return "no error";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal("n", "4"), "the knob `n` is given twice; leave one of them out");
  EXPECT_EQ(refusal("", "3"),
            "`` is no name of a knob; a name has at most 60 characters, without =, quotes and blanks at its "
            "ends");
  for (const char* bad : {"m=1", " m", "m\n", "\"m\""})
    EXPECT_NE(refusal(bad, "3").find("is no name of a knob"), std::string::npos) << bad;
  for (const char* bad : {"", "fast", "5 Mpp"}) {
    // Page and prompt have no command-line options.
    EXPECT_TRUE(refusal("m", bad).starts_with("the knob `m`: ")) << refusal("m", bad);
    EXPECT_EQ(refusal("m", bad).find("--"), std::string::npos) << refusal("m", bad);
  }
}

}  // namespace
}  // namespace asperity::lua::knob_test
