// SPDX-License-Identifier: GPL-3.0-or-later
// The run directory: where it is made, what may be written where, the manifest, and how a run ends.
#include "engine/experiment/run_directory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <sstream>
#include <thread>
#include <vector>

#include "engine/core/digest.hpp"
#include "engine/experiment/run_facts.hpp"
#include "tests/experiment/run_fixture.hpp"

namespace asperity::run_directory_test {
namespace {

namespace fs = std::filesystem;

class RunDirectoryTest : public InFolder {
 protected:
  RunSetup setup() const {
    RunSetup s;
    s.script_name = "examples/fig9.lua";
    s.script_text = "print 'hello'\n";
    s.runs = folder / "runs";
    s.arguments = {"20", "A"};
    s.versions = Json::object({{"asperity", "0.1.0"}});
    return s;
  }
  static Json manifest(const RunDirectory& run) {
    return Json::parse(content_of(run.path() / "manifest.json"), "manifest.json");
  }
};

TEST_F(RunDirectoryTest, TakesTheFirstFreeNumber) {
  const RunDirectory one(setup()), two(setup());
  EXPECT_EQ(one.path(), folder / "runs" / "fig9-1");
  EXPECT_EQ(two.path(), folder / "runs" / "fig9-2");
  fs::create_directory(folder / "runs" / "fig9-3");
  EXPECT_EQ(RunDirectory(setup()).path(), folder / "runs" / "fig9-4");
}

TEST_F(RunDirectoryTest, ThreadsNeverShareOne) {
  std::vector<std::string> paths(8);
  std::vector<std::thread> threads;
  for (std::string& path : paths)
    threads.emplace_back([&path, this] { path = RunDirectory(setup()).path().string(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::set<std::string>(paths.begin(), paths.end()).size(), paths.size());
}

TEST_F(RunDirectoryTest, MadeLaterIsThereWithItsFirstFile) {
  std::string text = "one\n";
  {
    RunDirectory unused(setup(), [&] { return text; });
    unused.journal().write("call");
    EXPECT_EQ(unused.place_to_read("here.csv"), "here.csv");
    EXPECT_TRUE(unused.finish(RunStatus::done));
    EXPECT_TRUE(unused.path().empty());
    EXPECT_FALSE(fs::exists(folder / "runs"));
  }
  RunDirectory run(setup(), [&] { return text; });
  EXPECT_EQ(run.path_for("a.csv"), folder / "runs" / "fig9-1" / "a.csv");
  EXPECT_EQ(content_of(run.path() / "script.lua"), "one\n");
  run.journal().write("call");
  text += "two\n";
  EXPECT_TRUE(run.finish(RunStatus::done));
  EXPECT_EQ(content_of(run.path() / "script.lua"), "one\ntwo\n");
  EXPECT_NE(content_of(run.path() / "journal.jsonl").find("\"event\":\"call\""), std::string::npos);
  EXPECT_EQ(manifest(run).find("script")->find("digest")->string(), Digester().add(text).hex());
}

TEST_F(RunDirectoryTest, BeginsWithScriptManifestAndJournal) {
  const RunDirectory run(setup());
  EXPECT_EQ(content_of(run.path() / "script.lua"), "print 'hello'\n");
  EXPECT_EQ(manifest(run).find("status")->string(), "running");
  EXPECT_NE(
      content_of(run.path() / "journal.jsonl").find("{\"n\":1,\"event\":\"begin\",\"script\":\"fig9.lua\""),
      std::string::npos);
  EXPECT_EQ(files_in(run.path()), 3U);
}

TEST_F(RunDirectoryTest, OutMayBeMissingOrEmptyOnly) {
  RunSetup s = setup();
  s.out = folder / "a" / "b";
  EXPECT_EQ(RunDirectory(s).path(), folder / "a" / "b");
  EXPECT_EQ(error_of([&] { RunDirectory again(s); }),
            "bad_value: `--out` names `" + s.out->string() + "`, which is not empty; give a new directory");
  s.out = folder / "empty";
  fs::create_directory(*s.out);
  EXPECT_EQ(RunDirectory(s).path(), *s.out);
  s.out = folder / "file";
  std::ofstream(*s.out) << "x";
  EXPECT_EQ(error_of([&] { RunDirectory file(s); }),
            "bad_value: `--out` names `" + s.out->string() +
                "`, which is a file; give the name of a new directory");
}

TEST_F(RunDirectoryTest, FilesGoUnderIt) {
  RunDirectory run(setup());
  EXPECT_EQ(run.path_for("chart.svg"), run.path() / "chart.svg");
  EXPECT_EQ(run.path_for("maps/high/a.png"), run.path() / "maps" / "high" / "a.png");
  EXPECT_TRUE(fs::is_directory(run.path() / "maps" / "high"));
  EXPECT_EQ(run.path_for("maps/../b.png"), run.path() / "b.png");
  EXPECT_EQ(run.path_for("./c.png"), run.path() / "c.png");
}

// A script that writes press.csv and reads it back once got the one beside it.
TEST_F(RunDirectoryTest, WhatTheRunWroteIsReadBeforeWhatLiesBeside) {
  const fs::path beside = fs::current_path();
  fs::current_path(folder);
  {
    RunDirectory run(setup());
    std::ofstream("press.csv") << "beside";
    std::ofstream("other.csv") << "beside";
    EXPECT_EQ(run.place_to_read("press.csv"), "press.csv");
    std::ofstream(run.path_for("./press.csv")) << "of the run";
    EXPECT_EQ(content_of(run.place_to_read("press.csv")), "of the run");
    EXPECT_EQ(content_of(run.place_to_read("maps/../press.csv")), "of the run");
    EXPECT_EQ(run.place_to_read("other.csv"), "other.csv");
    run.path_for("other.csv");  // not yet written
    EXPECT_EQ(run.place_to_read("other.csv"), "other.csv");
    EXPECT_EQ(run.place_to_read((folder / "press.csv").string()), folder / "press.csv");
  }
  fs::current_path(beside);
}

TEST_F(RunDirectoryTest, RefusesEveryWayOut) {
  RunDirectory run(setup());
  const auto refused = [](std::string_view file) {
    return "not_permitted: the file `" + std::string(file) +
           "` lies outside the run directory; files are written only under the run directory; `--trust` "
           "lifts this";
  };
  fs::create_symlink("/tmp", run.path() / "link");
  for (const std::string file : {"/tmp/x", "../x", "a/../../x", "maps/../../fig9-1x/x", "link/x"})
    EXPECT_EQ(error_of([&] { run.path_for(file); }), refused(file));
  EXPECT_FALSE(fs::exists(folder / "runs" / "x"));
}

TEST_F(RunDirectoryTest, RefusesWhatIsNoFile) {
  RunDirectory run(setup());
  fs::create_directory(run.path() / "sub");
  EXPECT_EQ(error_of([&] { run.path_for(""); }),
            "bad_value: `` is not the name of a file; give a name such as \"heights.npy\"");
  for (const std::string file : {".", "..", "sub/", "a/.."})
    EXPECT_NE(error_of([&] { run.path_for(file); }), "") << file;
  EXPECT_NE(error_of([&] { run.path_for(std::string_view("a\0b", 3)); }), "");
  EXPECT_EQ(error_of([&] { run.path_for("sub"); }), "bad_value: `sub` is a folder; give the name of a file");
}

TEST_F(RunDirectoryTest, KeepsItsOwnFilesToItself) {
  RunSetup s = setup();
  s.trusted = true;
  RunDirectory run(s);
  // S10: also what the page draws of it.
  for (const std::string file :
       {"manifest.json", "./journal.jsonl", "a/../script.lua", ".views/x", "./.views/a/b"})
    EXPECT_EQ(error_of([&] { run.path_for(file); }).substr(0, 14), "not_permitted:") << file;
  EXPECT_EQ(error_of([&] { run.path_for((run.path() / "manifest.json").string()); }).substr(0, 14),
            "not_permitted:");
}

TEST_F(RunDirectoryTest, TrustLiftsTheFence) {
  RunSetup s = setup();
  s.trusted = true;
  RunDirectory run(s);
  EXPECT_EQ(run.path_for((folder / "far" / "x.csv").string()), folder / "far" / "x.csv");
  EXPECT_EQ(run.path_for("../x.csv"), run.path() / "../x.csv");
}

TEST_F(RunDirectoryTest, UnwritablePlaceIsAClearError) {
  RunSetup s = setup();
  s.runs = "/proc/nowhere/runs";
  EXPECT_NE(
      error_of([&] { RunDirectory run(s); }).find("bad_file: cannot make the folder `/proc/nowhere/runs`"),
      std::string::npos);
}

TEST_F(RunDirectoryTest, EqualRunsHaveEqualManifestsApartFromUnhashed) {
  std::vector<std::string> texts;
  for (const int threads : {1, 2}) {
    RunSetup s = setup();
    s.threads = threads;
    RunDirectory run(s);
    run.note_input(threads == 1 ? "a.x3p" : "b.csv", 10, "d1");
    run.note_input(threads == 1 ? "b.csv" : "a.x3p", 10, "d1");
    const std::vector<Entry> row = {{"mu", 0.4}};
    run.notebook("book")->write(row);
    run.path_for("never-written.png");
    run.note("plan", Json::List{1, 2});
    EXPECT_TRUE(run.finish(RunStatus::done));
    Json json = manifest(run);
    EXPECT_NE(json.find("unhashed")->find("seconds"), nullptr);
    EXPECT_EQ(json.find("unhashed")->find("threads")->number(), threads);
    EXPECT_EQ(json.find("outputs")->list().size(), 1U);
    json.set("unhashed", Json());
    texts.push_back(json.text(2));
  }
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_NE(texts[0].find("\"arguments\": [\n    \"20\",\n    \"A\"\n  ]"), std::string::npos);
}

TEST_F(RunDirectoryTest, EndsOnce) {
  RunDirectory run(setup());
  const std::vector<Entry> row = {{"mu", 0.4}};
  run.notebook("book")->write(row);
  Expectation e;
  e.column = "mu";
  e.at_least = 1;
  run.notebook("book")->expect(e);
  EXPECT_TRUE(run.finish(RunStatus::failed, "an expectation failed"));
  EXPECT_FALSE(run.finish(RunStatus::done));
  const Json json = manifest(run);
  EXPECT_EQ(json.find("status")->string(), "failed");
  EXPECT_EQ(json.find("reason")->string(), "an expectation failed");
  EXPECT_EQ(json.find("expectations")->list().size(), 1U);
  EXPECT_EQ(json.find("outputs")->list().at(0).find("digest")->string(),
            file_digest(run.path() / "book.csv"));
  EXPECT_TRUE(
      content_of(run.path() / "journal.jsonl")
          .ends_with("\"event\":\"end\",\"status\":\"failed\",\"reason\":\"an expectation failed\"}\n"));
  EXPECT_NE(error_of([&] { run.notebook("book")->write(row); }), "");
}

TEST_F(RunDirectoryTest, AWatchdogMayEndItDuringWrites) {
  RunDirectory run(setup());
  const auto book = run.notebook("book");
  std::atomic<int> written{0};
  std::thread writer([&] {
    try {
      for (int k = 0;; ++k) {
        const std::vector<Entry> row = {{"k", static_cast<double>(k)}};
        book->write(row);
        written = k + 1;
      }
    } catch (const Error&) {
      // The journal is closed: what the script would see.
    }
  });
  while (written < 50) std::this_thread::yield();
  EXPECT_TRUE(run.finish(RunStatus::killed, "the time limit of 1 s is reached"));
  writer.join();
  EXPECT_EQ(content_of(run.path() / "book.csv"), book->table().csv());
  std::istringstream lines(content_of(run.path() / "journal.jsonl"));
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line);)
    rows += Json::parse(line, "line").find("event")->string() == "row" ? 1 : 0;
  EXPECT_EQ(rows, book->table().rows());
  EXPECT_EQ(manifest(run).find("status")->string(), "killed");
}

TEST_F(RunDirectoryTest, AStuckWriterDoesNotHoldTheWatchdog) {
  // A file that is a pipe nobody reads blocks its writer, as a dead disk does.
  RunDirectory run(setup());
  const auto book = run.notebook("book");
  std::vector<Entry> row = {{"k", 1.0}};
  book->write(row);
  fs::remove(run.path() / "book.csv");
  ASSERT_EQ(::mkfifo((run.path() / "book.csv").c_str(), 0600), 0);
  std::thread writer([&] { book->write(row); });  // waits for a reader, holding the notebook
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(run.finish(RunStatus::killed, "stuck", std::chrono::milliseconds(100)));
  EXPECT_EQ(manifest(run).find("status")->string(), "killed");
  EXPECT_NE(content_of(run.path() / "journal.jsonl").find("\"event\":\"end\""), std::string::npos);
  {
    std::ifstream reader(run.path() / "book.csv");
    writer.join();
  }
}

TEST_F(RunDirectoryTest, OneNotebookAName) {
  RunDirectory run(setup());
  EXPECT_EQ(run.notebook("a b"), run.notebook("a b"));
  EXPECT_EQ(run.notebook("a b")->csv(), run.path() / "a-b.csv");
  EXPECT_EQ(run.notebook("a/b")->csv(), run.path() / "a-b-2.csv");
  EXPECT_EQ(run.notebook("../../x")->csv().parent_path(), run.path());
  EXPECT_EQ(error_of([&] { run.notebook(""); }), "bad_value: a notebook has an empty name; give it a name");
}

TEST_F(RunDirectoryTest, LooseRunWritesWhereItStands) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  RunDirectory run(RunDirectory::Without::loose);
  EXPECT_EQ(run.path_for("sub/a.csv"), fs::path("sub/a.csv"));
  EXPECT_NE(error_of([&] { run.path_for("../a.csv"); }), "");
  EXPECT_EQ(RunDirectory(RunDirectory::Without::loose, true).path_for("/tmp/a.csv"), fs::path("/tmp/a.csv"));
  const std::vector<Entry> row = {{"mu", 0.4}};
  run.notebook("book")->write(row);
  EXPECT_TRUE(run.finish(RunStatus::done));
  EXPECT_EQ(content_of("book.csv"), "mu\n0.4\n");
  EXPECT_FALSE(fs::exists("manifest.json"));
  fs::current_path(before);
}

TEST_F(RunDirectoryTest, DryRunWritesNothing) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  RunDirectory run(RunDirectory::Without::dry);
  run.path_for("sub/a.csv");
  const std::vector<Entry> row = {{"mu", 0.4}};
  run.notebook("book")->write(row);
  EXPECT_EQ(run.notebook("book")->table().rows(), 1U);
  EXPECT_NE(error_of([&] { run.path_for("/tmp/a.csv"); }), "");
  EXPECT_TRUE(run.finish(RunStatus::done));
  EXPECT_EQ(files_in(folder), 0U);
  fs::current_path(before);
}

}  // namespace
}  // namespace asperity::run_directory_test
