// SPDX-License-Identifier: GPL-3.0-or-later
// Common mistakes: bare numbers in another unit, values of another type. Errors name the line and a cure.

#include "tests/bindings/lua_test.hpp"
#include "tests/support/warnings.hpp"

namespace asperity::lua::answers_test {
namespace {

class Answers : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(run("al = lab.material 'Al-2011'\n"
                  "s = lab.surface.sine{ cells=32, size='1 mm', amplitude='1 um', material=al }\n"
                  "function contact(t)\n"
                  "  return lab.contact{ lower=t and t.lower or s, upper=t and t.upper or lab.rigid,\n"
                  "    boundary='periodic', effects={ elasticity='half_space' } }\nend"),
              "");
  }
  std::string warned(const std::string& code) {
    test::Warnings monitor;
    const Session::Reporting reporting(session, monitor);
    EXPECT_EQ(run(code), "") << code;
    std::string text;
    for (const std::string& sentence : monitor.all) text += sentence + "\n";
    return text;
  }
  void refuses(const std::string& code, const std::string& part) {
    const std::string error = run(code);
    EXPECT_NE(error.find(part), std::string::npos) << code << "\n" << error;
    EXPECT_EQ(error.rfind("script.lua:", 0), 0u) << error;
  }
  void warns(const std::string& code, const std::string& part) {
    const std::string text = warned(code);
    EXPECT_NE(text.find(part), std::string::npos) << code << "\n" << text;
  }
};

TEST_F(Answers, BareNumbersOfAnotherUnitAreAnswered) {
  warns("local x = s:rotated(45)", "script.lua:1: `angle` is 45 rad, over a whole turn");
  warns("contact{ upper=s }:rotate(90 * math.pi)", "write \"282.743 deg\"");
  warns("lab.material{ young=70, poisson=0.3 }", "`young` is 70 Pa, softer than any solid");
  warns("lab.material{ hardness=1.1 }", "write \"1.1 GPa\"");
  warns("lab.material{ hardness=1100 }", "write \"1100 MPa\"");
  warns("lab.stylus{ tip=2 }", "write \"2 um\"");
  warns("contact{ upper=lab.rigid }:press{ pressure=50 }", "write \"50 MPa\", or \"50 Pa\"");
  warns("lab.friction{ tau0=500, alpha=0.2 }", "write \"500 MPa\", or \"500 Pa\"");
  refuses(
      "local law = lab.friction{ tau0=1, alpha=0.2 }\n"
      "lab.tilt_stage{ contact=lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity='box' } },\n"
      "  friction=law, mass='4 g', step=1 }:raise{ repeats=1 }",
      "above the angle of slip");
  for (const char* right : {"local x = s:rotated(math.pi / 2)", "local x = s:rotated '45 deg'",
                            "local x = s:rotated(2 * math.pi)", "lab.material{ young=70e9, poisson=0.3 }",
                            "lab.material{ young=1, poisson=0 }", "lab.friction{ tau0=499.5, alpha=0.2 }",
                            "lab.material{ young='70 Pa', poisson=0.3 }"})
    EXPECT_EQ(warned(right), "") << right;
}

TEST_F(Answers, ValuesOfAnotherKindAreConvertedOrRefused) {
  refuses("lab.material(nil)", "lab.material was given nothing (nil)");
  refuses("lab.material()", "lab.material was given nothing (nil)");
  refuses("lab.surface.from_table{ size=1, heights={ 1, 2, 3 } }",
          "`heights` must be rows of numbers, heights[j+1][i+1], and its first element is the number 1");
  refuses("lab.surface.from_table{ size=1, heights={ {} } }", "its first row is empty");
  EXPECT_EQ(run("book = lab.notebook 'b13'\n"
                "book:write{ ['z [um]']='1 mm', p='2 MPa', name='worn' }\n"
                "book:write{ z='0.5 um', p='3 kPa', ['name']='2nd' }"),
            "");
  EXPECT_TRUE(
      holds("(function() local a, b = table.unpack(book:rows())\n"
            "return a.z == 1e-3 and a.p == 2e6 and a.name == 'worn' and b.z == 0.5e-6 and b.p == 3000 "
            "and b.name == '2nd' end)()"));
  refuses("book:write{ ['z [um]']='1 MPa' }",
          "column `z`: \"1 MPa\": a pressure where a number in um is wanted");
  refuses("book:write{ z='5' }", "column `z`: \"5\"");
  EXPECT_EQ(run("book:write{ z='missing' }"), "");
}

TEST_F(Answers, ExpectationsCountInTheUnitOfTheColumn) {
  EXPECT_EQ(run("book = lab.notebook 'b6' book:write{ ['p [MPa]']=10 }"), "");
  EXPECT_TRUE(holds("book:expect('p', { near='10 MPa', rel=0.1 })"));
  EXPECT_TRUE(holds("book:expect('p', { at_least='5 MPa' })"));
  EXPECT_FALSE(holds("book:expect('p', { at_most='5 MPa' })"));
  refuses("book:expect('p', { near='10 N', rel=0.1 })", "`near` is \"10 N\", which is a force");
}

TEST_F(Answers, EveryErrorNamesTheLineOfTheScript) {
  refuses("local ok, message = pcall(os.execute, 'ls') error(message, 0)", "os.execute is not available");
  refuses("local ok, message = pcall(io.lines, 'nosuch') error(message, 0)", "nosuch");
  refuses("local ok, message = pcall(dofile, 'nosuch.lua') error(message, 0)", "cannot open nosuch.lua");
  refuses("\nio.lines 'nosuch'", "script.lua:2: ");
  refuses("for k, v in pairs(s) do end", "a surface is no table; help \"Surface\" lists its fields");
  refuses("local x = '1 um' + 1", "where a quantity is a plain SI number");
  refuses("local x = 2 * '1 um'", "the string \"1 um\" was used in arithmetic");
  EXPECT_EQ(value("'10' + 1"), "11");
  refuses("lab.material{ hardness='100 HB' }",
          "`HB` is a scale of hardness, and hardness is a pressure; write HB x 9.807 MPa");
}

TEST_F(Answers, NumbersInStringsFollowOneRule) {
  EXPECT_EQ(value("lab.surface.sine{ cells='64', size='1 mm', amplitude='1 um' }.cells[1]"), "64");
  refuses("lab.surface.sine{ cells='64 um', size='1 mm', amplitude='1 um' }",
          "a length where a plain number is wanted");
  refuses("lab.surface.sine{ cells='6.5', size='1 mm', amplitude='1 um' }",
          "`cells` is \"6.5\"; give a whole");
}

TEST_F(Answers, AContactMayBeClosedTwiceAndNotInsideItsSweep) {
  EXPECT_EQ(run("local c = contact() c:close() c:close()"), "");
  refuses("local c = contact() c:close() c:press{ pressure=1 }", "a contact was used after it was closed");
  refuses("local c = contact() for st in c:sweep{ pressure={ 1e5, 2e5 } } do c:close() end",
          "the contact of the sweep was closed inside its loop");
  refuses("contact():sweep{ pressure={} }", "`pressure` is an empty list");
}

TEST_F(Answers, CallsThatChangeNothingSaySo) {
  warns("contact():place{ seed=2 }", "contact:place: placing a flat upper body changes nothing");
  warns("contact():rotate '90 deg'", "contact:rotate: turning a flat upper body changes nothing");
  EXPECT_EQ(warned("contact{ upper=s }:place{ seed=2 }"), "");
  warns("s:profile{ row=0 }:filtered{ long_wave='10 mm' }",
        "the length is 1 mm: little more than the mean is removed");
  warns("s:filtered{ short_wave='1 nm' }", "carry no wave so short");
  EXPECT_EQ(warned("s:filtered{ short_wave='80 um', long_wave='0.8 mm' }"), "");
}

TEST_F(Answers, AStylusOfASpeedAsksForTheRate) {
  refuses("lab.stylus{ speed='1 mm/s' }", "`speed` is given without `rate`");
  EXPECT_EQ(run("lab.stylus{ speed='1 mm/s', rate='1 kHz' } lab.stylus{ speed='1 mm/s', spacing='1 um' }"),
            "");
}

TEST_F(Answers, AStateThatIsPrintedSaysWhatItIsToBeDoubtedFor) {
  const auto printed = [&](const std::string& lower, const std::string& pressure) {
    return value("contact{ lower=" + lower + " }:press{ pressure='" + pressure + "' }");
  };
  EXPECT_EQ(printed("s", "1 kPa").find("warning"), std::string::npos);
  EXPECT_NE(printed("s", "500 GPa").find("warning: the mean pressure is"), std::string::npos);
  EXPECT_NE(printed("s", "500 GPa").find("warning: the peak pressure is"), std::string::npos);
  EXPECT_NE(
      printed("s:scaled{ amplitude='10 mm' }", "1 kPa").find("warning: the combined heights have an rms"),
      std::string::npos);
  EXPECT_EQ(value("(function() local c = contact() local st = c:press{ pressure='1 kPa' } c:close() "
                  "return tostring(st) end)()")
                .find("error"),
            std::string::npos);
}

TEST_F(Answers, FrictionOfAStateAndTheTiltStageReportItsLimits) {
  const std::string hard = "the peak pressure is";
  EXPECT_EQ(run("law = lab.friction{ tau0='5 MPa', alpha=0.1 }\n"
                "stage = lab.tilt_stage{ contact=contact(), friction=law, mass='4.3 g' }"),
            "");
  warns("law:on(contact():press{ pressure='500 GPa' })", "script.lua:1: law:on: the mean pressure is");
  warns("law:on(contact():press{ pressure='500 GPa' })", "script.lua:1: law:on: " + hard);
  EXPECT_EQ(warned("law:on(contact():press{ pressure='1 MPa' })"), "");
  const std::string heavy =
      "lab.tilt_stage{ contact=contact(), friction=law, mass='2000 kg' }:raise{ repeats=2 }";
  warns("print(" + heavy + ")", "tilt stage: " + hard);
  EXPECT_NE(value(heavy + ".note").find(hard), std::string::npos);
  EXPECT_EQ(value("#contact():press{ pressure='1 MPa' }.warnings"), "0");
  EXPECT_NE(value("contact():press{ pressure='500 GPa' }.warnings[2]").find(hard), std::string::npos);
}

TEST_F(Answers, NamesStandAlongXAndNotUp) {
  EXPECT_EQ(run("book = lab.notebook 'grits' book:write{ grit='P80', Ra=1 } book:write{ grit='P120', Ra=2 }"),
            "");
  EXPECT_EQ(run("book:chart{ x='grit', y='Ra' }"), "");
  refuses("book:chart{ x='Ra', y='grit' }", "`grit` holds names, such as \"P80\"; names can only be along x");
}

// The last height continues in the first.
TEST_F(Answers, APeriodicFunctionHasNoStepAtTheRim) {
  const std::string surface =
      "lab.surface.from_function{ cells=32, size=1e-3, material=al, height=function(x, y) return ";
  EXPECT_EQ(warned("contact{ lower=" + surface +
                   "1e-6 * math.cos(2e3 * math.pi * x) * math.sin(2e3 * math.pi * y) end } }:press{ "
                   "pressure=1e6 }"),
            "");
  warns("contact{ lower=" + surface + "1e-3 * x end } }:press{ pressure=1e6 }", "continue across the rim");
  warns("contact{ lower=" + surface + "1e-6 * math.cos(3e3 * math.pi * y) end } }:press{ pressure=1e6 }",
        "continue across the rim");
}

// Names may contain digits.
TEST_F(Answers, ArgumentsMayHaveDigitsInTheirNames) {
  EXPECT_EQ(value("require 'asperity.arguments'({ H1=1, x_2=3 }, 'H1=2', 'x_2=4').H1"), "2");
  EXPECT_NE(run("require 'asperity.arguments'({ H1=1 }, '1H=2')").find("is no argument of this script"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::lua::answers_test
