// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of untrusted scripts.
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::sandbox_test {
namespace {

class Sandbox : public LuaTest {
 protected:
  void refused(const std::string& code, const std::string& part) {
    const std::string error = run(code);
    EXPECT_NE(error.find(part), std::string::npos) << code << ": " << error;
  }
};

TEST_F(Sandbox, OtherProgramsAreOutOfReach) {
  refused(
      "os.execute('true')",
      "script.lua:1: os.execute is not available to a script (asperity run --trust gives the whole of Lua)");
  refused("io.popen('ls')", "script.lua:1: io.popen is not available to a script");
  refused("os.tmpname()", "script.lua:1: os.tmpname is not available to a script; give the file a name");
  refused("io.tmpfile()", "script.lua:1: io.tmpfile is not available to a script");
  refused("os.setlocale('C')", "script.lua:1: os.setlocale is not available");
}

TEST_F(Sandbox, CLibrariesAreOutOfReach) {
  EXPECT_EQ(value("package.loadlib"), "nil");
  EXPECT_EQ(value("package.cpath"), "");
  EXPECT_EQ(value("#package.searchers"), "2");
  write_file("mean.so",
             "\x7f"
             "ELF");
  EXPECT_EQ(run("package.cpath = '" + folder.string() + "/?.so'"), "");
  refused("require 'mean'", "module 'mean' not found");
}

TEST_F(Sandbox, BytecodeIsRefusedHoweverItComes) {
  EXPECT_EQ(run("code = string.dump(function() return 1 end)"), "");
  EXPECT_EQ(value("load(code)"), "nil");
  EXPECT_EQ(value("select(2, load(code))"), "attempt to load a binary chunk (mode is 't')");
  EXPECT_EQ(value("load(code, 'x', 'b')"), "nil");
  EXPECT_EQ(value("load(code, 'x', 'bt', {})"), "nil");
  EXPECT_EQ(value("load(function() local c = code code = nil return c end, 'x', 'b')"), "nil");
  EXPECT_EQ(run("code = string.dump(function() return 1 end)\n"
                "local f = io.open('chunk.luac', 'wb') f:write(code) f:close()"),
            "");
  const std::string file = (run_folder() / "chunk.luac").string();
  EXPECT_EQ(value("loadfile('" + file + "')"), "nil");
  EXPECT_EQ(value("loadfile('" + file + "', 'b')"), "nil");
  refused("dofile('" + file + "')", "attempt to load a binary chunk");
  EXPECT_EQ(run("package.path = '" + run_folder().string() + "/?.luac'"), "");
  refused("require 'chunk'", "attempt to load a binary chunk");
}

TEST_F(Sandbox, TextChunksStillLoad) {
  EXPECT_EQ(value("load('return 1 + 1')()"), "2");
  EXPECT_EQ(value("load('return x', 'name', 't', { x=5 })()"), "5");
  EXPECT_NE(run("load('return x', 'name', 't', nil)()").find("attempt to index a nil value"),
            std::string::npos);
  EXPECT_NE(value("select(2, load('return ='))").find("unexpected symbol"), std::string::npos);
  write_file("three.lua", "return 3");
  EXPECT_EQ(value("dofile('" + (folder / "three.lua").string() + "')"), "3");
  EXPECT_EQ(value("loadfile('" + (folder / "three.lua").string() + "')()"), "3");
}

TEST_F(Sandbox, HooksAndMetatablesOfNativeValuesAreOutOfReach) {
  EXPECT_EQ(
      run("local names = {} for name in pairs(debug) do names[#names + 1] = name end table.sort(names)\n"
          "assert(table.concat(names, ' ') == 'getinfo traceback', table.concat(names, ' '))"),
      "");
  EXPECT_TRUE(holds("require 'debug' == debug and package.loaded.debug == debug"));
  EXPECT_TRUE(holds("type(getmetatable(lab.rigid)) == 'string'"));
}

TEST_F(Sandbox, OriginalsCannotBeMetOnTheStack) {
  // Originals call the reader of load and error handlers.
  EXPECT_EQ(run("local met = {}\n"
                "local function look() for level = 0, 12 do\n"
                "  local info = debug.getinfo(level, 'f') or debug.getinfo(level)\n"
                "  if info then met[#met + 1] = info.func end end end\n"
                "load(function() look() return nil end)\n"
                "xpcall(load, look, nil)\nxpcall(io.open, look, {})\n"
                "setmetatable({}, { __gc=look }) collectgarbage()\n"
                "assert(#met == 0)"),
            "");
  EXPECT_EQ(run("local co = coroutine.create(function() coroutine.yield() end) coroutine.resume(co)\n"
                "assert(debug.getinfo(co, 0, 'f').func == nil and debug.getinfo(co, 1).func == nil)"),
            "");
}

TEST_F(Sandbox, WhatIsKnownOfAFunctionIsStillTold) {
  EXPECT_EQ(run("\nlocal function f() return debug.getinfo(1, 'l').currentline end\nassert(f() == 2)"), "");
  EXPECT_EQ(run("local function outer() return (debug.getinfo(2, 'l').currentline) end\n"
                "local line = outer()\nassert(line == 2, line)"),
            "");
  EXPECT_EQ(value("debug.getinfo(print).what"), "C");
  EXPECT_EQ(value("debug.getinfo(99)"), "nil");
  EXPECT_NE(value("debug.traceback('here')").find("stack traceback"), std::string::npos);
  EXPECT_NE(run("debug.getinfo(1, '?')"), "");
}

TEST_F(Sandbox, FilesAreWrittenUnderTheRunOnly) {
  EXPECT_EQ(run("local f = io.open('notes/a.txt', 'w') f:write('kept') f:close()"), "");
  EXPECT_EQ(content_of(run_folder() / "notes/a.txt"), "kept");
  EXPECT_EQ(run("io.output('out.txt') io.write('also') io.close() io.output(io.stdout)"), "");
  EXPECT_EQ(content_of(run_folder() / "out.txt"), "also");
  for (const char* mode : {"w", "wb", "a", "r+", "w+", "a+", "r+b"}) {
    for (const char* path : {"../x.txt", "/tmp/asperity-escape.txt", "notes/../../x.txt", "./../x.txt"}) {
      const std::string error = run(std::string("io.open('") + path + "', '" + mode + "')");
      EXPECT_EQ(error.rfind("script.lua:1: ", 0), 0u) << path << mode << ": " << error;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "x.txt"));
  EXPECT_FALSE(std::filesystem::exists("/tmp/asperity-escape.txt"));
  refused("io.output('/tmp/asperity-escape.txt')", "script.lua:1: ");
  refused("io.open(12, 'w')", "a file name must be a string, and is a number");
}

TEST_F(Sandbox, LinksAreNoWayOut) {
  std::filesystem::create_directory(folder / "outside");
  std::filesystem::create_directory_symlink(folder / "outside", run_folder() / "link");
  std::filesystem::create_symlink(folder / "outside/file.txt", run_folder() / "file.txt");
  EXPECT_NE(run("io.open('link/x.txt', 'w')"), "");
  EXPECT_NE(run("io.open('file.txt', 'w')"), "");
  EXPECT_NE(run("lab.surface.flat{ cells=2, size=1 }:write 'link/x.npy'"), "");
  EXPECT_NE(run("os.remove('link/x.txt')"), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "outside"));
}

TEST_F(Sandbox, TheRunsOwnRecordsAreNotTheScriptsToWrite) {
  for (const char* name : {"manifest.json", "journal.jsonl", "script.lua", "./manifest.json"}) {
    EXPECT_NE(run(std::string("io.open('") + name + "', 'w')"), "") << name;
    EXPECT_NE(run(std::string("os.remove('") + name + "')"), "") << name;
    EXPECT_NE(run(std::string("os.rename('") + name + "', 'other')"), "") << name;
  }
  EXPECT_EQ(run("io.open('mine.txt', 'w'):close()"), "");
  EXPECT_NE(run("os.rename('mine.txt', 'manifest.json')"), "");
}

TEST_F(Sandbox, RemovingAndRenamingStayInside) {
  write_file("precious.txt", "mine");
  EXPECT_NE(run("os.remove('../precious.txt')"), "");
  EXPECT_NE(run("os.remove('" + (folder / "precious.txt").string() + "')"), "");
  EXPECT_NE(run("os.rename('../precious.txt', 'stolen.txt')"), "");
  EXPECT_EQ(run("io.open('a.txt', 'w'):close()"), "");
  EXPECT_NE(run("os.rename('a.txt', '../precious.txt')"), "");
  EXPECT_EQ(content_of(folder / "precious.txt"), "mine");
  EXPECT_EQ(run("assert(os.rename('a.txt', 'b.txt')) assert(os.remove('b.txt'))\n"
                "local ok, why = os.remove('b.txt') assert(ok == nil and why)"),
            "");
}

TEST_F(Sandbox, FilesAreReadFromAnywhere) {
  write_file("data.txt", "1 2\n3 4\n");
  const std::string path = (folder / "data.txt").string();
  EXPECT_EQ(value("io.open('" + path + "'):read('l')"), "1 2");
  EXPECT_EQ(run("local n = 0 for line in io.lines('" + path + "') do n = n + 1 end assert(n == 2)"), "");
  EXPECT_EQ(value("io.open('/nowhere/at/all')"), "nil");
  for (const char* function : {"io.lines", "io.input"}) {
    const std::string message = run(std::string("local n = 1\n") + function + "('/nowhere/at/all')");
    EXPECT_NE(message.find(":2: /nowhere/at/all: No such file"), std::string::npos) << message;
  }
}

TEST_F(Sandbox, ReplacingGlobalsOpensNoDoor) {
  EXPECT_EQ(run("string.find = function() return nil end\ntostring = function() return 'r' end\n"
                "type = function() return 'string' end\nerror = function() end\nselect = nil"),
            "");
  EXPECT_NE(run("io.open('/tmp/asperity-escape.txt', 'w')"), "");
  EXPECT_NE(
      run("io.open('/tmp/asperity-escape.txt', setmetatable({}, { __tostring=function() return 'r' end }))"),
      "");
  EXPECT_FALSE(std::filesystem::exists("/tmp/asperity-escape.txt"));
}

TEST_F(Sandbox, TrustGivesTheWholeOfLua) {
  open_trusted();
  EXPECT_EQ(value("os.execute('true')"), "true");
  EXPECT_EQ(value("type(package.loadlib)"), "function");
  EXPECT_EQ(value("type(debug.sethook)"), "function");
  EXPECT_EQ(value("load(string.dump(function() return 7 end))()"), "7");
  const std::string path = (folder / "anywhere.txt").string();
  EXPECT_EQ(run("local f = assert(io.open('" + path + "', 'w')) f:write('x') f:close() assert(os.remove('" +
                path + "'))"),
            "");
  EXPECT_EQ(run("lab.surface.flat{ cells=2, size=1 }:write '" + (folder / "s.npy").string() + "'"), "");
  EXPECT_TRUE(std::filesystem::exists(folder / "s.npy"));
  EXPECT_NE(run("print(undefined_thing)"), "");
}

}  // namespace
}  // namespace asperity::lua::sandbox_test
