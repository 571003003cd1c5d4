// SPDX-License-Identifier: GPL-3.0-or-later
// Removed but open files count against the disk limit.
#include "bindings/cli/disk_bound.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace asperity::cli::unlinked_files_test {
namespace {

class UnlinkedFiles : public testing::Test {
 protected:
  UnlinkedFiles() : path_(testing::TempDir() + "asperity-unlinked-XXXXXX") {
    file_ = ::mkstemp(path_.data());
  }
  ~UnlinkedFiles() override {
    ::close(file_);
    ::unlink(path_.c_str());
  }
  void write(std::size_t bytes) const {
    const std::string text(bytes, 'x');
    ASSERT_EQ(::write(file_, text.data(), bytes), static_cast<ssize_t>(bytes));
    ::fsync(file_);
  }
  std::int64_t size() const {
    struct stat facts {};
    return ::fstat(file_, &facts) == 0 ? std::int64_t{facts.st_size} : -1;
  }

  std::string path_;
  int file_ = -1;
};

TEST_F(UnlinkedFiles, AFileWithANameIsNoneOfThem) {
  empty_unlinked_files();  // inherited files
  const std::int64_t before = unlinked_bytes();
  write(100'000);
  EXPECT_EQ(unlinked_bytes(), before);
  empty_unlinked_files();
  EXPECT_EQ(size(), 100'000);
  ::unlink(path_.c_str());
  EXPECT_GE(unlinked_bytes(), before + 100'000);
}

TEST_F(UnlinkedFiles, BeyondTheBoundTheyAreEmptied) {
  ::unlink(path_.c_str());
  const UnlinkedFilesBound bound(unlinked_bytes() + 200'000);
  write(100'000);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  EXPECT_EQ(size(), 100'000);
  write(300'000);
  for (int tries = 0; size() > 0 && tries < 500; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(size(), 0);
}

}  // namespace
}  // namespace asperity::cli::unlinked_files_test
