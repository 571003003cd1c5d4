// SPDX-License-Identifier: GPL-3.0-or-later
// Removes files beyond a run's limit, the record last, without following links.
#include "bindings/cli/disk_bound.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/support/run_fixture.hpp"

namespace asperity::cli::disk_bound_test {
namespace {

namespace fs = std::filesystem;

class DiskBound : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    fs::create_directories(folder / "run");
  }

  void put(const char* name, std::size_t bytes, int age) {
    const fs::path path = folder / "run" / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << std::string(bytes, 'x');
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::seconds(age));
  }
  bool there(const char* name) const { return fs::exists(fs::symlink_status(folder / "run" / name)); }
};

TEST_F(DiskBound, TheLastWrittenGoFirstAndTheRecordLast) {
  put("manifest.json", 5000, 0);
  put("old.csv", 100000, 100);
  put("newer.csv", 100000, 50);
  put("below/newest.csv", 100000, 1);
  const auto whole = disk_use(folder / "run", 100);
  EXPECT_EQ(whole.files, 5U);
  EXPECT_EQ(keep_within(folder / "run", whole.bytes, 100), "");
  EXPECT_NE(keep_within(folder / "run", whole.bytes - 150000, 100), "");
  EXPECT_TRUE(there("manifest.json") && there("old.csv"));
  EXPECT_FALSE(there("newer.csv") || there("below/newest.csv"));
  EXPECT_LE(disk_use(folder / "run", 100).bytes, whole.bytes - 150000);
}

TEST_F(DiskBound, NoMoreFilesAreLeftThanMayBe) {
  for (int k = 0; k < 40; ++k) put(("d" + std::to_string(k % 5) + "/f" + std::to_string(k)).c_str(), 1, k);
  put(".lock", 1, 0);
  EXPECT_NE(keep_within(folder / "run", 1 << 30, 10), "");
  EXPECT_LE(disk_use(folder / "run", 100).files, 10U);
  EXPECT_TRUE(there(".lock"));  // the remover holds the lock
}

TEST_F(DiskBound, LinksAreRemovedAndNotFollowed) {
  std::ofstream(folder / "elsewhere") << "kept";
  put("a.csv", 10, 5);
  fs::create_symlink(folder / "elsewhere", folder / "run" / "link");
  fs::create_directory_symlink(folder, folder / "run" / "folder");
  EXPECT_NE(keep_within(folder / "run", 0, 0), "");
  EXPECT_FALSE(there("a.csv") || there("link") || there("folder"));
  EXPECT_TRUE(fs::exists(folder / "elsewhere"));
}

}  // namespace
}  // namespace asperity::cli::disk_bound_test
