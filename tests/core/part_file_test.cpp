// SPDX-License-Identifier: GPL-3.0-or-later
// Names of files that are written aside: no two are one, each is known for what it is, and what a killed
// writer left is told from what somebody is writing.
#include "engine/core/files/part_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <set>
#include <string>

namespace asperity::part_file_test {
namespace {

namespace fs = std::filesystem;

class PartFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "asperity-part-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path make(const fs::path& file) const {
    std::ofstream(file) << "part";
    return file;
  }
  // A part of a process that has ended.
  fs::path left_by_the_dead(const fs::path& target) const {
    int name[2];
    EXPECT_EQ(::pipe(name), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      const std::string path = part_beside(target).string();
      const bool written = ::write(name[1], path.data(), path.size()) == static_cast<ssize_t>(path.size());
      ::_exit(written ? 0 : 1);
    }
    std::string path(4096, '\0');
    const ssize_t length = ::read(name[0], path.data(), path.size());
    path.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    ::waitpid(child, nullptr, 0);
    ::close(name[0]);
    ::close(name[1]);
    return make(path);
  }
  fs::path folder;
};

// F11: processes of two containers had one number and wrote one file.
TEST_F(PartFile, F11NoTwoNamesAreOne) {
  std::set<fs::path> names;
  for (int k = 0; k < 1000; ++k) names.insert(part_beside(folder / "a.h5"));
  EXPECT_EQ(names.size(), 1000U);
  for (const fs::path& name : names) {
    EXPECT_EQ(name.parent_path(), folder);
    EXPECT_EQ(name.extension(), ".h5");
    EXPECT_TRUE(is_part(name)) << name;
  }
}

TEST_F(PartFile, HasANameThatFileSystemsTake) {
  for (const std::string& stem : {std::string("a"), std::string(250, 'x')})
    for (const std::string& extension : {std::string(), std::string(".npy"), "." + std::string(200, 'y')}) {
      const fs::path part = part_beside(folder / (stem + extension));
      EXPECT_LE(part.filename().native().size(), 255U);
      EXPECT_TRUE(is_part(part));
    }
}

TEST_F(PartFile, IsKnownByItsName) {
  for (const char* name :
       {".n.1234-0.part.csv", ".n.h5.1234-17.part", ".a b.1a2b3c4d-7-0123456789abcdef.part.png"})
    EXPECT_TRUE(is_part(name)) << name;
  for (const char* name :
       {"n.csv", ".part", "n.1234-0.part.csv", ".n.part", ".n.1234.part", ".n.1234-0.part.a.b", ".n.x-0.part",
        ".n.1a2b3c4-7-0123456789abcdef.part", ".lock", ".hidden"})
    EXPECT_FALSE(is_part(name)) << name;
}

TEST_F(PartFile, F10IsAbandonedWhenItsWriterHasEndedOrIsSilentForADay) {
  const fs::path own = make(part_beside(folder / "a.csv")), dead = left_by_the_dead(folder / "a.csv"),
                 elsewhere = make(folder / ".a.00000000-1-0123456789abcdef.part.csv");
  EXPECT_FALSE(is_abandoned(own));
  EXPECT_TRUE(is_abandoned(dead));
  EXPECT_FALSE(is_abandoned(elsewhere));
  EXPECT_FALSE(is_abandoned(make(folder / "a.csv")));
  fs::last_write_time(elsewhere, fs::file_time_type::clock::now() - std::chrono::hours(25));
  EXPECT_TRUE(is_abandoned(elsewhere));
}

TEST_F(PartFile, F10IsSweptAsAsked) {
  const fs::path inner = folder / "maps";
  fs::create_directory(inner);
  const fs::path own = make(part_beside(folder / "a.csv")), kept = make(folder / "a.csv"),
                 deep = make(part_beside(inner / "b.png"));
  const fs::path dead = left_by_the_dead(folder / "a.csv");
  fs::create_directory_symlink(inner, folder / "link");
  EXPECT_EQ(sweep_parts(folder, Parts::abandoned, true), 1);
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_EQ(sweep_parts(folder, Parts::all), 1);
  EXPECT_FALSE(fs::exists(own));
  EXPECT_TRUE(fs::exists(deep));
  EXPECT_EQ(sweep_parts(folder, Parts::all, true), 1);
  EXPECT_FALSE(fs::exists(deep));
  EXPECT_TRUE(fs::exists(kept));
  EXPECT_EQ(sweep_parts(folder / "missing", Parts::all), 0);
}

}  // namespace
}  // namespace asperity::part_file_test
