// SPDX-License-Identifier: GPL-3.0-or-later
// Part of every test program: a test that leaks file descriptors fails and names their targets.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <system_error>

namespace asperity::testing {
namespace {

std::map<std::string, std::string> open_files() {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/fd", ignored)) {
    std::error_code gone;  // the descriptor of this listing
    const fs::path target = fs::read_symlink(entry.path(), gone);
    if (!gone) found.emplace(entry.path().filename().string(), target.string());
  }
  return found;
}

class OpenFiles final : public ::testing::EmptyTestEventListener {
  void OnTestStart(const ::testing::TestInfo&) override { before_ = open_files(); }
  void OnTestEnd(const ::testing::TestInfo&) override {
    for (const auto& [descriptor, target] : open_files())
      if (before_.count(descriptor) == 0 && target.find("/proc/") == std::string::npos)
        ADD_FAILURE() << "file descriptor " << descriptor << " was left open: " << target;
  }

  std::map<std::string, std::string> before_;
};

[[maybe_unused]] const bool listens = [] {
  ::testing::UnitTest::GetInstance()->listeners().Append(new OpenFiles);
  return true;
}();

}  // namespace
}  // namespace asperity::testing
