// SPDX-License-Identifier: GPL-3.0-or-later
// Dry runs return placeholders that check names and pass through arithmetic; the check stops where the
// script's path depends on one.
#include "bindings/lua/registry/dry_run.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::placeholder_test {
namespace {

class DryRun : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    open_dry();
    ASSERT_EQ(
        run("s = lab.surface.weierstrass_mandelbrot{ cells=16384, D=2.5, n_max=4000 }\n"
            "al = lab.material 'Al-2011'\n"
            "c = lab.contact{ lower=s:with{ material=al }, upper=lab.rigid, effects={ elasticity='box' } }\n"
            "st = c:press{ pressure='1 MPa' }\nlaw = lab.friction{ tau0='500 MPa', alpha=0.2 }"),
        "");
  }
  void stops(const std::string& code) {
    const std::string error = run(code);
    EXPECT_TRUE(stopped_at_placeholder(error)) << code << ": " << error;
  }
  void goes_on(const std::string& code) { EXPECT_EQ(run(code), "") << code; }
};

TEST_F(DryRun, KeepsNamesOfFieldsAndMethodsChecked) {
  EXPECT_EQ(run("print(st.aera)"), "script.lua:1: a state has no field `aera` (did you mean `area`?)");
  EXPECT_EQ(run("s:scalled{ rms=1 }").rfind("script.lua:1: a surface has no field `scalled`", 0), 0u);
  EXPECT_EQ(
      run("print(s:profile{ row=0 }:roughnes())").rfind("script.lua:1: a profile has no field `roughnes`", 0),
      0u);
}

TEST_F(DryRun, AListWithNamedFieldsHasThemAll) {
  goes_on(
      "traces = lab.stylus{}:scan(s, { count=2 })\nfor _, t in ipairs(traces) do print(t:roughness().Ra) "
      "end\n"
      "print(#traces * 2, traces.tip_effect.Ra_ratio / 2, traces.lines[1].x)");
  EXPECT_EQ(run("print(traces[1].lenght)").rfind("script.lua:1: a profile has no field `lenght`", 0), 0u);
  EXPECT_NE(run("lab.stylus{}:scan(s, { cuont=2 })").find("unknown key `cuont`"), std::string::npos);
}

TEST_F(DryRun, KeepsOptionsChecked) {
  EXPECT_EQ(run("c:press{ presure='1 MPa' }").rfind("script.lua:1: contact:press: unknown key `presure`", 0),
            0u);
  EXPECT_NE(run("c:press{ pressure='1 um' }").find("a length where a pressure is wanted"), std::string::npos);
  EXPECT_NE(run("s:scaled{ rms='1 um', abuot='base' }").find("unknown key `abuot`"), std::string::npos);
  EXPECT_NE(run("lab.surface.weierstrass_mandelbrot{ cells=4, D=5 }").find("`D` is 5"), std::string::npos);
  EXPECT_NE(run("s:height(1, 2, 3)").find("takes at most 2"), std::string::npos);
  EXPECT_NE(
      run("c:press{ pressure=st.pressure, lod=st.load }").find("unknown key `lod` (did you mean `load`?)"),
      std::string::npos);
}

TEST_F(DryRun, PlaceholdersMayStandAnywhereInAnOptionsTable) {
  goes_on("c:press{ pressure=st.pressure }");
  goes_on("c:press{ pressure=st.pressure * 2, dwell=st.load }");
  goes_on(
      "lab.contact{ lower=s, upper=s:mirrored(), effects={ elasticity={ model='box', stiffness=st.stiffness "
      "} },\n"
      "  accuracy={ tolerance=st.residual } }");
  goes_on("lab.surface.flat{ cells={ st.nodes_in_contact, 4 }, size={ st.approach, '1 mm' } }");
  goes_on("lab.surface.from_table{ size=1, heights={ { st.area, 2 }, { 3, st.area } } }");
  goes_on("lab.surface.from_table{ size=1, heights=s:heights() }");
  goes_on("c:sweep{ pressure={ 1e6, st.pressure } }");
  goes_on("lab.material{ young=st.pressure, poisson=0.3 }");
  goes_on("lab.surface.flat(st.area)");
  goes_on("lab.material(st.area)");
  goes_on("s:with{ material=st.area }");
}

TEST_F(DryRun, PassesThroughArithmeticAndText) {
  goes_on(
      "local x = (st.area * 2 + 1)^2 / -st.load // 3 % 2\nx = st.spots | 1 & ~st.spots << 2\n"
      "x = st.area .. ' m^2' .. 1\nx = #st.solver\n"
      "x = math.sqrt(st.area) + math.max(1, st.area) + math.floor(st.area)\n"
      "x = string.format('%.3f %d %s', st.area, st.spots, st) .. ('%g'):format(st.area)\n"
      "x = table.concat({ st.area, 'x', st.load }, ' ')\nx = tostring(st.area) .. tostring(st)\n"
      "x = tonumber(st.area) + 1\nx = st.area == 3\nx = not st.converged\n"
      "local t = { [st.spots]=1 } t[st.spots] = 2 x = t[st.spots]\n"
      "table.insert(t, st.area) x = t[1] * 2\nx = select('#', st.area, 1) + 1\n"
      "local a, b = assert(st.area, 2) x = b + 1");
}

TEST_F(DryRun, LoopsOverResultsRunOnce) {
  goes_on(
      "local n = 0 for st2 in c:sweep{ pressure={ 1, 2, 3 } } do n = n + 1 local a = st2.area end assert(n "
      "== 1)");
  goes_on(
      "local n = 0 for _, p in ipairs(s:profiles()) do n = n + 1 local a = p:roughness().Ra end assert(n == "
      "1)");
  goes_on("for name, v in pairs(st.cost) do local x = v * 2 end");
  goes_on("for j, row in ipairs(s:heights()) do for i, z in ipairs(row) do local x = z + i end end");
  EXPECT_NE(run("for st2 in c:sweep{ pressure={ 1 } } do print(st2.aera) end").find("no field `aera`"),
            std::string::npos);
}

TEST_F(DryRun, FunctionsWithSeveralResultsGiveSeveralPlaceholders) {
  goes_on(
      "local x, y = lab.surface.grain_profile{ radius='1 mm', D=1.5, points=64 }:outline()\n"
      "local a = #x + #y + x[1] + y[1]");
}

TEST_F(DryRun, StopsWhereThePathDependsOnAResult) {
  stops("if st.area > 3 then print(1) end");
  stops("while st.area < 1 do end");
  stops("for k = 1, st.spots do end");
  stops("for k = st.spots, 1, -1 do end");
  stops("local t = { 3, st.area, 1 } table.sort(t)");
  stops("local t = ({})[math.random(st.spots)]");
  stops("string.gsub(st.solver, 'a', 'b')");
  stops("io.lines(st.solver)");
}

TEST_F(DryRun, MistakesAreNotTakenForPlaceholders) {
  for (const char* mistake :
       {"error('placeholder')", "local x = nil + 1", "undefined_thing()", "math.floor('x')",
        "table.concat({ {} })", "error{}", "local x = s + 1", "lab.surface.flat{ cells=4 }"})
    EXPECT_FALSE(stopped_at_placeholder(run(mistake))) << mistake << ": " << run(mistake);
}

TEST_F(DryRun, ErrorsOfWrappedFunctionsKeepTheirLine) {
  EXPECT_EQ(run("\nmath.floor('x')"),
            "script.lua:2: bad argument #1 to 'floor' (number expected, got string)");
  EXPECT_EQ(run("\n\nstring.rep('x', 1e10)"), "script.lua:3: resulting string too large");
  EXPECT_EQ(run("table.concat({ {} })").rfind("script.lua:1: invalid value", 0), 0u);
}

TEST_F(DryRun, WritesNothingAndShowsNothing) {
  testing::internal::CaptureStdout();
  goes_on("print 'hello' io.write('a', st.area):write('b') io.stdout:write('c') io.stderr:write('d')");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  goes_on(
      "local f = assert(io.open('kept.txt', 'w')) f:write('x') f:close()\n"
      "io.output('other.txt') io.close(io.output())\nos.rename('kept.txt', 'b.txt') os.remove('b.txt')\n"
      "s:write 'surface.npy' s:picture 'surface.png'\n"
      "local book = lab.notebook 'book' book:write{ a=1, b=st.area } book:units{ b='m^2' }\n"
      "book:chart{ x='a', y='b' } book:expect('a', { near=1, within=0.1 })");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files += entry.path() != run_folder();
  EXPECT_EQ(files, 0u);
  EXPECT_NE(run("io.open('/etc/x', 'w')"), "");  // still a mistake
  std::filesystem::current_path(before);
}

TEST_F(DryRun, NeverWorksOnTheGrid) {
  collect();
  EXPECT_LT(memory::held(), 8 << 20);
  goes_on(
      "for k = 1, 50 do local x = s:filtered{ long_wave='1 um' }:resampled{ cells=8192 }:spectrum().C end");
  collect();
  EXPECT_LT(memory::held(), 8 << 20);
}

TEST_F(DryRun, NotebooksMayBeAskedForTheirRows) {
  goes_on(
      "local book = lab.notebook 'rows' book:write{ a=1, b=st.area }\n"
      "for _, row in ipairs(book:rows()) do local x = row.a + 1 end");
}

TEST_F(DryRun, FrictionAndTheStageAreFollowed) {
  goes_on(
      "local r = law:on(st) local x = r.mu + r.force\n"
      "local t = lab.tilt_stage{ contact=c, friction=law, mass='4 g' }:raise{ repeats=2 }\n"
      "x = t.angle / lab.units.deg x = t.trials[1].angle");
  EXPECT_NE(run("lab.tilt_stage{ contact=c, friction=law, mas='4 g' }").find("unknown key `mas`"),
            std::string::npos);
}

TEST(Placeholder, LineOfAMessage) {
  EXPECT_EQ(line_of("script.lua:12: what"), "12");
  EXPECT_EQ(line_of("a:b/script.lua:7: x:9: y"), "7");
  EXPECT_EQ(line_of("no line here"), "?");
  EXPECT_EQ(line_of("script.lua:: x"), "?");
}

}  // namespace
}  // namespace asperity::lua::placeholder_test
