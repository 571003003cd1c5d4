// SPDX-License-Identifier: GPL-3.0-or-later
// Many small results per file, visible to other processes at once and synced together.
#include "engine/core/files/result_log.hpp"

#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <limits>
#include <thread>

#include "engine/core/digest.hpp"
#include "engine/run/result_files.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::result_log_test {
namespace {
// Network file systems may return fewer bytes than requested, or be interrupted. 0: as the kernel does.
std::atomic<std::size_t> most_at_once = 0, reads = 0;
}  // namespace

// In place of the C library's.
extern "C" ssize_t pread(int file, void* to, size_t length, off_t offset) {
  const std::size_t most = most_at_once;
  if (most > 0 && reads++ % 3 == 1) {
    errno = EINTR;
    return -1;
  }
  return ::syscall(SYS_pread64, file, to, most > 0 ? std::min(length, most) : length, offset);
}

namespace {

class ResultLogTest : public InFolder {
 protected:
  std::filesystem::path store() const { return folder / "store" / ResultLog::folder_name; }
  ResultLog::Note note() {
    return [this](const std::string&, std::string sentence) { notices.push_back(std::move(sentence)); };
  }
  static std::string name(int k) { return Digester().add(k).hex(); }
  static std::string bytes(int k) {
    return std::string(static_cast<std::size_t>(100 + k % 7), static_cast<char>(k));
  }
  std::filesystem::path only_file() const { return std::filesystem::directory_iterator(store())->path(); }
  void SetUp() override {
    InFolder::SetUp();
    std::filesystem::create_directory(folder / "store");
  }
  static std::string found(ResultLog& log, int k) {
    const std::optional<ResultLog::Found> record = log.find(name(k));
    return record ? record->bytes : "none";
  }

  ResultFilesSetup setup() const {
    ResultFilesSetup made;
    made.folder = folder / "store";
    made.build = "one";
    return made;
  }
  static void keep(ResultFiles& files, const std::string& key, double value, double seconds = 1) {
    ResultFacts facts;
    facts.one_of_many = true;
    facts.numbers = {{"value", value}};
    facts.texts = {{"what", "a case"}};
    facts.cost = {seconds, 3.5, 64};
    Field field(3, 1);
    field[1] = -0.0;
    field[2] = value;
    files.keep(key, "lab.ensemble", facts, {{"case", &field}});
  }

  std::vector<std::string> notices;
};

TEST_F(ResultLogTest, ThousandsStandInOneFileAndAreFoundToTheBit) {
  {
    ResultLog log(store(), note());
    EXPECT_EQ(found(log, 0), "none");
    for (int k = 0; k < 3000; ++k) log.keep(name(k), bytes(k));
    EXPECT_EQ(found(log, 2999), bytes(2999));
  }
  EXPECT_EQ(files_in(store()), 1U);
  ResultLog log(store(), note());
  for (int k = 0; k < 3000; ++k) ASSERT_EQ(found(log, k), bytes(k)) << k;
  EXPECT_EQ(found(log, 3000), "none");
  EXPECT_TRUE(notices.empty());
}

TEST_F(ResultLogTest, RecordsThatComeInPiecesAreWhole) {
  {
    ResultLog log(store(), note());
    for (int k = 0; k < 3; ++k) log.keep(name(k), bytes(k));
  }
  ResultLog log(store(), note());
  most_at_once = 37;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(found(log, k), bytes(k)) << k;
  most_at_once = 0;
  EXPECT_GT(reads, 3U);
  EXPECT_TRUE(notices.empty());
}

TEST_F(ResultLogTest, OthersFindWhatComesWhileItComes) {
  ResultLog one(store(), note()), other(store(), note());
  EXPECT_EQ(found(other, 1), "none");
  for (int k = 0; k < 50; ++k) {
    one.keep(name(2 * k), bytes(2 * k));
    EXPECT_EQ(found(other, 2 * k), bytes(2 * k)) << k;
    other.keep(name(2 * k + 1), bytes(2 * k + 1));
    EXPECT_EQ(found(one, 2 * k + 1), bytes(2 * k + 1)) << k;
  }
  EXPECT_EQ(files_in(store()), 2U);
}

TEST_F(ResultLogTest, SeveralThreadsKeepAndFind) {
  ResultLog log(store(), note());
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&log, t] {
        for (int k = t; k < 800; k += 4) {
          log.keep(name(k), bytes(k));
          log.find(name(799 - k));
        }
      });
  }
  ResultLog again(store(), note());
  for (int k = 0; k < 800; ++k) ASSERT_EQ(found(again, k), bytes(k)) << k;
}

// A kill or power cut leaves complete records usable.
TEST_F(ResultLogTest, ATornEndLosesNoRecordBeforeIt) {
  {
    ResultLog log(store(), note());
    for (int k = 0; k < 3; ++k) log.keep(name(k), bytes(k));
  }
  const std::filesystem::path file = only_file();
  const std::string whole = content_of(file);
  std::size_t ends = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    ResultLog log(store(), note());
    std::size_t end = 0;
    for (int k = 0; k < 3; ++k) {
      end += bytes(k).size() + static_cast<std::size_t>(ResultLog::bytes_beside);
      ASSERT_EQ(found(log, k), end <= length ? bytes(k) : "none") << length << " " << k;
      if (end == length) ++ends;
    }
  }
  EXPECT_EQ(ends, 2U);
  EXPECT_TRUE(notices.empty());
}

TEST_F(ResultLogTest, AnAlteredRecordIsToldAndNotTaken) {
  {
    ResultLog log(store(), note());
    for (int k = 0; k < 3; ++k) log.keep(name(k), bytes(k));
  }
  const std::filesystem::path file = only_file();
  const std::string whole = content_of(file);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    notices.clear();
    std::string altered = whole;
    altered[at] = static_cast<char>(altered[at] ^ 4);
    std::ofstream(file, std::ios::binary) << altered;
    ResultLog log(store(), note());
    int lost = 0;
    for (int k = 0; k < 3; ++k) {
      const std::string record = found(log, k);
      ASSERT_TRUE(record == bytes(k) || record == "none") << at;
      if (record == "none") ++lost;
    }
    ASSERT_GE(lost, 1) << at;
    // A length beyond the end looks like an unfinished record.
    if (!notices.empty()) {
      ASSERT_TRUE(notices.front().ends_with("; it was computed again")) << notices.front();
    }
  }
  // A power cut leaves zeros.
  notices.clear();
  std::ofstream(file, std::ios::binary)
      << whole.substr(0, whole.size() - 100) + std::string(100, '\0') + std::string(200, '\0');
  ResultLog log(store(), note());
  EXPECT_EQ(found(log, 0), bytes(0));
  EXPECT_EQ(found(log, 1), bytes(1));
  EXPECT_EQ(found(log, 2), "none");
  EXPECT_FALSE(notices.empty());
}

TEST_F(ResultLogTest, WhatOthersTookAwayIsNotFoundAndWrittenElsewhere) {
  ResultLog log(store(), note());
  log.keep(name(1), bytes(1));
  std::filesystem::remove(only_file());
  EXPECT_EQ(found(log, 1), "none");
  log.keep(name(2), bytes(2));
  log.wait_for_disk();
  log.keep(name(3), bytes(3));
  EXPECT_EQ(files_in(store()), 1U);
  EXPECT_EQ(found(log, 3), bytes(3));
}

// A wait for the disk notices that the file was removed; until then the log writes on into it.
TEST_F(ResultLogTest, WaitsForTheDiskAtMostOnceASecond) {
  ResultLog log(store(), note());
  const auto begun = std::chrono::steady_clock::now();
  const std::filesystem::path first = log.keep(name(1), bytes(1));
  std::filesystem::remove(first);
  log.keep(name(2), bytes(2));
  const std::filesystem::path third = log.keep(name(3), bytes(3));
  if (std::chrono::steady_clock::now() - begun < std::chrono::seconds(1)) {
    EXPECT_EQ(third, first);
  }
  log.wait_for_disk();
  EXPECT_NE(log.keep(name(4), bytes(4)), first);
}

// A service may start without standard input; the next file that it opens is number 0.
TEST_F(ResultLogTest, KeepsAndFindsWithoutStandardInput) {
  struct WithoutInput {
    const int input = ::dup(0);
    WithoutInput() { ::close(0); }
    ~WithoutInput() {
      ::dup2(input, 0);
      ::close(input);
    }
  };
  ResultLog log(store(), note());
  log.keep(name(1), bytes(1));
  log.keep(name(2), bytes(2));
  const WithoutInput without;
  errno = EIO;  // of an earlier call
  EXPECT_NO_THROW(log.wait_for_disk());
  EXPECT_EQ(found(log, 1), bytes(1));
  ResultLog other(store(), note());
  EXPECT_EQ(found(other, 2), bytes(2));
  other.keep(name(3), bytes(3));
  EXPECT_EQ(found(other, 3), bytes(3));
  EXPECT_EQ(found(log, 3), bytes(3));
}

TEST_F(ResultLogTest, ResultsThatAreOneOfManyShareAFile) {
  {
    ResultFiles files(setup());
    for (int k = 0; k < 100; ++k) keep(files, "case " + std::to_string(k), k, 0.0021);
    keep(files, "cheap", 1, 0.0019);
    EXPECT_EQ(files.counts().kept, 100);
    files.bring_to_disk();
    EXPECT_TRUE(files.notices().empty());
  }
  EXPECT_EQ(files_in(folder / "store"), 1U);
  EXPECT_EQ(files_in(store()), 1U);
  ResultFiles files(setup());
  EXPECT_FALSE(files.find("cheap"));
  std::optional<FoundResult> found = files.find("case 41");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->number("value"), 41);
  EXPECT_EQ(found->text("what"), "a case");
  EXPECT_EQ(found->cost.seconds, 0.0021);
  EXPECT_EQ(found->cost.transforms, 3.5);
  EXPECT_EQ(found->take("case")[2], 41);
  ResultFilesSetup other = setup();
  other.build = "two";
  EXPECT_FALSE(ResultFiles(other).find("case 41"));
}

TEST_F(ResultLogTest, WhatTheThreadItselfDidNotSpendIsNotWorthAFile) {
  ResultFiles files(setup());
  ResultFacts facts;
  facts.cost.seconds = 1;
  facts.processor_seconds = 0.001;
  files.keep("waited", "press", facts, {});
  EXPECT_EQ(files.counts().kept, 0);
  facts.processor_seconds = 0.5;
  files.keep("worked", "press", facts, {});
  EXPECT_EQ(files.counts().kept, 1);
}

TEST_F(ResultLogTest, RecordsOfAnotherFolderAreBroughtOver) {
  ResultFilesSetup next = setup();
  next.folder = folder / "next";
  next.also = {folder / "missing", folder / "store"};
  {
    ResultFiles files(setup());
    keep(files, "case", 0.25);
  }
  EXPECT_EQ(ResultFiles(next).find("case")->number("value"), 0.25);
  std::filesystem::remove_all(folder / "store");
  next.also.clear();
  std::optional<FoundResult> found = ResultFiles(next).find("case");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->number("value"), 0.25);
}

TEST_F(ResultLogTest, LogsCountAgainstTheLimitAndOldOnesMakeRoom) {
  ResultFilesSetup limited = setup();
  limited.most_bytes = 30 << 10;
  {
    ResultFiles files(limited);
    for (int k = 0; k < 1000; ++k) keep(files, "old " + std::to_string(k), k);
    EXPECT_GT(files.counts().kept, 50);
    EXPECT_LT(files.counts().kept, 200);
    ASSERT_EQ(files.notices().size(), 1U);
    EXPECT_NE(files.notices().front().find("exceed the 30 KiB of its store"), std::string::npos);
  }
  EXPECT_LE(std::filesystem::file_size(only_file()), 30U << 10);
  std::filesystem::last_write_time(only_file(),
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  ResultFiles files(limited);
  keep(files, "new", 1);
  EXPECT_EQ(files.counts().kept, 1);
  EXPECT_EQ(files_in(store()), 1U);
  EXPECT_FALSE(files.find("old 1"));
  EXPECT_TRUE(files.find("new"));
}

}  // namespace
}  // namespace asperity::result_log_test
