// SPDX-License-Identifier: GPL-3.0-or-later
// All files are on disk before the manifest says done. Replaces fsync and rename to record their order.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "engine/run/result_files.hpp"
#include "engine/run/run_directory.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::durable_end_test {
namespace {

struct Trace {
  std::mutex mutex;
  std::vector<std::string> steps;
  std::atomic<bool> on{false};
  void add(std::string step) {
    if (!on.load()) return;
    const std::lock_guard lock(mutex);
    steps.push_back(std::move(step));
  }
};

Trace& trace() {
  static Trace kept;
  return kept;
}

std::string path_of(int descriptor) {
  std::array<char, 4096> path{};
  const ssize_t length =
      ::readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path.data(), path.size());
  return {path.data(), static_cast<std::size_t>(length > 0 ? length : 0)};
}

}  // namespace
}  // namespace asperity::durable_end_test

extern "C" int fsync(int descriptor) {
  asperity::durable_end_test::trace().add("sync " + asperity::durable_end_test::path_of(descriptor));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

extern "C" int rename(const char* from, const char* to) noexcept {
  asperity::durable_end_test::trace().add(std::string("from ") + from);
  asperity::durable_end_test::trace().add(std::string("to ") + to);
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace asperity::durable_end_test {
namespace {

class DurableEnd : public InFolder {
 protected:
  void TearDown() override {
    trace().on = false;
    trace().steps.clear();
    InFolder::TearDown();
  }
  static long first(const std::string& step) {
    const auto& steps = trace().steps;
    return std::ranges::find(steps, step) - steps.begin();
  }
  static long last(const std::string& step) {
    const auto& steps = trace().steps;
    const auto found = std::find(steps.rbegin(), steps.rend(), step);
    return found == steps.rend() ? -1 : steps.rend() - found - 1;
  }
};

TEST_F(DurableEnd, EverythingListedIsOnTheDiskBeforeTheManifestSaysDone) {
  RunSetup setup;
  setup.script_name = "s.lua";
  setup.out = folder / "runs" / "one";
  RunDirectory run(setup);
  const std::vector<Entry> row = {{"mu", 0.4}};
  run.notebook("book")->write(row);
  std::ofstream(run.path_for("maps/high/a.png")) << "picture";
  run.path_for("never.png");
  trace().on = true;
  EXPECT_TRUE(run.finish(RunStatus::done));
  trace().on = false;
  const std::string root = run.path().string();
  const long said = last("to " + root + "/manifest.json");
  ASSERT_GE(said, 1);
  const Json manifest = Json::parse(content_of(run.path() / "manifest.json"), "manifest");
  std::vector<std::string> before = {
      root + "/journal.jsonl",    root,           root + "/maps", root + "/maps/high",
      (folder / "runs").string(), folder.string()};
  for (const Json& entry : manifest.find("outputs")->list())
    before.push_back(root + "/" + entry.find("file")->string());
  EXPECT_EQ(before.size(), 8U);
  for (const std::string& file : before) EXPECT_LT(first("sync " + file), said) << file;
  const std::string& part = trace().steps[static_cast<std::size_t>(said) - 1];
  EXPECT_LT(first("sync " + part.substr(5)), said) << part;
  EXPECT_GT(last("sync " + root), said);
}

// The end of the run waits for results of a shared file.
TEST_F(DurableEnd, ResultsThatShareAFileAreOnTheDiskBeforeTheManifestSaysDone) {
  RunSetup setup;
  setup.script_name = "s.lua";
  setup.out = folder / "one";
  RunDirectory run(setup);
  ResultFilesSetup kept;
  kept.folder = run.store();
  ResultFiles results(kept);
  run.before_its_end([&results] { results.bring_to_disk(); });
  ResultFacts facts;
  facts.one_of_many = true;
  facts.cost.seconds = 1;
  trace().on = true;
  const std::size_t cases = 200;
  for (std::size_t k = 0; k < cases; ++k)
    results.keep("case " + std::to_string(k), "lab.ensemble", facts, {});
  const std::string log =
      std::filesystem::directory_iterator(run.store() / ResultLog::folder_name)->path().string();
  EXPECT_LT(static_cast<std::size_t>(std::ranges::count(trace().steps, "sync " + log)), cases / 10);
  trace().steps.clear();
  EXPECT_TRUE(run.finish(RunStatus::done));
  trace().on = false;
  EXPECT_LT(first("sync " + log), last("to " + run.path().string() + "/manifest.json"));
}

// A resume needs both files.
TEST_F(DurableEnd, ScriptAndManifestAreOnTheDiskFromTheBeginning) {
  RunSetup setup;
  setup.script_name = "s.lua";
  setup.script_text = "return 1";
  setup.out = folder / "one";
  trace().on = true;
  const RunDirectory run(setup);
  trace().on = false;
  const std::string root = run.path().string();
  for (const char* file : {"/script.lua", "/manifest.json"}) {
    const long renamed = first(std::string("to ") + root + file);
    ASSERT_LT(renamed, static_cast<long>(trace().steps.size())) << file;
    EXPECT_LT(first("sync " + trace().steps[static_cast<std::size_t>(renamed) - 1].substr(5)), renamed)
        << file;
    EXPECT_GT(last("sync " + root), renamed) << file;
  }
  EXPECT_GE(last("sync " + folder.string()), 0);
}

TEST_F(DurableEnd, OfARunThatNobodyKeepsNothingIsWaitedFor) {
  RunSetup setup;
  setup.script_name = "s.lua";
  setup.out = folder / "one";
  setup.scratch = true;
  trace().on = true;
  RunDirectory run(setup);
  EXPECT_TRUE(run.finish(RunStatus::done));
  trace().on = false;
  EXPECT_EQ(std::ranges::count_if(trace().steps, [](const auto& step) { return step.starts_with("sync "); }),
            0);
  EXPECT_FALSE(std::filesystem::exists(run.path() / ".lock"));
}

}  // namespace
}  // namespace asperity::durable_end_test
