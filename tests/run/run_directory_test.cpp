// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_directory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

#include "engine/core/digest.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/run_facts.hpp"
#include "engine/run/run_folder.hpp"
#include "tests/support/run_fixture.hpp"

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
  EXPECT_EQ(files_in(run.path()), 4U);  // and the lock
}

TEST_F(RunDirectoryTest, OutMayBeMissingOrEmptyOnly) {
  RunSetup s = setup();
  s.out = folder / "a" / "b";
  EXPECT_EQ(RunDirectory(s).path(), folder / "a" / "b");
  EXPECT_EQ(error_of([&] { RunDirectory again(s); }),
            "bad_value: `--out` names `" + s.out->string() +
                "`, which is not empty; give a new directory, or --resume to go on with the run there");
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

// A script must read the press.csv it wrote, not the file in the working directory.
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
           "` is outside the run directory; give a path in the run directory, or add `--trust`";
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
  for (const std::string file :
       {"manifest.json", "./journal.jsonl", "a/../script.lua", ".lock", ".views/x", "./.views/a/b"})
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
      // A closed journal refuses events.
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
  // An unread pipe blocks its writer like a dead disk.
  RunDirectory run(setup());
  const auto book = run.notebook("book");
  std::vector<Entry> row = {{"k", 1.0}};
  book->write(row);
  fs::remove(run.path() / "book.csv");
  ASSERT_EQ(::mkfifo((run.path() / "book.csv").c_str(), 0600), 0);
  std::thread writer([&] { book->write(row); });  // holds the notebook
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

TEST_F(RunDirectoryTest, IsLockedToItsEnd) {
  RunSetup s = setup();
  s.out = folder / "r";
  RunDirectory run(s);
  const std::string before = content_of(run.path() / "journal.jsonl");
  RunSetup again = setup();
  again.resume = s.out;
  for (const RunSetup& second : {s, again}) {
    const std::string refusal = error_of([&] { RunDirectory other(second); });
    EXPECT_NE(refusal.find("is being written by process " + std::to_string(::getpid())), std::string::npos)
        << refusal;
  }
  EXPECT_EQ(content_of(run.path() / "journal.jsonl"), before);
  EXPECT_TRUE(run.finish(RunStatus::interrupted));
  EXPECT_EQ(error_of([&] { RunDirectory taken_up(again); }), "");
}

// An interrupted run records its inputs.
TEST_F(RunDirectoryTest, KnowsWhatTheRunItTakesUpHasRead) {
  RunSetup s = setup();
  s.out = folder / "r";
  {
    RunDirectory run(s);
    EXPECT_FALSE(run.note_input("a.csv", 10, "d1"));
    EXPECT_FALSE(run.note_input("b.csv", 10, "d2"));
    EXPECT_EQ(manifest(run).find("unhashed")->find("inputs_so_far")->list().size(), 2U);
    EXPECT_EQ(manifest(run).find("inputs"), nullptr);
  }  // interrupted
  RunSetup again = setup();
  again.resume = s.out;
  RunDirectory run(again);
  EXPECT_FALSE(run.note_input("a.csv", 10, "d1"));
  EXPECT_TRUE(run.note_input("b.csv", 10, "another"));
  EXPECT_FALSE(run.note_input("c.csv", 10, "d3"));
  EXPECT_TRUE(run.finish(RunStatus::done));
  EXPECT_EQ(manifest(run).find("inputs")->list().size(), 3U);
  EXPECT_EQ(manifest(run).find("unhashed")->find("inputs_so_far"), nullptr);
}

// The directory is locked throughout for the other process.
TEST_F(RunDirectoryTest, OnePreparedForAnotherProcessIsLockedThroughout) {
  RunSetup s = setup();
  s.out = folder / "above" / "r";
  RunDirectory::Prepared prepared = RunDirectory::prepared_for(s);
  EXPECT_EQ(prepared.path, *s.out);
  EXPECT_NE(error_of([&] { RunDirectory::prepared_for(s); }).find("is being written by process"),
            std::string::npos);
  RunSetup inner = s;
  inner.lock = RunLock::inherited(prepared.path, ::dup(prepared.lock->descriptor()));
  {
    RunDirectory run(inner);
    EXPECT_TRUE(run.finish(RunStatus::interrupted));
  }
  inner.lock = nullptr;
  RunSetup again = setup();
  again.resume = s.out;
  EXPECT_NE(error_of([&] { RunDirectory other(again); }).find("is being written by process"),
            std::string::npos);
  prepared.leave();
  EXPECT_TRUE(fs::exists(*s.out / "manifest.json"));
  prepared = RunDirectory::prepared_for(again);
  EXPECT_FALSE(prepared.made);
  EXPECT_NE(error_of([&] { RunDirectory other(again); }), "");
  prepared.leave();
  EXPECT_EQ(error_of([&] { RunDirectory other(again); }), "");
}

TEST_F(RunDirectoryTest, NothingIsLeftOfOnePreparedInVain) {
  for (const char* kind : {"out", "resume", "numbered"}) {
    RunSetup s = setup();
    if (kind == std::string("out")) s.out = folder / "r";
    if (kind == std::string("resume")) s.resume = folder / "r";
    RunDirectory::Prepared prepared = RunDirectory::prepared_for(s);
    EXPECT_TRUE(prepared.made && prepared.lock != nullptr) << kind;
    prepared.leave();
    EXPECT_FALSE(fs::exists(prepared.path)) << kind;
  }
  fs::create_directory(folder / "mine");
  std::ofstream(folder / "mine" / "data.csv") << "1";
  RunSetup s = setup();
  s.resume = folder / "mine";
  RunDirectory::Prepared prepared = RunDirectory::prepared_for(s);
  prepared.leave();
  EXPECT_EQ(files_in(folder / "mine"), 1U);
}

// A run killed before its first manifest may start again.
TEST_F(RunDirectoryTest, WhatHasNotBegunMayBegin) {
  RunSetup s = setup();
  s.out = folder / "r";
  const auto leave = [&](const std::vector<std::string>& files) {
    fs::remove_all(*s.out);
    fs::create_directories(*s.out);
    for (const std::string& file : files)
      if (file == "store")
        fs::create_directory(*s.out / file);
      else
        std::ofstream(*s.out / file) << (file == "manifest.json" ? "" : "half");
  };
  const std::vector<std::vector<std::string>> not_begun = {
      {},
      {"script.lua"},
      {"script.lua", "journal.jsonl"},
      {".lock", "script.lua", "journal.jsonl", ".script.1a2b3c4d-7-0123456789abcdef.part.lua"},
      {"journal.jsonl", "store", ".manifest.12-0.part.json"},
      {"script.lua", "journal.jsonl", "manifest.json"}};
  for (const auto& files : not_begun) {
    leave(files);
    EXPECT_TRUE(is_not_begun(*s.out));
    RunDirectory run(s);
    EXPECT_TRUE(run.finish(RunStatus::done));
    EXPECT_EQ(content_of(run.path() / "script.lua"), s.script_text);
    EXPECT_EQ(manifest(run).find("status")->string(), "done");
    EXPECT_EQ(files_in(run.path()), files.size() == 3 && files[1] == "store" ? 5U : 4U);
  }
  for (const auto& files :
       std::vector<std::vector<std::string>>{{"script.lua", "mine.txt"}, {"journal.json"}}) {
    leave(files);
    EXPECT_FALSE(is_not_begun(*s.out));
    EXPECT_NE(error_of([&] { RunDirectory run(s); }).find("which is not empty"), std::string::npos);
    EXPECT_EQ(files_in(*s.out), files.size());
  }
  leave({});
  fs::create_symlink(folder / "elsewhere", *s.out / "journal.jsonl");
  EXPECT_FALSE(is_not_begun(*s.out));
}

TEST_F(RunDirectoryTest, AMoveAsideThatWasCutOffGoesOn) {
  const fs::path root = folder / "r";
  fs::create_directories(root / "before-1");
  fs::create_directories(root / "before-2");
  fs::create_directories(root / "store");
  for (const char* file : {"before-1/manifest.json", "before-2/manifest.json", "before-2/journal.jsonl",
                           "book.csv", "journal.jsonl", ".lock"})
    std::ofstream(root / file) << file;
  finish_moving_aside(root);
  EXPECT_EQ(content_of(root / "before-2" / "book.csv"), "book.csv");
  EXPECT_EQ(content_of(root / "before-2" / "journal.jsonl"), "before-2/journal.jsonl");
  EXPECT_TRUE(fs::exists(root / "store"));
  EXPECT_TRUE(is_not_begun(root));
}

TEST_F(RunDirectoryTest, AFinishedRunIsMendedOrSaysWhatCannotBe) {
  RunSetup s = setup();
  s.out = folder / "r";
  const auto work = [](RunDirectory& run, double value) {
    const std::vector<Entry> row = {{"mu", value}};
    run.notebook("book")->write(row);
    std::ofstream(run.path_for("maps/a.txt")) << "a map";
  };
  std::string whole;
  {
    RunDirectory run(s);
    work(run, 0.4);
    EXPECT_TRUE(run.finish(RunStatus::done));
    Json json = manifest(run);
    whole = json.set("unhashed", Json()).text();
  }
  RunSetup again = setup();
  again.resume = s.out;
  const auto damage = [&](int how) {
    if (how == 0) fs::resize_file(*s.out / "maps/a.txt", 0);
    if (how == 1) fs::remove(*s.out / "book.csv");
    if (how == 2) std::ofstream(*s.out / "book.csv") << "mu\n0.5\n";
  };
  for (int how = 0; how < 3; ++how) {
    damage(how);
    EXPECT_EQ(altered_outputs(read_run(*s.out)).size(), 1U);
    {
      const RunDirectory cut_off(again);  // the repair is interrupted
    }
    RunDirectory run(again);
    work(run, 0.4);
    EXPECT_TRUE(run.finish(RunStatus::done));
    EXPECT_TRUE(run.mended());
    EXPECT_TRUE(altered_outputs(read_run(*s.out)).empty());
    Json json = manifest(run);
    EXPECT_EQ(json.find("unhashed")->find("recorded_outputs"), nullptr);
    EXPECT_EQ(json.set("unhashed", Json()).text(), whole);
  }
  damage(2);
  RunDirectory run(again);
  work(run, 0.6);
  EXPECT_NE(
      error_of([&] { run.finish(RunStatus::done); }).find("`book.csv` could not be restored as recorded"),
      std::string::npos);
  EXPECT_FALSE(run.mended());
  EXPECT_EQ(manifest(run).find("status")->string(), "failed");
}

TEST_F(RunDirectoryTest, TheJournalIsKnownByItsDigest) {
  RunSetup s = setup();
  s.out = folder / "r";
  {
    RunDirectory run(s);
    const std::vector<Entry> row = {
        {"mu", 0.1 + 0.2}, {"text", std::string("a\"b")}, {"whole", 3.0}, {"nan", std::nan("")}};
    run.notebook("book")->write(row);
    EXPECT_TRUE(run.finish(RunStatus::done));
  }
  EXPECT_EQ(read_run(*s.out).journal_fault, "");
  const std::string whole = content_of(*s.out / "journal.jsonl");
  std::string altered = whole;
  altered[altered.find("whole\":3") + 7] = '4';
  std::ofstream(*s.out / "journal.jsonl", std::ios::binary) << altered;
  EXPECT_NE(read_run(*s.out).journal_fault.find("was altered since the run"), std::string::npos);
  std::ofstream(*s.out / "journal.jsonl", std::ios::binary) << whole.substr(0, whole.find('\n') + 1);
  EXPECT_NE(read_run(*s.out).journal_fault, "");
  fs::remove(*s.out / "journal.jsonl");
  EXPECT_NE(read_run(*s.out, true).journal_fault, "");
  EXPECT_THROW(read_run(*s.out), Error);
}

TEST_F(RunDirectoryTest, AJournalThatIsTakenAwayUnderWayIsNoticed) {
  RunSetup s = setup();
  s.out = folder / "r";
  RunDirectory run(s);
  fs::remove(run.path() / "journal.jsonl");
  EXPECT_NE(error_of([&] { run.finish(RunStatus::done); }).find("was removed while the run wrote it"),
            std::string::npos);
  EXPECT_EQ(manifest(run).find("status")->string(), "failed");
  RunSetup again = setup();
  again.resume = s.out;
  again.journal_lost = true;
  RunDirectory taken_up(again);
  EXPECT_TRUE(taken_up.finish(RunStatus::done));
  EXPECT_EQ(read_run(*s.out).journal.size(), 2U);
}

// A link replaces each of the run's own files and folders.
TEST_F(RunDirectoryTest, ALinkInTheirPlaceIsRefusedAndLeadsNowhere) {
  RunSetup s = setup();
  s.out = folder / "r";
  {
    RunDirectory run(s);
    EXPECT_TRUE(run.finish(RunStatus::interrupted));
  }
  fs::create_directory(folder / "victim");
  RunSetup again = setup();
  again.resume = s.out;
  for (const char* own : {"script.lua", "manifest.json", "journal.jsonl", ".lock", "store"})
    for (const bool anew : {false, true}) {
      const fs::path file = *s.out / own, aside = folder / "aside", victim = folder / "victim" / own;
      fs::remove_all(aside);
      if (fs::exists(file)) {
        fs::rename(file, aside);
        fs::copy_file(aside, victim, fs::copy_options::overwrite_existing);
      } else {
        fs::create_directories(victim);
      }
      fs::create_symlink(victim, file);
      const std::string before = fs::is_directory(victim) ? "" : content_of(victim);
      again.anew = anew;
      EXPECT_NE(error_of([&] { RunDirectory run(again); }).find("` is a link"), std::string::npos) << own;
      EXPECT_EQ(fs::is_directory(victim) ? "" : content_of(victim), before) << own;
      EXPECT_TRUE(fs::is_symlink(file)) << own;
      fs::remove(file);
      if (fs::exists(aside)) fs::rename(aside, file);
    }
  again.anew = false;
  EXPECT_EQ(error_of([&] { RunDirectory run(again); }), "");
}

// A linked table is replaced.
TEST_F(RunDirectoryTest, ATableIsNotAppendedToThroughALink) {
  RunDirectory run(setup());
  std::vector<Entry> row = {{"k", 1.0}};
  run.notebook("book")->write(row);
  std::ofstream(folder / "victim") << "mine\n";
  fs::remove(run.path() / "book.csv");
  fs::create_symlink(folder / "victim", run.path() / "book.csv");
  run.notebook("book")->write(row);
  EXPECT_EQ(content_of(folder / "victim"), "mine\n");
  EXPECT_EQ(content_of(run.path() / "book.csv"), "k\n1\n1\n");
}

// Resuming a run leaves its hard-linked copy (cp -al) unchanged.
TEST_F(RunDirectoryTest, ACopyByHardLinksIsAnotherRun) {
  RunSetup s = setup();
  s.out = folder / "r";
  std::vector<Entry> row = {{"k", 1.0}};
  {
    RunDirectory run(s);
    run.notebook("book")->write(row);
    EXPECT_TRUE(run.finish(RunStatus::interrupted));
  }
  for (const char* taken : {"copy", "r"}) {
    fs::remove_all(folder / "copy");
    fs::copy(folder / "r", folder / "copy",
             fs::copy_options::recursive | fs::copy_options::create_hard_links);
    EXPECT_EQ(fs::hard_link_count(folder / "r/.lock"), 2U);
    const fs::path other = folder / (std::string(taken) == "r" ? "copy" : "r");
    std::map<fs::path, std::string> before;
    for (const auto& entry : fs::directory_iterator(other))
      if (entry.is_regular_file()) before[entry.path()] = content_of(entry.path());
    EXPECT_TRUE(before.contains(other / "journal.jsonl") && before.contains(other / "book.csv"));
    RunSetup again = setup();
    again.resume = folder / taken;
    RunDirectory run(again);
    run.notebook("book")->write(row);
    run.notebook("book")->write(row);
    EXPECT_EQ(error_of([&] { RunLock::take(other); }), "");
    EXPECT_NE(error_of([&] { RunLock::take(folder / taken); }), "");
    EXPECT_TRUE(run.finish(RunStatus::interrupted));
    EXPECT_EQ(content_of(run.path() / "book.csv"), "k\n1\n1\n");
    before.erase(other / ".lock");
    for (const auto& [file, bytes] : before) EXPECT_EQ(content_of(file), bytes) << file;
  }
}

// A table with a second hard link is replaced too.
TEST_F(RunDirectoryTest, ATableIsNotAppendedToUnderItsOtherName) {
  RunDirectory run(setup());
  std::vector<Entry> row = {{"k", 1.0}};
  run.notebook("book")->write(row);
  fs::create_hard_link(run.path() / "book.csv", folder / "copy.csv");
  run.notebook("book")->write(row);
  EXPECT_EQ(content_of(folder / "copy.csv"), "k\n1\n");
  EXPECT_EQ(content_of(run.path() / "book.csv"), "k\n1\n1\n");
}

TEST_F(RunDirectoryTest, TakenUpItHasNoPartsOfAKilledWriter) {
  RunSetup s = setup();
  s.out = folder / "r";
  {
    RunDirectory run(s);
    fs::create_directories(run.path() / "store");
    for (const char* part : {".n.12-3.part.csv", "store/.x.1a2b3c4d-1-0123456789abcdef.part.h5"})
      std::ofstream(run.path() / part) << "half";
    EXPECT_TRUE(run.finish(RunStatus::interrupted));
  }
  RunSetup again = setup();
  again.resume = s.out;
  const RunDirectory run(again);
  EXPECT_EQ(files_in(run.path()), 5U);
  EXPECT_EQ(files_in(run.path() / "store"), 0U);
}

}  // namespace
}  // namespace asperity::run_directory_test
