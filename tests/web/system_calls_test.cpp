// SPDX-License-Identifier: GPL-3.0-or-later
// The filter alone: computations work, also under sanitizers; ways out are blocked.
#include "bindings/web/sandbox/confinement.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <string>
#include <thread>

#include "engine/core/sanitizers.hpp"

namespace asperity::web::system_calls_test {
namespace {

class SystemCalls : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = load_system_call_filter(); !missing.empty()) GTEST_SKIP() << missing;
  }
  // The work's result behind the filter; 100: no filter, 101: killed by a signal.
  static int confined(const std::function<int()>& work) {
    const pid_t process = ::fork();
    if (process == 0) ::_exit(confine_system_calls(Confined::script).empty() ? work() : 100);
    int status = 0;
    ::waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 101;
  }
};

// The undefined-behaviour sanitizer inspects a type when a thread starts, or aborts.
TEST_F(SystemCalls, WorkBesideTheMainOneBeginsBehindTheFilter) {
  EXPECT_EQ(confined([] {
              int sum = 0;
              std::thread adding([&sum] { sum = 7; });
              adding.join();
              return sum;
            }),
            7);
}

TEST_F(SystemCalls, ProgramsAndSocketsAreRefused) {
  EXPECT_EQ(confined([] {
              char name[] = "/bin/true";
              char* const arguments[] = {name, nullptr};
              ::execv(name, arguments);
              return errno == EPERM ? 1 : 2;
            }),
            1);
  EXPECT_EQ(confined([] { return ::socket(AF_INET, SOCK_STREAM, 0) < 0 && errno == EPERM ? 1 : 2; }), 1);
}

// Only sanitizers need a pipe.
TEST_F(SystemCalls, APipeIsMadeForASanitizerAlone) {
  EXPECT_EQ(confined([] {
              int ends[2];
              return ::pipe(ends) == 0 ? 1 : errno == EPERM ? 2 : 3;
            }),
            sanitized ? 1 : 2);
}

}  // namespace
}  // namespace asperity::web::system_calls_test
