// SPDX-License-Identifier: GPL-3.0-or-later
// A `|` in the scripts is the cursor.
#include "bindings/lua/editor/completion.hpp"

#include <algorithm>

#include "bindings/lua/surface/surface.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::completion_test {
namespace {

Completion at_bar(std::string script, const std::vector<LiveGlobal>& live = {}) {
  const std::size_t bar = script.find('|');
  script.erase(bar, 1);
  return complete(script, bar, live);
}

std::vector<std::string> texts(const std::string& script, const std::vector<LiveGlobal>& live = {}) {
  std::vector<std::string> names;
  for (const Candidate& c : at_bar(script, live).candidates) names.push_back(c.text);
  return names;
}

bool offers(const std::string& script, const std::string& text) {
  const std::vector<std::string> all = texts(script);
  return std::find(all.begin(), all.end(), text) != all.end();
}

Candidate found(const std::string& script, const std::string& text) {
  for (const Candidate& c : at_bar(script).candidates)
    if (c.text == text) return c;
  return {};
}

using Names = std::vector<std::string>;

TEST(Completion, OfAModuleGivesWhatTheRegistryHas) {
  const Names all = texts("local lab = require \"asperity\"\nlab.surface.|");
  EXPECT_EQ(all.size(), surface_module().functions.size());
  EXPECT_EQ(texts("lab.surface.weier|"), Names{"weierstrass_mandelbrot"});
  const Candidate flat = found("lab.surface.|", "flat");
  EXPECT_EQ(flat.kind, "method");
  EXPECT_EQ(flat.detail, "lab.surface.flat{ cells=, size=, material= }");
  EXPECT_FALSE(flat.help.empty());
  EXPECT_EQ(found("lab.|", "surface").kind, "module");
  EXPECT_EQ(found("lab.|", "rigid").kind, "value");
  EXPECT_TRUE(offers("local L = require('asperity')\nL.units.|", "um"));
}

TEST(Completion, OfAVariableGivesTheMethodsOfItsClass) {
  const std::string contact =
      "local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity=\"box\" } }\n";
  EXPECT_TRUE(offers(contact + "c:|", "press"));
  EXPECT_FALSE(offers(contact + "c:|", "roughness"));
  EXPECT_EQ(texts(contact + "c:pre|"), Names{"press"});
  EXPECT_TRUE(offers("c = lab.contact{}\nc:|", "press"));
  EXPECT_TRUE(offers("local a <const>, b <close> = 1, lab.contact{}\nb:|", "press"));
  EXPECT_TRUE(texts("local a, b = 1, lab.contact{}\na:|").empty());
  // Fields come before methods.
  const Candidate approach = found(contact + "local st = c:press{}\nst.|", "approach");
  EXPECT_EQ(approach.kind, "value");
  EXPECT_EQ(approach.detail, "number, m");
  EXPECT_FALSE(offers(contact + "local st = c:press{}\nst:|", "approach"));
}

TEST(Completion, FollowsChainsOfCallsToTheirEnd) {
  EXPECT_TRUE(offers("lab.surface.flat{ cells=4, size=1 }:rotated(\"37 deg\"):|", "roughness"));
  EXPECT_TRUE(offers("local s = (lab.surface.flat{})\ns:scaled{ rms=1 }:mirrored():|", "write"));
  EXPECT_TRUE(offers("local m = lab.material \"Al-2011\"\nm.|", "young"));
  EXPECT_TRUE(offers("lab.stylus{}:scan(s)[1]:|", "outline"));
  EXPECT_TRUE(offers("lab.materials[1].|", "hardness"));
  EXPECT_TRUE(offers("local s = given or lab.surface.flat{}\ns:|", "rotated"));
}

TEST(Completion, KnowsWhatOperatorsGive) {
  const std::string surfaces =
      "local lab = require \"asperity\"\nlocal a, b = lab.surface.flat{}, lab.surface.flat{}\n";
  for (const char* expression : {"a - b", "2 * (a + b) / 3", "-a", "b * 2", "a:levelled() - 0.5 * b"})
    EXPECT_TRUE(offers(surfaces + "local d = " + expression + "\nd:|", "roughness")) << expression;
  for (const char* expression : {"#a", "a.measured - b.measured", "not a"})
    EXPECT_FALSE(offers(surfaces + "local d = " + expression + "\nd:|", "roughness")) << expression;
}

TEST(Completion, KnowsWhatAForLoopTurnsThrough) {
  const std::string contact = "local c = lab.contact{}\n";
  EXPECT_TRUE(offers(contact + "for st in c:sweep{ pressure={1, 2} } do st.|", "area_fraction"));
  EXPECT_TRUE(offers("for event, st in lab.protocol{}:on(c) do print(st.|", "area_fraction"));
  EXPECT_TRUE(offers("for i, p in ipairs(lab.stylus{}:scan(s)) do p:|", "fractal_dimension"));
  EXPECT_EQ(found("for k = 1, 9 do |", "k").detail, "a number");
}

TEST(Completion, TheLastAssignmentInSightDecides) {
  EXPECT_TRUE(offers("local c = lab.contact{}\nc = lab.surface.flat{}\nc:|", "plus"));
  EXPECT_FALSE(offers("local c = lab.contact{}\nc = lab.surface.flat{}\nc:|", "press"));
  EXPECT_TRUE(offers("function kit.bench(s)\n  local c = lab.contact{ lower=s }\n  c:|", "press"));
  EXPECT_TRUE(texts("local s = lab.surface.flat{}\nlocal f = function(s) s:|").empty());
  EXPECT_TRUE(texts("local s = lab.surface.flat{}\nlocal s\ns:|").empty());
  EXPECT_TRUE(offers("local s = lab.surface.flat{}\ns.name = 1\ns:|", "plus"));
  EXPECT_TRUE(offers("local s = lab.surface.flat{}\nf{ s = 1 }\ns:|", "plus"));
  // A script's own tables and functions have no known type.
  EXPECT_TRUE(texts("local bodies = { lower = lab.surface.flat{} }\nbodies.|").empty());
  EXPECT_TRUE(texts("local function rough() return lab.surface.flat{} end\nrough():|").empty());
}

TEST(Completion, OffersTheKeysThatACallStillTakes) {
  const Names keys = texts("lab.contact{ |");
  EXPECT_EQ(keys, (Names{"lower", "upper", "boundary", "effects", "accuracy"}));
  EXPECT_EQ(texts("lab.contact{ lower=s, upper = lab.rigid, |"), (Names{"boundary", "effects", "accuracy"}));
  EXPECT_EQ(texts("lab.contact{ lower=s, |, accuracy={} }"), (Names{"upper", "boundary", "effects"}));
  EXPECT_EQ(texts("local c = lab.contact{}\nc:press{ pres|"), Names{"pressure"});
  const Candidate pressure = found("local c = lab.contact{}\nc:press{ |", "pressure");
  EXPECT_EQ(pressure.kind, "key");
  EXPECT_NE(pressure.detail.find("in Pa"), std::string::npos) << pressure.detail;
  EXPECT_NE(found("lab.stylus{ |", "tip").detail.find("default \"2 um\""), std::string::npos);
  EXPECT_TRUE(offers("lab.surface.read(\"a.csv\", { |", "unit"));
  EXPECT_TRUE(offers("lab.notebook(\"n\"):chart{ x=\"N\", |", "one_line_per"));
}

TEST(Completion, OffersTheKeysOfTablesInsideTables) {
  EXPECT_TRUE(offers("lab.contact{ effects={ |", "elasticity"));
  EXPECT_TRUE(offers("lab.contact{ effects={ elasticity=\"box\", creep={ |", "onset"));
  EXPECT_EQ(texts("lab.contact{ accuracy = { tol|"), Names{"tolerance"});
  EXPECT_TRUE(offers("lab.protocol{ { pr|", "press"));
  EXPECT_TRUE(offers("lab.protocol{ {press={ pressure=1 }}, {|", "rotate"));
  EXPECT_TRUE(offers("lab.protocol{ {press={ |", "dwell"));
}

TEST(Completion, OffersTheWordsThatAStringMayBe) {
  EXPECT_EQ(texts("lab.contact{ boundary=\"|"), (Names{"free", "periodic"}));
  EXPECT_EQ(texts("lab.contact{ boundary='per|"), Names{"periodic"});
  EXPECT_EQ(at_bar("lab.contact{ boundary='per|").from, std::string("lab.contact{ boundary='").size());
  EXPECT_EQ(texts("local st = lab.contact{}:press{}\nst:field \"ga|"), Names{"gap"});
  EXPECT_EQ(texts("local st = lab.contact{}:press{}\nst:deformed(\"|"), (Names{"lower", "upper"}));
  EXPECT_TRUE(offers("lab.contact{ boundary=|", "\"periodic\""));
  EXPECT_TRUE(offers("lab.contact{ accuracy={ estimate=|", "true"));
  EXPECT_TRUE(offers("lab.material \"Al|", "Al-2011"));
  EXPECT_TRUE(offers("lab.material(\"|", "quartz"));
  EXPECT_TRUE(offers("help \"lab.surf|", "lab.surface.flat"));
  EXPECT_TRUE(offers("lab.help(\"|", "Surface"));
  EXPECT_EQ(texts("local lab = require \"asperity|"), (Names{"asperity", "asperity.paper"}));
  EXPECT_TRUE(texts("print(\"lab.|").empty());
}

TEST(Completion, OffersUnitsAfterANumberInQuotes) {
  EXPECT_EQ(texts("lab.surface.flat{ size=\"250 u|"), Names{"um"});
  EXPECT_EQ(texts("local c = lab.contact{}\nc:press{ pressure=\"3 M|"), Names{"MPa"});
  EXPECT_EQ(texts("lab.stylus{ tip=\"|"), Names{"2 um"});
  EXPECT_EQ(texts("lab.tilt_stage{ probe_pressure={ \"1 G|"), Names{"GPa"});
  EXPECT_EQ(texts("local c = lab.contact{}\nc:rotate(\"37|"), (Names{" deg", " rad"}));
  EXPECT_EQ(at_bar("lab.stylus{ tip=\"2 u|").from, std::string("lab.stylus{ tip=\"2 ").size());
}

TEST(Completion, OffersVariablesKeywordsAndWhatTheSandboxKeeps) {
  EXPECT_EQ(texts("local plate = 1\nlocal x = pla|"), Names{"plate"});
  EXPECT_EQ(found("local plate = lab.surface.flat{}\npla|", "plate").detail, "a surface");
  EXPECT_EQ(texts("func|"), Names{"function"});
  EXPECT_TRUE(offers("ip|", "ipairs"));
  EXPECT_TRUE(offers("he|", "help"));
  EXPECT_TRUE(offers("string.f|", "format"));
  EXPECT_TRUE(offers("(\"x\"):up|", "upper"));
  EXPECT_FALSE(offers("os.|", "execute"));
  EXPECT_FALSE(offers("io.|", "popen"));
  EXPECT_TRUE(offers("io.|", "open"));
  EXPECT_TRUE(offers("os.|", "exit"));
  EXPECT_TRUE(texts("local plates = pla|").empty());
}

TEST(Completion, OffersWhatLivesAtAPrompt) {
  const std::vector<LiveGlobal> live = {{"c", "Contact"}, {"bench", "table", {{"plate", "Surface"}}}};
  EXPECT_EQ(texts("c:pre|", live), Names{"press"});
  EXPECT_EQ(texts("bench.|", live), Names{"plate"});
  EXPECT_EQ(texts("bench.plate:rota|", live), Names{"rotated"});
  EXPECT_EQ(texts("ben|", live), Names{"bench"});
}

TEST(Completion, IsSilentWhereNothingIsKnown) {
  for (const char* script : {"-- lab.|", "--[[ lab.|", "x = 12|", "local |", "for |", "function |", "goto |",
                             "lab.nothing.|", "local x = 5\nx.|", "lab.surface.flat{ cells={ 3, lab.nix:|"}) {
    const Names all = texts(script);
    EXPECT_TRUE(all.empty() || all == Names{"function"}) << script << " offers " << all.front();
  }
  EXPECT_FALSE(texts("|").empty());
  EXPECT_TRUE(complete("lab.", 400).candidates.size() > 5);
}

TEST(Completion, TakesCaseForASlipOnlyWhereNothingElseFits) {
  EXPECT_EQ(texts("lab.material \"al-|"), Names{"Al-2011"});
  EXPECT_EQ(texts("local S, s = 1, 2\nS|"), Names{"S"});
}

TEST(Completion, SurvivesEveryHalfWrittenScript) {
  const std::string script =
      "#!/usr/bin/asperity\nlocal lab = require \"asperity\" --[==[ long\n]==]\nlocal s <const> = "
      "lab.surface.flat{ cells={4, 4}, size='1 m' }:rotated(\"3 deg\")\nlocal function f(a, ...) if a then "
      "return s elseif not a then return [[x]] else goto done end ::done:: end\nfor i, t in ipairs{s} do "
      "repeat x, y = t:height(1,\n2), 3 until y >= 0x1p-3 end\nlab.contact{ lower=s, upper=lab.rigid, "
      "effects={ elasticity=\"box\" } }:press{ load=\"5 N\" }\nlocal t = { [1]=s; k={s}, f(s)[1].x, \"\\\"\" "
      "}\n";
  for (std::size_t k = 0; k <= script.size(); ++k) {
    const Completion whole = complete(script, k);
    EXPECT_LE(whole.from, k);
    EXPECT_LE(complete(script.substr(k), script.size()).from, script.size() - k);
    std::string lame = script;
    if (k < script.size()) lame.erase(k, 1);
    EXPECT_LE(complete(lame, lame.size()).from, lame.size());
  }
}

// Linear in the script's length for any nesting.
std::size_t steps_of(const std::string& script) {
  return ScriptTypes(script, read_tokens(script).list, {}).steps();
}

TEST(Completion, BearsBracketsWithoutEnd) {
  for (const char* part : {"{", "(", "[", "f{", "x={", "x={{", "lab.contact{ lower={"}) {
    std::string text = "local lab = require 'asperity' ";
    for (int k = 0; k < 200000; ++k) text += part;
    EXPECT_LE(complete(text, text.size()).from, text.size()) << part;
  }
}

TEST(Completion, CostsInProportionToTheScript) {
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int k = 0; k < times; ++k) text += part;
    return text;
  };
  const std::vector<std::string> parts = {
      "local s = lab.surface.flat{ cells=4, size=1 }:rotated(3):plus(s)\n",
      "(",
      "{",
      "f(",
      "local x = {",
      ")",
      "local f = function(a) return {",
      "x = x + (",
      "a.b = function() ",
      "do local x = 1 ",
      "if x then ",
      "x, y = y, {x, ",
      "\"",
      "[[",
      "end ",
      "t.a = t.a .. 'x'\n",
      "return (function() "};
  for (const std::string& part : parts) {
    const std::string few = repeated(part, 500), many = repeated(part, 4000);
    EXPECT_LE(steps_of(many), 12 * steps_of(few) + 100) << part;
    EXPECT_LE(complete(many, many.size()).from, many.size());
  }
}

}  // namespace
}  // namespace asperity::lua::completion_test
