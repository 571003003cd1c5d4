// SPDX-License-Identifier: GPL-3.0-or-later
// Atomic replacement of files; unique, recognisable temporary names that distinguish a killed from a running
// writer.
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <iterator>
#include <set>
#include <string>

#include "tests/support/run_fixture.hpp"

namespace asperity::atomic_file_test {
namespace {

namespace fs = std::filesystem;

using AtomicFileTest = InFolder;

TEST_F(AtomicFileTest, ReplacesTheWholeFileAndLeavesNothingBeside) {
  write_atomically(folder / "a.txt", "first");
  write_atomically(folder / "a.txt", "");
  EXPECT_EQ(content_of(folder / "a.txt"), "");
  write_atomically(folder / "a.txt", "second");
  EXPECT_EQ(content_of(folder / "a.txt"), "second");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST_F(AtomicFileTest, LeavesTheOldFileWhenNotCommitted) {
  write_atomically(folder / "a.npy", "old");
  {
    const AtomicFile atomic(folder / "a.npy");
    EXPECT_EQ(atomic.temporary().extension(), ".npy");
    std::ofstream(atomic.temporary()) << "half";
  }
  EXPECT_EQ(content_of(folder / "a.npy"), "old");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST_F(AtomicFileTest, SaysWhyItCannotWrite) {
  EXPECT_EQ(
      error_of([&] { write_atomically(folder / "missing" / "a.txt", "x"); }),
      "bad_file: cannot write `" + (folder / "missing" / "a.txt").string() + "`: no such file or directory");
}

TEST_F(AtomicFileTest, SaysThatTheDiskIsFull) {
  const int full = ::open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  EXPECT_EQ(error_of([&] { append_whole(full, "line\n", "journal.jsonl"); }),
            "bad_file: cannot write `journal.jsonl`: no space left on device; free some space on that disk, "
            "or write "
            "elsewhere with `--out`");
  ::close(full);
}

TEST_F(AtomicFileTest, AppendsOnlyToWhatExists) {
  EXPECT_FALSE(append_to_existing(folder / "a.csv", "x\n"));
  write_atomically(folder / "a.csv", "h\n");
  EXPECT_TRUE(append_to_existing(folder / "a.csv", "x\n"));
  EXPECT_EQ(content_of(folder / "a.csv"), "h\nx\n");
}

TEST_F(AtomicFileTest, ADeviceOrPipeIsLeftWhatItIs) {
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(
      error_of([&] { write_atomically(pipe, "text"); }),
      "bad_file: cannot write `" + pipe.string() + "`: it is a device or a pipe; give the name of a file");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(AtomicFileTest, IsOfTheModeAskedFor) {
  write_atomically(folder / "history", "line\n", Durable::no, 0600);
  EXPECT_EQ(fs::status(folder / "history").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFileTest, WrittenInPiecesStandsOnlyWhenItIsWhole) {
  AtomicFile file(folder / "a.txt", FileWords::data);
  file.write("first, ");
  EXPECT_EQ(content_of(file.temporary()), "first, ");
  file.write("second");
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  file.commit(Durable::yes);
  EXPECT_EQ(content_of(folder / "a.txt"), "first, second");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST_F(AtomicFileTest, OfDataIsRefusedInTheWordsOfData) {
  const std::string folder_named = "\"" + folder.string() + "\"";
  EXPECT_EQ(
      error_of([&] { AtomicFile(folder / "missing" / "a.npy", FileWords::data); }),
      "bad_file: there is no directory \"" + (folder / "missing").string() + "\" to write in; make it first");
  EXPECT_EQ(error_of([&] { AtomicFile(folder, FileWords::data); }),
            "bad_file: " + folder_named + " is a directory; give the name of a file in it");
  AtomicFile never_written(folder / "a.npy", FileWords::data);
  EXPECT_EQ(error_of([&] { never_written.commit(); }),
            "bad_file: \"" + (folder / "a.npy").string() +
                "\" cannot be written: No such file or directory; check permission and space on the disk");
}

class PartFile : public InFolder {
 protected:
  fs::path make(const fs::path& file) const {
    std::ofstream(file) << "part";
    return file;
  }
  // From an ended process.
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
};

// Processes of two containers can have the same number.
TEST_F(PartFile, NoTwoNamesAreOne) {
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

TEST_F(PartFile, IsAbandonedWhenItsWriterHasEndedOrIsSilentForADay) {
  const fs::path own = make(part_beside(folder / "a.csv")), dead = left_by_the_dead(folder / "a.csv"),
                 elsewhere = make(folder / ".a.00000000-1-0123456789abcdef.part.csv");
  EXPECT_FALSE(is_abandoned(own));
  EXPECT_TRUE(is_abandoned(dead));
  EXPECT_FALSE(is_abandoned(elsewhere));
  EXPECT_FALSE(is_abandoned(make(folder / "a.csv")));
  fs::last_write_time(elsewhere, fs::file_time_type::clock::now() - std::chrono::hours(25));
  EXPECT_TRUE(is_abandoned(elsewhere));
}

TEST_F(PartFile, IsSweptAsAsked) {
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

TEST_F(PartFile, FoldersOfAKilledProcessAreRemovedByTheNextOne) {
  const pid_t child = ::fork();
  if (child == 0) {
    const TemporaryFolder left("picture", folder);
    write_atomically(left.path() / "script", "plot x");
    ::_exit(fs::exists(left.path()) ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  const auto folders = [&] { return std::distance(fs::directory_iterator(folder), {}); };
  ASSERT_EQ(folders(), 1);
  {
    const TemporaryFolder own("rank", folder), other("rank", folder);
    EXPECT_NE(own.path(), other.path());
    EXPECT_EQ(fs::status(own.path()).permissions(), fs::perms::owner_all);
    EXPECT_EQ(folders(), 2);
  }
  EXPECT_EQ(folders(), 0);
}

}  // namespace
}  // namespace asperity::atomic_file_test
