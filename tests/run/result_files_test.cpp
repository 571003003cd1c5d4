// SPDX-License-Identifier: GPL-3.0-or-later
// Stored results return bit for bit, damaged files are ignored, the folder has a limit.
#include "engine/run/result_files.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>

#include "engine/core/program_identity.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::result_files_test {
namespace {

class ResultFilesTest : public InFolder {
 protected:
  ResultFilesSetup setup(const std::string& name = "store") const {
    ResultFilesSetup made;
    made.folder = folder / name;
    made.least_seconds = 0.01;
    made.build = "one";
    return made;
  }
  static void keep(ResultFiles& files, const std::string& key, const Field& field, double seconds = 1) {
    ResultFacts facts;
    facts.numbers = {
        {"approach", 1.0 / 3}, {"lowest", -0.0}, {"bound", std::numeric_limits<double>::infinity()}};
    facts.texts = {{"solver", "the one"}, {"empty", ""}};
    facts.cost = {seconds, 31.25, 4096};
    files.keep(key, "press", facts, {{"pressure", &field}, {"gap", &field}});
  }
  std::filesystem::path only_file(const std::string& name = "store") const {
    std::filesystem::path found;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name)) found = entry.path();
    return found;
  }
  static std::size_t count(const std::filesystem::path& where) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(where), {}));
  }
  Field ramp(int nx = 5, int ny = 3) const {
    Field field(nx, ny);
    for (std::size_t k = 0; k < field.size(); ++k) field[k] = std::sqrt(static_cast<double>(k));
    return field;
  }
};

TEST_F(ResultFilesTest, WhatIsKeptComesBackToTheBit) {
  const Field field = ramp();
  {
    ResultFiles files(setup());
    EXPECT_FALSE(files.find("key"));
    keep(files, "key", field);
    EXPECT_EQ(files.counts().kept, 1);
  }
  ResultFiles files(setup());
  std::optional<FoundResult> found = files.find("key");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->number("approach"), 1.0 / 3);
  EXPECT_TRUE(std::signbit(found->number("lowest")));
  EXPECT_EQ(found->number("bound"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(found->text("solver"), "the one");
  EXPECT_EQ(found->text("empty"), "");
  const Field again = found->take("gap");
  EXPECT_EQ(again.nx(), 5);
  EXPECT_EQ(again.ny(), 3);
  EXPECT_TRUE(std::ranges::equal(again.values(), field.values()));
  EXPECT_EQ(found->cost.seconds, 1);
  EXPECT_EQ(found->cost.transforms, 31.25);
  EXPECT_EQ(found->cost.bytes, 4096);
  EXPECT_EQ(files.counts().found, 1);
  EXPECT_EQ(files.counts().seconds_saved, 1);
  EXPECT_THROW(found->number("nothing"), Error);
}

TEST_F(ResultFilesTest, AnotherKeyOrBuildFindsNothing) {
  ResultFiles files(setup());
  keep(files, "key", ramp());
  EXPECT_FALSE(files.find("another"));
  ResultFilesSetup other = setup();
  other.build = "two";
  EXPECT_FALSE(ResultFiles(other).find("key"));
}

TEST_F(ResultFilesTest, CheapResultsAreNotWorthAFile) {
  ResultFiles files(setup());
  keep(files, "key", ramp(), 0.009);
  EXPECT_FALSE(std::filesystem::exists(folder / "store"));
}

// Cut at any length, or one bit flipped: never the result, never a crash.
TEST_F(ResultFilesTest, ATornOrAlteredFileIsNotTakenForTheResult) {
  ResultFiles writer(setup());
  keep(writer, "key", ramp());
  const std::filesystem::path file = only_file();
  const std::string whole = content_of(file);
  const auto write = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    write(whole.substr(0, length));
    ResultFiles files(setup());
    EXPECT_FALSE(files.find("key")) << length;
    ASSERT_EQ(files.notices().size(), 1U) << length;
    EXPECT_TRUE(files.notices().front().ends_with("; it was computed again")) << files.notices().front();
  }
  std::size_t harmless = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string altered = whole;
    altered[at] = static_cast<char>(altered[at] ^ 4);
    write(altered);
    std::optional<FoundResult> found = ResultFiles(setup()).find("key");
    if (!found) continue;
    ++harmless;  // padding, for example
    EXPECT_EQ(found->number("approach"), 1.0 / 3);
    EXPECT_TRUE(std::ranges::equal(found->take("pressure").values(), ramp().values()));
    EXPECT_TRUE(std::ranges::equal(found->take("gap").values(), ramp().values()));
  }
  EXPECT_LT(harmless, whole.size() / 2);
  // A result of another key.
  write(whole);
  ResultFilesSetup elsewhere = setup("elsewhere");
  ResultFiles others(elsewhere);
  keep(others, "another", ramp());
  std::filesystem::copy_file(only_file("elsewhere"), file, std::filesystem::copy_options::overwrite_existing);
  EXPECT_FALSE(ResultFiles(setup()).find("key"));
}

TEST_F(ResultFilesTest, WhatAnotherFolderHasIsBroughtOver) {
  {
    ResultFiles earlier(setup("earlier"));
    keep(earlier, "key", ramp());
  }
  ResultFilesSetup next = setup();
  next.also = {folder / "missing", folder / "earlier"};
  EXPECT_TRUE(ResultFiles(next).find("key"));
  std::filesystem::remove_all(folder / "earlier");
  EXPECT_TRUE(ResultFiles(setup()).find("key"));
}

TEST_F(ResultFilesTest, WhatWasUsedLongestAgoMakesRoom) {
  const Field field = ramp(64, 64);  // 32 KiB; two per result
  ResultFilesSetup limited = setup();
  limited.most_bytes = 250 << 10;
  {
    ResultFiles files(limited);
    for (const char* key : {"first", "second", "third"}) keep(files, key, field);
    EXPECT_EQ(count(limited.folder), 3U);
    keep(files, "fourth", field);  // all three are of this run
    EXPECT_EQ(count(limited.folder), 3U);
    ASSERT_EQ(files.notices().size(), 1U);
    EXPECT_NE(files.notices().front().find("results of this run exceed"), std::string::npos);
  }
  for (const auto& entry : std::filesystem::directory_iterator(limited.folder))
    std::filesystem::last_write_time(entry, entry.last_write_time() - std::chrono::hours(1));
  ResultFiles files(limited);
  EXPECT_TRUE(files.find("first"));
  keep(files, "fourth", field);
  EXPECT_EQ(count(limited.folder), 3U);
  EXPECT_TRUE(files.find("first"));
  EXPECT_TRUE(files.find("fourth"));
  EXPECT_NE(files.find("second").has_value(), files.find("third").has_value());
  ResultFilesSetup tiny = setup("tiny");
  tiny.most_bytes = 1000;
  ResultFiles nothing(tiny);
  keep(nothing, "key", field);
  EXPECT_EQ(count(tiny.folder), 0U);
}

// One user cannot fill a shared folder.
TEST_F(ResultFilesTest, OneAddsNoMoreThanItMay) {
  const Field field = ramp(64, 64);
  ResultFilesSetup shared = setup();
  shared.most_bytes = unlimited;
  {
    ResultFiles files(shared);
    keep(files, "of others", field);
  }
  shared.most_added = 150 << 10;
  ResultFiles files(shared);
  EXPECT_TRUE(files.find("of others"));
  for (const char* key : {"first", "second", "third"}) keep(files, key, field);
  EXPECT_EQ(files.counts().kept, 2);
  EXPECT_EQ(count(shared.folder), 3U);
  ASSERT_EQ(files.notices().size(), 1U);
  EXPECT_NE(files.notices().front().find("150 KiB that it may add to its store"), std::string::npos)
      << files.notices().front();
}

TEST_F(ResultFilesTest, PartsOfKilledWritersGoAndOthersCount) {
  const Field field = ramp(64, 64);
  ResultFilesSetup limited = setup();
  limited.most_bytes = 250 << 10;
  std::filesystem::create_directories(limited.folder);
  const std::filesystem::path old = limited.folder / ".x.00000000-1-0123456789abcdef.part.result",
                              now = limited.folder / ".y.00000000-1-0123456789abcdef.part.result";
  for (const auto& part : {old, now}) std::ofstream(part) << std::string(200 << 10, 'x');
  std::filesystem::last_write_time(old,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(48));
  ResultFiles files(limited);
  EXPECT_FALSE(std::filesystem::exists(old));
  EXPECT_TRUE(std::filesystem::exists(now));
  keep(files, "key", field);
  EXPECT_EQ(files.counts().kept, 0);
  EXPECT_TRUE(std::filesystem::exists(now));  // another process writes the file
}

TEST_F(ResultFilesTest, TheLimitIsToldInItsOwnUnit) {
  ResultFilesSetup limited = setup();
  limited.most_bytes = 3 << 10;
  ResultFiles files(limited);
  keep(files, "key", ramp(64, 64));
  ASSERT_EQ(files.notices().size(), 1U);
  EXPECT_NE(files.notices().front().find("exceed the 3 KiB of its store"), std::string::npos)
      << files.notices().front();
}

TEST_F(ResultFilesTest, AFolderThatCannotBeMadeIsNoticedAndNothingElse) {
  std::ofstream(folder / "store") << "a file";
  ResultFiles files(setup());
  keep(files, "key", ramp());
  keep(files, "another", ramp());
  EXPECT_EQ(files.counts().kept, 0);
  ASSERT_EQ(files.notices().size(), 1U);
  EXPECT_NE(files.notices().front().find("could not be stored"), std::string::npos);
}

TEST_F(ResultFilesTest, NothingIsKeptBeforeTheDiskHasWhatItNeeds) {
  ResultFilesSetup made = setup();
  made.needed = {folder / "script.lua", folder};
  ResultFiles files(made);
  keep(files, "key", ramp());
  EXPECT_EQ(files.counts().kept, 0);
  ASSERT_EQ(files.notices().size(), 1U);
  EXPECT_NE(files.notices().front().find("script.lua` on the disk: No such file"), std::string::npos)
      << files.notices().front();
  std::ofstream(folder / "script.lua") << "return 1";
  keep(files, "key", ramp());
  EXPECT_EQ(files.counts().kept, 1);
}

TEST(BuildIdentity, IsAlwaysTheSame) {
  EXPECT_EQ(build_identity(), build_identity());
  EXPECT_GE(build_identity().size(), 32U);
}

}  // namespace
}  // namespace asperity::result_files_test
