// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scripts/runner/process.hpp"

namespace asperity::scripts::command_line_test {
namespace {

namespace fs = std::filesystem;

class CommandLine : public testing::Test {
 protected:
  Outcome call(std::vector<std::string> arguments) {
    Start start;
    start.command = {ASPERITY_PROGRAM};
    start.command.insert(start.command.end(), arguments.begin(), arguments.end());
    start.folder = folder.path();
    return run_process(start);
  }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder.path() / name).parent_path());
    std::ofstream(folder.path() / name) << text;
  }
  bool exists(const std::string& name) { return fs::exists(folder.path() / name); }
  TemporaryFolder folder;
};

TEST_F(CommandLine, BadUsageEndsWithTwoAndMakesNothing) {
  write("good.lua", "print 'hello'");
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"rum"},
      {"run"},
      {"run", "nothere.lua"},
      {"run", "."},
      {"run", "--nonsense", "good.lua"},
      {"run", "good.lua", "--threads", "0"},
      {"run", "good.lua", "--threads", "many"},
      {"run", "good.lua", "--seed", "x"},
      {"run", "good.lua", "--limit-time", "5 kg"},
      {"run", "good.lua", "--limit-time", "-5s"},
      {"run", "good.lua", "--limit-time", "0"},
      {"run", "good.lua", "--limit-memory", "4X"},
      {"run", "good.lua", "--limit-memory", "-1"},
      {"run", "good.lua", "--out"},
      {"check"},
      {"check", "nothere.lua"},
      {"check", "good.lua", "--trust"},
      {"help", "nosuchthing"},
      {"lesson", "nosuchthing"},
      {"lesson", "--copy"},
      {"lesson", "tilt", "--copy", "--run"},
      {"accuracy"},
      {"accuracy", "nothere.lua"},
      {"accuracy", "good.lua", "--at-most", "5 kg"},
      {"accuracy", "good.lua", "--repeats", "0"},
      {"accuracy", "good.lua", "--truth", "much"},
      {"accuracy", "good.lua", "--nonsense"},
  };
  for (const auto& arguments : wrong) {
    const Outcome outcome = call(arguments);
    std::string shown;
    for (const std::string& argument : arguments) shown += " " + argument;
    EXPECT_EQ(outcome.status, 2) << shown << "\n" << outcome.output << outcome.error;
    EXPECT_NE(outcome.error + outcome.output, "") << shown;
  }
  EXPECT_FALSE(exists("runs"));
}

TEST_F(CommandLine, AMissingScriptIsNamed) {
  EXPECT_NE(call({"run", "nothere.lua"}).error.find("there is no script `nothere.lua` that can be read"),
            std::string::npos);
  EXPECT_NE(call({"run", "."}).error.find("`.` is a folder"), std::string::npos);
}

TEST_F(CommandLine, RunsAreNumberedUp) {
  write("rub.lua", "print 'x'");
  for (int k = 1; k <= 3; ++k) {
    const Outcome outcome = call({"run", "rub.lua"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output, "x\n");
    const std::string name = "runs/rub-" + std::to_string(k);
    EXPECT_TRUE(exists(name));
    EXPECT_EQ(faults_of_run(folder.path() / name), std::vector<std::string>{});
    EXPECT_NE(outcome.error.find(name), std::string::npos) << outcome.error;
    EXPECT_EQ(content_of(folder.path() / name / "script.lua"), "print 'x'");
  }
}

TEST_F(CommandLine, AFullDirectoryIsRefusedAndLeftAlone) {
  write("s.lua", "print 'x'");
  write("full/precious.txt", "mine");
  const Outcome outcome = call({"run", "s.lua", "--out", "full"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("full"), std::string::npos);
  EXPECT_EQ(outcome.output, "");
  EXPECT_FALSE(exists("full/script.lua"));
  EXPECT_EQ(content_of(folder.path() / "full/precious.txt"), "mine");
  fs::create_directory(folder.path() / "empty");
  EXPECT_EQ(call({"run", "s.lua", "--out", "empty"}).status, 0);
  EXPECT_TRUE(exists("empty/manifest.json"));
  EXPECT_EQ(call({"run", "s.lua", "--out", "empty"}).status, 2);
  EXPECT_EQ(call({"run", "s.lua", "--out", "a/b/c"}).status, 0);
  EXPECT_EQ(call({"run", "s.lua", "--out", "s.lua"}).status, 2);  // a file is in the way
}

TEST_F(CommandLine, TheManifestSaysWhatRan) {
  write("s.lua",
        "local lab = require 'asperity'\nlab.surface.flat{ cells=4, size=1 }:write 'flat.npy'\n"
        "lab.notebook 'rows':write{ a=1 }");
  ASSERT_EQ(call({"run", "s.lua", "--out", "r", "--seed", "9", "--", "x", "-y"}).status, 0);
  const auto manifest = nlohmann::json::parse(content_of(folder.path() / "r/manifest.json"));
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["seed"], 9);
  EXPECT_EQ(manifest["script"]["name"], "s.lua");
  EXPECT_EQ(manifest["arguments"], (std::vector<std::string>{"x", "-y"}));
  const std::string outputs = manifest["outputs"].dump();
  EXPECT_NE(outputs.find("flat.npy"), std::string::npos);
  EXPECT_NE(outputs.find("rows.csv"), std::string::npos);
}

TEST_F(CommandLine, EqualRunsHaveEqualManifests) {
  write("s.lua",
        "local lab = require 'asperity'\n"
        "lab.surface.weierstrass_mandelbrot{ cells=32, D=2.5 }:write 'w.npy'");
  ASSERT_EQ(call({"run", "s.lua", "--out", "a", "--threads", "1"}).status, 0);
  ASSERT_EQ(call({"run", "s.lua", "--out", "b", "--threads", "2"}).status, 0);
  auto a = nlohmann::json::parse(content_of(folder.path() / "a/manifest.json"));
  auto b = nlohmann::json::parse(content_of(folder.path() / "b/manifest.json"));
  a.erase("unhashed");
  b.erase("unhashed");
  EXPECT_EQ(a.dump(), b.dump());
  EXPECT_EQ(content_of(folder.path() / "a/w.npy"), content_of(folder.path() / "b/w.npy"));
}

TEST_F(CommandLine, TrustIsNeededToReachOutside) {
  write("s.lua",
        "local f = assert(io.open('outside.txt', 'w')) f:write 'x' f:close()\nassert(os.execute 'true')");
  EXPECT_EQ(call({"run", "s.lua"}).status, 1);
  EXPECT_FALSE(exists("outside.txt"));
  EXPECT_TRUE(exists("runs/s-1/outside.txt"));
  const std::string path = (folder.path() / "outside.txt").string();
  write("t.lua",
        "local f = assert(io.open('" + path + "', 'w')) f:write 'x' f:close()\nassert(os.execute 'true')");
  EXPECT_EQ(call({"run", "t.lua"}).status, 1);
  EXPECT_FALSE(exists("outside.txt"));
  EXPECT_EQ(call({"run", "t.lua", "--trust"}).status, 0);
  EXPECT_TRUE(exists("outside.txt"));
}

TEST_F(CommandLine, ModulesBesideTheScriptAreFoundFromAnywhere) {
  write("lib/main.lua", "print(require('helper').answer)");
  write("lib/helper.lua", "return { answer=42 }");
  EXPECT_EQ(call({"run", "lib/main.lua"}).output, "42\n");
  EXPECT_EQ(call({"run", (folder.path() / "lib/main.lua").string()}).output, "42\n");
}

TEST_F(CommandLine, ScriptsWithAwkwardNamesRun) {
  for (const char* name :
       {"two words.lua", "Größe.lua", "no_ending", "-dash.lua", ".hidden.lua", "a.b.c.lua"}) {
    write(name, "print 'ran'");
    const Outcome outcome = call({"run", std::string("./") + name});
    EXPECT_EQ(outcome.status, 0) << name << outcome.error;
    EXPECT_EQ(outcome.output, "ran\n") << name;
  }
}

TEST_F(CommandLine, HelpMaterialsAndVersionAnswer) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"help"},
                                                    {"help", "lab.surface"},
                                                    {"help", "press"},
                                                    {"help", "State.area"},
                                                    {"help", "--reference"},
                                                    {"help", "--types"},
                                                    {"materials"},
                                                    {"version"},
                                                    {"--help"},
                                                    {"run", "--help"}}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments[0] << outcome.error;
    EXPECT_GT(outcome.output.size(), 20u) << arguments[0];
    EXPECT_EQ(outcome.error, "") << arguments[0];
  }
  EXPECT_NE(call({"materials"}).output.find("Al-2011"), std::string::npos);
  EXPECT_NE(call({"version"}).output.find("vectors   "), std::string::npos);
  EXPECT_NE(call({"help", "surfase"}).error.find("did you mean"), std::string::npos);
}

// A refusal lists commands in the parser's order.
TEST_F(CommandLine, EveryCommandStandsInTheOverviewAndExplainsItself) {
  std::istringstream overview(call({"help"}).output);
  std::string told;
  for (std::string program, command, rest;
       overview >> program >> command && program == "asperity" && std::getline(overview, rest);)
    told += command + " ";
  EXPECT_EQ(told,
            "run run replay press-log check explain cases status accuracy repl serve lesson help materials "
            "version ");
  std::istringstream lines(call({"help"}).output);
  std::set<std::size_t> columns;
  for (std::string line; std::getline(lines, line) && line.starts_with("asperity ");)
    columns.insert(line.find_first_not_of(' ', line.find("   ")));
  EXPECT_EQ(columns.size(), 1U) << testing::PrintToString(columns);

  const std::string refusal = call({"nocommand"}).error, before = "the commands are ";
  ASSERT_NE(refusal.find(before), std::string::npos) << refusal;
  std::istringstream listed(refusal.substr(refusal.find(before) + before.size()));
  for (std::string name; listed >> name;) {
    if (name == "and") continue;
    if (name.back() == ',') name.pop_back();
    EXPECT_NE((" " + told).find(" " + name + " "), std::string::npos) << name;
    const Outcome help = call({name, "--help"});
    EXPECT_EQ(help.status, 0) << name;
    EXPECT_NE(help.output.find("Usage: asperity " + name), std::string::npos) << help.output;
    EXPECT_EQ(call({"help", name}).output, help.output);
  }
}

TEST_F(CommandLine, LessonsAreListedShownCopiedAndRun) {
  EXPECT_NE(call({"lesson"}).output.find("6  tilt: Tilt it"), std::string::npos);
  EXPECT_NE(call({"lesson", "6"}).output.find("Predict: "), std::string::npos);
  EXPECT_EQ(call({"lesson", "fractal_dimension", "--copy"}).status, 0);
  EXPECT_TRUE(exists("02_fractal_dimension.lua"));
  write("02_fractal_dimension.lua", "print 'mine'");
  const Outcome refused = call({"lesson", "fractal_dimension", "--copy"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.error.find("is there already"), std::string::npos) << refused.error;
  EXPECT_EQ(call({"run", "02_fractal_dimension.lua"}).output, "mine\n");  // the edited copy
  const Outcome ran = call({"lesson", "fractal_dimension", "--run", "--out", "found"});
  EXPECT_EQ(ran.status, 0) << ran.error;
  EXPECT_NE(ran.output.find("Why: "), std::string::npos);
  EXPECT_TRUE(exists("found/stretched.svg"));
  EXPECT_NE(call({"lesson", "tild"}).error.find("did you mean `tilt`?"), std::string::npos);
}

// Three holds, each with a quarter turn.
std::string rows_of_a_log(const char* mark, bool turns) {
  std::ostringstream rows;
  const double loads[] = {20e3, 30e3, 40e3};
  for (int k = 0; k < 240; ++k) {
    const int part = k % 80;
    const double share = part < 20   ? 0
                         : part < 30 ? (part - 20) / 10.0
                         : part < 60 ? 1
                         : part < 70 ? (70 - part) / 10.0
                                     : 0;
    rows << k << mark << loads[k / 80] * share + 3 * ((k * 37) % 11 - 5);
    if (turns) rows << mark << 90 * ((k + 5) / 80);
    rows << "\n";
  }
  return rows.str();
}

TEST_F(CommandLine, APressLogOfATestingMachineIsFoundDrawnAndReplayed) {
  write("utm.csv",
        "\"Prüfprotokoll\";\"Nr. 7\"\n\"Prüfer\";\"Müller\"\n\"Datum\";\"23.11.2026\"\n\"Werkstoff\";\"Al\"\n"
        "\"Probe\";\"A 3\"\n\"Prüfzeit\";\"Standardkraft\";\"Drehwinkel\"\n\"s\";\"N\";\"°\"\n" +
            rows_of_a_log(";", true));
  const Outcome ran = call({"press-log", "utm.csv", "--area", "490 mm^2", "--turn-step", "90 deg", "--out",
                            "found", "--", "cells=32"});
  EXPECT_EQ(ran.status, 0) << ran.error;
  for (const char* told :
       {"found          3 holds, 0 peaks, 3 releases, 3 turns", "  hold  ", "  rise  ", "  release  ",
        "  turn  ", "turned by 90 deg", "press 81.6", "Ra of the lower body: "})
    EXPECT_NE(ran.output.find(told), std::string::npos) << told << "\n" << ran.output;
  EXPECT_NE(ran.error.find("the titles of its columns were found in line 6"), std::string::npos) << ran.error;
  EXPECT_TRUE(exists("found/press_log.svg") && exists("found/done.csv") && exists("found/manifest.json"));
  EXPECT_EQ(call({"replay", "found"}).status, 0);

  write(
      "pair.lua",
      "local lab = require 'asperity'\nlocal s = lab.surface.sine{ cells=32, size='1 mm', amplitude='1 um', "
      "material=lab.material 'Al-2011' }\nlocal function pair(p)\n  assert(p.presses == 3)\n  return "
      "lab.contact{ lower=s, upper=lab.rigid, boundary='periodic', effects={ elasticity='half_space' } "
      "}\nend\n"
      "return pair\n");
  const Outcome own =
      call({"press-log", "utm.csv", "--area", "490 mm^2", "--specimen", "pair.lua", "--skip", "5"});
  EXPECT_EQ(own.status, 0) << own.error;
  EXPECT_EQ(own.error.find("were found in line"), std::string::npos) << own.error;

  const Outcome without_area = call({"press-log", "utm.csv"});
  EXPECT_EQ(without_area.status, 1);
  EXPECT_NE(without_area.error.find("give the area of the specimen"), std::string::npos)
      << without_area.error;
  const Outcome wrong_skip = call({"press-log", "utm.csv", "--area", "490 mm^2", "--skip", "3"});
  EXPECT_NE(wrong_skip.error.find("its column titles are in line 6; give skip=5"), std::string::npos)
      << wrong_skip.error;
}

TEST_F(CommandLine, APressLogOfLabViewIsReadBelowItsHead) {
  write("labview.lvm",
        "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDate\t2026/11/23\n"
        "Time\t10:11:12.345678\n***End_of_Header***\t\n\nChannels\t2\t\nSamples\t240\t240\n"
        "X_Dimension\tTime\tTime\nX0\t0.0\t0.0\n***End_of_Header***\t\t\nTime [s]\tForce [N]\n" +
            rows_of_a_log("\t", false));
  const Outcome ran = call({"press-log", "labview.lvm", "--area", "490 mm^2", "--", "cells=32"});
  EXPECT_EQ(ran.status, 0) << ran.error;
  EXPECT_NE(ran.output.find("found          3 holds, 0 peaks, 3 releases"), std::string::npos) << ran.output;
  EXPECT_NE(ran.error.find("the titles of its columns were found in line 14"), std::string::npos)
      << ran.error;
}

// No option consumes the script or run after its value.
TEST_F(CommandLine, OptionsStandBeforeTheScriptOrAfterIt) {
  write("s.lua", "print 'ran'");
  ASSERT_EQ(call({"run", "s.lua", "--out", "kept"}).status, 0);
  const std::vector<std::vector<std::string>> options_of_run = {{"--reuse", "kept"},
                                                                {"--reuse", "kept", "--reuse", "kept"},
                                                                {"--seed", "3"},
                                                                {"--limit-time", "60s"},
                                                                {"--limit-memory", "1G"},
                                                                {"--threads", "1"},
                                                                {"--store-limit", "1G"},
                                                                {"--store", "shelf"},
                                                                {"--trust"},
                                                                {"--store", "shelf", "--shard", "1/1"}};
  for (const std::vector<std::string>& options : options_of_run) {
    std::vector<std::string> before = {"run"}, after = {"run", "s.lua"};
    before.insert(before.end(), options.begin(), options.end());
    before.emplace_back("s.lua");
    after.insert(after.end(), options.begin(), options.end());
    for (const std::vector<std::string>& arguments : {before, after}) {
      const Outcome outcome = call(arguments);
      EXPECT_EQ(outcome.status, 0) << options[0] << ": " << outcome.error;
      EXPECT_EQ(outcome.output, "ran\n") << options[0] << ": " << outcome.error;
    }
  }
  EXPECT_EQ(call({"run", "--out", "first", "s.lua"}).output, "ran\n");
  EXPECT_EQ(call({"check", "--seed", "3", "--limit-time", "60s", "s.lua"}).status, 0);
  EXPECT_EQ(call({"explain", "--json", "--seed", "3", "s.lua"}).status, 0);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--set", "press.pressure=1"}, {"--set", "cells=8", "--set", "size=1"}}) {
    std::vector<std::string> before = {"replay"}, after = {"replay", "kept"};
    before.insert(before.end(), options.begin(), options.end());
    before.emplace_back("kept");
    after.insert(after.end(), options.begin(), options.end());
    const Outcome one = call(before), other = call(after);
    EXPECT_EQ(one.status, other.status) << one.error << other.error;
    EXPECT_NE(one.status, 2) << one.error;
  }
}

TEST_F(CommandLine, AnUnwritableFolderIsAnErrorOfUsage) {
  write("s.lua", "print 'x'");
  EXPECT_EQ(call({"run", "s.lua", "--out", "/proc/nothing/here"}).status, 2);
}

TEST_F(CommandLine, OutputThatNobodyReadsIsNoCrash) {
  write("s.lua", "local f = io.open('/dev/full', 'r')\nprint 'x'\nio.stdout:write(('y'):rep(1e5))");
  Start start;
  start.command = {"sh", "-c", "'" ASPERITY_PROGRAM "' run s.lua > /dev/full"};
  start.folder = folder.path();
  const Outcome outcome = run_process(start);
  EXPECT_EQ(outcome.signal, 0);
  EXPECT_EQ(faults_of_run(folder.path() / "runs/s-1"), std::vector<std::string>{});
  start.command = {"sh", "-c", "'" ASPERITY_PROGRAM "' run s.lua | true"};
  run_process(start);
}

}  // namespace
}  // namespace asperity::scripts::command_line_test
