// SPDX-License-Identifier: GPL-3.0-or-later
// One holder, named in errors; the lock ends with its process.
#include "engine/run/run_folder.hpp"

#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "tests/support/run_fixture.hpp"

namespace asperity::run_lock_test {
namespace {

namespace fs = std::filesystem;

class RunLockTest : public InFolder {
 protected:
  std::string held_by(pid_t process) const {
    utsname system{};
    ::uname(&system);
    return "`" + folder.string() + "` is being written by process " + std::to_string(process) + " on " +
           system.nodename;
  }
  pid_t holder(const RunLock::Ask& ask = RunLock::ask_system) const {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        const std::shared_ptr<RunLock> lock = RunLock::take(folder, ask);
        if (::write(ready[1], "y", 1) == 1)
          for (;;) ::pause();
      } catch (const Error&) {
      }
      ::_exit(1);
    }
    ::close(ready[1]);
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    return child;
  }
  static void kill(pid_t process) {
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
  static int no_locks(int) { return ENOLCK; }
};

TEST_F(RunLockTest, TheSecondComerIsToldProcessAndHostAndChangesNothing) {
  const std::shared_ptr<RunLock> lock = RunLock::take(folder);
  const std::string before = content_of(folder / ".lock");
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(error_of([&] { RunLock::take(folder); }),
              "bad_state: " + held_by(::getpid()) + "; wait until it has ended, or give another directory");
  EXPECT_NE(error_of([&] { RunLock::take_if_known(folder); }), "");
  EXPECT_EQ(content_of(folder / ".lock"), before);
  EXPECT_EQ(files_in(folder), 1U);
  lock->release();
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }), "");
}

TEST_F(RunLockTest, IsFreeOnceItsProcessIsKilled) {
  const pid_t child = holder();
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }).find("bad_state: " + held_by(child)), 0U);
  kill(child);
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }), "");
}

// A new holder may not have written its name.
TEST_F(RunLockTest, WhoIsNamedLives) {
  const pid_t child = holder();
  kill(child);
  fs::create_directory(folder / "other");
  const std::shared_ptr<RunLock> other = RunLock::take(folder / "other");
  const std::string name = content_of(folder / "other/.lock");
  int asked = 0;
  const auto ask = [&](int) {
    if (++asked == 3) std::ofstream(folder / ".lock") << name;
    return EAGAIN;
  };
  EXPECT_EQ(error_of([&] { RunLock::take(folder, ask); }),
            "bad_state: " + held_by(::getpid()) + "; wait until it has ended, or give another directory");
}

// One holds the lock until all others are refused.
TEST_F(RunLockTest, OfManyOneHasIt) {
  constexpr int comers = 8;
  int until[2];
  ASSERT_EQ(::pipe(until), 0);
  for (int k = 0; k < comers; ++k) {
    if (::fork() != 0) continue;
    ::close(until[1]);
    try {
      const std::shared_ptr<RunLock> lock = RunLock::take(folder);
      char end = 0;
      ::_exit(::read(until[0], &end, 1) == 0 ? 0 : 4);
    } catch (const Error& error) {
      ::_exit(std::string(error.what()).find("is being written by process ") != std::string::npos ? 2 : 3);
    }
  }
  ::close(until[0]);
  int held = 0, refused = 0;
  const auto wait_for = [&](int flags) {
    int status = 0;
    if (::waitpid(-1, &status, flags) <= 0) return false;
    held += WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 1 : 0;
    refused += WIFEXITED(status) && WEXITSTATUS(status) == 2 ? 1 : 0;
    return true;
  };
  int ended = 0;
  const auto last_try = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  while (ended + 1 < comers && std::chrono::steady_clock::now() < last_try)
    if (wait_for(WNOHANG))
      ++ended;
    else
      ::usleep(5'000);
  ::close(until[1]);
  for (; ended < comers; ++ended) wait_for(0);
  EXPECT_EQ(held, 1);
  EXPECT_EQ(refused, comers - 1);
}

TEST_F(RunLockTest, WithoutLocksProcessAndHostDecide) {
  const pid_t child = holder(no_locks);
  EXPECT_EQ(error_of([&] { RunLock::take(folder, no_locks); }),
            "bad_state: " + held_by(child) + "; wait until it has ended, or give another directory");
  kill(child);
  {
    const std::shared_ptr<RunLock> lock = RunLock::take(folder, no_locks);
    EXPECT_NE(lock->notice().find("has no locks"), std::string::npos);
    EXPECT_NE(error_of([&] { RunLock::take(folder, no_locks); }), "");
  }
  EXPECT_EQ(error_of([&] { RunLock::take(folder, no_locks); }), "");
  EXPECT_EQ(RunLock::take(folder)->notice(), "");
  std::ofstream(folder / ".lock")
      << "{\"process\":1,\"host\":\"another\",\"machine_start\":\"x\",\"process_space\":\"\","
         "\"process_start\":\"1\"}\n";
  EXPECT_EQ(error_of([&] { RunLock::take(folder, no_locks); }),
            "bad_state: `" + folder.string() +
                "` is being written by process 1 on another; if it has ended, remove `" +
                (folder / ".lock").string() + "`; this file system has no locks");
}

// A sandbox hides boot time and process namespace and forbids signals: the holder counts as alive.
TEST_F(RunLockTest, AHolderOfWhomLittleIsKnownIsBelievedToLive) {
  utsname system{};
  ::uname(&system);
  std::ofstream(folder / ".lock")
      << "{\"process\":999999999,\"host\":\"" << system.nodename
      << "\",\"machine_start\":\"\",\"process_space\":\"\",\"process_start\":\"\"}\n";
  EXPECT_EQ(error_of([&] { RunLock::take(folder, no_locks); }).find("bad_state: " + held_by(999999999)), 0U);
}

// The lock lasts as long as either process.
TEST_F(RunLockTest, AnInheritedLockHoldsUntilBothAreDone) {
  const std::string held = "bad_state: " + held_by(::getpid());
  std::shared_ptr<RunLock> parent = RunLock::take(folder);
  std::shared_ptr<RunLock> child = RunLock::inherited(folder, ::dup(parent->descriptor()));
  child->release();
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }).find(held), 0U);
  child = RunLock::inherited(folder, ::dup(parent->descriptor()));
  parent->release();
  EXPECT_NE(error_of([&] { RunLock::take(folder); }).find("is being written by another process"),
            std::string::npos);
  child.reset();
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }), "");
}

TEST_F(RunLockTest, IsFreeAtOnceThoughAChildIsStillDying) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t process = ::fork();
  if (process == 0) {
    const std::shared_ptr<RunLock> lock = RunLock::take(folder);
    if (::fork() == 0) {
      ::usleep(150'000);
      ::_exit(0);
    }
    if (::write(ready[1], "y", 1) == 1)
      for (;;) ::pause();
    ::_exit(1);
  }
  ::close(ready[1]);
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  ::close(ready[0]);
  kill(process);
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }), "");
}

TEST_F(RunLockTest, ATornNameHoldsNothing) {
  for (const char* text : {"", "{\"process\":1", "[]\n", "{}\n", "\n"}) {
    std::ofstream(folder / ".lock") << text;
    EXPECT_EQ(error_of([&] { RunLock::take(folder, no_locks); }), "") << text;
    std::ofstream(folder / ".lock") << text;
    EXPECT_EQ(error_of([&] { RunLock::take(folder); }), "") << text;
  }
}

TEST_F(RunLockTest, IsNoLink) {
  std::ofstream(folder / "victim") << "mine";
  fs::create_symlink(folder / "victim", folder / ".lock");
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }),
            "bad_file: `" + (folder / ".lock").string() +
                "` is a link; remove the link: a run writes its own files");
  EXPECT_EQ(content_of(folder / "victim"), "mine");
}

TEST_F(RunLockTest, AnotherNameOfItsFileKeepsItsBytes) {
  std::ofstream(folder / "victim") << "mine";
  fs::create_hard_link(folder / "victim", folder / ".lock");
  {
    const std::shared_ptr<RunLock> lock = RunLock::take(folder);
    EXPECT_NE(content_of(folder / ".lock"), "mine");
    EXPECT_NE(error_of([&] { RunLock::take(folder); }), "");
  }
  EXPECT_EQ(content_of(folder / "victim"), "mine");
  EXPECT_EQ(error_of([&] { RunLock::take(folder); }), "");
}

// The file may be replaced between opening and locking.
TEST_F(RunLockTest, OfAFileThatWasReplacedLocksTheNewOne) {
  int asked = 0;
  const std::shared_ptr<RunLock> lock = RunLock::take(folder, [&](int descriptor) {
    if (++asked == 1) {
      std::ofstream(folder / "new") << "";
      fs::rename(folder / "new", folder / ".lock");
    }
    return RunLock::ask_system(descriptor);
  });
  EXPECT_EQ(asked, 2);
  EXPECT_NE(error_of([&] { RunLock::take(folder); }), "");
}

TEST_F(RunLockTest, IsNotMadeWhereOnlyAskedFor) {
  EXPECT_EQ(RunLock::take_if_known(folder), nullptr);
  EXPECT_EQ(files_in(folder), 0U);
}

}  // namespace
}  // namespace asperity::run_lock_test
