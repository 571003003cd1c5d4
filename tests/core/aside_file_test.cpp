// SPDX-License-Identifier: GPL-3.0-or-later
// Files written aside: whole or not at all, and what the system's refusals say.
#include "engine/core/files/aside_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/run_fixture.hpp"

namespace asperity::aside_file_test {
namespace {

using AsideFileTest = InFolder;

TEST_F(AsideFileTest, ReplacesTheWholeFileAndLeavesNothingBeside) {
  write_aside(folder / "a.txt", "first");
  write_aside(folder / "a.txt", "");
  EXPECT_EQ(content_of(folder / "a.txt"), "");
  write_aside(folder / "a.txt", "second");
  EXPECT_EQ(content_of(folder / "a.txt"), "second");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST_F(AsideFileTest, LeavesTheOldFileWhenNotCommitted) {
  write_aside(folder / "a.npy", "old");
  {
    const AsideFile aside(folder / "a.npy");
    EXPECT_EQ(aside.temporary().extension(), ".npy");
    std::ofstream(aside.temporary()) << "half";
  }
  EXPECT_EQ(content_of(folder / "a.npy"), "old");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST_F(AsideFileTest, SaysWhyItCannotWrite) {
  EXPECT_EQ(
      error_of([&] { write_aside(folder / "missing" / "a.txt", "x"); }),
      "bad_file: cannot write `" + (folder / "missing" / "a.txt").string() + "`: no such file or directory");
}

TEST_F(AsideFileTest, SaysThatTheDiskIsFull) {
  const int full = ::open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  EXPECT_EQ(error_of([&] { append_whole(full, "line\n", "journal.jsonl"); }),
            "bad_file: cannot write `journal.jsonl`: no space left on device; free some space on that disk, "
            "or write "
            "elsewhere with `--out`");
  ::close(full);
}

TEST_F(AsideFileTest, AppendsOnlyToWhatExists) {
  EXPECT_FALSE(append_to_existing(folder / "a.csv", "x\n"));
  write_aside(folder / "a.csv", "h\n");
  EXPECT_TRUE(append_to_existing(folder / "a.csv", "x\n"));
  EXPECT_EQ(content_of(folder / "a.csv"), "h\nx\n");
}

TEST(SafeFileName, KeepsWhatIsHarmless) {
  EXPECT_EQ(safe_file_name("rotation-memory_2.5"), "rotation-memory_2.5");
  EXPECT_EQ(safe_file_name("Rauheit (µm)"), "Rauheit-µm");
  EXPECT_EQ(safe_file_name("a'b`rm -rf /`"), "a-b-rm-rf");
  EXPECT_EQ(safe_file_name("../../etc/passwd"), "etc-passwd");
  EXPECT_EQ(safe_file_name(".hidden"), "hidden");
  EXPECT_EQ(safe_file_name(""), "unnamed");
  EXPECT_EQ(safe_file_name("///"), "unnamed");
}

TEST(SafeFileName, CutsLongNamesBetweenCharacters) {
  EXPECT_EQ(safe_file_name(std::string(500, 'x')).size(), 120U);
  std::string wide = "x";
  for (int k = 0; k < 100; ++k) wide += "µ";
  const std::string cut = safe_file_name(wide);
  EXPECT_EQ(cut, wide.substr(0, 119));
}

TEST_F(AsideFileTest, ADeviceOrPipeIsLeftWhatItIs) {
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(
      error_of([&] { write_aside(pipe, "text"); }),
      "bad_file: cannot write `" + pipe.string() + "`: it is a device or a pipe; give the name of a file");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

}  // namespace
}  // namespace asperity::aside_file_test
