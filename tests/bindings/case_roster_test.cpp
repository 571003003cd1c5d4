// SPDX-License-Identifier: GPL-3.0-or-later
// The list of an ensemble's cases in a shared store.
#include "bindings/lua/ensemble/case_roster.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "engine/run/result_files.hpp"

namespace asperity::lua::case_roster_test {
namespace {

namespace fs = std::filesystem;

class Store {
 public:
  Store() {
    std::string pattern = (fs::temp_directory_path() / "asperity-roster-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~Store() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  void keep(const std::string& key, const std::string& build, const std::string& failure = {}) const {
    ResultFiles files({.folder = folder, .also = {}, .build = build, .needed = {}});
    ResultFacts facts;
    facts.however_cheap = facts.one_of_many = true;
    if (!failure.empty()) facts.texts = {{"failure", failure}};
    files.keep(key, "lab.ensemble", facts, {});
  }

  fs::path folder;
};

CaseRoster roster_of(const std::string& build) {
  CaseRoster roster;
  roster.script = "study.lua";
  roster.place = "at study.lua:2";
  roster.build = build;
  roster.ensemble = 2;
  roster.shards = 3;
  return roster;
}

RosterEntry entry(std::size_t k) {
  const std::string number = std::to_string(k + 1);
  return {"case k = " + number, {"case plain " + number, "case drawn " + number}};
}

bool has_room(std::int64_t) { return true; }

TEST(CaseRoster, IsReadAsItWasWritten) {
  const Store store;
  note_roster(store.folder, "script", roster_of("aa"), 4, entry, has_room);
  note_roster(store.folder, "script", roster_of("aa"), 4, entry, has_room);
  note_roster(store.folder, "script", roster_of("bb"), 4, entry, has_room);
  std::ofstream(store.folder / "ensembles" / "torn.json") << "{\"script\":";
  const std::vector<CaseRoster> rosters = rosters_in(store.folder);
  ASSERT_EQ(rosters.size(), 2U);
  EXPECT_EQ(rosters[0].build, "aa");
  EXPECT_EQ(rosters[1].build, "bb");
  EXPECT_EQ(rosters[0].place, "at study.lua:2");
  EXPECT_EQ(rosters[0].ensemble, 2);
  EXPECT_EQ(rosters[0].shards, 3);
  ASSERT_EQ(rosters[0].cases.size(), 4U);
  EXPECT_EQ(rosters[0].cases[3].name, "case k = 4");
  EXPECT_EQ(rosters[0].cases[3].keys, entry(3).keys);
  EXPECT_TRUE(rosters_in(store.folder / "nowhere").empty());
}

TEST(CaseRoster, CountsAResultWhateverFailedBeforeOrAfterIt) {
  const Store store;
  store.keep("failed case plain 2", "aa", "out of memory");
  store.keep("failed case plain 3", "aa", "not yet");
  store.keep("case drawn 3", "aa");
  store.keep("case plain 4", "aa");
  store.keep("failed case plain 4", "aa", "too late");
  store.keep("case plain 1", "bb");
  note_roster(store.folder, "script", roster_of("aa"), 4, entry, has_room);
  const StoreReport report = look_up(store.folder, rosters_in(store.folder).at(0));
  EXPECT_EQ(report.missing, std::vector<std::size_t>{0});
  ASSERT_EQ(report.failed.size(), 1U);
  EXPECT_EQ(report.failed[0].first, 1U);
  EXPECT_EQ(report.failed[0].second, "out of memory");
}

TEST(CaseRoster, IsLeftOutIfTheStoreHasNoRoomForIt) {
  const Store store;
  std::int64_t bytes = 0;
  note_roster(store.folder, "script", roster_of("aa"), 4, entry, [&](std::int64_t asked) {
    bytes = asked;
    return false;
  });
  EXPECT_TRUE(rosters_in(store.folder).empty());
  note_roster(store.folder, "script", roster_of("aa"), 4, entry, has_room);
  const std::filesystem::directory_iterator written(store.folder / "ensembles");
  EXPECT_EQ(static_cast<std::int64_t>(written->file_size()), bytes);
}

TEST(CaseRoster, NamesWholeShardsAndElseCases) {
  EXPECT_EQ(cases_text({1, 2, 4, 5, 7, 8}, 11, 3), "cases 2 to 3, 5 to 6 and 8 to 9");
  EXPECT_EQ(cases_text({1, 2, 4, 5, 7, 8, 10, 11}, 12, 3), "shards 2/3 and 3/3");
  EXPECT_EQ(cases_text({1, 4, 7, 10}, 11, 3), "shard 2/3");
  EXPECT_EQ(cases_text({1, 4, 7}, 11, 3), "cases 2, 5 and 8");
  EXPECT_EQ(cases_text({4}, 5, 0), "case 5");
  EXPECT_EQ(cases_text({1}, 2, 5), "shard 2/5");
  std::vector<std::size_t> odd;
  for (std::size_t k = 0; k < 60; k += 2) odd.push_back(k);
  EXPECT_TRUE(cases_text(odd, 60, 0).ends_with(", 39 and 10 more"));
}

}  // namespace
}  // namespace asperity::lua::case_roster_test
