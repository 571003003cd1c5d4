// SPDX-License-Identifier: GPL-3.0-or-later
// Order and values do not depend on the number of threads.
#include <unistd.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "bindings/lua/runtime/state.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/parallel.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua::ensemble_test {
namespace {

class RecordingMonitor final : public Monitor {
 public:
  void progress(std::string_view what, double done) override {
    progressed = std::string(what);
    last_done = done;
  }
  void progress_of_parts(std::string_view what, double done, std::string_view of, double) override {
    progress(what, done);
    part = std::string(of);
  }
  void warn(std::string_view sentence) override { warnings.emplace_back(sentence); }
  std::string progressed, part;
  double last_done = -1;
  std::vector<std::string> warnings;
};

class Bench {
 public:
  explicit Bench(int threads = 2, bool dry_run = false, bool trusted = false) : session(monitor) {
    set_thread_count(threads);
    session.seed = 7;
    session.dry_run = dry_run;
    session.trusted = trusted;
    output_ = open_memstream(&text_, &size_);
    session.output = output_;
    state_ = make_state(session, "");
    EXPECT_EQ(run("lab = require 'asperity'"), "");
  }
  ~Bench() {
    state_.reset();
    std::fclose(output_);
    std::free(text_);
    set_thread_count(0);
    stop_flag().clear();
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  // The result as text, or "error: " and the message.
  std::string run(const std::string& script) {
    lua_State* L = state_.get();
    lua_settop(L, 0);
    auto action = [&script](lua_State* s) {
      if (luaL_loadbufferx(s, script.data(), script.size(), "=script", "t") != LUA_OK) return lua_error(s);
      lua_call(s, 0, 1);
      if (lua_isnil(s, -1)) {
        lua_pushliteral(s, "");
      } else {
        luaL_tolstring(s, -1, nullptr);
      }
      return 1;
    };
    if (protect(L, 0, 1, action) != LUA_OK) return "error: " + error_text(L, -1);
    return lua_tostring(L, -1);
  }
  std::string printed() {
    std::fflush(output_);
    return std::string(text_, size_);
  }
  lua_State* state() { return state_.get(); }

  RecordingMonitor monitor;
  Session session;

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* output_ = nullptr;
  State state_;
};

testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << text << "\" does not hold \"" << part << "\"";
}

// Native work, random numbers and text, flattened to a string.
const char* const study = R"(
  local rows = lab.ensemble{
    over = { D = {2.1, 2.5, 2.9}, seed = {1, 2, 3, 4} },
    run = function(case)
      local s = lab.surface.weierstrass_mandelbrot{ cells = 64, D = case.D, seed = case.seed }
      print("case", case.D, case.seed)
      io.write("noise ", math.random(1000), "\n")
      io.stdout:write("done\n")
      local r = s:roughness()
      return { digest = s.digest, Ra = r.Ra, draw = math.random(), surface = s }
    end }
  local lines = {}
  for k, row in ipairs(rows) do
    lines[k] = string.format("%d: D=%.17g seed=%d %s %.17g %.17g %s", k, row.D, row.seed, row.digest, row.Ra,
                             row.draw, row.surface.digest)
  end
  return table.concat(lines, "\n")
)";

std::string journal_of(int threads, std::string& rows, std::string& printed,
                       const std::string& script = study, std::string* kept = nullptr) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      ("asperity-ensemble-" + std::to_string(getpid()) + "-" + std::to_string(threads));
  std::filesystem::remove_all(folder);
  std::string text;
  {
    Bench bench(threads);
    RunSetup setup;
    setup.script_name = "study.lua";
    setup.out = folder;
    bench.session.run = std::make_shared<RunDirectory>(setup);
    rows = bench.run(script);
    printed = bench.printed();
    bench.session.run->finish(RunStatus::done);
    if (kept != nullptr) {
      std::ifstream table(folder / "ensemble_kept.csv");
      *kept = std::string(std::istreambuf_iterator<char>(table), {});
    }
    std::ifstream file(folder / "journal.jsonl");
    std::ostringstream all;
    all << file.rdbuf();
    text = all.str();
  }
  std::filesystem::remove_all(folder);
  return text;
}

TEST(Ensemble, SameRowsAndDigestsForAnyNumberOfThreads) {
  std::string rows, printed;
  const std::string journal = journal_of(1, rows, printed);
  EXPECT_TRUE(contains(rows, "12: D=2.8999999999999999 seed=4"));
  EXPECT_TRUE(contains(printed, "case\t2.9\t4\nnoise "));
  EXPECT_TRUE(
      contains(journal, "\"event\":\"ensemble\",\"cases\":12,\"over\":[\"D\",\"seed\"],\"result\":\""));
  for (const int threads : {2, 4}) {
    std::string other_rows, other_printed;
    EXPECT_EQ(journal_of(threads, other_rows, other_printed), journal) << threads;
    EXPECT_EQ(other_rows, rows) << threads;
    EXPECT_EQ(other_printed, printed) << threads;
  }
}

TEST(Ensemble, LastKeyInOrderOfNamesVariesFastest) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local t = {}
    for _, row in ipairs(lab.ensemble{ over = { b = {1, 2}, a = {"x", true}, c = {0.5} },
                                       run = function() return {} end }) do
      t[#t + 1] = tostring(row.a) .. row.b .. row.c
    end
    return table.concat(t, " "))"),
            "x10.5 x20.5 true10.5 true20.5");
}

TEST(Ensemble, ListOfCasesInPlaceOfLists) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local rows = lab.ensemble{ cases = { {D = 2, seed = 5}, {D = 3} },
                               run = function(case) return { sum = case.D + (case.seed or 0) } end }
    return rows[1].sum .. " " .. rows[2].sum .. " " .. tostring(rows[2].seed))"),
            "7 3 nil");
}

TEST(Ensemble, EmptyListsAndEmptyReturnsAreRefused) {
  Bench bench;
  EXPECT_TRUE(
      contains(bench.run("lab.ensemble{ over = { a = {}, b = {1, 2} }, run = function() return {} end }"),
               "a list in `over` is empty, so there is no case"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ cases = {}, run = function() return {} end }"),
                       "`cases` is empty, so there is no case"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = {}, run = function() return {} end }"),
                       "`over` names nothing to vary; give at least one list"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { a = {1} }, run = function() local r = 1 end }"),
                       "case a = 1: `run` returned nothing (nil); return a table of named results"));
}

TEST(Ensemble, WrongKeysAreNamed) {
  Bench bench;
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ ovr = { a = {1} }, run = function() end }"),
                       "unknown key `ovr` (did you mean `over`?)"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ run = function() end }"), "`over` is missing"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { a = {1} } }"), "`run` is missing"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { a = 3 }, run = function() end }"),
                       "`over.a` is the number 3; give a list of values, such as {3}"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { a = {1, nil, 3, x = 2} }, run = function() end }"),
                       "`over.a` is not a list"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { a = {print} }, run = function() end }"),
                       "`over.a[1]` is a function; a case is described by numbers"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { a = {1} }, cases = {}, run = function() end }"),
                       "both `over` and `cases` are given"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ cases = { 5 }, run = function() end }"),
                       "`cases[1]` is the number 5; give a table of named values"));
  EXPECT_TRUE(contains(bench.run(R"(
    local l = {}
    for i = 1, 1001 do l[i] = i end
    lab.ensemble{ over = { a = l, b = l }, run = function() end })"),
                       "`over` makes 1.002e+06 cases"));
}

TEST(Ensemble, EveryKindOfUpvalueTravels) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local none, yes, whole, real, text = nil, true, 3, 0.1, "a\0b"
    local format, random, sin, out = string.format, math.random, math.sin, io.stdout
    local lib, lab2, sine = string, lab, lab.surface.sine
    local t = { 1, 2, { deep = "x" }, [true] = "t", [1.5] = "h" }
    t.self = t
    local class = { __index = { twice = function(o) return 2 * o.v end }, __call = function(o, x) return o.v + x end }
    local object = setmetatable({ v = 21 }, class)
    local steel, roughness = lab.material "quartz", lab.surface.flat{ cells = 4, size = 1 }:roughness()
    local surface = lab.surface.sine{ cells = 16, size = 1e-3, amplitude = 1e-6 }
    local keyed = { [surface] = "found" }
    local rigid = lab.rigid
    local rows = lab.ensemble{ over = { k = {1} }, run = function(case)
      assert(none == nil and yes == true and math.type(whole) == "integer" and real == 0.1 and #text == 3)
      assert(format == string.format and random == math.random and sin == math.sin and out == io.stdout)
      assert(lib == string and lab2 == require "asperity")
      assert(t.self == t and t[3].deep == "x" and t[true] == "t" and t[1.5] == "h" and #t == 3)
      assert(object:twice() == 42 and object(1) == 22 and getmetatable(object) == class)
      assert(steel.name == "quartz" and roughness.Ra == 0 and rigid == lab2.rigid)
      assert(keyed[surface] == "found" and surface.digest == sine{ cells = 16, size = 1e-3, amplitude = 1e-6 }.digest)
      return { digest = surface.digest, again = surface }
    end }
    assert(rows[1].digest == surface.digest and rows[1].again == surface)
    return "all"
  )"),
            "all");
}

TEST(Ensemble, LocalFunctionsMayCallEachOther) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local odd
    local function even(n) if n == 0 then return true end return odd(n - 1) end
    function odd(n) if n == 0 then return false end return even(n - 1) end
    local count = 0
    local function step() count = count + 1 end
    local function read() return count end
    local rows = lab.ensemble{ over = { n = {3, 4} }, run = function(case)
      step() step() count = count + 1
      return { even = even(case.n), count = read() }
    end }
    return tostring(rows[1].even) .. tostring(rows[2].even) .. rows[1].count .. rows[2].count .. count
  )"),
            "falsetrue330");
}

TEST(Ensemble, GlobalsAndAdditionsToLibrariesTravel) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    factor = 10
    function double(x) return 2 * x end
    function triple(x) return double(x) + x end
    function string.shout(s) return s:upper() .. "!" end
    math.golden = 1.5
    local say = print
    print = function(...) say("<", ...) end
    local rows = lab.ensemble{ over = { x = {1, 2} }, run = function(case)
      print(case.x)
      return { y = triple(case.x) * factor, s = ("hi"):shout(), g = math.golden }
    end }
    return rows[2].y .. rows[2].s .. rows[2].g
  )"),
            "60HI!1.5");
  EXPECT_EQ(bench.printed(), "<\t1\n<\t2\n");
}

TEST(Ensemble, UntransferableGlobalIsNamedWhenUsed) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    wheel = coroutine.create(function() end)
    box = { inner = { wheel } }
    return #lab.ensemble{ over = { x = {1} }, run = function() return { y = 1 } end }
  )"),
            "1");
  EXPECT_TRUE(
      contains(bench.run("lab.ensemble{ over = { x = {1} }, run = function() return { y = wheel } end }"),
               "case x = 1: script:1: the global `wheel` stays with the script: `wheel` is a coroutine; "
               "make it inside `run`"));
  EXPECT_TRUE(
      contains(bench.run("lab.ensemble{ over = { x = {1} }, run = function() return { y = box } end }"),
               "`box.inner[1]` is a coroutine"));
  EXPECT_TRUE(
      contains(bench.run("lab.ensemble{ over = { x = {1} }, run = function() return { y = bx } end }"),
               "the global `bx` was never set"));
}

TEST(Ensemble, CasesDoNotSeeEachOthersChanges) {
  for (const int threads : {1, 2}) {
    Bench bench(threads);
    EXPECT_EQ(bench.run(R"(
      local seen, n = {}, 0
      total = 0
      local rows = lab.ensemble{ over = { x = {1, 2, 3} }, run = function(case)
        seen[#seen + 1] = case.x
        n, total = n + 1, total + 1
        string.mine = case.x
        case.x = nil
        return { seen = #seen, n = n, total = total }
      end }
      assert(#seen == 0 and n == 0 and total == 0 and rawget(string, "mine") == nil)
      return rows[3].x .. rows[3].seen .. rows[3].n .. rows[3].total
    )"),
              "3111");
  }
}

TEST(Ensemble, UntransferableUpvaluesAreNamedWithTheWayToThem) {
  Bench bench;
  const auto error_of = [&](const std::string& script) {
    return bench.run(script + "\nlab.ensemble{ over = { x = {1} }, run = run }");
  };
  EXPECT_TRUE(
      contains(error_of("local c = coroutine.create(print) local function run() return c end"),
               "script:2: lab.ensemble: `run` uses the upvalue `c`, which is a coroutine; make it inside "
               "`run`"));
  EXPECT_TRUE(contains(error_of("local w = coroutine.wrap(print) local function run() return w end"),
                       "`run` uses the upvalue `w`, which uses the upvalue `thread`, which is a coroutine"));
  EXPECT_TRUE(
      contains(error_of("local f = io.tmpfile and io.open('/dev/null') local function run() return f end"),
               "`run` uses the upvalue `f`, which is an open file"));
  EXPECT_TRUE(contains(error_of("local g = string.gmatch('a', 'a') local function run() return g end"),
                       "`run` uses the upvalue `g`, which holds state that cannot be copied"));
  EXPECT_TRUE(
      contains(error_of("local app = { list = { 1, { ['two words'] = coroutine.create(print) } } }"
                        " local function helper() return app end local function run() return helper() end"),
               "`run` uses the upvalue `helper`, which uses the upvalue `app.list[2][\"two words\"]`, which "
               "is a coroutine"));
  EXPECT_TRUE(contains(error_of("local o = setmetatable({}, { __index = { c = coroutine.create(print) } })"
                                " local function run() return o end"),
                       "`run` uses the upvalue `o's metatable.__index.c`, which is a coroutine"));
}

TEST(Ensemble, ABenchStaysWithTheScript) {
  Bench bench;
  EXPECT_TRUE(contains(bench.run(R"(
    local plate = lab.surface.sine{ cells = 16, size = 1e-3, amplitude = 1e-6, material = lab.material "Al-2011" }
    local c = lab.contact{ lower = plate, upper = lab.rigid, boundary = "free", effects = { elasticity = "box" } }
    return lab.ensemble{ over = { p = {1e6} }, run = function(case) return { a = c:press{ pressure = case.p } } end }
  )"),
                       "`run` uses the upvalue `c`, which is a contact; make it inside `run`"));
}

TEST(Ensemble, AClosedValueDoesNotTravel) {
  Bench bench;
  EXPECT_TRUE(contains(bench.run(R"(
    local s
    do
      local closing <close> = lab.surface.flat{ cells = 2, size = 1 }
      s = closing
    end
    lab.ensemble{ over = { x = {1} }, run = function() return { s = s } end })"),
                       "`run` uses the upvalue `s`, which is a surface that was closed"));
}

TEST(Ensemble, ContactStatesComeBackAsValues) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local plate = lab.surface.sine{ cells = 16, size = 1e-3, amplitude = 1e-6, material = lab.material "Al-2011" }
    local rows = lab.ensemble{ over = { p = {1e6, 1e9} }, run = function(case)
      local c = lab.contact{ lower = plate, upper = lab.rigid, boundary = "free", effects = { elasticity = "box" } }
      return { state = c:press{ pressure = case.p } }
    end }
    return tostring(rows[1].state.area < rows[2].state.area)
  )"),
            "true");
}

const char* const failing = R"(
      local function deep(case) error("boom " .. case.seed) end
      local function run(case)
        print(case.D, case.seed)
        if case.D > 2 and case.seed > 1 then deep(case) end
        return { twice = 2 * case.D, list = { 1 } }
      end
      local over = { D = {2, 2.5}, seed = {1, 2, 3}, kind = {"cold"} }
)";

TEST(Ensemble, AllOtherCasesRunAndOneErrorNamesThoseThatFailed) {
  for (const int threads : {1, 2, 4}) {
    Bench bench(threads);
    const std::string message =
        bench.run(std::string(failing) + "      lab.ensemble{ over = over, run = run }");
    EXPECT_TRUE(contains(message,
                         "error: script:9: lab.ensemble: 2 of 6 cases failed, and the other 4 ran\n"
                         "  case D = 2.5, kind = \"cold\", seed = 2: script:2: boom 2\n"
                         "  case D = 2.5, kind = \"cold\", seed = 3: script:2: boom 3\n"
                         "where the first of them failed:\nstack traceback:\n"));
    EXPECT_TRUE(contains(message, "script:5: in function"));
    EXPECT_EQ(bench.printed(), "2\t1\n2\t2\n2\t3\n2.5\t1\n2.5\t2\n2.5\t3\n");
    EXPECT_EQ(bench.monitor.warnings,
              (std::vector<std::string>{"case D = 2.5, kind = \"cold\", seed = 2 failed: script:2: boom 2",
                                        "case D = 2.5, kind = \"cold\", seed = 3 failed: script:2: boom 3"}));
  }
}

TEST(Ensemble, WhatSucceededBesideFailuresIsKept) {
  const std::string script = std::string(failing) + "      lab.ensemble{ over = over, run = run }";
  std::string rows, printed, kept;
  const std::string journal = journal_of(1, rows, printed, script, &kept);
  EXPECT_EQ(kept, "D,kind,seed,twice\n2,cold,1,4\n2,cold,2,4\n2,cold,3,4\n2.5,cold,1,5\n");
  EXPECT_TRUE(contains(rows, "the other 4 ran (their results are in ensemble_kept.csv)\n"));
  EXPECT_TRUE(contains(journal,
                       "\"failed\":[{\"index\":5,\"case\":\"case D = 2.5, kind = \\\"cold\\\", seed = 2\","
                       "\"message\":\"script:2: boom 2\"},{\"index\":6"));
  for (const int threads : {2, 4}) {
    std::string other_rows, other_printed, other_kept;
    EXPECT_EQ(journal_of(threads, other_rows, other_printed, script, &other_kept), journal) << threads;
    EXPECT_EQ(other_kept, kept) << threads;
    EXPECT_EQ(other_rows, rows) << threads;
  }
}

TEST(Ensemble, FailuresReportedAreAListBesideTheRows) {
  for (const int threads : {1, 3}) {
    Bench bench(threads);
    EXPECT_EQ(bench.run(std::string(failing) + R"(
      local rows = lab.ensemble{ over = over, run = run, on_failure = "report" }
      local text = #rows .. " " .. rows[4].D .. " " .. rows[4].twice
      for _, failure in ipairs(rows.failed) do
        text = text .. "; " .. failure.index .. " " .. failure.case.seed .. " " .. failure.message
      end
      return text)"),
              "4 2.5 5.0; 5 2 script:2: boom 2; 6 3 script:2: boom 3");
    EXPECT_EQ(bench.monitor.warnings.size(), 2U);
    EXPECT_EQ(bench.run("return #lab.ensemble{ over = { x = {1} }, run = function() return {} end, "
                        "on_failure = 'report' }.failed"),
              "0");
  }
}

TEST(Ensemble, ACaseAloneFailsInItsOwnWords) {
  Bench bench;
  const std::string message =
      bench.run("lab.ensemble{ over = { x = {1} }, run = function() error('boom') end }");
  EXPECT_TRUE(
      contains(message, "error: script:1: lab.ensemble: case x = 1: script:1: boom\nstack traceback:"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { x = {1} }, run = print, on_failure = 'ignore' }"),
                       "`on_failure` is \"ignore\"; give \"error\" or \"report\""));
}

TEST(Ensemble, ManyFailuresAreCounted) {
  Bench bench;
  const std::string message = bench.run(
      "local l = {} for i = 1, 60 do l[i] = i end "
      "lab.ensemble{ over = { x = l }, run = function() error('no', 0) end }");
  EXPECT_TRUE(contains(message, "60 of 60 cases failed\n  case x = 1: no\n"));
  EXPECT_TRUE(contains(message, "  case x = 50: no\n  and 10 more\n"));
}

TEST(Ensemble, ErrorValuesThatAreNoTextAreShown) {
  Bench bench;
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { x = {1} }, run = function() error({}) end }"),
                       "case x = 1: script:1: (error value: table: "));
  EXPECT_TRUE(
      contains(bench.run("lab.ensemble{ over = { x = {1} }, run = function() lab.surface.sphre{} end }"),
               "script:1: lab.surface has no field `sphre` (did you mean `sphere`?)"));
}

TEST(Ensemble, ReturnsMustBeTablesOfData) {
  Bench bench;
  const auto error_of = [&](const std::string& body) {
    return bench.run("lab.ensemble{ over = { x = {1} }, run = function(case) " + body + " end }");
  };
  EXPECT_TRUE(contains(error_of("return 3"),
                       "case x = 1: `run` returned the number 3; return a table of named "
                       "results"));
  EXPECT_TRUE(contains(error_of("return { a = { f = print } }"),
                       "`run(case).a.f` is a function; return numbers, strings, booleans, tables"));
  EXPECT_TRUE(contains(error_of("return { co = coroutine.create(print) }"), "`run(case).co` is a coroutine"));
  EXPECT_TRUE(contains(error_of("return { m = math }"), "`run(case).m` is a part of Lua's library"));
  EXPECT_TRUE(
      contains(error_of("return { m = setmetatable({}, {}) }"), "`run(case).m` is a table with a metatable"));
  EXPECT_TRUE(contains(error_of("return { x = 2 }"),
                       "`run` returned `x` = the number 2, but `x` is 1 in this case; "
                       "give the column another name"));
  EXPECT_EQ(error_of("return { x = 1 }"), "");
}

TEST(Ensemble, ResultsAndNestedTablesComeBack) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local rows = lab.ensemble{ over = { x = {1, 2} }, run = function(case)
      if case.x == 1 then return lab.surface.flat{ cells = 4, size = 1 }:roughness() end
      local deep = {}
      for i = 1, 50000 do deep = { next = deep } end
      case.list = { 1, 2, { 3 } }
      case.deep = deep
      case.list[4] = case.list
      return case
    end }
    local n, d = 0, rows[2].deep
    while d.next do n, d = n + 1, d.next end
    local l = rows[2].list
    return rows[1].x .. rows[1].Ra .. " " .. n .. " " .. l[3][1] .. tostring(l[4] == l)
  )"),
            "10.0 50000 3true");
}

TEST(Ensemble, CasesHaveTheirOwnSeed) {
  Bench bench;
  EXPECT_EQ(bench.run(R"(
    local function draws()
      return lab.ensemble{ over = { x = {1, 2} }, run = function() return { r = math.random() } end }
    end
    local a, b = draws(), draws()
    return tostring(a[1].r == b[1].r) .. tostring(a[1].r ~= a[2].r)
  )"),
            "truetrue");
}

TEST(Ensemble, ACaseNeitherRecordsNorExits) {
  Bench bench;
  const auto error_of = [&](const std::string& body) {
    return bench.run("lab.ensemble{ over = { x = {1} }, run = function(case) " + body + " end }");
  };
  EXPECT_TRUE(contains(error_of("os.exit(3)"), "a case of an ensemble cannot end the run"));
  EXPECT_TRUE(contains(error_of("io.open('x', 'w')"), "a case of an ensemble writes no files"));
  EXPECT_TRUE(contains(error_of("os.execute('true')"), "os.execute is not available to a script"));
  EXPECT_TRUE(contains(error_of("local f = load('\\27Lua') return f()"), "attempt to call a nil value"));
}

TEST(Ensemble, NestsInsideACase) {
  std::string first;
  for (const int threads : {1, 2}) {
    Bench bench(threads);
    const std::string result = bench.run(R"(
      local rows = lab.ensemble{ over = { a = {1, 2} }, run = function(outer)
        local inner = lab.ensemble{ over = { b = {10, 20} }, run = function(case)
          print(outer.a, case.b)
          return { sum = outer.a + case.b, r = math.random() }
        end }
        return { sum = inner[1].sum + inner[2].sum, r = inner[1].r }
      end }
      return rows[1].sum .. " " .. rows[2].sum .. " " .. rows[2].r
    )");
    if (first.empty()) first = result;
    EXPECT_EQ(result, first);
    EXPECT_TRUE(contains(result, "32 34 0."));
    EXPECT_EQ(bench.printed(), "1\t10\n1\t20\n2\t10\n2\t20\n");
  }
}

TEST(Ensemble, LoopThatNeverEndsIsStopped) {
  for (const char* body :
       {"while true do end", "while true do pcall(function() while true do end end) end"}) {
    Bench bench;
    std::jthread stopper([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      stop_flag().raise(StopReason::interrupt);
    });
    EXPECT_EQ(
        bench.run(std::string("lab.ensemble{ over = { x = {1, 2, 3} }, run = function() ") + body + " end }"),
        "error: script:1: interrupted");
  }
}

TEST(Ensemble, TimeLimitIsSaid) {
  Bench bench;
  std::jthread stopper([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop_flag().raise(StopReason::time_limit);
  });
  EXPECT_TRUE(
      contains(bench.run("lab.ensemble{ over = { x = {1} }, run = function() while true do end end }"),
               "the time limit of the run is reached"));
}

TEST(Ensemble, MemoryLimitEndsTheCaseOnly) {
  Bench bench;
  memory::set_limit(memory::held() + (std::int64_t{24} << 20));
  const std::string message = bench.run(
      "lab.ensemble{ over = { x = {1} }, run = function() local t = {} for i = 1, 1e8 do t[i] = i end end }");
  memory::set_limit(0);
  EXPECT_TRUE(contains(message, "case x = 1: not enough memory"));
  EXPECT_EQ(bench.run("return #lab.ensemble{ over = { x = {1} }, run = function() return {} end }"), "1");
}

TEST(Ensemble, ProgressIsThatOfTheWhole) {
  Bench bench(1);
  bench.run(R"(
    lab.ensemble{ over = { x = {1, 2, 3, 4} }, run = function()
      local t = os.clock()
      while os.clock() - t < 0.03 do end
    end })");
  EXPECT_EQ(bench.monitor.progressed, "ensemble");
  EXPECT_TRUE(contains(bench.monitor.part, " of 4 cases done"));
  EXPECT_GE(bench.monitor.last_done, 0);
  EXPECT_LE(bench.monitor.last_done, 1);
}

TEST(Ensemble, DryRunChecksTheFirstCase) {
  Bench bench(2, true);
  EXPECT_EQ(bench.run(R"(
    local rows = lab.ensemble{ over = { D = {2.1, 2.5}, seed = {1, 2} }, run = function(case)
      local s = lab.surface.weierstrass_mandelbrot{ cells = 64, D = case.D, seed = case.seed }
      return { Ra = s:roughness().Ra, s = s }
    end }
    local mean = (rows[1].Ra + rows[4].Ra) / 2
    return #rows .. " " .. rows[3].D .. " " .. tostring(mean)
  )"),
            "4 2.5 ?");
  EXPECT_TRUE(contains(bench.run(R"(lab.ensemble{ over = { D = {2.1} }, run = function(case)
      return { s = lab.surface.weierstrass_mandelbrot{ cels = 64, D = case.D } }
    end })"),
                       "case D = 2.1: script:2: lab.surface.weierstrass_mandelbrot"));
  EXPECT_TRUE(contains(bench.run("lab.ensemble{ over = { D = {2.1} }, run = function() return 1 end }"),
                       "`run` returned the number 1"));
}

TEST(Ensemble, TrustedScriptsHaveTheWholeOfLuaInCases) {
  Bench bench(2, false, true);
  EXPECT_EQ(bench.run("local rows = lab.ensemble{ over = { x = {1} }, run = function()"
                      " return { p = type(io.popen), d = type(debug.sethook) } end }"
                      " return rows[1].p .. rows[1].d"),
            "functionfunction");
}

TEST(Ensemble, EndlessNestingIsRefusedAndShallowNestingRuns) {
  Bench bench(2);
  EXPECT_TRUE(
      contains(bench.run("local function f() return lab.ensemble{ over = { x = {1} }, run = f }[1] end f()"),
               "this ensemble is inside 8 others"));
  EXPECT_EQ(bench.run("local rows = lab.ensemble{ over = { x = {1, 2} }, run = function(case)"
                      " local inner = lab.ensemble{ over = { y = {10, 20} }, run = function(c)"
                      " return { sum = case.x + c.y } end }"
                      " return { total = inner[1].sum + inner[2].sum } end }"
                      " return rows[1].total .. ' ' .. rows[2].total"),
            "32 34");
}

}  // namespace
}  // namespace asperity::lua::ensemble_test
