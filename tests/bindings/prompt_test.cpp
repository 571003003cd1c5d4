// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/prompt.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::prompt_test {
namespace {

class PromptTest : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    prompt.emplace(L);
  }
  void TearDown() override {
    prompt.reset();
    if (session.output != stdout) std::fclose(session.output);
    session.output = stdout;
    LuaTest::TearDown();
  }

  // The output of a line, "more", or "error: " and the message.
  std::string say(const std::string& line) {
    char* text = nullptr;
    std::size_t length = 0;
    session.output = open_memstream(&text, &length);
    const Prompt::Outcome outcome = prompt->take(line);
    std::fclose(session.output);
    session.output = stdout;
    const std::string shown(text, length);
    std::free(text);
    if (outcome == Prompt::Outcome::more) return "more";
    if (outcome == Prompt::Outcome::failed) return "error: " + prompt->error();
    return shown.ends_with("\n") ? shown.substr(0, shown.size() - 1) : shown;
  }

  std::optional<Prompt> prompt;
};

TEST_F(PromptTest, ShowsTheValueOfAnExpression) {
  EXPECT_EQ(say("1 + 1"), "2");
  EXPECT_EQ(say("0.1 ; "), "0.1");
  EXPECT_EQ(say("'a', nil"), "a  nil");
  EXPECT_EQ(say("return 7"), "7");
  EXPECT_EQ(say("x = 3"), "");
  EXPECT_EQ(say(""), "");
  EXPECT_EQ(say("-- nothing"), "");
  EXPECT_EQ(say("(function() end)()"), "");
  EXPECT_EQ(say("lab.surface.flat{ cells=4, size=1 }"), "surface 4 x 4 cells, 1 m x 1 m, peak to valley 0 m");
}

TEST_F(PromptTest, ListsItsVariables) {
  EXPECT_EQ(say("who()").find("nothing is on the bench"), 0U);
  say("s, n = lab.surface.flat{ cells=4, size=1 }, 3");
  const std::string list = "n  3\ns  surface 4 x 4 cells, 1 m x 1 m, peak to valley 0 m";
  EXPECT_EQ(say("who"), list);
  EXPECT_EQ(say(" who() "), list);
  EXPECT_EQ(prompt->script().find("who"), std::string::npos);
}

TEST_F(PromptTest, EndsByWord) {
  for (const char* line : {"exit", "quit", "exit()", " quit() ;"})
    EXPECT_EQ(prompt->take(line), Prompt::Outcome::end) << line;
  EXPECT_EQ(prompt->take("x = 'exit'"), Prompt::Outcome::done);
}

TEST_F(PromptTest, ShowsTablesOnOneLine) {
  EXPECT_EQ(say("{}"), "{}");
  EXPECT_EQ(say("{ 1, 2.5, 'x', b = true, a = { 1 } }"), "{ 1, 2.5, \"x\", a = { 1 }, b = true }");
  EXPECT_EQ(say("{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 }"),
            "{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, ... (11 in all) }");
  EXPECT_EQ(say("{ { { { 1, 2 } } } }"), "{ { { { 2 values } } } }");
  EXPECT_EQ(say("t = {} t.t = t"), "");
  EXPECT_EQ(say("t").find('\n'), std::string::npos);
  EXPECT_EQ(say("setmetatable({}, { __tostring = function() return 'mine' end })"), "mine");
}

TEST_F(PromptTest, TellsTheUnitOfAField) {
  say("s = lab.surface.sine{ cells=16, size='1 mm', amplitude='1 um' }");
  EXPECT_EQ(say("s.peak_to_valley"), "2 um (2e-06 m)");
  EXPECT_NE(say("s:scaled{ amplitude='3 um' }.peak_to_valley").find("3 um ("), std::string::npos);
  EXPECT_EQ(say("kit = { s = s, r = s:roughness() }"), "");
  EXPECT_EQ(say("kit.s.peak_to_valley"), "2 um (2e-06 m)");
  EXPECT_EQ(say("kit.r.amplitude"), "2 um (2e-06 m)");
  EXPECT_EQ(say("s:roughness().amplitude"), "2 um (2e-06 m)");
  EXPECT_EQ(say("s:roughness().kurtosis").find(" ("), std::string::npos);
  EXPECT_EQ(say("kit.r.nothing").find("error: prompt:1: a roughness result has no field `nothing`"), 0U);
  EXPECT_EQ(shown_quantity(3, dimension::length), "3 m");
}

TEST_F(PromptTest, WaitsUntilAStatementIsWhole) {
  EXPECT_EQ(say("for i = 1, 2 do"), "more");
  EXPECT_TRUE(prompt->continued());
  EXPECT_EQ(say(""), "more");
  EXPECT_EQ(say("end"), "");
  EXPECT_FALSE(prompt->continued());
  EXPECT_EQ(say("x = [["), "more");
  EXPECT_EQ(say("long]]"), "");
  EXPECT_EQ(say("x"), "long");
  EXPECT_EQ(say("lab.surface.flat{"), "more");
  prompt->forget();
  EXPECT_EQ(say("1"), "1");
  EXPECT_EQ(say("x = = 1"), "error: prompt:1: unexpected symbol near '='");
  EXPECT_EQ(say("1"), "1");
}

TEST_F(PromptTest, WhatLocalDeclaresStays) {
  EXPECT_EQ(say("local a, b <const> = 1, 2"), "");
  EXPECT_EQ(say("a, b"), "1  2");
  EXPECT_EQ(say("local function f(n) if n == 0 then return 'end' end return f(n - 1) end"), "");
  EXPECT_EQ(say("f(3)"), "end");
  EXPECT_EQ(say("do local inside = 1 end"), "");
  EXPECT_EQ(say("inside").find("error: "), 0U);
  EXPECT_EQ(with_lasting_locals("local x, y print(x)"), "      x, y = nil print(x)");
  EXPECT_EQ(with_lasting_locals("f(function() local x = 1 end)"), "f(function() local x = 1 end)");
  EXPECT_EQ(with_lasting_locals("s = 'local x'"), "s = 'local x'");
}

TEST_F(PromptTest, ALineThatFailsLeavesEveryVariableAsItWas) {
  say("x = 1");
  EXPECT_EQ(say("x = 2; y = 3; x = nil; error('on purpose', 0)"), "error: on purpose");
  EXPECT_EQ(say("x"), "1");
  EXPECT_NE(say("y").find("was never set"), std::string::npos);
  say("function deep() error 'inside' end");
  EXPECT_NE(say("deep()").find("in function 'deep'"), std::string::npos);
  EXPECT_EQ(say("error 'bare'"), "error: prompt:1: bare");
}

TEST_F(PromptTest, KeepsWhatWentWellAsAScript) {
  say("local s = 1 -- a comment");
  say("s + 1 -- shown");
  say("broken(");
  prompt->forget();
  say("error 'no'");
  say("help 'sine'");
  say("tostring(s)");
  EXPECT_EQ(prompt->script(),
            "lab = require \"asperity\"\ns = 1\nprint(s + 1)\n-- help 'sine'\ntostring(s)\n");
  EXPECT_EQ(run(prompt->script()), "");
}

TEST_F(PromptTest, CompletesWithWhatLives) {
  EXPECT_EQ(say("s = lab.surface.sine{ cells=8, size=1, amplitude=0.1, material=lab.material 'Al-2011' }"),
            "");
  EXPECT_EQ(say("bench = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity='box' } }"), "");
  const auto first = [&](const std::string& line) {
    const Completion found = prompt->complete(line, line.size());
    return found.candidates.empty() ? "" : line.substr(0, found.from) + found.candidates.front().text;
  };
  EXPECT_EQ(first("bench:pre"), "bench:press");
  EXPECT_EQ(first("ben"), "bench");
  EXPECT_EQ(say("bench:press{"), "more");
  EXPECT_EQ(first("pressu"), "pressure");
}

}  // namespace
}  // namespace asperity::lua::prompt_test
